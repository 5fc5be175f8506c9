// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/cell_triangles.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vdbounce {
namespace {

using Eigen::Vector3f;

// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2). Each tetrahedron goes from corner 0 to corner 7 along three
// edges.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

struct Corner {
    Vector3f position;
    float value;
};

Vector3f crossing(const Corner& a, const Corner& b)
{
    const double part = double(a.value) / (double(a.value) - double(b.value));
    return a.position + float(part) * (b.position - a.position);
}

void addTetrahedron(const Corner (&corner)[4], std::vector<PatchTriangle>& triangles)
{
    const Corner* inside[4];
    const Corner* outside[4];
    int ins = 0;
    int outs = 0;
    for (const Corner& c : corner) {
        if (c.value < 0.0f) {
            inside[ins++] = &c;
        } else {
            outside[outs++] = &c;
        }
    }
    if (ins == 0 || outs == 0) return;
    if (ins == 2) {
        const Vector3f p[4] = {crossing(*inside[0], *outside[0]), crossing(*inside[0], *outside[1]),
                               crossing(*inside[1], *outside[1]), crossing(*inside[1], *outside[0])};
        triangles.push_back({p[0], p[1], p[2]});
        triangles.push_back({p[0], p[2], p[3]});
        return;
    }
    const Corner* alone = ins == 1 ? inside[0] : outside[0];
    const Corner* const* others = ins == 1 ? outside : inside;
    triangles.push_back({crossing(*alone, *others[0]), crossing(*alone, *others[1]), crossing(*alone, *others[2])});
}

// As triangles that are points. A solid's corner that one of these diagonals ends in would be cut off, as much as 0.8
// voxels deep, even where the value at its very tip is zero.
void addCrossingsOfOtherDiagonals(const Corner (&corners)[8], std::vector<PatchTriangle>& triangles)
{
    for (int a = 0; a < 8; ++a) {
        for (int b = a + 1; b < 8; ++b) {
            const bool edge = (a & b) == a || (a & b) == b;
            if (edge || (corners[a].value < 0.0f) == (corners[b].value < 0.0f)) continue;
            const Vector3f point = crossing(corners[a], corners[b]);
            triangles.push_back({point, point, point});
        }
    }
}

} // namespace

void addTriangles(const float* cell, const VoxelMetric& metric, SurfacePatch& patch,
                  std::vector<PatchTriangle>& triangles)
{
    Corner corners[8];
    for (int c = 0; c < 8; ++c) {
        const int x = c & 1;
        const int y = c >> 1 & 1;
        const int z = c >> 2;
        corners[c].value = cell[SampleBlock::kStrideX * x + SampleBlock::kStrideY * y + SampleBlock::kStrideZ * z];
        corners[c].position = (metric.toSpace * Vec3d(x - 0.5, y - 0.5, z - 0.5)).cast<float>();
    }
    const std::size_t first = triangles.size();
    for (const auto& t : kTetrahedra) {
        const Corner tetrahedron[4] = {corners[t[0]], corners[t[1]], corners[t[2]], corners[t[3]]};
        addTetrahedron(tetrahedron, triangles);
    }
    addCrossingsOfOtherDiagonals(corners, triangles);
    patch.firstTriangle = std::uint32_t(first);
    patch.triangles = std::uint32_t(triangles.size() - first);
    // Its point is the one closest to the mean of all, which may lie beside the surface.
    Vector3f mean = Vector3f::Zero();
    for (std::size_t t = first; t < triangles.size(); ++t)
        mean += (triangles[t][0] + triangles[t][1] + triangles[t][2]) / float(3 * patch.triangles);
    Vector3f best = triangles[first][0];
    for (std::size_t t = first; t < triangles.size(); ++t) {
        const Vector3f found = closestPoint(triangles[t], mean);
        if ((found - mean).squaredNorm() < (best - mean).squaredNorm()) best = found;
    }
    patch.reach = 0.0f;
    for (std::size_t t = first; t < triangles.size(); ++t) {
        for (const Vector3f& corner : triangles[t]) patch.reach = std::max(patch.reach, (corner - best).norm());
    }
    const Vec3d at = metric.toIndex * best.cast<double>();
    patch.cubic = Cubic{};
    for (int a = 0; a < 3; ++a) patch.at[a] = float(at[a]);
    // The side is told by the mean gradient, of signs only: values may differ by orders of magnitude.
    for (int c = 0; c < 8; ++c) {
        const float sign = corners[c].value < 0.0f ? -1.0f : 1.0f;
        for (int a = 0; a < 3; ++a) patch.cubic.c[1 + a] += (c >> a & 1) != 0 ? sign : -sign;
    }
}

// After Ericson, Real-Time Collision Detection, 5.1.5.
Vector3f closestPoint(const PatchTriangle& triangle, const Vector3f& p)
{
    const Vector3f& a = triangle[0];
    const Vector3f& b = triangle[1];
    const Vector3f& c = triangle[2];
    const Vector3f ab = b - a;
    const Vector3f ac = c - a;
    const auto part = [](float x, float y) { return y > 0.0f ? std::min(std::max(x / y, 0.0f), 1.0f) : 0.0f; };
    const float d1 = ab.dot(p - a);
    const float d2 = ac.dot(p - a);
    if (d1 <= 0.0f && d2 <= 0.0f) return a;
    const float d3 = ab.dot(p - b);
    const float d4 = ac.dot(p - b);
    if (d3 >= 0.0f && d4 <= d3) return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return a + part(d1, d1 - d3) * ab;
    const float d5 = ab.dot(p - c);
    const float d6 = ac.dot(p - c);
    if (d6 >= 0.0f && d5 <= d6) return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return a + part(d2, d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) return b + part(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b);
    const float sum = va + vb + vc;
    if (!(sum > 0.0f)) return a;
    return a + (vb / sum) * ab + (vc / sum) * ac;
}

} // namespace vdbounce
