// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>

namespace vdbounce {

/// What a conversion will take, told before it starts from the mesh's area alone.
struct ConversionEstimate {
    double activeVoxels = 0.0; ///< of the band; more than there will be where bands of near surfaces overlap
    double bytes = 0.0;        ///< at the peak, beside the mesh
    double cpuSeconds = 0.0;   ///< on one core of a machine of 2024, within a factor of two or three
};

/// `exterior` and `interior` are the band's half widths, world; `beside` is what other grids take, bytes a leaf. Voxels
/// and bytes are within a factor of two, but where bands of near surfaces overlap.
ConversionEstimate estimateConversion(const TriangleMesh& mesh, const LinearTransform& transform, double exterior,
                                      double interior, double beside = 0.0);

/// Throws UsageError when the estimate is beyond `maxMemory` bytes, or the mesh's voxels are too many to be numbered;
/// names what it would take and what there is.
void requireConvertible(const TriangleMesh& mesh, const LinearTransform& transform, double exterior, double interior,
                        std::uint64_t maxMemory, double beside = 0.0);

} // namespace vdbounce
