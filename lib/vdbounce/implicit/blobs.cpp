// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/blobs.h"

#include "vdbounce/base/error.h"
#include "vdbounce/field/option_checks.h"
#include "vdbounce/implicit/blob_surface.h"
#include "vdbounce/implicit/leaf_limit.h"
#include "vdbounce/implicit/particle_balls.h"
#include "vdbounce/implicit/redistance.h"
#include "vdbounce/implicit/sphere_union.h"
#include "vdbounce/io/number_text.h"

#include <cmath>

namespace vdbounce {
namespace {

void validate(const BlobOptions& options)
{
    requireVoxelSize(options.voxelSize, "particles");
    requireBand("band", options.halfWidthVx);
    requireInRange(options.strength > 0.0 && std::isfinite(options.strength), "strength", options.strength,
                   "give a number above zero, for example 1");
    if (options.threshold)
        requireInRange(*options.threshold > 0.0 && std::isfinite(*options.threshold), "threshold", *options.threshold,
                       "give a number above zero, for example 0.4");
    if (options.radius)
        requireInRange(options.radius->value > 0.0 && std::isfinite(options.radius->value), "radius",
                       options.radius->value, "give a length above zero, for example 2vx");
    requireInRange(options.cutOff > 0.0 && options.cutOff < 1.0, "cut-off", options.cutOff,
                   "give a part of the threshold, for example 1e-4");
}

std::string count(std::uint64_t number) { return std::to_string(number) + (number == 1 ? " particle" : " particles"); }

void warnAboutParticles(const ParticleBalls& made, const BlobOptions& options, BlobResult& result)
{
    result.particles = made.balls.size();
    result.notFinite = made.notFinite;
    result.noRadius = made.noRadius;
    result.tooSmall = made.tooSmall;
    if (made.notFinite > 0)
        result.warnings.push_back(count(made.notFinite) + " left out: position or radius is not finite");
    if (made.noRadius > 0) result.warnings.push_back(count(made.noRadius) + " left out: the radius is not above zero");
    if (made.tooSmall > 0)
        result.warnings.push_back(count(made.tooSmall) +
                                  " without a voxel centre inside, which leave no surface of their own; use voxels "
                                  "smaller than " +
                                  numberText(options.voxelSize));
}

void requireSomething(const ParticleBalls& made, const Particles& particles)
{
    if (made.balls.empty())
        throw InputError("particles",
                         "none of the " + std::to_string(particles.size()) +
                             " has a finite position and a radius above zero",
                         "give particles that have, or --radius where the file carries none");
}

[[noreturn]] void throwNoSurface(const BlobResult& result)
{
    throw InputError("particles", "no voxel centre lies inside the surface of " + count(result.particles),
                     "use smaller voxels, a larger radius or a lower threshold");
}

LevelSetGrid unionOf(BallList balls, const BlobOptions& options, const BlobResult& result, Progress& progress)
{
    if (result.tooSmall == result.particles) throwNoSurface(result);
    return sphereUnion(std::move(balls), {options.halfWidthVx, options.voxelSize}, options.gridName,
                       leavesWithin(options.maxMemory, kBytesPerLeaf), progress);
}

LevelSetGrid blend(BallList balls, const BlobSurface& surface, const BlobOptions& options, const BlobResult& result,
                   Progress& progress)
{
    const auto implicit = blobImplicit(std::move(balls), surface, options.voxelSize,
                                       leavesWithin(options.maxMemory, kBytesPerLeaf), progress);
    if (!implicit) throwNoSurface(result);
    RedistanceOptions redistancing;
    redistancing.exterior = redistancing.interior = Length{options.halfWidthVx, true};
    redistancing.name = options.gridName;
    redistancing.maxMemory = options.maxMemory;
    return redistance(*implicit, redistancing, progress);
}

} // namespace

BlobResult makeBlobs(const Particles& particles, const BlobOptions& options, Progress& progress)
{
    validate(options);
    if (particles.radius.empty() && !particles.empty() && !options.radius)
        throw UsageError("radius", "the particles have none", "give --radius, for example 2vx");
    throwIfStopped(progress);
    const bool spheres = options.kernel == BlobKernel::Sphere;
    const double threshold = options.threshold.value_or(kernelValue(options.kernel, 1.0));
    const double level = threshold / options.strength;
    const BlobSurface surface{options.kernel, level, level * options.cutOff};
    BallMaking making{options.voxelSize, 0.0, 1.0, 1.0, options.halfWidthVx};
    if (options.radius) making.radius = options.radius->world(options.voxelSize);
    if (!spheres) {
        making.surface = kernelArgument(options.kernel, level);
        making.reachPerRadius = surface.reachPerRadius();
    }
    ParticleBalls made = makeBalls(particles, making);
    requireSomething(made, particles);
    BlobResult result;
    warnAboutParticles(made, options, result);
    result.grid = spheres ? unionOf(std::move(made.balls), options, result, progress)
                          : blend(std::move(made.balls), surface, options, result, progress);
    return result;
}

LevelSetGrid blobs(const Particles& particles, const BlobOptions& options, Progress& progress)
{
    return makeBlobs(particles, options, progress).grid;
}

} // namespace vdbounce
