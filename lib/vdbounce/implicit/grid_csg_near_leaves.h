// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <bitset>
#include <map>
#include <tuple>

namespace vdbounce {

/// A node of OpenVDB's lower level: its first voxel; ordered as OpenVDB orders coordinates.
struct LowerNodePlace {
    int x, y, z;
    bool operator<(const LowerNodePlace& other) const
    {
        return std::tie(x, y, z) < std::tie(other.x, other.y, other.z);
    }
};

/// Of a node's 16^3 leaves, in its order.
using LeafBits = std::bitset<4096>;
using NearLeaves = std::map<LowerNodePlace, LeafBits>;

/// The leaves of a grid with voxels at `onto` in which phi may be anything but one value, some more among them. In all
/// others the field is constant.
NearLeaves leavesNearBlocks(const DistanceField& field, const LinearTransform& onto);

} // namespace vdbounce
