// SPDX-License-Identifier: Apache-2.0
#include "support/one_particle.h"
#include "support/random.h"
#include "support/still_colliders.h"

#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/shape_field.h"
#include "vdbounce/contact/step.h"
#include "vdbounce/contact/sweep.h"
#include "vdbounce/implicit/csg_field.h"
#include "vdbounce/implicit/shapes.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const ImplicitField>;

FieldPtr csg(CsgOperation operation, std::vector<FieldPtr> operands)
{
    return std::make_shared<const CsgField>(operation, std::move(operands));
}

std::vector<std::pair<const char*, FieldPtr>> forms()
{
    const auto brick = makeField(BoxShape{Vec3d::Zero(), Vec3d(0.8, 0.3, 0.5), Eigen::Quaterniond(1, 0.2, 0.1, 0.3)});
    const auto ball = makeField(SphereShape{Vec3d(0.2, 0.3, 0.1), 0.5});
    return {{"sphere", ball},
            {"box", brick},
            {"thin box", makeField(BoxShape{Vec3d::Zero(), Vec3d(1.0, 0.001, 1.0)})},
            {"capsule", makeField(CapsuleShape{Vec3d(-0.5, 0, 0), Vec3d(0.5, 0.3, 0), 0.2})},
            {"cylinder", makeField(CylinderShape{Vec3d(0, -0.4, 0), Vec3d(0.1, 0.4, 0), 0.6})},
            {"cone", makeField(ConeShape{Vec3d(0, -0.4, 0), Vec3d(0, 0.8, 0), 0.7, 0.0})},
            {"torus", makeField(TorusShape{Vec3d::Zero(), Vec3d(0, 1, 0.3), 0.7, 0.2})},
            {"ellipsoid", makeField(EllipsoidShape{Vec3d::Zero(), Vec3d(0.9, 0.3, 0.5)})},
            {"union", csg(CsgOperation::Union, {brick, ball})},
            {"subtraction", csg(CsgOperation::Subtraction, {brick, ball})},
            {"intersection", csg(CsgOperation::Intersection, {brick, ball})}};
}

// Half of space under a floor that rises, which counts how often it is asked.
class RisingFloor final : public ImplicitField {
public:
    double phi(const Vec3d& world, double time) const override
    {
        ++lookups;
        return world.y() - kSpeed * time;
    }
    FieldSample sample(const Vec3d& world, double time) const override { return {phi(world, time), Vec3d::UnitY()}; }
    void phiInRow(const Vec3d& from, const Vec3d& step, int count, double time, double* out) const override
    {
        for (int i = 0; i < count; ++i) out[i] = phi(from + double(i) * step, time);
    }
    Box box() const override { return {Vec3d::Constant(-1e300), Vec3d::Constant(1e300)}; }
    double thinnestWall() const override { return 0.0; } // so that every path is searched
    double resolution() const override { return 1e-3; }
    bool still() const override { return false; }
    Vec3d velocity(const Vec3d&, double) const override { return {0, kSpeed, 0}; }
    double reach(double begin, double end) const override { return kSpeed * (end - begin); }

    static constexpr double kSpeed = 2.0;
    mutable int lookups = 0;
};

} // namespace

TEST_CASE("a path finds the first point of a shape by formula at any speed")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, field] : forms()) {
        const StillColliders colliders({{name, field, 0.5, 0.2}});
        int hits = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d from = 2.0 * random.direction();
            const Vec3d to = from + (0.5 + 4.0 * random.uniform(0, 1)) * (0.5 * random.direction() - from).normalized();
            const double radius = i % 2 == 0 ? 0.0 : 0.03;
            const PathHit hit = sweepPath(colliders, from, to, radius);
            // What a walk in small strides finds.
            constexpr int kStrides = 2000;
            double first = 2.0;
            for (int k = 0; k <= kStrides && first > 1.0; ++k) {
                const double t = double(k) / kStrides;
                if (field->phi(from + t * (to - from), 0.0) - radius < -1e-4) first = t;
            }
            INFO(name << " from " << from.transpose() << " to " << to.transpose());
            if (first <= 1.0) REQUIRE(hit.hit);
            if (!hit.hit) continue;
            ++hits;
            REQUIRE(hit.when <= first);
            REQUIRE(field->phi(hit.position, 0.0) - radius == Approx(0.0).margin(1e-6));
            REQUIRE(colliders.probe(hit.position, radius).gap >= 0.0);
            REQUIRE(hit.hasNormal);
            REQUIRE(hit.normal.norm() == Approx(1.0));
        }
        INFO(name);
        CHECK(hits > 50);
    }
}

