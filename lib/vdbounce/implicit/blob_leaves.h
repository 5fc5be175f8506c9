// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/implicit/ball_descent.h"
#include "vdbounce/io/scalar_grid.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace vdbounce {

/// Takes the leaves of an implicit function, from many threads and in any order, and makes a grid of those near its
/// surface.
class BlobLeaves {
public:
    /// Refuses more leaves than that with UsageError.
    explicit BlobLeaves(std::uint64_t maxLeaves);
    ~BlobLeaves();
    BlobLeaves(const BlobLeaves&) = delete;
    BlobLeaves& operator=(const BlobLeaves&) = delete;

    /// A leaf (leaf coordinates): 512 values, z fastest, negative inside. Each leaf may come once.
    void add(const Vec3i& leaf, const float* values);

    /// A cube that is inside, as are all voxels up to two from it.
    void addInside(const LeafCube& cube);

    /// Of what came so far, once: leaves with voxels up to two from a change of sign, all of them active; `background`
    /// and its negative elsewhere. What never came is outside. Nothing where there is no change of sign.
    std::optional<ScalarGrid> implicitGrid(float background, double voxelSize);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
    std::uint64_t maxLeaves_;
};

} // namespace vdbounce
