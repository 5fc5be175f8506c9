// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/openvdb_grid.h"

namespace vdbounce {

LevelSetSummary summarize(const LevelSetGrid& handle)
{
    const openvdb::FloatGrid& grid = toOpenVdb(handle);
    LevelSetSummary summary;
    const openvdb::Vec3d voxel = grid.voxelSize();
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    summary.name = grid.getName();
    summary.valueType = grid.saveFloatAsHalf() ? "half" : grid.valueType();
    summary.voxelSize = Vec3d(voxel.x(), voxel.y(), voxel.z());
    summary.background = grid.background();
    summary.halfWidthVx = summary.background / summary.voxelSize.minCoeff();
    summary.activeVoxels = grid.activeVoxelCount();
    summary.leaves = grid.tree().leafCount();
    summary.memoryBytes = grid.memUsage();
    summary.indexMin = Vec3i(box.min().x(), box.min().y(), box.min().z());
    summary.indexMax = Vec3i(box.max().x(), box.max().y(), box.max().z());
    if (box.empty()) return summary;
    for (int corner = 0; corner < 8; ++corner) {
        const openvdb::Vec3d index((corner & 1) != 0 ? box.max().x() : box.min().x(),
                                   (corner & 2) != 0 ? box.max().y() : box.min().y(),
                                   (corner & 4) != 0 ? box.max().z() : box.min().z());
        const openvdb::Vec3d world = grid.indexToWorld(index);
        summary.worldBox.add(Vec3d(world.x(), world.y(), world.z()));
    }
    return summary;
}

} // namespace vdbounce
