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

std::vector<VoxelSample> spreadSamples(const openvdb::FloatGrid& grid, const VerifyOptions& options)
{
    const std::uint64_t active = grid.activeVoxelCount();
    const std::uint64_t stride = std::max<std::uint64_t>(1, active / std::max<std::uint64_t>(1, options.samples));
    std::vector<VoxelSample> samples;
    std::uint64_t number = 0;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
            if (number++ % stride != 0) continue;
            const openvdb::Vec3d world = grid.indexToWorld(voxel.getCoord());
            samples.push_back({Vec3d(world.x(), world.y(), world.z()),
                               double(options.half ? float(openvdb::math::half(*voxel)) : *voxel)});
        }
    }
    return samples;
}

bool signIsWrong(const MeshTree& tree, SignMethod sign, const Vec3d& p, double phi)
{
    const bool inside = sign == SignMethod::Parity ? tree.insideByParity(p) : std::abs(tree.windingNumber(p)) > 0.5;
    // Flood also fills what only it calls inside.
    return sign == SignMethod::Flood ? inside && !(phi < 0.0) : inside != (phi < 0.0);
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
    const std::vector<VoxelSample> samples = spreadSamples(grid, options);
    const bool sheet = options.sign == SignMethod::Unsigned;
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
            if (signIsWrong(tree, options.sign, p, samples[i].phi)) ++part.signs;
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
