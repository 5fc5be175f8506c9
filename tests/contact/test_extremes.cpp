// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/random.h"
#include "support/stability_table.h"

#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/particle_pass.h"

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

/// @file
/// How far sizes, times, speeds and masses can go. What each test measured is written down by stabilityRow().

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const DistanceField>;

constexpr double kVoxel = 0.05;

FieldPtr fieldOf(const Phi& phi, const openvdb::math::Transform::Ptr& transform, int side, double halfWidthVx = 3.0)
{
    return std::make_shared<const DistanceField>(levelSet(bandGrid(phi, transform, side, halfWidthVx)));
}

StepOptions millisecond()
{
    StepOptions options;
    options.dt = 1e-3;
    return options;
}

// The same scene in other units: a bounce, a slide and a rest on tilted ground, in voxels and seconds of the original.
struct Outcome {
    Vec3d bounced;
    Vec3d bounceVelocity;
    Vec3d slid;
    Vec3d rested;
    double drift = 0.0; // of what rests

    double differs(const Outcome& other) const
    {
        return std::max({(bounced - other.bounced).norm(), (bounceVelocity - other.bounceVelocity).norm() / 100.0,
                         (slid - other.slid).norm(), (rested - other.rested).norm()});
    }
};

// `voxel` is the length of a voxel, `second` that of a second, `origin` where the scene is.
Outcome play(double voxel, double second, const Vec3d& origin)
{
    const Vec3d normal(0.02, 1, 0.01);
    const Phi phi = [=](const Vec3d& p) { return normal.normalized().dot(p - origin) - 0.22 * voxel; };
    const StillColliders colliders(
        {{"ground", fieldOf(phi, affineTransform(voxel * Mat3d::Identity(), origin), 30, 6.0), 0.6, 0.3}});
    StepOptions options;
    options.dt = 1e-3 * second;
    options.gravity = Vec3d(0, -200 * voxel / (second * second), 0);
    const auto run = [&](const Vec3d& from, const Vec3d& velocity, int steps) {
        MovingParticle particle = placed(origin + voxel * from, voxel / second * velocity, colliders, 0.4 * voxel);
        StepTally tally(1);
        for (int s = 0; s < steps; ++s) step(particle, colliders, options, tally);
        return particle;
    };
    const auto inVoxels = [&](const MovingParticle& particle) { return Vec3d((particle.position - origin) / voxel); };
    Outcome outcome;
    const MovingParticle bounced = run(Vec3d(-2, 12, 1), Vec3d(4, 0, -3), 1000);
    outcome.bounced = inVoxels(bounced);
    outcome.bounceVelocity = bounced.velocity * second / voxel;
    outcome.slid = inVoxels(run(Vec3d(-10, 0.9, 0), Vec3d(40, 0, 5), 2500));
    MovingParticle rests = run(Vec3d(3, 5, 2), Vec3d::Zero(), 4000);
    outcome.rested = inVoxels(rests);
    StepTally tally(1);
    for (int s = 0; s < 2000; ++s) step(rests, colliders, options, tally);
    outcome.drift = (inVoxels(rests) - outcome.rested).norm();
    return outcome;
}

