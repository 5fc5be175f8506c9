// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/length.h"
#include "vdbounce/base/progress.h"
#include "vdbounce/implicit/blob_kernel.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/particles/particles.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

struct BlobOptions {
    double voxelSize = 0.0; ///< world units, >= 1.5e-5; voxel centres lie at its multiples
    BlobKernel kernel = BlobKernel::Gaussian;

    /// t of F, > 0; left out: the kernel's value at 1, so that a lone particle of strength 1 has its surface at its
    /// radius. Says nothing for spheres.
    std::optional<double> threshold;

    double strength = 1.0; ///< alpha of F, > 0, the same for all particles. Says nothing for spheres.

    /// Of all particles, > 0, where they have none of their own.
    std::optional<Length> radius;

    double halfWidthVx = 3.0; ///< of the band on both sides, voxels, >= 1
    std::string gridName = "surface";

    /// What a particle adds to F at a voxel may be left out where it is less than this part of t, > 0 and < 1: a
    /// Gaussian ends nowhere. So F is too small by no more than this part of t for each particle near enough to show at
    /// all. Cost grows with the cube of sqrt(1 - ln cutOff).
    double cutOff = 1e-4;

    std::uint64_t maxMemory = 0; ///< bytes; what needs more is refused; 0: three quarters of the machine's
};

struct BlobResult {
    LevelSetGrid grid;
    std::uint64_t particles = 0;       ///< that the surface is made of
    std::uint64_t notFinite = 0;       ///< left out: a coordinate or the radius is no finite number
    std::uint64_t noRadius = 0;        ///< left out: the radius is zero or negative
    std::uint64_t tooSmall = 0;        ///< so small that there is no voxel centre within it: alone it leaves no surface
    std::vector<std::string> warnings; ///< one sentence each
};

/// The level set of the surface around particles (the lecture's "metaballs"):
///
///     F(x) = sum over i of alpha f(|x - x_i| / r_i) - t,    inside where F > 0,
///
/// with the kernels f of BlobKernel, made into signed distance; or the union of the particles as spheres.
///
/// Kernels: F is summed in single precision, in an order that depends on the particles only, near its surface and
/// nowhere else, and made into a function that is the exact distance for one particle alone; redistance() then finds
/// the surface between voxels and the distance in the band. Surfaces narrower than a voxel are lost.
///
/// Spheres: phi is exact outside, see sphereUnion().
///
/// Particles that are not finite or have no radius above zero are left out and counted, as a file of a simulation may
/// well hold some; those that were already `rejected` likewise, by the same test. Throws UsageError for options out of
/// range, where neither particles nor options have a radius, and for more leaves than maxMemory holds; InputError where
/// no particle is left or one lies beyond 2^30 voxels, Interrupted. The same bits for any number of threads.
///
/// Cost: see docs/decisions/0008-blobs.md; beside the grid about 100 bytes a particle.
BlobResult makeBlobs(const Particles& particles, const BlobOptions& options, Progress& progress = Progress::none());

/// The grid alone.
LevelSetGrid blobs(const Particles& particles, const BlobOptions& options, Progress& progress = Progress::none());

} // namespace vdbounce
