// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_case.h"

#include "vdbounce/base/progress.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstddef>
#include <string>

namespace vdbounce::bench {

struct CollideBenchOptions {
    std::size_t particles = 10'000'000;
    int repetitions = 3; ///< of which the median is taken
};

/// Measures steps of particles that fall in a column on a sphere of radius 100 voxels against NanoVDB's collision
/// example, whose situation it is: a unit square beside the sphere's axis, dt 0.01, 100 steps. As in the example the
/// column begins so high that nothing touches in that time; and once more it begins 3 voxels above the surface, so that
/// all particles land. Ours collide with restitution, friction and a radius; the example mirrors velocities of points.
///
/// Nanoseconds a particle step, on one and on all threads, with all steps in one call and one step a call. The pass is
/// made and particles are put in place before the clock starts; what the pass finds out about them first is in the
/// figure. Then the shares of particle steps that looked something up and that touched.
Cases benchColumn(const CollideBenchOptions& options, Progress& progress);

/// The same for particles in the box around a mesh that is 128 voxels long: nine of ten anywhere outside of the mesh,
/// one within 2 voxels of its surface, for 20 steps with slow random velocities. The peer is what moving the same
/// arrays costs without any collision, so ratios are below 1. Throws InputError for a mesh that fills its box.
Cases benchMeshBox(const std::string& name, const TriangleMesh& mesh, const CollideBenchOptions& options,
                   Progress& progress);

} // namespace vdbounce::bench
