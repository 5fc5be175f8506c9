// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"

#include "vdbounce/base/progress.h"
#include "vdbounce/io/level_set_grid.h"

#include <cstddef>
#include <string>
#include <vector>

namespace vdbounce::bench {

/// A level set to measure lookups in.
struct FieldSubject {
    std::string name;
    LevelSetGrid grid;
};

/// The sphere of radius 256 voxels, band 3.
FieldSubject sphereSubject();

struct FieldBenchOptions {
    std::vector<std::size_t> points{2'000'000, 20'000'000}; ///< how many are looked up
    int repetitions = 3;                                    ///< of which the median is taken
};

/// Measures phi and gradient of many points against the peers: near the surface in random order and in leaf order, and
/// spread over the box, on one and on all threads, nanoseconds a point. Whatever it takes from the array of points to
/// the array of results is in the figure. Peers look up a part of the same points, another one in each repetition,
/// because all of them would take many minutes. All is compiled with the same flags, for any processor of the
/// architecture; our vector code chooses the processor's own instructions when it runs, which the peers have no way to.
///
/// Then the other storages and lookups: bytes, speed, and error; and the bounds: what they cost to make against reading
/// the grid from disk, and how far apart they are. Throws InputError for a level set without surface.
Cases benchField(const FieldSubject& subject, const FieldBenchOptions& options, Progress& progress);

} // namespace vdbounce::bench
