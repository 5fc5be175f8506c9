// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_ways.h"

#include "vdbounce/base/random_numbers.h"
#include "vdbounce/contact/step.h"

#include <cmath>
#include <optional>

namespace vdbounce::bench {
namespace {

constexpr double kParticleRadius = 0.02;
constexpr double kSlopeDegrees = 20.0;
constexpr double kSlopeFriction = 0.2;

// Along the parabola in steps that the ball's curvature cannot hide from, then halved.
std::optional<Impact> firstImpact(const Vec3d& from, const Vec3d& velocity, double seconds)
{
    constexpr int kSteps = 2000;
    const Vec3d gravity = StepOptions().gravity;
    const auto at = [&](double t) { return Vec3d(from + t * velocity + 0.5 * t * t * gravity - kBallCentre); };
    const double touch = kBallRadius + kParticleRadius;
    for (int i = 1; i <= kSteps; ++i) {
        double inside = seconds * i / kSteps;
        if (at(inside).norm() >= touch) continue;
        double free = seconds * (i - 1) / kSteps;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (free + inside);
            (at(middle).norm() < touch ? inside : free) = middle;
        }
        return Impact{free, kBallCentre + kBallRadius * at(free).normalized()};
    }
    return std::nullopt;
}

Vec3d direction(CounterRandom& random)
{
    while (true) {
        const Vec3d v = 2.0 * random.uniformVector() - Vec3d::Ones();
        if (v.squaredNorm() <= 1.0 && v.squaredNorm() > 1e-4) return v.normalized();
    }
}

} // namespace

Shots shotsAtBall(std::size_t count, double seconds, std::uint64_t seed)
{
    Shots shots;
    for (std::uint64_t tried = 0; shots.impacts.size() < count; ++tried) {
        CounterRandom random(seed, tried);
        const Vec3d from = kBallCentre + (1.5 + random.uniform()) * direction(random);
        const Vec3d aim = kBallCentre + 0.9 * random.uniform() * direction(random);
        const Vec3d velocity = std::pow(10.0, 0.5 + 1.5 * random.uniform()) * (aim - from).normalized();
        const std::optional<Impact> impact = firstImpact(from, velocity, 0.9 * seconds);
        if (!impact) continue;
        shots.particles.position.push_back(from);
        shots.particles.velocity.push_back(velocity);
        shots.particles.radius.push_back(kParticleRadius);
        shots.impacts.push_back(*impact);
    }
    numberInOrder(shots.particles);
    return shots;
}

Slope slidingSlope(std::size_t count, double seconds, std::uint64_t seed)
{
    Slope slope;
    const double angle = kSlopeDegrees * 3.14159265358979323846 / 180.0;
    // Down along x and a little along z, so that no axis is along it.
    const Vec3d ahead = Vec3d(1.0, 0.0, 0.3).normalized();
    slope.normal = std::cos(angle) * Vec3d::UnitY() + std::sin(angle) * ahead;
    slope.down = std::cos(angle) * ahead - std::sin(angle) * Vec3d::UnitY();
    slope.friction = kSlopeFriction;
    const double g = StepOptions().gravity.norm();
    slope.way = 0.5 * g * (std::sin(angle) - kSlopeFriction * std::cos(angle)) * seconds * seconds;
    const Vec3d across = slope.normal.cross(slope.down);
    for (std::size_t i = 0; i < count; ++i) {
        CounterRandom random(seed, i);
        const double along = random.uniform();
        slope.particles.position.push_back(along * slope.down + random.uniform() * across +
                                           kParticleRadius * slope.normal);
        slope.particles.radius.push_back(kParticleRadius);
        slope.within.add(slope.particles.position.back());
        slope.within.add(slope.particles.position.back() + slope.way * slope.down);
    }
    slope.within.min -= Vec3d::Constant(0.5);
    slope.within.max += Vec3d::Constant(0.5);
    slope.particles.ensureVelocity();
    numberInOrder(slope.particles);
    return slope;
}

} // namespace vdbounce::bench
