// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vdbounce {

/// Puts a mesh together from a reader's points and faces and checks both on the way. Places in errors are
/// what the reader passes, "bunny.obj:12" or "bunny.stl: triangle 7".
class MeshAssembly {
public:
    explicit MeshAssembly(std::string file) : file_(std::move(file)) {}

    /// Refuses NaN and infinite positions.
    void addPoint(const Vec3d& point, const std::string& place);
    void addPoint(const Vec3d& point)
    {
        if (point.allFinite()) {
            mesh_.points.push_back(point);
        } else {
            addPoint(point, file_ + ": point " + std::to_string(mesh_.points.size()));
        }
    }

    /// Corners are zero-based, of any count from 3; refuses those that are not among the points so far.
    template <class PlaceName> void addFace(const std::vector<std::int64_t>& corners, const PlaceName& place)
    {
        if (!soundCorners(corners)) refuseFace(corners, place());
        appendFace(corners);
    }

    std::size_t pointCount() const { return mesh_.points.size(); }

    /// The mesh; refuses one without faces.
    TriangleMesh finish();

private:
    bool soundCorners(const std::vector<std::int64_t>& corners) const;
    [[noreturn]] void refuseFace(const std::vector<std::int64_t>& corners, const std::string& place) const;
    void appendFace(const std::vector<std::int64_t>& corners);

    std::string file_;
    TriangleMesh mesh_;
    std::vector<std::uint32_t> corners_;
};

} // namespace vdbounce
