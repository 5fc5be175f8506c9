// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"

#include <cstddef>

namespace vdbounce {

/// phi and its gradient at one point, world space, single precision.
struct PointSample {
    float phi;
    float gradient[3];
};

/// Looks many points up at once, on all threads: samples[i] is DistanceField::sample(points[i]), in single precision.
///
/// Points may come in any order, and each sample depends on its own point only: the same bits whatever the order, the
/// number of threads, and the processor's vector width (the best of AVX-512, AVX2 and SSE4 is chosen when the program
/// runs). Within 8 units (Lookup::Cubic 16) in the last place of the largest voxel value around the point of what
/// sample() returns, the gradient within as many of that value over the voxel's side. World positions are taken to
/// voxels in double precision, so that this holds far from the origin too.
///
/// Cost: 8 to 30 ns a point and thread, as the points' order, the size of the field, its storage and its lookup let the
/// voxels come out of the cache (`vdbounce bench field` measures it). Points near a surface in no order are put in
/// order first, which takes 6 bytes a point, for at most four million at a time. Points outside of the field's box, and
/// Lookup::Nearest with Normal::Analytic and Lookup::Cubic with Normal::Central, are done one at a time by sample(), at
/// 100 to 500 ns.
void samplePoints(const DistanceField& field, const Vec3d* points, std::size_t count, PointSample* samples);

/// The same with another gradient than the field's, with Lookup::Trilinear in its blocks; what lies elsewhere, and
/// other lookups, have the field's own. Normal::Analytic reads 8 voxels instead of 32: for those who need phi only.
void samplePoints(const DistanceField& field, const Vec3d* points, std::size_t count, PointSample* samples,
                  Normal normal);

} // namespace vdbounce
