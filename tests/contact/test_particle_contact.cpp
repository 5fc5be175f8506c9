// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/contact/cell_list.h"
#include "vdbounce/contact/particle_pass.h"

#include <Eigen/Geometry>

#include <cmath>
#include <set>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

PassOptions interacting(double restitution, double friction, const Vec3d& gravity, double radius)
{
    PassOptions options;
    options.interact = true;
    options.particles = {restitution, friction};
    options.step.gravity = gravity;
    options.step.dt = 1e-3;
    options.defaults = {radius, 1.0};
    return options;
}

Particles pair(const Vec3d& a, const Vec3d& va, const Vec3d& b, const Vec3d& vb)
{
    Particles particles;
    particles.resize(2);
    particles.position = {a, b};
    particles.velocity = {va, vb};
    return particles;
}

Vec3d momentum(const Particles& particles)
{
    Vec3d sum = Vec3d::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i)
        sum += (particles.mass.empty() ? 1.0 : particles.mass[i]) * particles.velocity[i];
    return sum;
}

double kinetic(const Particles& particles) { return totalEnergy(particles, {0.0, 1.0}, Vec3d::Zero()); }

// A box of four walls and a floor, 1 wide.
ColliderSet tub()
{
    return ColliderSet({{"floor", PlaneField(Vec3d::Zero(), Vec3d(0, 1, 0)), 0.2, 0.4},
                        {"left", PlaneField(Vec3d(-0.5, 0, 0), Vec3d(1, 0, 0)), 0.2, 0.4},
                        {"right", PlaneField(Vec3d(0.5, 0, 0), Vec3d(-1, 0, 0)), 0.2, 0.4},
                        {"front", PlaneField(Vec3d(0, 0, 0.5), Vec3d(0, 0, -1)), 0.2, 0.4},
                        {"back", PlaneField(Vec3d(0, 0, -0.5), Vec3d(0, 0, 1)), 0.2, 0.4}});
}

} // namespace

TEST_CASE("a cell list meets each two points near each other once")
{
    VDBOUNCE_RANDOM(random);
    std::vector<Vec3d> points(600);
    for (Vec3d& p : points) p = random.in(Box{Vec3d(-1, 5, 0), Vec3d(2, 6, 0.5)});
    std::vector<std::uint8_t> skipped(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); i += 7) skipped[i] = 1;
    for (double cell : {0.05, 0.3, 100.0, 1e-9}) {
        const CellList cells(points, skipped, cell);
        std::set<std::pair<std::uint32_t, std::uint32_t>> met;
        for (std::size_t place = 0; place < cells.size(); ++place) {
            const std::uint32_t i = cells.index(place);
            cells.forEachNearAfter(place, [&](std::uint32_t j) {
                CHECK(i != j);
                CHECK(met.insert({std::min(i, j), std::max(i, j)}).second);
            });
        }
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            for (std::uint32_t j = i + 1; j < points.size(); ++j) {
                if (skipped[i] != 0 || skipped[j] != 0) {
                    REQUIRE(met.count({i, j}) == 0);
                } else if ((points[i] - points[j]).norm() <= cell) {
                    REQUIRE(met.count({i, j}) == 1);
                }
            }
        }
    }
}

TEST_CASE("two particles collide as the textbook says")
{
    const ColliderSet none({});
    for (double e : {0.0, 0.5, 1.0}) {
        for (double ratio : {1.0, 3.0, 1000.0}) {
            Particles particles = pair(Vec3d(-1, 0, 0), Vec3d(2, 0, 0), Vec3d(0, 0, 0), Vec3d(-1, 0, 0));
            particles.mass = {1.0, ratio};
            ParticlePass pass(particles, none, interacting(e, 0.3, Vec3d::Zero(), 0.1));
            pass.advance(400);
            const double before = 2.0 - ratio;
            const double centre = before / (1.0 + ratio);
            INFO("restitution " << e << ", mass ratio " << ratio);
            CHECK(particles.velocity[0].x() == Approx(centre - e * 3.0 * ratio / (1.0 + ratio)));
            CHECK(particles.velocity[1].x() == Approx(centre + e * 3.0 / (1.0 + ratio)));
            CHECK((particles.position[1] - particles.position[0]).norm() >= 0.2 * (1.0 - 1e-9));
        }
    }
}

TEST_CASE("a collision keeps its restitution wherever between steps it falls")
{
    VDBOUNCE_RANDOM(random);
    const ColliderSet none({});
    for (int i = 0; i < 500; ++i) {
        Particles particles =
            pair(Vec3d(random.uniform(-0.5, -0.3), 0, 0), Vec3d(1, 0, 0), Vec3d::Zero(), Vec3d::Zero());
        ParticlePass pass(particles, none, interacting(1.0, 0.3, Vec3d::Zero(), 0.1));
        pass.advance(500);
        REQUIRE(particles.velocity[0].norm() == Approx(0.0).margin(1e-12));
        REQUIRE(particles.velocity[1].x() == Approx(1.0));
    }
}

