// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"

#include "vdbounce/base/progress.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vdbounce::bench {

struct MeshBenchOptions {
    int dim = 128;       ///< voxels on the longest side of the mesh's box
    double bandVx = 3.0; ///< half width of the band on both sides, voxels, >= 1
    int repetitions = 3; ///< of which the median is taken
};

/// How one way to make a level set of a mesh did. Times and peak are medians.
struct MeshFigures {
    double cpuSeconds = 0.0; ///< processor time of all threads
    double wallSeconds = 0.0;
    std::optional<double> peakBytes; ///< above what was held before, the finished grid included, the mesh not; nothing
                                     ///< where the system does not tell
    double gridBytes = 0.0;
    std::uint64_t activeVoxels = 0;
    double largestErrorVx = 0.0; ///< | |phi| - distance |, of 20,000 active voxels or more
};

struct MeshBenchResult {
    std::string name;    ///< "bunny.obj at 128, band 3, 2 threads"
    std::string mesh;    ///< "bunny.obj"
    std::string threads; ///< "2 threads"
    MeshBenchOptions options;
    std::size_t triangles = 0;
    double meshBytes = 0.0; ///< of the points and triangles in memory
    MeshFigures ours;
    MeshFigures theirs;
};

/// Measures meshToLevelSet() against OpenVDB's meshToVolume (bench/mesh_peers.h), taken in turn, on as many threads as
/// are allowed. Both get the mesh in memory and return a finished grid with signs; neither pays for freeing it. The
/// errors are those of verifyLevelSet(), whose search in double precision asks neither of them.
///
/// Throws what meshToLevelSet() does.
MeshBenchResult benchMesh(const std::string& name, const TriangleMesh& mesh, const MeshBenchOptions& options,
                          Progress& progress);

/// The same as cases: times, peak memory, active voxels and largest error beside the peer's, and what the memory is to
/// be compared with.
Cases casesOf(const MeshBenchResult& result);

} // namespace vdbounce::bench
