// SPDX-License-Identifier: Apache-2.0
#include "bench/field_peers.h"

#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/math/Stencils.h>
#include <openvdb/tools/GridOperators.h>
#include <openvdb/tools/Interpolation.h>

#include <nanovdb/util/OpenToNanoVDB.h>
#include <nanovdb/util/SampleFromVoxels.h>

namespace vdbounce::bench {
namespace {

using openvdb::FloatGrid;
using FloatAccessor = openvdb::tree::ValueAccessor<const openvdb::FloatTree, /*IsSafe=*/false>;
using VectorAccessor = openvdb::tree::ValueAccessor<const openvdb::Vec3STree, /*IsSafe=*/false>;

openvdb::Vec3d toOpenVdbVector(const Vec3d& v) { return openvdb::Vec3d(v.x(), v.y(), v.z()); }

// phi and central differences from a trilinear sampler, in index space, then carried to the world by the map.
template <class Vector, class Sampler, class ToWorld>
PointSample sevenSamples(const Vector& index, const Sampler& sampler, const ToWorld& gradientToWorld)
{
    float gradient[3];
    for (int axis = 0; axis < 3; ++axis) {
        Vector step(0.0);
        step[axis] = 1.0;
        gradient[axis] = 0.5f * (sampler(index + step) - sampler(index - step));
    }
    return {sampler(index), {gradientToWorld(gradient[0]), gradientToWorld(gradient[1]), gradientToWorld(gradient[2])}};
}

FieldPeer boxSamples(const FloatGrid::ConstPtr& grid)
{
    return {"OpenVDB, 7 box samples",
            [grid](const Vec3d* points, std::size_t count, PointSample* samples) {
                const FloatAccessor accessor(grid->tree());
                const auto& transform = grid->transform();
                const float perVoxel = float(1.0 / grid->voxelSize()[0]);
                const auto sampler = [&](const openvdb::Vec3d& index) {
                    return openvdb::tools::BoxSampler::sample(accessor, index);
                };
                for (std::size_t i = 0; i < count; ++i) {
                    samples[i] = sevenSamples(transform.worldToIndex(toOpenVdbVector(points[i])), sampler,
                                              [&](float g) { return g * perVoxel; });
                }
            },
            true};
}

FieldPeer boxStencil(const FloatGrid::ConstPtr& grid)
{
    return {"OpenVDB, BoxStencil",
            [grid](const Vec3d* points, std::size_t count, PointSample* samples) {
                openvdb::math::BoxStencil<FloatGrid, /*IsSafe=*/false> stencil(*grid);
                const auto& transform = grid->transform();
                const float perVoxel = float(1.0 / grid->voxelSize()[0]);
                for (std::size_t i = 0; i < count; ++i) {
                    const openvdb::Vec3d index = transform.worldToIndex(toOpenVdbVector(points[i]));
                    const openvdb::Vec3f at(index);
                    stencil.moveTo(openvdb::Coord::floor(index));
                    const auto gradient = stencil.gradient(at) * perVoxel;
                    samples[i] = {stencil.interpolation(at), {gradient[0], gradient[1], gradient[2]}};
                }
            },
            false};
}

FieldPeer gradientGrid(const FloatGrid::ConstPtr& grid)
{
    const openvdb::Vec3SGrid::ConstPtr gradients = openvdb::tools::gradient(*grid);
    return {"OpenVDB, precomputed gradient grid",
            [grid, gradients](const Vec3d* points, std::size_t count, PointSample* samples) {
                const FloatAccessor accessor(grid->tree());
                const VectorAccessor vectors(gradients->tree());
                const auto& transform = grid->transform();
                for (std::size_t i = 0; i < count; ++i) {
                    const openvdb::Vec3d index = transform.worldToIndex(toOpenVdbVector(points[i]));
                    const openvdb::Vec3f gradient = openvdb::tools::BoxSampler::sample(vectors, index);
                    samples[i] = {openvdb::tools::BoxSampler::sample(accessor, index),
                                  {gradient[0], gradient[1], gradient[2]}};
                }
            },
            false};
}

FieldPeer nanoSamples(const FloatGrid::ConstPtr& grid)
{
    const auto handle = std::make_shared<nanovdb::GridHandle<>>(nanovdb::openToNanoVDB(*grid));
    return {"NanoVDB, 7 trilinear samples",
            [handle](const Vec3d* points, std::size_t count, PointSample* samples) {
                const auto* nano = handle->grid<float>();
                const auto accessor = nano->getAccessor();
                const float perVoxel = float(1.0 / nano->voxelSize()[0]);
                // Without the cache of the last cell, which no two of the seven share.
                const auto trilinear = nanovdb::createSampler<1, decltype(accessor), false>(accessor);
                for (std::size_t i = 0; i < count; ++i) {
                    const nanovdb::Vec3d world(points[i].x(), points[i].y(), points[i].z());
                    samples[i] =
                        sevenSamples(nano->worldToIndex(world), trilinear, [&](float g) { return g * perVoxel; });
                }
            },
            true};
}

} // namespace

std::vector<FieldPeer> fieldPeers(const LevelSetGrid& handle)
{
    const FloatGrid::ConstPtr& grid = handle.holder().grid;
    return {boxSamples(grid), boxStencil(grid), gradientGrid(grid), nanoSamples(grid)};
}

} // namespace vdbounce::bench