Phi plate(double thicknessVx)
{
    return [=](const Vec3d& p) {
        const Vec3d d =
            Vec3d(std::abs(p.x()), std::abs(p.y() - 0.013), std::abs(p.z())) - Vec3d(1, 0.5 * thicknessVx * kVoxel, 1);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

// Whether a straight way leads through the plate and not around it.
bool passesPlate(const Vec3d& from, const Vec3d& to)
{
    if ((from.y() - 0.013) * (to.y() - 0.013) >= 0.0) return false;
    const Vec3d crossing = from + (0.013 - from.y()) / (to.y() - from.y()) * (to - from);
    return std::max(std::abs(crossing.x()), std::abs(crossing.z())) < 1.0 - 1.5 * kVoxel;
}

// How many of random shots from outside, 10^low to 10^high voxels a step fast, end inside or `passes` tells of.
int leaksOf(const FieldPtr& field, int shots, double low, double high,
            const std::function<bool(const Vec3d&, const Vec3d&)>& passes)
{
    Random random;
    StepOptions options;
    options.dt = 0.01;
    options.gravity = Vec3d::Zero();
    int leaks = 0;
    for (int i = 0; i < shots; ++i) {
        const StillColliders colliders({{"target", field, random.uniform(0, 1), random.uniform(0, 1)}});
        const Vec3d from(random.uniform(-0.8, 0.8), random.uniform(1.1, 3), random.uniform(-0.8, 0.8));
        const Vec3d aim(random.uniform(-0.8, 0.8), 0.013, random.uniform(-0.8, 0.8));
        const double speed = kVoxel / options.dt * std::pow(10.0, random.uniform(low, high));
        MovingParticle particle =
            placed(from, speed * (aim - from).normalized(), colliders, i % 2 == 0 ? 0.0 : random.uniform(0, kVoxel));
        StepTally tally(1);
        for (int s = 0; s < 30; ++s) {
            const Vec3d before = particle.position;
            step(particle, colliders, options, tally);
            const bool inside = !(colliders.probe(particle.position, particle.radius).gap >= 0.0);
            if (!inside && !passes(before, particle.position)) continue;
            ++leaks;
            break;
        }
    }
    return leaks;
}

bool never(const Vec3d&, const Vec3d&) { return false; }

} // namespace

TEST_CASE("a scene of any size gives the same answers", "[extremes]")
{
    const Outcome expected = play(kVoxel, 1.0, Vec3d::Zero());
    double worst = 0.0;
    double drift = expected.drift;
    for (double voxel : {1.6e-5, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
        // With gravity in proportion, and with the gravity of the first, where time goes with the root of the size.
        for (double second : {1.0, std::sqrt(voxel / kVoxel)}) {
            INFO("voxel " << voxel << ", second " << second);
            const Outcome same = play(voxel, second, Vec3d::Zero());
            worst = std::max(worst, same.differs(expected));
            drift = std::max(drift, same.drift);
            CHECK(same.differs(expected) <= 1e-4);
            CHECK(same.drift == 0.0);
        }
    }
    stabilityRow("voxel side", "1.6e-5 to 1e6 world units", "largest difference of places, voxels", worst);
    stabilityRow("at rest in scenes of these sizes", "1.6e-5 to 1e6 world units", "drift, voxels", drift);
}

TEST_CASE("a scene a million times its size from the origin gives the same answers", "[extremes]")
{
    const Outcome expected = play(kVoxel, 1.0, Vec3d::Zero());
    double worst = 0.0;
    double drift = 0.0;
    const double size = 60 * kVoxel;
    for (double away : {1e2, 1e4, 1e6}) {
        for (const Vec3d& towards : {Vec3d(1, 0, 0), Vec3d(-0.3, 0.9, 0.7)}) {
            INFO(away << " sizes towards " << towards.transpose());
            const Outcome same = play(kVoxel, 1.0, away * size * towards);
            worst = std::max(worst, same.differs(expected));
            drift = std::max(drift, same.drift);
            CHECK(same.differs(expected) <= 1e-4);
            CHECK(same.drift == 0.0);
        }
    }
    stabilityRow("distance from the origin", "up to 1e6 times the scene's size", "largest difference of places, voxels",
                 worst);
    stabilityRow("at rest there", "up to 1e6 times the scene's size", "drift, voxels", drift);
}

TEST_CASE("steps from a nanosecond to ten seconds", "[extremes]")
{
    const double e = 0.6;
    const double mu = 0.3;
    double worstBounce = 0.0;
    double worstSlide = 0.0;
    double worstGain = 0.0;
    for (const Ground& ground : grounds(kUp)) {
        const StillColliders colliders = single(ground, e, mu);
        for (double dt : {1e-9, 1e-7, 1e-5, 1e-3, 1e-1, 1.0, 10.0}) {
            INFO(ground.name << ", dt " << dt);
            StepOptions options;
            options.dt = dt;
            StepTally tally(1);
            MovingParticle falls =
                placed(Vec3d(0.1, kGroundOffset + 0.02 + 10.5 * dt, 0), Vec3d(0, -1, 0), colliders, 0.02);
            double before = energy(falls, options.gravity);
            for (int s = 0; s < 100; ++s) {
                step(falls, colliders, options, tally);
                REQUIRE(colliders.probe(falls.position, falls.radius).gap >= 0.0);
                const double now = energy(falls, options.gravity);
                worstGain = std::max(worstGain, (now - before) / (1.0 + std::abs(before)));
                REQUIRE(now <= before + 1e-12 * (1.0 + std::abs(before)));
                before = now;
            }
            // Later it has come down again.
            if (dt <= 1e-5) {
                const double expected = e * (1.0 + 10.5 * kGravity * dt) - 89.5 * kGravity * dt;
                CHECK(falls.velocity.y() == Approx(expected).margin(2.0 * kGravity * dt));
                worstBounce = std::max(worstBounce, std::abs(falls.velocity.y() - expected));
            }
            MovingParticle slides = placed(Vec3d(0.1, kGroundOffset, 0), Vec3d(1, 0, 0), colliders);
            for (int s = 0; s < 100; ++s) step(slides, colliders, options, tally);
            if (dt <= 1e-3) {
                const double expected = 1.0 - 100 * dt * mu * kGravity;
                CHECK(slides.velocity.x() == Approx(expected).epsilon(1e-3));
                worstSlide = std::max(worstSlide, std::abs(slides.velocity.x() / expected - 1.0));
            } else {
                CHECK(slides.velocity.norm() == 0.0);
            }
            // Once it rests nothing moves it.
            MovingParticle rests = placed(Vec3d(0.1, kGroundOffset, 0.2), Vec3d::Zero(), colliders);
            for (int s = 0; s < 100; ++s) step(rests, colliders, options, tally);
            const Vec3d at = rests.position;
            for (int s = 0; s < 1000; ++s) step(rests, colliders, options, tally);
            CHECK((rests.position - at).norm() <= 1e-6 * kGroundVoxel);
        }
    }
    stabilityRow("dt", "1e-9 to 10 s", "most energy gained in a step, relative", worstGain);
    stabilityRow("bounce", "dt 1e-9 to 1e-5 s", "error of the speed after, of 0.6", worstBounce);
    stabilityRow("sliding", "dt 1e-9 to 1e-3 s", "relative error of the speed after 100 steps", worstSlide);
}

TEST_CASE("speeds up to a thousand million voxels a step do not leak", "[extremes]")
{
    const int leaks = leaksOf(fieldOf(plate(2.0), uniformTransform(kVoxel), 26), 3000, 5, 9, passesPlate) +
                      leaksOf(fieldOf(sphere(0.9), uniformTransform(kVoxel), 22), 3000, 5, 9, never);
    CHECK(leaks == 0);
    stabilityRow("speed", "1e5 to 1e9 voxels a step", "leaks of 3000 shots each at a plate of 2 voxels and a sphere",
                 leaks);
}

TEST_CASE("radii from nothing to 50 voxels", "[extremes]")
{
    const double voxel = 0.02;
    const double e = 0.8;
    // A radius wide, bands know their distance where a particle's centre is.
    const FieldPtr floor = fieldOf(halfSpace(kUp, 0.22 * voxel), uniformTransform(voxel), 58, 55.0);
    const FieldPtr ball = fieldOf(sphere(10 * voxel), uniformTransform(voxel), 68, 56.0);
    const double tops[] = {0.22 * voxel, 10 * voxel};
    double worst = 0.0;
    for (double radius : {0.0, 1e-6, 1e-3, 0.5, 1.0, 5.0, 20.0, 50.0}) {
        for (int shape : {0, 1}) {
            INFO("radius " << radius << " voxels on " << (shape == 0 ? "a floor" : "a ball"));
            const StillColliders colliders({{"thing", shape == 0 ? floor : ball, e, 0.3}});
            const double r = radius * voxel;
            const double height = 2.0;
            MovingParticle particle = placed(Vec3d(0, tops[shape] + r + height, 0), Vec3d::Zero(), colliders, r);
            StepTally tally(1);
            while (particle.velocity.y() <= 0.0 && tally.near < 2000) step(particle, colliders, millisecond(), tally);
            const double peak =
                particle.position.y() - r - tops[shape] + particle.velocity.squaredNorm() / (2 * kGravity);
            worst = std::max(worst, std::abs(peak - e * e * height) / height);
            // Trilinear lookup takes h^2 / (8 R) off a sphere of radius R, and its top tilts by less than that.
            CHECK(peak == Approx(e * e * height).epsilon(0.005));
            MovingParticle beside = placed(Vec3d(0.11, tops[shape] + r + 0.3, 0.05), Vec3d(0.3, 0, 0), colliders, r);
            for (int s = 0; s < 1500; ++s) {
                step(beside, colliders, millisecond(), tally);
                REQUIRE(colliders.probe(beside.position, r).gap >= 0.0);
            }
        }
    }
    stabilityRow("radius", "0 to 50 voxels", "relative error of a bounce's height", worst);
}

TEST_CASE("restitution and friction at the ends of their ranges", "[extremes]")
{
    double worst = 0.0;
    for (const Ground& ground : grounds(kUp)) {
        for (double e : {0.0, 1.0}) {
            for (double mu : {0.0, 1e6}) {
                INFO(ground.name << ", restitution " << e << ", mu " << mu);
                const StillColliders colliders = single(ground, e, mu);
                const StepOptions options = millisecond();
                MovingParticle particle =
                    placed(Vec3d(-0.8, kGroundOffset + 0.3, 0.1), Vec3d(0.4, 0, 0), colliders, 0.02);
                StepTally tally(1);
                const double whole = energy(particle, options.gravity);
                double before = whole;
                for (int s = 0; s < 3000; ++s) {
                    step(particle, colliders, options, tally);
                    REQUIRE(colliders.probe(particle.position, 0.02).gap >= 0.0);
                    const double now = energy(particle, options.gravity);
                    worst = std::max(worst, now - before);
                    REQUIRE(now <= before + 1e-12);
                    before = now;
                }
                if (e == 1.0 && mu == 0.0) CHECK(before == Approx(whole).epsilon(1e-9));
                if (e == 0.0) CHECK(std::abs(particle.velocity.y()) <= 1e-6);
                CHECK(particle.velocity.x() == Approx(mu == 0.0 ? 0.4 : 0.0).margin(1e-5));
            }
        }
    }
    stabilityRow("restitution and friction", "0 and 1, 0 and 1e6", "most energy gained in a step, J a kg", worst);
}

TEST_CASE("masses from 1e-12 to 1e12", "[extremes]")
{
    const Shape ball = fieldOf(sphere(0.5), uniformTransform(kVoxel), 14);
    double worstImpulse = 0.0;
    double worstMomentum = 0.0;
    double worstAnswer = 0.0;
    for (double mass : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
        INFO("mass " << mass);
        PassOptions options;
        options.step = millisecond();
        options.step.gravity = Vec3d::Zero();
        options.defaults = {0.02, mass};
        Particles start;
        start.resize(1);
        start.position[0] = Vec3d(-1, 0, 0);
        start.ensureVelocity();
        start.velocity[0] = Vec3d(3, 0, 0);

        Collider thing{"ball", ball, 0.7, 0.2};
        Particles particles = start;
        const ColliderSet fixed({thing});
        const PassReport report = ParticlePass(particles, fixed, options).advance(400);
        const Vec3d change = mass * (particles.velocity[0] - start.velocity[0]);
        const double impulseError = (change + report.tally.impulse[0]).norm() / (3.0 * mass);
        worstImpulse = std::max(worstImpulse, impulseError);
        CHECK(impulseError <= 1e-14);

        thing.body = evenDensity(ball, 1.0);
        const ColliderSet free({thing});
        particles = start;
        ParticlePass pass(particles, free, options);
        pass.advance(400);
        const RigidVelocity after = pass.bodies()[0]->velocity();
        const double sum = particles.velocity[0].x() * mass + after.linear.x();
        worstMomentum = std::max(worstMomentum, std::abs(sum / (3.0 * mass) - 1.0));
        CHECK(sum == Approx(3.0 * mass).epsilon(1e-12));
        const double expected = 3.0 * 1.7 * mass / (mass + 1.0);
        worstAnswer = std::max(worstAnswer, std::abs(after.linear.x() / expected - 1.0));
        CHECK(after.linear.x() == Approx(expected).epsilon(0.01));
    }
    const std::string range = "1e-12 to 1e12, of a free body 1";
    stabilityRow("mass", range, "relative error of the impulse that is reported", worstImpulse);
    stabilityRow("mass", range, "relative error of the momentum together", worstMomentum);
    stabilityRow("mass", range, "relative error of the body's velocity", worstAnswer);
}

TEST_CASE("walls of two voxels hold, and how much thinner ones leak", "[extremes]")
{
    for (double thickness : {2.0, 1.0, 0.5}) {
        const int leaks = leaksOf(fieldOf(plate(thickness), uniformTransform(kVoxel), 26), 1000, -1, 7, passesPlate);
        std::ostringstream range;
        range << thickness << " voxels";
        stabilityRow("thickness of a plate", range.str(), "leaks of 1000 shots, 0.1 to 1e7 voxels a step", leaks);
        if (thickness >= 2.0) CHECK(leaks == 0);
    }
}

TEST_CASE("the smallest numbers, and zeros of either sign", "[extremes]")
{
    const double tiny = std::numeric_limits<double>::denorm_min();
    const double small = std::numeric_limits<double>::min();
    const Phi phi = halfSpace(kUp);
    const Ground list[] = {{"plane", PlaneField(Vec3d::Zero(), kUp)},
                           {"level set", fieldOf(phi, uniformTransform(kVoxel), 10)}};
    for (const Ground& ground : list) {
        const StillColliders colliders = single(ground, 0.5, 0.3);
        for (double length : {0.0, -0.0, tiny, small, 1e-200}) {
            for (double speed : {0.0, -0.0, tiny, -tiny, small, -small, 1e-200, -1e-200}) {
                for (bool weight : {false, true}) {
                    INFO(ground.name << ", at " << length << ", speed " << speed << ", weight " << weight);
                    StepOptions options = millisecond();
                    if (!weight) options.gravity = Vec3d(0, -0.0, 0);
                    MovingParticle particle =
                        placed(Vec3d(-length, length, tiny), Vec3d(speed, speed, -speed), colliders, 0.0);
                    REQUIRE_FALSE(particle.inside);
                    StepTally tally(1);
                    for (int s = 0; s < 50; ++s) {
                        step(particle, colliders, options, tally);
                        REQUIRE(particle.position.allFinite());
                        REQUIRE(particle.velocity.allFinite());
                        // The square of less than this is 0, and so is the length that the root of it tells.
                        REQUIRE(colliders.probe(particle.position, 0.0).gap >= -1e-150);
                    }
                    CHECK(particle.position.norm() <= 1e-6 * kVoxel);
                    CHECK(particle.velocity.norm() <= 1e-6);
                }
            }
        }
    }
    stabilityRow("places and speeds next to 0", "5e-324 to 1e-200, 0 and -0",
                 "not finite, or deeper inside than 1e-150", 0);
}

TEST_CASE("grids without a surface, or with next to none", "[extremes]")
{
    openvdb::initialize();
    const auto grid = [](float background) {
        auto result = openvdb::FloatGrid::create(background);
        result->setTransform(uniformTransform(kVoxel));
        result->setGridClass(openvdb::GRID_LEVEL_SET);
        return result;
    };
    const auto cube = [](const openvdb::FloatGrid::Ptr& into, float value) {
        into->denseFill(openvdb::CoordBBox(openvdb::Coord(-6), openvdb::Coord(6)), value, true);
        return into;
    };
    const auto oneVoxel = [](const openvdb::FloatGrid::Ptr& into, float value) {
        into->tree().setValueOn(openvdb::Coord(0), value);
        return into;
    };
    struct Case {
        const char* name;
        openvdb::FloatGrid::Ptr grid;
    };
    const Case cases[] = {{"empty", grid(0.15f)},
                          {"one voxel, outside", oneVoxel(grid(0.15f), 0.05f)},
                          {"one voxel, inside", oneVoxel(grid(0.15f), -0.05f)},
                          {"all inside", cube(grid(0.15f), -0.15f)},
                          {"all outside", cube(grid(0.15f), 0.15f)}};
    VDBOUNCE_RANDOM(random);
    for (const Case& thing : cases) {
        const auto field = std::make_shared<const DistanceField>(levelSet(thing.grid));
        for (Scheme scheme : {Scheme::CollideContact, Scheme::Iterate, Scheme::Once}) {
            for (int i = 0; i < 100; ++i) {
                const StillColliders colliders({{"thing", field, random.uniform(0, 1), random.uniform(0, 1)}});
                const Vec3d from = random.uniform(0.0, 1.0) * random.direction();
                MovingParticle particle =
                    placed(from, -std::pow(10.0, random.uniform(-1, 5)) * from, colliders, i % 2 == 0 ? 0.0 : 0.02);
                const bool outside = !particle.inside;
                StepOptions options = millisecond();
                options.scheme = scheme;
                StepTally tally(1);
                for (int s = 0; s < 50; ++s) {
                    step(particle, colliders, options, tally);
                    INFO(thing.name << ", from " << from.transpose() << ", step " << s << ", scheme " << int(scheme));
                    REQUIRE(particle.position.allFinite());
                    REQUIRE(particle.velocity.allFinite());
                    if (outside && scheme != Scheme::Once)
                        REQUIRE(colliders.probe(particle.position, particle.radius).gap >= 0.0);
                }
            }
        }
    }
    stabilityRow("grids without a surface", "empty, one voxel, all inside, all outside", "not finite, or went inside",
                 0);
}
