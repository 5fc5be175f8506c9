// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"
#include "vdbounce/implicit/redistance.h"
#include "vdbounce/implicit/sample_block.h"
#include "vdbounce/io/openvdb_grid.h"

#include <vector>

namespace vdbounce {

/// A grid of numbers read as an implicit function F: the values less `iso`, turned so that F < 0 inside.
///
/// Where values are larger inside (densities) all of space is known: the background is what there is outside the active
/// voxels. Otherwise only active voxels are known, since what lies beyond a narrow band is cut off; a level set's tiles
/// and background then still tell the side.
class ImplicitSamples {
public:
    ImplicitSamples(const openvdb::FloatGrid& grid, double iso, Inside inside);

    /// Throws InputError that names the voxel where an active value is not a finite number.
    void requireFinite() const;

    /// Origins of leaves which together hold the lowest corners of all cells that the surface may cross, in
    /// lexicographic order.
    std::vector<Vec3i> candidateLeaves() const;

    /// Fills `block` around the leaf at `origin`.
    void load(const Vec3i& origin, SampleBlock& block) const;

    /// Which of a leaf's 512 voxels are inside, and of which that is known: bit z + 8 y of word x.
    struct Sides {
        std::array<std::uint64_t, 8> inside{};
        std::array<std::uint64_t, 8> known{};
    };
    Sides sides(const Vec3i& origin) const;

    /// The side is known outside the active voxels as well.
    bool sideKnownEverywhere() const { return sideKnownEverywhere_; }

    float toF(float value) const
    {
        const double above = double(value) - iso_;
        return float(inside_ == Inside::Below ? above : -above);
    }

    const openvdb::FloatGrid& grid() const { return grid_; }

private:
    const openvdb::FloatGrid& grid_;
    double iso_;
    Inside inside_;
    bool inactiveKnown_;
    bool sideKnownEverywhere_;
};

} // namespace vdbounce
