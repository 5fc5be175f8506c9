// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/field/band_width.h"
#include "vdbounce/implicit/ball_list.h"

#include <cstddef>
#include <cstdint>

namespace vdbounce {

/// The distances of a leaf's 8^3 voxels to a union of spheres, z fastest.
struct SphereLeaf {
    alignas(64) float phi[512];   ///< world units; the band's width with the sign beyond it
    std::uint64_t active[8] = {}; ///< bit 8 y + z of word x where phi is within the band

    bool anyActive() const
    {
        std::uint64_t any = 0;
        for (std::uint64_t word : active) any |= word;
        return any != 0;
    }
};

/// How a union of spheres is measured.
struct SphereBand {
    double halfWidthVx; ///< of the band, voxels
    double voxelSize;   ///< world units

    /// World units, as the grid has it.
    float width() const { return bandWidth(halfWidthVx * voxelSize); }
};

/// min |x - c| - r over the balls (index space) at every voxel of the leaf (leaf coordinates).
///
/// Where all balls have one radius the squared distances are compared in double precision: exact. Else the nearest
/// sphere is searched in floats relative to the leaf, and its distance taken in double: exact but where two
/// spheres are nearest to within 2e-6 voxels, of which either may be taken. Bits do not depend on the processor.
/// `count` must be below 2^31.
void measureSphereLeaf(const Ball* balls, std::size_t count, const Vec3i& leaf, const SphereBand& band,
                       SphereLeaf& result);

} // namespace vdbounce
