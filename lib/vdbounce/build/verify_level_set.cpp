// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/verify_level_set.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/io/openvdb_grid.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

struct VoxelSample {
    Vec3d world;
    double phi;
};

std::vector<VoxelSample> spreadSamples(const openvdb::FloatGrid& grid, std::uint64_t wanted)
{
    const std::uint64_t active = grid.activeVoxelCount();
    const std::uint64_t stride = std::max<std::uint64_t>(1, active / std::max<std::uint64_t>(1, wanted));
    std::vector<VoxelSample> samples;
    std::uint64_t number = 0;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
            if (number++ % stride != 0) continue;
            const openvdb::Vec3d world = grid.indexToWorld(voxel.getCoord());
            samples.push_back({Vec3d(world.x(), world.y(), world.z()), double(*voxel)});
        }
    }
    return samples;
}

struct Errors {
    double largest = 0.0;
    double squares = 0.0;
    std::uint64_t signs = 0;

    Errors& operator+=(const Errors& other)
    {
        largest = std::max(largest, other.largest);
        squares += other.squares;
        signs += other.signs;
        return *this;
    }
};

} // namespace

VerifyReport verifyLevelSet(const LevelSetGrid& handle, const TriangleMesh& mesh, double offset,
                            const VerifyOptions& options)
{
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    const MeshTree tree(mesh);
    // Where faces disagree on which way is out, winding means nothing and crossings still count.
    const bool byParity = inspectEdges(mesh).inconsistent > 0;
    const std::vector<VoxelSample> samples = spreadSamples(grid, options.samples);
    const bool sheet = offset > 0.0;
    // A voxel that float rounding places on the surface has no side to be wrong about.
    const double onSurface = 1e-6 * grid.voxelSize()[0];
    const Errors errors = reduceBlocks(samples.size(), 256, Errors{}, [&](IndexRange range) {
        Errors part;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const double distance = tree.closest(samples[i].world).distance;
            const double error =
                sheet ? std::abs(samples[i].phi - (distance - offset)) : std::abs(std::abs(samples[i].phi) - distance);
            part.largest = std::max(part.largest, error);
            part.squares += error * error;
            if (sheet || distance < onSurface) continue;
            const Vec3d& p = samples[i].world;
            const bool inside = byParity ? tree.insideByParity(p) : tree.windingNumber(p) > 0.5;
            if (inside != (samples[i].phi < 0.0)) ++part.signs;
        }
        return part;
    });
    const double voxel = grid.voxelSize()[0];
    VerifyReport report;
    report.samples = samples.size();
    report.maxErrorVx = errors.largest / voxel;
    report.rmsErrorVx = samples.empty() ? 0.0 : std::sqrt(errors.squares / double(samples.size())) / voxel;
    report.signErrors = errors.signs;
    return report;
}

} // namespace vdbounce
