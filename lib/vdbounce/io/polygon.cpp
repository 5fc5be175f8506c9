// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/polygon.h"

#include <Eigen/Geometry>

namespace vdbounce {
namespace {

Vec3d newellNormal(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& corners)
{
    Vec3d normal = Vec3d::Zero();
    const Vec3d& origin = points[corners[0]];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = points[corners[i]] - origin;
        const Vec3d b = points[corners[(i + 1) % corners.size()]] - origin;
        normal += a.cross(b);
    }
    return normal;
}

// Twice the signed area of a, b, c seen against `normal`.
double signedArea(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& normal)
{
    return (b - a).cross(c - a).dot(normal);
}

bool isEar(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& ring, std::size_t at,
           const Vec3d& normal)
{
    const std::size_t count = ring.size();
    const std::uint32_t before = ring[(at + count - 1) % count];
    const std::uint32_t here = ring[at];
    const std::uint32_t after = ring[(at + 1) % count];
    const Vec3d& a = points[before];
    const Vec3d& b = points[here];
    const Vec3d& c = points[after];
    if (signedArea(a, b, c, normal) <= 0.0) return false;
    for (std::uint32_t other : ring) {
        if (other == before || other == here || other == after) continue;
        const Vec3d& p = points[other];
        const bool inside = signedArea(a, b, p, normal) >= 0.0 && signedArea(b, c, p, normal) >= 0.0 &&
                            signedArea(c, a, p, normal) >= 0.0;
        if (inside) return false;
    }
    return true;
}

} // namespace

void appendPolygon(TriangleMesh& mesh, const std::vector<std::uint32_t>& corners)
{
    if (corners.size() == 3) {
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const Vec3d normal = newellNormal(mesh.points, corners);
    std::vector<std::uint32_t> ring = corners;
    while (ring.size() > 3) {
        std::size_t ear = 0;
        while (ear < ring.size() && !isEar(mesh.points, ring, ear, normal)) ++ear;
        if (ear == ring.size()) break;
        const std::size_t count = ring.size();
        mesh.triangles.push_back({ring[(ear + count - 1) % count], ring[ear], ring[(ear + 1) % count]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    for (std::size_t i = 2; i < ring.size(); ++i) mesh.triangles.push_back({ring[0], ring[i - 1], ring[i]});
}

} // namespace vdbounce
