// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/grounds.h"
#include "support/one_particle.h"
#include "support/random.h"

#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/particle_pass.h"

#include <Eigen/Geometry>

#include <cmath>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

std::shared_ptr<const DistanceField> fieldOf(const Phi& phi, double voxel, int side, double halfWidthVx = 3.0)
{
    return std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(voxel), side, halfWidthVx)));
}

Phi box(const Vec3d& low, const Vec3d& high)
{
    return [=](const Vec3d& p) {
        const Vec3d d = (p - 0.5 * (low + high)).cwiseAbs() - 0.5 * (high - low);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
}

Motion moving(const Vec3d& velocity, const Vec3d& angular = Vec3d::Zero(), const Vec3d& centre = Vec3d::Zero())
{
    return Motion(Motion::Constant{velocity, angular, centre});
}

Collider collider(const Shape& shape, double restitution, double friction, const Motion& motion,
                  OnHit onHit = OnHit::Bounce)
{
    Collider result{"thing", shape, restitution, friction, onHit};
    result.motion = motion;
    return result;
}

// Colliders that move by themselves, with their time.
class Scene {
public:
    Scene(std::vector<Collider> colliders, const StepOptions& options)
        : set_(std::move(colliders)), options_(options), placed_(set_, 0.0, 0.0), tally_(set_.size())
    {
    }

    Scene(const Scene&) = delete; // what is placed refers to the set
    Scene& operator=(const Scene&) = delete;

    // A particle that begins with them.
    MovingParticle particle(const Vec3d& position, const Vec3d& velocity, double radius = 0.0) const
    {
        return placed(position, velocity, placed_, radius);
    }

    // One step of one particle, or of several that do not see each other.
    void advance(std::initializer_list<MovingParticle*> particles)
    {
        placed_ = PlacedColliders(set_, double(steps_) * options_.dt, options_.dt);
        ++steps_;
        for (MovingParticle* particle : particles) step(*particle, placed_, options_, tally_);
    }
    void advance(MovingParticle& particle) { advance({&particle}); }

    double gap(const MovingParticle& particle) const { return placed_.probe(particle.position, particle.radius).gap; }
    // Where the first collider was when the last step began, and where it is now.
    const Placement& placement() const { return placed_.placement(0); }
    const StepTally& tally() const { return tally_; }
    double time() const { return double(steps_) * options_.dt; }

private:
    ColliderSet set_;
    StepOptions options_;
    PlacedColliders placed_;
    StepTally tally_;
    std::uint64_t steps_ = 0;
};

StepOptions weightless(double dt)
{
    StepOptions options;
    options.dt = dt;
    options.gravity = Vec3d::Zero();
    return options;
}

StepOptions millisecond()
{
    StepOptions options;
    options.dt = 1e-3;
    return options;
}

} // namespace

TEST_CASE("a floor that rises at a constant speed throws a resting particle up with twice that speed")
{
    for (const Ground& ground : grounds(kUp)) {
        for (double speed : {0.1, 2.0, 500.0}) {
            INFO(ground.name << ", speed " << speed);
            Scene scene({collider(ground.shape, 1.0, 0.3, moving(Vec3d(0, speed, 0)))}, weightless(1e-3));
            MovingParticle particle = scene.particle(Vec3d(0.1, kGroundOffset + 0.0522, 0.2), Vec3d::Zero(), 0.02);
            while (scene.tally().contacts == 0 && scene.time() < 1.0) scene.advance(particle);
            CHECK((particle.velocity - Vec3d(0, 2 * speed, 0)).norm() <= 1e-4 * speed);
            for (int s = 0; s < 100; ++s) scene.advance(particle);
            CHECK(scene.tally().contacts == 1);
            CHECK(scene.gap(particle) > 0.0);
        }
    }
}

