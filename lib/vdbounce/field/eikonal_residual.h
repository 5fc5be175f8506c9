// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/distance_field.h"

#include <cstdint>

namespace vdbounce {

/// How far a level set's values are from being distances, for which |grad phi| = 1, the eikonal equation: the
/// residual | |grad phi| - 1 | of its voxels. 0.1 means that particles meet the surface at nine or eleven tenths
/// of their radius. See eikonalResidual().
struct EikonalResidual {
    std::uint64_t voxels = 0; ///< that were measured: they and their six neighbours hold distances
    double mean = 0.0;
    double median = 0.0; ///< to an eighth of itself; 0 below a millionth
    double largest = 0.0;
    Vec3d where = Vec3d::Zero();    ///< of the largest: the voxel's centre, world
    double slope = 0.0;             ///< the mean of |grad phi| itself: 2 where values are twice the distances
    std::uint64_t creaseVoxels = 0; ///< of `voxels`: beside a crease, see below
    std::uint64_t offVoxels = 0;    ///< of `voxels`: with a residual above kOff

    /// A residual that contact begins to show: a tenth of the radius, or of the depth.
    static constexpr double kOff = 0.1;

    double creaseShare() const { return voxels == 0 ? 0.0 : double(creaseVoxels) / double(voxels); }
    double offShare() const { return voxels == 0 ? 0.0 : double(offVoxels) / double(voxels); }
};

/// Measures every voxel of `field` that holds a distance, as do its six neighbours: values that are clamped to the
/// band are none. Gradients are central differences, those that collisions interpolate, carried to world space by the
/// transform's inverse transpose.
///
/// On the medial axis and at edges a true distance has creases, where central differences find |grad phi| < 1 although
/// every value is right. So where the slopes before and behind a voxel differ along an axis by more than around a ball
/// of 6.7 voxels, and neither is steeper than a distance can be, both are tried for each such axis, and what fits best
/// counts: of a true distance one is right. The residual tells whether values are distances; whether voxels are small
/// enough for the shape thinFeatures() tells.
///
/// What remains where values are exact: 1 / (3 r^2) at most r voxels from a centre of curvature, and up to 0.3 within a
/// voxel or two of sharp edges.
///
/// Same bits for any number of threads. Cost: some 8 nanoseconds a voxel of the field's blocks.
EikonalResidual eikonalResidual(const DistanceField& field);

} // namespace vdbounce
