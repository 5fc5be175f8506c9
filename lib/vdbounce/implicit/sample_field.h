// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/implicit/implicit_field.h"
#include "vdbounce/io/level_set_grid.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vdbounce {

struct SampleFieldOptions {
    double voxelSize = 0.0; ///< world units, > 0; voxel centres then lie at its multiples

    /// Instead of voxelSize: any invertible map from voxels to the world. Lengths in voxels are then multiples of the
    /// longest side.
    std::optional<LinearTransform> transform;

    double exteriorVx = 3.0; ///< half width of the band outside, voxels, >= 1; becomes the background
    double interiorVx = 3.0; ///< half width of the band inside, voxels, >= 1
    double time = 0.0;       ///< seconds, of fields that move

    /// The world box within which voxels are made; needed where the field has no end.
    std::optional<Box> within;

    std::string gridName = "surface";
    std::uint64_t maxMemory = 0; ///< bytes; what needs more is refused; 0: three quarters of the machine's
};

/// Makes a narrow-band level set of a field: every voxel of the band holds phi rounded to float. Space is halved from
/// the box around the inside down to the 8^3 leaves, and where the surface is too far to be in the band nothing is
/// looked up but the middle of a cube: phi never exaggerates.
///
///     auto ball = makeField(SphereShape{Vec3d(0, 1, 0), 0.5});
///     LevelSetGrid grid = sampleField(*ball, {0.01});
///
/// The same bits for any number of threads. Throws UsageError for options out of range, for a field without end and
/// without `within`, and for what needs more than maxMemory; Interrupted.
/// Cost: about 1 microsecond and 2 KB a leaf, the lookups of 512 voxels.
LevelSetGrid sampleField(const ImplicitField& field, const SampleFieldOptions& options,
                         Progress& progress = Progress::none());

} // namespace vdbounce