TEST_CASE("a platform drags a particle along by mu g until it moves with it")
{
    const double mu = 0.3;
    const Vec3d velocity(0.8, 0, -0.6);
    for (const Ground& ground : grounds(kUp)) {
        INFO(ground.name);
        Scene scene({collider(ground.shape, 0.2, mu, moving(velocity))}, millisecond());
        MovingParticle particle = scene.particle(Vec3d(0, kGroundOffset, 0), Vec3d::Zero());
        while (scene.time() < 0.2) scene.advance(particle);
        CHECK((particle.velocity - mu * kGravity * 0.2 * velocity).norm() <= 0.01 * mu * kGravity * 0.2);
        while (scene.time() < 0.345) scene.advance(particle);
        const Vec3d rests = scene.placement().end.toLocal(particle.position);
        CHECK((particle.velocity - velocity).norm() <= 1e-12);
        // What it slid back by while it was slower.
        CHECK((rests + velocity / (2 * mu * kGravity)).head<1>().norm() <= 0.01 / (2 * mu * kGravity));
        while (scene.time() < 1.0) scene.advance(particle);
        CHECK((scene.placement().end.toLocal(particle.position) - rests).norm() <= 1e-6 * kGroundVoxel);
        CHECK((particle.velocity - velocity).norm() <= 1e-12);
    }
}

TEST_CASE("on a turntable a particle rests exactly while omega^2 r < mu g, and moves along")
{
    const double mu = 0.5;
    const double omega = 3.0;
    const double limit = mu * kGravity / (omega * omega);
    for (const Ground& ground : grounds(kUp)) {
        for (double share : {0.3, 0.6, 0.98, 1.02}) {
            INFO(ground.name << ", " << share << " of the largest radius");
            const double r = share * limit;
            Scene scene({collider(ground.shape, 0.3, mu, moving(Vec3d::Zero(), Vec3d(0, omega, 0)))}, millisecond());
            MovingParticle particle = scene.particle(Vec3d(r, kGroundOffset, 0), Vec3d(0, 0, -omega * r));
            while (scene.time() < 2 * M_PI / omega) scene.advance(particle);
            const Vec3d local = scene.placement().end.toLocal(particle.position);
            const double drift = std::hypot(local.x(), local.z()) - r;
            if (share < 1.0) {
                CHECK(std::abs(drift) < 1e-6);
                CHECK((local - Vec3d(r, kGroundOffset, 0)).norm() < 1e-6);
            } else {
                CHECK(drift > 0.01);
            }
        }
    }
}

TEST_CASE("a paddle that turns about its end gives a particle (1 + e) times its speed there, whatever both share")
{
    const auto paddle = fieldOf(box(Vec3d(0, -0.1, -0.3), Vec3d(1, 0.1, 0.3)), 0.04, 32);
    const double omega = 2.0;
    for (const Vec3d& shared : {Vec3d(0, 0, 0), Vec3d(3, -1, 2), Vec3d(300, -100, 200)}) {
        for (double e : {0.0, 0.6, 1.0}) {
            INFO("restitution " << e << ", both move by " << shared.transpose());
            Scene scene({collider(paddle, e, 0.0, moving(shared, Vec3d(0, 0, omega)))}, weightless(1e-3));
            MovingParticle particle = scene.particle(Vec3d(0.7, 0.3, 0.02), shared);
            while (scene.tally().contacts == 0 && scene.time() < 1.0) scene.advance(particle);
            // It is met by the face that is 0.1 above the middle.
            const double arm = std::sqrt(0.7 * 0.7 + 0.3 * 0.3 - 0.1 * 0.1);
            const double angle = std::atan2(0.3, 0.7) - std::atan2(0.1, arm);
            const Vec3d expected = (1.0 + e) * omega * arm * Vec3d(-std::sin(angle), std::cos(angle), 0.0);
            CHECK(scene.time() == Approx(angle / omega).margin(1.1e-3));
            CHECK((particle.velocity - shared - expected).norm() <= 0.01 * expected.norm());
        }
    }
}

