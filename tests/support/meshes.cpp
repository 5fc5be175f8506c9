// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"

#include "vdbounce/base/triangle_distance.h"

#include <algorithm>
#include <limits>
#include <map>

namespace vdbounce::test {

TriangleMesh boxMesh(const Vec3d& half, const Vec3d& centre)
{
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        mesh.points.push_back(centre + sign.cwiseProduct(half));
    }
    const std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

TriangleMesh sphereMesh(double radius, int level, const Vec3d& centre)
{
    TriangleMesh mesh;
    mesh.points = {Vec3d(1, 0, 0), Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1), Vec3d(0, 0, -1)};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int l = 0; l < level; ++l) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [at, isNew] =
                middles.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(mesh.points.size()));
            if (isNew) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
            return at->second;
        };
        std::vector<TriangleMesh::Triangle> finer;
        for (const auto& t : mesh.triangles) {
            const std::uint32_t ab = middle(t[0], t[1]);
            const std::uint32_t bc = middle(t[1], t[2]);
            const std::uint32_t ca = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (Vec3d& p : mesh.points) p = centre + radius * p;
    return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b)
{
    TriangleMesh mesh = a;
    const auto offset = std::uint32_t(a.points.size());
    mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
    for (const auto& t : b.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return mesh;
}

TriangleMesh flipped(TriangleMesh mesh)
{
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

double bruteForceDistance(const TriangleMesh& mesh, const Vec3d& p)
{
    double nearest2 = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d q = closestPointOnTriangle(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
        nearest2 = std::min(nearest2, (q - p).squaredNorm());
    }
    return std::sqrt(nearest2);
}

bool bruteForceInside(const TriangleMesh& mesh, const Vec3d& p)
{
    double winding = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        winding += windingContribution(p, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    }
    return winding > 0.5;
}

} // namespace vdbounce::test
