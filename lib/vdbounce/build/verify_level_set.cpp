// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/verify_level_set.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/mesh_oracle.h"
#include "vdbounce/field/openvdb_transform.h"
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

// `onSurface`: a voxel that float rounding places on the surface has no side to be wrong about.
void compare(const MeshOracle& oracle, const VoxelSample& sample, bool flood, double onSurface, Errors& errors)
{
    const double body = oracle.bodyDistance(sample.world);
    const double sheet = oracle.sheetDistance(sample.world);
    const bool inside = body < onSurface ? sample.phi < 0.0 : oracle.inBody(sample.world);
    const double expected = std::min(inside ? -body : body, sheet);
    // A wrong side is counted as such, not as a wrong distance; flood also fills what only it calls inside.
    const bool filled = flood && !inside && sample.phi < 0.0;
    const bool wrongSide = !filled && std::abs(expected) > onSurface && (expected < 0.0) != (sample.phi < 0.0);
    const double error = std::isfinite(sheet) && !wrongSide ? std::abs(sample.phi - expected)
                                                            : std::abs(std::abs(sample.phi) - std::abs(expected));
    errors.largest = std::max(errors.largest, error);
    errors.squares += error * error;
    errors.signs += wrongSide ? 1 : 0;
}

} // namespace

VerifyReport verifyLevelSet(const LevelSetGrid& handle, const TriangleMesh& mesh, const VerifyOptions& options)
{
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    const LinearTransform transform = toLinearTransform(grid.transform());
    const double voxel = transform.voxelSize().maxCoeff();
    const MeshOracle oracle(mesh, options.sign, transform, 0.5 * options.thickness);
    const std::vector<VoxelSample> samples = spreadSamples(grid, options);
    const Errors errors = reduceBlocks(samples.size(), 256, Errors{}, [&](IndexRange range) {
        Errors part;
        for (std::size_t i = range.begin; i < range.end; ++i)
            compare(oracle, samples[i], options.sign == SignMethod::Flood, 1e-6 * voxel, part);
        return part;
    });
    VerifyReport report;
    report.samples = samples.size();
    report.maxErrorVx = errors.largest / voxel;
    report.rmsErrorVx = samples.empty() ? 0.0 : std::sqrt(errors.squares / double(samples.size())) / voxel;
    report.signErrors = errors.signs;
    return report;
}

} // namespace vdbounce
