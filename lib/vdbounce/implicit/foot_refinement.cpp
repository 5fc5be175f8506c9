// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/foot_refinement.h"

#include "vdbounce/implicit/cell_triangles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// Newton converges quadratically from a start within a voxel: the third step is below float rounding.
constexpr int kNewtonSteps = 3;

// A cubic is no longer trusted farther than this from the patch's own point, along any axis, voxels: there are other
// patches.
constexpr float kTrusted = 1.25f;

// A foot is good when the last step was shorter than this, voxels.
constexpr float kConverged = 0.02f;

// The lines from voxels to their feet meet where the determinant is 0; near that the surface's bend is left out.
constexpr float kSmallestDeterminant = 0.05f;

float dot(const float (&a)[3], const float (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The adjugate of a symmetric matrix (xx, yy, zz, xy, xz, yz), and its determinant.
struct Adjugate {
    float a[6];
    float determinant;

    explicit Adjugate(const float (&m)[6])
    {
        a[0] = m[1] * m[2] - m[5] * m[5];
        a[1] = m[0] * m[2] - m[4] * m[4];
        a[2] = m[0] * m[1] - m[3] * m[3];
        a[3] = m[4] * m[5] - m[3] * m[2];
        a[4] = m[3] * m[5] - m[4] * m[1];
        a[5] = m[3] * m[4] - m[5] * m[0];
        determinant = m[0] * a[0] + m[3] * a[3] + m[4] * a[4];
    }
    void apply(const float (&v)[3], float (&r)[3]) const
    {
        r[0] = a[0] * v[0] + a[3] * v[1] + a[4] * v[2];
        r[1] = a[3] * v[0] + a[1] * v[1] + a[5] * v[2];
        r[2] = a[4] * v[0] + a[5] * v[1] + a[2] * v[2];
    }
};

// One step of Newton's method towards the point u on the zero line of `cubic` that is closest to q; returns its length,
// the largest of its components.
float newtonStep(const Cubic& cubic, const VoxelMetric& metric, const float (&q)[3], float (&u)[3])
{
    float value = 0.0f;
    float gradient[3];
    float second[6];
    cubic.at(u, value, gradient, second);
    const float r[3] = {q[0] - u[0], q[1] - u[1], q[2] - u[2]};
    float mr[3];
    metric.apply(r, mr);
    const float lambda = dot(gradient, mr) / dot(gradient, gradient);
    float m[6];
    for (int i = 0; i < 6; ++i) m[i] = metric.g[i] + lambda * second[i];
    Adjugate inverse(m);
    if (!(inverse.determinant > kSmallestDeterminant)) inverse = Adjugate(metric.g);
    float alongGradient[3];
    float alongWay[3];
    inverse.apply(gradient, alongGradient);
    inverse.apply(mr, alongWay);
    const float mu = (dot(gradient, alongWay) + value * inverse.determinant) / dot(gradient, alongGradient);
    float length = 0.0f;
    for (int a = 0; a < 3; ++a) {
        const float step = (alongWay[a] - mu * alongGradient[a]) / inverse.determinant;
        length = std::max(length, std::abs(step));
        u[a] += step;
    }
    return length;
}

struct Foot {
    float way[3];
    float squared;
    bool upright; // the way to it is perpendicular to the surface
};

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Foot footOnCubic(const SurfacePatch& patch, const VoxelMetric& metric, const float (&q)[3], const float (&way)[3])
{
    float u[3];
    for (int a = 0; a < 3; ++a) u[a] = q[a] + way[a];
    float step = kInfinity;
    for (int i = 0; i < kNewtonSteps; ++i) step = newtonStep(patch.cubic, metric, q, u);
    bool good = step <= kConverged;
    for (int a = 0; a < 3; ++a) good = good && std::abs(u[a] - patch.at[a]) <= kTrusted;
    Foot foot{{u[0] - q[0], u[1] - q[1], u[2] - q[2]}, kInfinity, good};
    if (good) foot.squared = metric.squared(foot.way);
    return foot;
}

Foot footOnTriangles(const FittedSurface& surface, const SurfacePatch& patch, const VoxelMetric& metric,
                     const float (&q)[3])
{
    const Eigen::Vector3f from = (metric.toSpace * Vec3d(q[0], q[1], q[2])).cast<float>();
    Foot foot{{0.0f, 0.0f, 0.0f}, kInfinity, false};
    Eigen::Vector3f best = Eigen::Vector3f::Zero();
    for (std::uint32_t t = 0; t < patch.triangles; ++t) {
        const PatchTriangle& triangle = surface.triangles[patch.firstTriangle + t];
        const Eigen::Vector3f way = closestPoint(triangle, from) - from;
        if (!(way.squaredNorm() < foot.squared)) continue;
        foot.squared = way.squaredNorm();
        best = way;
        const Eigen::Vector3f normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        const float along = normal.dot(way);
        constexpr float kUprightSquared = 0.9f; // the cosine's: within 18 degrees
        foot.upright = along * along >= kUprightSquared * normal.squaredNorm() * way.squaredNorm();
    }
    const Vec3d way = metric.toIndex * best.cast<double>();
    for (int a = 0; a < 3; ++a) foot.way[a] = float(way[a]);
    return foot;
}

// The voxel seen from the centre of the patch's cell.
void fromCentre(const SurfacePatch& patch, const FootLeaf& leaf, int v, float (&q)[3])
{
    const Vec3i voxel = leaf.voxel(v);
    for (int a = 0; a < 3; ++a) q[a] = float(voxel[a] - patch.cell[a]) - 0.5f;
}

} // namespace

void refineFoot(const FittedSurface& surface, const VoxelMetric& metric, FootLeaf& leaf, int v)
{
    const SurfacePatch& patch = surface.patches[std::size_t(leaf.patch[v])];
    float q[3];
    fromCentre(patch, leaf, v, q);
    const float way[3] = {leaf.way[0][v], leaf.way[1][v], leaf.way[2][v]};
    const Foot foot =
        patch.triangles > 0 ? footOnTriangles(surface, patch, metric, q) : footOnCubic(patch, metric, q, way);
    if (patch.rim != 0 && !foot.upright) {
        leaf.patch[v] = FootLeaf::kNone;
        leaf.squared[v] = kInfinity;
        return;
    }
    // The start is on the surface only to a thousandth of a voxel, so a foot may be that much farther.
    constexpr float kSlack = 1.001f;
    constexpr float kSlackNear = 1e-4f;
    if (!(foot.squared <= kSlack * leaf.squared[v] + kSlackNear)) return;
    for (int a = 0; a < 3; ++a) leaf.way[a][v] = foot.way[a];
    leaf.squared[v] = foot.squared;
}

bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v)
{
    const SurfacePatch& patch = surface.patches[std::size_t(leaf.patch[v])];
    float q[3];
    fromCentre(patch, leaf, v, q);
    float gradient[3] = {patch.cubic.c[1], patch.cubic.c[2], patch.cubic.c[3]};
    if (patch.triangles == 0) {
        const float u[3] = {q[0] + leaf.way[0][v], q[1] + leaf.way[1][v], q[2] + leaf.way[2][v]};
        float value = 0.0f;
        float second[6];
        patch.cubic.at(u, value, gradient, second);
    }
    const float way[3] = {leaf.way[0][v], leaf.way[1][v], leaf.way[2][v]};
    return dot(gradient, way) <= 0.0f;
}

} // namespace vdbounce
