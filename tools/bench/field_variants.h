// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_field.h"

#include "vdbounce/field/sample_points.h"

namespace vdbounce::bench {

/// The largest difference of phi, voxels.
double largestDifference(const PointSample* a, const PointSample* b, std::size_t count, double voxelSize);

/// The same points with values kept in fewer bits and with the other lookups, on one thread: what each saves and costs
/// against floats, trilinear and central differences. Then the default with the vector code of each kind of processor.
void benchVariants(const FieldSubject& subject, const DistanceField& field, const std::vector<Vec3d>& points,
                   const FieldBenchOptions& options, Cases& cases);

/// What the tree behind the bounds costs to make and to keep, against reading the grid from disk and its memory; how
/// far apart the bounds are in the box, and what one costs.
void benchBounds(const FieldSubject& subject, const DistanceField& field, const FieldBenchOptions& options,
                 Cases& cases);

} // namespace vdbounce::bench