TEST_CASE("a floor that is keyed through a particle's place in one step carries it up")
{
    for (const Ground& ground : grounds(kUp)) {
        for (double lift : {0.01, 0.5, 40.0}) {
            INFO(ground.name << ", lifted by " << lift);
            const StepOptions options;
            std::vector<Motion::Key> keys(2);
            keys[1].time = options.dt;
            keys[1].translate = Vec3d(0, lift, 0);
            Scene scene({collider(ground.shape, 0.0, 0.5, Motion(keys))}, options);
            MovingParticle particle = scene.particle(Vec3d(0.1, kGroundOffset + 0.021, 0), Vec3d::Zero(), 0.02);
            for (int s = 0; s < 20; ++s) {
                scene.advance(particle);
                REQUIRE(scene.gap(particle) >= 0.0);
                REQUIRE(particle.position.y() >= lift);
            }
        }
    }
}

TEST_CASE("motion by keys equals the constant motion that they describe")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d velocity(0.3, 0.2, -0.1);
    const Vec3d angular(0.4, -1.1, 0.6);
    std::vector<Motion::Key> keys(11);
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const double time = 0.1 * double(k);
        keys[k] = {time, time * velocity,
                   Eigen::Quaterniond(Eigen::AngleAxisd(time * angular.norm(), angular.normalized()))};
    }
    const Motion constant = moving(velocity, angular);
    const Motion keyed(keys);
    for (int i = 0; i < 100; ++i) {
        const double time = random.uniform(0, 1);
        const Vec3d p = random.direction();
        REQUIRE((constant.poseAt(time).toWorld(p) - keyed.poseAt(time).toWorld(p)).norm() < 1e-14);
        REQUIRE((constant.velocityAt(time).at(p) - keyed.velocityAt(time).at(p)).norm() < 1e-13);
    }
    const auto block = fieldOf(box(Vec3d(-0.5, -0.3, -0.6), Vec3d(0.5, 0.3, 0.6)), 0.05, 18);
    std::uint64_t contacts = 0;
    for (int i = 0; i < 30; ++i) {
        Scene a({collider(block, 0.5, 0.3, constant)}, millisecond());
        Scene b({collider(block, 0.5, 0.3, keyed)}, millisecond());
        MovingParticle one = a.particle(random.in(Box{Vec3d(-0.5, 0.35, -0.5), Vec3d(0.5, 0.6, 0.5)}), Vec3d::Zero());
        MovingParticle other = one;
        while (a.time() < 0.99) {
            a.advance(one);
            b.advance(other);
        }
        contacts += a.tally().contacts;
        // Rounding decides in which of two steps a contact falls, and with it about g dt.
        CHECK((one.position - other.position).norm() < 1e-2 * 0.05);
        CHECK((one.velocity - other.velocity).norm() < 2.0 * kGravity * 1e-3);
    }
    CHECK(contacts > 30);
}

