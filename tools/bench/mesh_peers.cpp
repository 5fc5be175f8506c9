// SPDX-License-Identifier: Apache-2.0
#include "bench/mesh_peers.h"

#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/util/NullInterrupter.h>

namespace vdbounce::bench {
namespace {

// A mesh as meshToVolume asks for it, whose function names these are.
class IndexSpaceMesh {
public:
    IndexSpaceMesh(const TriangleMesh& mesh, double voxelSize) : mesh_(mesh), voxelsPerUnit_(1.0 / voxelSize) {}

    std::size_t polygonCount() const { return mesh_.triangles.size(); }
    std::size_t pointCount() const { return mesh_.points.size(); }
    std::size_t vertexCount(std::size_t /*polygon*/) const { return 3; }

    void getIndexSpacePoint(std::size_t polygon, std::size_t vertex, openvdb::Vec3d& position) const
    {
        const Vec3d& corner = mesh_.corner(polygon, int(vertex));
        position.init(corner.x() * voxelsPerUnit_, corner.y() * voxelsPerUnit_, corner.z() * voxelsPerUnit_);
    }

private:
    const TriangleMesh& mesh_;
    double voxelsPerUnit_;
};

// Lets Ctrl-C stop the peer too.
class StopAsked : public openvdb::util::NullInterrupter {
public:
    explicit StopAsked(const Progress& progress) : progress_(progress) {}
    bool wasInterrupted(int /*percent*/ = -1) override { return progress_.stopRequested(); }

private:
    const Progress& progress_;
};

} // namespace

LevelSetGrid meshToVolume(const TriangleMesh& mesh, const MeshToLevelSetOptions& options, Progress& progress)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(options.voxelSize);
    StopAsked stop(progress);
    const openvdb::FloatGrid::Ptr grid =
        openvdb::tools::meshToVolume<openvdb::FloatGrid>(stop, IndexSpaceMesh(mesh, options.voxelSize), *transform,
                                                         float(options.exteriorVx), float(options.interiorVx));
    throwIfStopped(progress); // what it returns then is unfinished
    grid->setName(options.gridName);
    return toLevelSetGrid(grid, options.gridName);
}

} // namespace vdbounce::bench