TEST_CASE("an oblique collision of two particles keeps Coulomb's law")
{
    const ColliderSet none({});
    const double mu = 0.2;
    const double e = 0.5;
    Particles particles = pair(Vec3d(0, 0.3, 0), Vec3d(1, -1, 0), Vec3d(0.2, 0, 0), Vec3d::Zero());
    const Vec3d before = momentum(particles);
    ParticlePass pass(particles, none, interacting(e, mu, Vec3d::Zero(), 0.1));
    pass.advance(300);
    CHECK((momentum(particles) - before).norm() < 1e-14);
    // The normal is that from the one to the other just before: follow the free path to it.
    double t = 0.0;
    while ((Vec3d(t, 0.3 - t, 0) - Vec3d(0.2, 0, 0)).norm() > 0.2) t += 1e-3;
    const Vec3d normal = (Vec3d(t - 1e-3, 0.3 - t + 1e-3, 0) - Vec3d(0.2, 0, 0)).normalized();
    const Vec3d w(1, -1, 0);
    const Vec3d tangential = w - w.dot(normal) * normal;
    const Vec3d expected =
        (1.0 - mu * (1 + e) * -w.dot(normal) / tangential.norm()) * tangential - e * w.dot(normal) * normal;
    CHECK((particles.velocity[0] - particles.velocity[1] - expected).norm() < 1e-9);
}

TEST_CASE("in a gas of particles momentum is kept to rounding and energy never grows")
{
    VDBOUNCE_RANDOM(random);
    const ColliderSet none({});
    for (double e : {1.0, 0.4}) {
        Particles particles;
        particles.resize(3000);
        particles.ensureVelocity();
        particles.radius.resize(3000);
        particles.mass.resize(3000);
        for (std::size_t i = 0; i < 3000; ++i) {
            particles.position[i] = random.in(Box{Vec3d::Constant(-0.5), Vec3d::Constant(0.5)});
            particles.velocity[i] = random.uniform(0, 5) * random.direction();
            particles.radius[i] = random.uniform(0.005, 0.03);
            particles.mass[i] = std::pow(10.0, random.uniform(-2, 2));
        }
        const Vec3d before = momentum(particles);
        double scale = 0.0;
        for (std::size_t i = 0; i < 3000; ++i) scale += particles.mass[i] * particles.velocity[i].norm();
        ParticlePass pass(particles, none, interacting(e, 0.3, Vec3d::Zero(), 0.0));
        double energy = kinetic(particles);
        for (int s = 0; s < 100; ++s) {
            pass.advance(1);
            REQUIRE((momentum(particles) - before).norm() < 1e-13 * scale);
            REQUIRE(kinetic(particles) <= energy * (1.0 + 1e-13));
            energy = kinetic(particles);
        }
    }
}

TEST_CASE("a heap of particles in a tub settles, stays in, and has the same bits for any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const ColliderSet colliders = tub();
    Particles start;
    start.resize(1500);
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.position[i] =
            Vec3d(-0.4 + 0.09 * double(i % 10), 0.1 + 0.09 * double(i / 100), -0.4 + 0.09 * double(i / 10 % 10)) +
            0.004 * random.direction();
    }
    const PassOptions options = interacting(0.2, 0.4, Vec3d(0, -9.81, 0), 0.04);
    std::vector<Vec3d> first;
    for (std::size_t threads : {1u, 2u, 3u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Particles particles = start;
        ParticlePass pass(particles, colliders, options);
        const int steps = threads == 1 ? 3000 : 300;
        PassReport report = pass.advance(300);
        if (first.empty()) first = particles.position;
        CHECK(particles.position == first);
        if (steps > 300) {
            report = pass.advance(steps - 300);
            CHECK(report.tally.unresolved == 0);
            double fastest = 0.0;
            for (std::size_t i = 0; i < particles.size(); ++i) {
                const Vec3d& p = particles.position[i];
                REQUIRE(p.allFinite());
                REQUIRE(p.y() >= 0.04 * (1 - 1e-9));
                REQUIRE(std::max(std::abs(p.x()), std::abs(p.z())) <= 0.46 * (1 + 1e-9));
                fastest = std::max(fastest, particles.velocity[i].norm());
            }
            const double deepest = [&] {
                double overlap = 0.0;
                for (std::size_t i = 0; i < particles.size(); ++i) {
                    for (std::size_t j = 0; j < i; ++j)
                        overlap = std::max(overlap, 0.08 - (particles.position[i] - particles.position[j]).norm());
                }
                return overlap;
            }();
            INFO("fastest " << fastest << ", deepest overlap " << deepest);
            CHECK(fastest < 0.1);
            CHECK(deepest < 0.008); // a tenth of a diameter under nineteen layers
        }
    }
}