TEST_CASE("a plate two voxels thick that moves and turns passes through no particle")
{
    VDBOUNCE_RANDOM(random);
    const double voxel = 0.05;
    const double middle = 0.013;
    const double side = 1.0;
    const auto plate = fieldOf(box(Vec3d(-side, middle - voxel, -side), Vec3d(side, middle + voxel, side)), voxel, 26);
    const double dt = 0.01;
    int met = 0;
    for (int i = 0; i < 1500; ++i) {
        const Vec3d velocity = voxel / dt * std::pow(10.0, random.uniform(-1, 6)) * random.direction();
        // Up to half a turn a step, beyond which nobody can tell which way it turned.
        const Vec3d angular = (i % 3 == 0 ? 0.0 : random.uniform(0, 1) / dt) * random.direction();
        const Vec3d own = i % 2 == 0 ? Vec3d(Vec3d::Zero())
                                     : Vec3d(voxel / dt * std::pow(10.0, random.uniform(-1, 6)) * random.direction());
        const double radius = i % 4 < 2 ? 0.0 : random.uniform(0, voxel);
        const Motion motion = moving(velocity, angular);
        Scene scene({collider(plate, random.uniform(0, 1), random.uniform(0, 1), motion)}, weightless(dt));
        // Where it must be now so that it lies in the plate at some time of the next four steps.
        const double when = random.uniform(0, 4) * dt;
        const Vec3d target(random.uniform(-0.8, 0.8) * side, middle, random.uniform(-0.8, 0.8) * side);
        MovingParticle particle = scene.particle(motion.poseAt(when).toWorld(target) - when * own, own, radius);
        if (particle.inside) continue;
        for (int s = 0; s < 8; ++s) {
            const Vec3d start = particle.position;
            scene.advance(particle);
            INFO("plate " << i << ", step " << s << ", velocity " << velocity.transpose() << ", angular "
                          << angular.transpose() << ", particle " << own.transpose() << ", radius " << radius);
            REQUIRE(scene.gap(particle) >= 0.0);
            const Placement& placement = scene.placement();
            const auto at = [&](double share) {
                return placement.between(share).toLocal(start + share * (particle.position - start));
            };
            double before = 0.0;
            double after = 1.0;
            const double sign = at(0.0).y() - middle;
            if (sign * (at(1.0).y() - middle) >= 0.0) continue;
            for (int k = 0; k < 60; ++k) {
                const double between = 0.5 * (before + after);
                (sign * (at(between).y() - middle) > 0.0 ? before : after) = between;
            }
            const Vec3d crossing = at(before).cwiseAbs();
            REQUIRE(std::max(crossing.x(), crossing.z()) > side - 1.5 * voxel);
        }
        met += scene.tally().contacts > 0 ? 1 : 0;
    }
    CHECK(met > 1000);
}

TEST_CASE("what sticks stays at one point of its collider")
{
    VDBOUNCE_RANDOM(random);
    const auto ball = fieldOf(sphere(0.5, Vec3d(0.3, 0, 0)), 0.05, 20);
    for (int i = 0; i < 20; ++i) {
        const Motion motion = moving(random.direction(), 4.0 * random.direction(), 0.2 * random.direction());
        Scene scene({collider(ball, 0.3, 0.5, motion, OnHit::Stick)}, millisecond());
        const Vec3d from = 1.2 * random.direction();
        MovingParticle particle = scene.particle(from, -8.0 * from, 0.02);
        while (particle.stuckTo == MovingParticle::kNotStuck && scene.time() < 1.0) scene.advance(particle);
        REQUIRE(particle.stuckTo == 0);
        CHECK(std::abs(scene.gap(particle)) <= 1e-2 * 0.05);
        const Vec3d held = scene.placement().end.toLocal(particle.position);
        for (int s = 0; s < 1000; ++s) scene.advance(particle);
        CHECK((scene.placement().end.toLocal(particle.position) - held).norm() < 1e-9);
        CHECK((particle.velocity - motion.velocityAt(scene.time()).at(particle.position)).norm() < 1e-9);
    }
}

TEST_CASE("what touches a collider that deletes is removed and counted")
{
    Particles particles;
    particles.resize(200);
    for (std::size_t i = 0; i < 200; ++i) particles.position[i] = Vec3d(0.001 * double(i), i % 2 == 0 ? 0.5 : 5.0, 0.0);
    const ColliderSet colliders({collider(grounds(kUp)[1].shape, 0.3, 0.5, Motion(), OnHit::Delete)});
    ParticlePass pass(particles, colliders, PassOptions());
    CHECK(pass.advance(20).deleted == 0);
    CHECK(pass.advance(100).deleted == 100);
    REQUIRE(particles.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) CHECK(particles.id[i] == std::int64_t(2 * i + 1));
    CHECK(pass.advance(20).deleted == 0);
}