TEST_CASE("no particle ends inside a shape by formula, whatever the scheme's chances")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, field] : forms()) {
        const StillColliders colliders({{name, field, 0.6, 0.3}});
        StepOptions options;
        options.dt = 0.01;
        StepTally tally(1);
        std::uint64_t inside = 0;
        for (int i = 0; i < 200; ++i) {
            MovingParticle particle =
                placed(1.8 * random.direction(), std::pow(10.0, random.uniform(-1, 3)) * random.direction(), colliders,
                       i % 2 == 0 ? 0.0 : 0.02);
            for (int s = 0; s < 100; ++s) {
                step(particle, colliders, options, tally);
                inside += colliders.probe(particle.position, particle.radius).gap < 0.0 ? 1 : 0;
            }
        }
        INFO(name << ": " << tally.contacts << " contacts, " << tally.unresolved << " unresolved");
        CHECK(inside == 0);
        CHECK(tally.unresolved * 1000 <= tally.contacts);
    }
}

TEST_CASE("a particle bounces in a hollow sphere for ever, with all its energy and on the path of the billiard")
{
    const auto hollow = csg(CsgOperation::Complement, {makeField(SphereShape{Vec3d::Zero(), 1.0})});
    const StillColliders colliders({{"hollow", hollow, 1.0, 0.0}});
    StepOptions options;
    options.gravity = Vec3d::Zero();
    options.dt = 1e-4;
    options.sweep = Sweep::Always;
    StepTally tally(1);
    MovingParticle particle = placed(Vec3d(0.5, 0, 0), Vec3d(0, 3, 0), colliders);
    double farthest = 0.0;
    double nearest = 1.0;
    for (int s = 0; s < 200000; ++s) {
        step(particle, colliders, options, tally);
        farthest = std::max(farthest, particle.position.norm());
        nearest = std::min(nearest, particle.position.norm());
    }
    CHECK(farthest <= 1.0);
    CHECK(particle.velocity.norm() == Approx(3.0).epsilon(1e-9));
    // Chords of a circle all pass the centre at the same distance; a bounce may turn one by what a step moves.
    CHECK(nearest == Approx(0.5).margin(0.01));
    CHECK(tally.contacts > 20);
}

TEST_CASE("the search on the way of a particle at rest ends soon before a surface that moves")
{
    const auto floor = std::make_shared<RisingFloor>();
    const ColliderSet set({{"floor", FieldPtr(floor)}});
    const PlacedColliders colliders(set, 0.0, 0.01);
    for (const double above : {1e-12, 1e-6, 1e-3, 0.015, 0.1}) {
        for (const Vec3d& way :
             {Vec3d(0, 0, 0), Vec3d(1e-15, 0, 0), Vec3d(0, 1e-9, 0), Vec3d(0, -1e-3, 0), Vec3d(0, 3, 0)}) {
            const Vec3d from(0, above, 0);
            floor->lookups = 0;
            const PathHit hit = sweepPath(colliders, from, from + way, 0.0, Sweep::Always);
            INFO(above << " above, way " << way.transpose());
            CHECK(hit.hit == (above + way.y() < 0.02 && above < 0.02 - way.y()));
            CHECK(floor->lookups < 100);
        }
    }
}

TEST_CASE("a particle that rests on a slab falls through a hole that comes along")
{
    const auto slab = makeField(BoxShape{Vec3d::Zero(), Vec3d(2, 0.2, 2)});
    const Motion along(Motion::Constant{Vec3d(1, 0, 0), Vec3d::Zero(), Vec3d::Zero()});
    const auto hole = asField(Shape(makeField(CylinderShape{Vec3d(-1.5, -1, 0), Vec3d(-1.5, 1, 0), 0.3})), along);
    const ColliderSet set({{"slab", csg(CsgOperation::Subtraction, {slab, hole}), 0.0, 0.8}});
    StepOptions options;
    options.dt = 0.002;
    StepTally tally(1);
    MovingParticle particle = placed(Vec3d(0, 0.25, 0), Vec3d::Zero(), PlacedColliders(set, 0.0, options.dt), 0.05);
    double time = 0.0;
    const auto until = [&](double end) {
        for (; time < end; time += options.dt) step(particle, PlacedColliders(set, time, options.dt), options, tally);
    };
    until(1.1); // the hole's rim is still 0.1 away
    CHECK(particle.position.y() == Approx(0.25).margin(1e-3));
    CHECK(particle.velocity.norm() < 1e-6);
    until(2.2); // and the hole has been there from 1.2 to 1.8
    CHECK(particle.position.y() < -0.3);
}

TEST_CASE("shapes by formula have the mass that theory says")
{
    const auto ball = evenDensity(makeField(SphereShape{Vec3d(1, 2, 3), 0.5}), 4.0);
    REQUIRE(ball);
    CHECK((ball->centre - Vec3d(1, 2, 3)).norm() < 1e-3);
    CHECK(ball->inertia(0, 0) == Approx(0.4 * 4.0 * 0.25).epsilon(2e-3));
    const auto brick = evenDensity(makeField(BoxShape{Vec3d::Zero(), Vec3d(1, 0.5, 0.25)}), 3.0);
    REQUIRE(brick);
    CHECK(brick->inertia(2, 2) == Approx(3.0 / 12.0 * (4.0 + 1.0)).epsilon(5e-3));
    CHECK_FALSE(evenDensity(makeField(PlaneShape{}), 1.0));
}
