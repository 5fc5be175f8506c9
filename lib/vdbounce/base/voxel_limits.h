// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// How small voxels, how far from the origin and how wide bands can be.

namespace vdbounce {

/// The shortest side of a voxel, world units: OpenVDB refuses a transform whose determinant is below 3e-15.
constexpr double kSmallestVoxel = 1.5e-5;

/// What a voxel's coordinates stay within, index space: 2^30. OpenVDB's are integers of 32 bits, and so sums of two of
/// them and the borders of leaves fit as well.
constexpr double kFarthestVoxel = 1073741824.0;

/// The narrowest half of a band, voxels: a surface between two voxels must be within the band of both, or a cell would
/// not know it.
constexpr double kNarrowestBandVx = 1.0;

/// What halves of bands stay below, voxels: beyond any grid, but short of overflow.
constexpr double kWidestBandVx = 1e6;

} // namespace vdbounce