TEST_CASE("a drop's hit tells time, place, normal, velocity and collider")
{
    const double radius = 0.02;
    const auto list = grounds(kUp);
    for (std::size_t g = 0; g < 3; ++g) {
        INFO(list[g].name);
        const ColliderSet colliders({collider(fieldOf(sphere(0.2, Vec3d(0, 0, 1)), 0.05, 28), 0.3, 0.5, Motion()),
                                     collider(list[g].shape, 0.4, 0.5, Motion())});
        Particles particles;
        particles.resize(1);
        particles.position[0] = Vec3d(0.1, kGroundOffset + radius + 1.0, -0.5);
        particles.ensureVelocity();
        particles.velocity[0] = Vec3d(0.2, 0, 0);
        PassOptions options;
        options.step = millisecond();
        options.defaults.radius = radius;
        options.hits = true;
        ParticlePass pass(particles, colliders, options);
        const double falls = std::sqrt(2.0 / kGravity);
        pass.advance(int(falls / options.step.dt) - 1);
        CHECK(particles.hits[0].count == 0);
        CHECK(particles.hits[0].collider == -1);
        pass.advance(3);
        const HitRecord& hit = particles.hits[0];
        CHECK(hit.count == 1);
        CHECK(hit.collider == 1);
        CHECK(hit.time == Approx(falls).margin(options.step.dt));
        CHECK((hit.position - Vec3d(0.1 + 0.2 * falls, kGroundOffset, -0.5)).norm() <= 6.0 * options.step.dt);
        CHECK((hit.normal - kUp).norm() <= 1e-5);
        CHECK((hit.velocity - Vec3d(0.2, -kGravity * falls, 0)).norm() <= 2.0 * kGravity * options.step.dt);
        // At rest it touches all the time, and that is one hit.
        pass.advance(4000);
        const int count = hit.count;
        CHECK(count > 3);
        pass.advance(2000);
        CHECK(hit.count == count);
    }
}

namespace {

// A free sphere in a hail of particles, without gravity.
struct Hail {
    Particles particles;
    double largestMomentumError = 0.0; // relative to the sum of all momenta's lengths
    double largestGain = 0.0;          // of energy in a step, relative
    std::uint64_t contacts = 0;
    std::vector<double> bodyState;
};

Hail hailOn(const ColliderSet& colliders, const Particles& start, Scheme scheme, double dt)
{
    Hail run;
    run.particles = start;
    PassOptions options;
    options.step = weightless(dt);
    options.step.scheme = scheme;
    options.defaults = {0.01, 0.02};
    ParticlePass pass(run.particles, colliders, options);
    const auto momentum = [&] {
        Vec3d sum = pass.bodies()[0]->momentum();
        for (const Vec3d& v : run.particles.velocity) sum += options.defaults.mass * v;
        return sum;
    };
    const auto energyNow = [&] {
        return pass.bodies()[0]->energy(Vec3d::Zero()) +
               totalEnergy(run.particles, options.defaults, options.step.gravity);
    };
    double scale = pass.bodies()[0]->momentum().norm();
    for (const Vec3d& v : run.particles.velocity) scale += options.defaults.mass * v.norm();
    const Vec3d whole = momentum();
    double before = energyNow();
    for (int s = 0; s < 300; ++s) {
        run.contacts += pass.advance(1).tally.contacts;
        run.largestMomentumError = std::max(run.largestMomentumError, (momentum() - whole).norm() / scale);
        const double now = energyNow();
        run.largestGain = std::max(run.largestGain, (now - before) / before);
        before = now;
    }
    const RigidVelocity velocity = pass.bodies()[0]->velocity();
    for (const Vec3d& v : {velocity.linear, velocity.angular, velocity.centre})
        run.bodyState.insert(run.bodyState.end(), {v.x(), v.y(), v.z()});
    return run;
}

} // namespace

