// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/mesh_assembly.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/polygon.h"

#include <limits>

namespace vdbounce {

void MeshAssembly::addPoint(const Vec3d& point, const std::string& place)
{
    if (!point.allFinite()) {
        throw InputError(place,
                         "position (" + numberText(point.x()) + ", " + numberText(point.y()) + ", " +
                             numberText(point.z()) + ") is not finite",
                         "correct it or remove the faces that use it");
    }
    if (mesh_.points.size() >= std::numeric_limits<std::uint32_t>::max()) {
        throw InputError(place, "more than 4294967295 points", "split the mesh");
    }
    mesh_.points.push_back(point);
}

bool MeshAssembly::soundCorners(const std::vector<std::int64_t>& corners) const
{
    if (corners.size() < 3) return false;
    const auto count = static_cast<std::int64_t>(mesh_.points.size());
    for (std::int64_t corner : corners) {
        if (corner < 0 || corner >= count) return false;
    }
    return true;
}

void MeshAssembly::refuseFace(const std::vector<std::int64_t>& corners, const std::string& place) const
{
    if (corners.size() < 3) {
        throw InputError(place, "a face with " + std::to_string(corners.size()) + " corners",
                         "a face needs at least 3");
    }
    for (std::int64_t corner : corners) {
        if (corner < 0 || corner >= static_cast<std::int64_t>(mesh_.points.size())) {
            throw InputError(place,
                             "face corner " + std::to_string(corner) + " (counted from 0) is out of range, there are " +
                                 std::to_string(mesh_.points.size()) + " points",
                             "correct the index or export the mesh again");
        }
    }
    throw InputError(place, "an unsound face", "export the mesh again");
}

void MeshAssembly::appendFace(const std::vector<std::int64_t>& corners)
{
    corners_.assign(corners.begin(), corners.end());
    appendPolygon(mesh_, corners_);
}

TriangleMesh MeshAssembly::finish()
{
    if (mesh_.triangles.empty()) {
        throw InputError(file_, "holds no faces (" + std::to_string(mesh_.points.size()) + " points)",
                         "export the mesh with its faces");
    }
    return std::move(mesh_);
}

} // namespace vdbounce
