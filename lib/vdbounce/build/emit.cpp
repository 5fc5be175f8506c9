// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/emit.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/base/random_numbers.h"
#include "vdbounce/field/option_checks.h"
#include "vdbounce/field/surface_cells.h"
#include "vdbounce/io/number_text.h"

#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kParticlesPerTask = 8192;
constexpr int kProjectionSteps = 8;   // Newton halves nothing worse than a voxel to rounding within five
constexpr int kScatterAttempts = 64;  // cells whose level set a point does not reach are few
constexpr double kOnSurfaceVx = 1e-3; // how close to the level set an emitted point ends, voxels

template <class PositionOf> Particles emit(const EmitOptions& options, const PositionOf& positionOf)
{
    if (options.radius)
        requireInRange(*options.radius >= 0.0 && std::isfinite(*options.radius), "--radius", *options.radius,
                       "give a length, 0 or more");
    if (options.mass)
        requireInRange(*options.mass > 0.0 && std::isfinite(*options.mass), "--mass", *options.mass,
                       "give a positive mass");
    Particles particles;
    particles.resize(options.count);
    if (options.velocity) particles.velocity.assign(options.count, *options.velocity);
    if (options.radius) particles.radius.assign(options.count, *options.radius);
    if (options.mass) particles.mass.assign(options.count, *options.mass);
    forEachIndex(options.count, kParticlesPerTask, [&](std::size_t i) {
        CounterRandom random(options.seed, i);
        particles.position[i] = positionOf(random);
    });
    return particles;
}

// Moves p onto phi = offset along the gradient; false when it does not get there.
bool projectOntoSurface(const DistanceField& field, double offset, Vec3d& p)
{
    for (int step = 0; step < kProjectionSteps; ++step) {
        const FieldSample sample = field.sample(p);
        const double slope2 = sample.gradient.squaredNorm();
        if (!(slope2 > 0.0)) return false;
        p -= (sample.phi - offset) / slope2 * sample.gradient;
    }
    return std::abs(field.phi(p) - offset) < kOnSurfaceVx * field.voxelSize();
}

} // namespace

Particles emitInBox(const Box& box, const EmitOptions& options)
{
    if (box.empty() || !box.min.allFinite() || !box.max.allFinite()) {
        throw UsageError("emit box", "--min is not below --max",
                         "give the lower corner as --min and the upper as --max");
    }
    return emit(options, [&](CounterRandom& random) {
        return Vec3d(box.min + box.size().cwiseProduct(random.uniformVector()));
    });
}

Particles emitInSphere(const Vec3d& centre, double radius, const EmitOptions& options)
{
    requireInRange(radius >= 0.0 && std::isfinite(radius), "emit sphere --radius", radius, "give a length, 0 or more");
    return emit(options, [&](CounterRandom& random) {
        // A point of the surrounding cube is in the ball with probability 0.52, so this ends.
        for (;;) {
            const Vec3d p = 2.0 * random.uniformVector() - Vec3d::Ones();
            if (p.squaredNorm() <= 1.0) return Vec3d(centre + radius * p);
        }
    });
}

Particles emitOnSurface(const DistanceField& field, double offset, const EmitOptions& options)
{
    const std::vector<Vec3i> cells = cellsAroundLevel(field, offset);
    if (cells.empty()) {
        throw InputError("emit surface", "the field has no surface at --offset " + numberText(offset),
                         "stay within the narrow band, " + numberText(field.background()) + " wide");
    }
    return emit(options, [&](CounterRandom& random) {
        Vec3d p = Vec3d::Zero();
        for (int attempt = 0; attempt < kScatterAttempts; ++attempt) {
            const auto cell = static_cast<std::size_t>(random.uniform() * double(cells.size()));
            p = field.transform().toWorld(cells[cell].cast<double>() + random.uniformVector());
            if (projectOntoSurface(field, offset, p)) break;
        }
        return p;
    });
}

} // namespace vdbounce