TEST_CASE("particles and a free body keep their momentum, gain no energy, and do so on any number of threads")
{
    VDBOUNCE_RANDOM(random);
    const Shape ball = fieldOf(sphere(0.5), 0.05, 14);
    Particles start;
    start.resize(1000);
    start.ensureVelocity();
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.position[i] = random.uniform(0.6, 2.0) * random.direction();
        start.velocity[i] = random.uniform(0.5, 4.0) * (0.4 * random.direction() - start.position[i]).normalized();
    }
    for (Scheme scheme : {Scheme::CollideContact, Scheme::Iterate}) {
        for (double e : {0.0, 0.5, 1.0}) {
            for (double mu : {0.0, 0.4}) {
                INFO("scheme " << int(scheme) << ", restitution " << e << ", mu " << mu);
                Collider thing = collider(ball, e, mu, Motion());
                thing.body = evenDensity(ball, 1.0);
                REQUIRE(thing.body);
                thing.body->velocity = Vec3d(0.3, 0, 0.1);
                thing.body->angularVelocity = Vec3d(0, 2, 1);
                const ColliderSet colliders({thing});
                const Hail run = hailOn(colliders, start, scheme, 2e-3);
                CHECK(run.contacts > 500);
                CHECK(run.largestMomentumError <= 1e-12);
                CHECK(run.largestGain <= 1e-9);
                if (scheme != Scheme::CollideContact || e != 0.5) continue;
                for (std::size_t threads : {1u, 2u, 3u}) {
                    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
                    const Hail same = hailOn(colliders, start, scheme, 2e-3);
                    CHECK(same.particles.position == run.particles.position);
                    CHECK(same.particles.velocity == run.particles.velocity);
                    CHECK(same.bodyState == run.bodyState);
                }
            }
        }
    }
}

TEST_CASE("a particle and a free sphere that meet head-on part as in one dimension")
{
    const Shape ball = fieldOf(sphere(0.5), 0.05, 14);
    for (double mass : {0.1, 1.0, 20.0}) {
        for (double e : {0.3, 1.0}) {
            INFO("mass " << mass << ", restitution " << e);
            Collider thing = collider(ball, e, 0.2, Motion());
            thing.body = evenDensity(ball, 1.0);
            const ColliderSet colliders({thing});
            Particles particles;
            particles.resize(1);
            particles.position[0] = Vec3d(-1, 0, 0);
            particles.ensureVelocity();
            particles.velocity[0] = Vec3d(3, 0, 0);
            PassOptions options;
            options.step = weightless(1e-3);
            options.defaults = {0.02, mass};
            ParticlePass pass(particles, colliders, options);
            pass.advance(400);
            const double together = mass * 3.0 / (mass + 1.0);
            CHECK(particles.velocity[0].x() == Approx(together - e * 3.0 / (mass + 1.0)).margin(0.03));
            CHECK(pass.bodies()[0]->velocity().linear.x() ==
                  Approx(together + e * 3.0 * mass / (mass + 1.0)).margin(0.03));
        }
    }
}

TEST_CASE("a sphere that grows pushes particles out at the speed of its surface")
{
    VDBOUNCE_RANDOM(random);
    const double seconds = 0.5;
    const double speed = 0.2;
    // Two voxels in all, so the band is wide enough for the one where the other has its surface, and around it.
    const auto field = std::make_shared<const DeformingField>(
        fieldOf(sphere(0.5), 0.05, 20, 5.0), fieldOf(sphere(0.5 + speed * seconds), 0.05, 20, 5.0), seconds);
    for (int i = 0; i < 2000; ++i) {
        const double share = random.uniform(0, 1);
        const Vec3d outward = random.direction();
        const double r = 0.5 + share * speed * seconds + random.uniform(-0.05, 0.05);
        REQUIRE((field->velocity(r * outward, share) - speed * outward).norm() <= 0.05 * speed);
    }
    for (double e : {0.0, 0.5}) {
        for (int i = 0; i < 50; ++i) {
            Scene scene({collider(DeformingShape{field, 0.0, seconds}, e, 0.3, Motion())}, weightless(2e-3));
            const Vec3d outward = random.direction();
            MovingParticle particle = scene.particle(0.55 * outward, Vec3d::Zero(), i % 2 == 0 ? 0.0 : 0.02);
            while (scene.time() < seconds) {
                scene.advance(particle);
                INFO("restitution " << e << ", towards " << outward.transpose() << ", at " << scene.time());
                REQUIRE(scene.gap(particle) >= 0.0);
            }
            INFO("restitution " << e << ", towards " << outward.transpose());
            CHECK((particle.velocity - (1.0 + e) * speed * outward).norm() <= 0.1 * speed);
        }
    }
}
