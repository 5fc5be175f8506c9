// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/ball_descent.h"
#include "vdbounce/io/openvdb_grid.h"

/// @file
/// Cubes of leaves as OpenVDB's trees have them.

namespace vdbounce {

inline openvdb::Coord originOfLeaf(const Vec3i& leaf)
{
    const Vec3i voxel = leaf * LeafCube::kLeafSide;
    return openvdb::Coord(voxel.x(), voxel.y(), voxel.z());
}

/// Fills a cube with the largest tiles that fit, inactive.
inline void addTiles(openvdb::FloatTree& tree, const LeafCube& cube, float value)
{
    // A leaf, 16^3 and 512^3 of them: a tree level each.
    constexpr int kLevels[] = {0, 4, 9};
    int size = 2;
    while (kLevels[size] > cube.level) --size;
    const int step = 1 << kLevels[size];
    for (int x = 0; x < cube.side(); x += step) {
        for (int y = 0; y < cube.side(); y += step) {
            for (int z = 0; z < cube.side(); z += step)
                tree.addTile(openvdb::Index(size + 1), originOfLeaf(cube.leaf + Vec3i(x, y, z)), value,
                             /*active=*/false);
        }
    }
}

} // namespace vdbounce
