// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/contact/shape_field.h"
#include "vdbounce/implicit/csg_field.h"
#include "vdbounce/implicit/shapes.h"

#include <cmath>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const ImplicitField>;

FieldPtr csg(CsgOperation operation, std::vector<FieldPtr> operands, double blend = 0.0)
{
    return std::make_shared<const CsgField>(operation, std::move(operands), blend);
}
FieldPtr complement(FieldPtr a) { return csg(CsgOperation::Complement, {std::move(a)}); }

const Box kAround{Vec3d::Constant(-1.5), Vec3d::Constant(1.5)};

FieldPtr ball() { return makeField(SphereShape{Vec3d(-0.2, 0.1, 0), 0.7}); }
FieldPtr brick() { return makeField(BoxShape{Vec3d(0.3, 0, 0.1), Vec3d(0.6, 0.4, 0.5)}); }
FieldPtr ring() { return makeField(TorusShape{Vec3d(0, 0.2, 0), Vec3d(0, 1, 0), 0.8, 0.2}); }

// Something of every kind, moving operands included.
std::vector<std::pair<const char*, FieldPtr>> someOfAll()
{
    const auto levelSetBall =
        std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(0.6), uniformTransform(0.05), 20, 4.0)));
    const Motion turning(Motion::Constant{Vec3d(0.3, 0, 0), Vec3d(0, 0, 2), Vec3d(0.1, 0.1, 0)});
    return {
        {"union", csg(CsgOperation::Union, {ball(), brick(), ring()})},
        {"intersection", csg(CsgOperation::Intersection, {ball(), brick()})},
        {"subtraction", csg(CsgOperation::Subtraction, {ball(), brick(), ring()})},
        {"complement", complement(brick())},
        {"blended union", csg(CsgOperation::Union, {ball(), brick(), ring()}, 0.3)},
        {"blended intersection", csg(CsgOperation::Intersection, {ball(), brick()}, 0.2)},
        {"blended subtraction", csg(CsgOperation::Subtraction, {brick(), ball()}, 0.2)},
        {"nested", csg(CsgOperation::Subtraction, {csg(CsgOperation::Union, {ball(), ring()}), complement(brick())})},
        {"with a level set", csg(CsgOperation::Subtraction, {brick(), asField(Shape(levelSetBall))})},
        {"with the inside of a level set", csg(CsgOperation::Complement, {asField(Shape(levelSetBall))})},
        {"with a moving hole", csg(CsgOperation::Subtraction, {brick(), asField(Shape(ball()), turning)})},
        {"blended with a moving one",
         csg(CsgOperation::Union, {brick(), asField(Shape(ring()), turning), ball()}, 0.3)},
        {"less a moving one, blended",
         csg(CsgOperation::Subtraction, {brick(), asField(Shape(ring()), turning)}, 0.3)}};
}

} // namespace

TEST_CASE("CSG of fields is inside where the set says")
{
    VDBOUNCE_RANDOM(random);
    const auto a = ball();
    const auto b = brick();
    const auto c = ring();
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.in(kAround);
        const bool inA = a->phi(p, 0) < 0;
        const bool inB = b->phi(p, 0) < 0;
        const bool inC = c->phi(p, 0) < 0;
        REQUIRE((csg(CsgOperation::Union, {a, b, c})->phi(p, 0) < 0) == (inA || inB || inC));
        REQUIRE((csg(CsgOperation::Intersection, {a, b, c})->phi(p, 0) < 0) == (inA && inB && inC));
        REQUIRE((csg(CsgOperation::Subtraction, {a, b, c})->phi(p, 0) < 0) == (inA && !inB && !inC));
        REQUIRE((complement(a)->phi(p, 0) < 0) == !inA);
    }
}

TEST_CASE("set identities hold for fields to the bit")
{
    VDBOUNCE_RANDOM(random);
    const auto a = ball();
    const auto b = brick();
    const auto both = [](CsgOperation operation, FieldPtr x, FieldPtr y) {
        return csg(operation, {std::move(x), std::move(y)});
    };
    constexpr auto kUnion = CsgOperation::Union;
    constexpr auto kIntersection = CsgOperation::Intersection;
    constexpr auto kSubtraction = CsgOperation::Subtraction;
    const std::pair<FieldPtr, FieldPtr> equal[] = {
        {both(kUnion, a, a), a},
        {both(kIntersection, a, a), a},
        {complement(complement(a)), a},
        {both(kUnion, a, b), both(kUnion, b, a)},
        {complement(both(kUnion, a, b)), both(kIntersection, complement(a), complement(b))},
        {complement(both(kIntersection, a, b)), both(kUnion, complement(a), complement(b))},
        {both(kSubtraction, a, b), both(kIntersection, a, complement(b))},
        {both(kUnion, a, both(kIntersection, a, b)), a}};
    for (int i = 0; i < 5000; ++i) {
        const Vec3d p = random.in(kAround);
        for (const auto& [left, right] : equal) REQUIRE(left->phi(p, 0) == right->phi(p, 0));
    }
}

TEST_CASE("the gradient of CSG is the derivative of its phi, and rows have the same bits as single lookups")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, field] : someOfAll()) {
        if (std::string(name).find("level set") != std::string::npos) continue; // central differences there
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p = random.in(kAround);
            const double time = random.uniform(0, 1);
            const Vec3d direction = random.direction();
            const double h = 1e-6;
            const double slope = (field->phi(p + h * direction, time) - field->phi(p - h * direction, time)) / (2 * h);
            const double forward = (field->phi(p + h * direction, time) - field->phi(p, time)) / h;
            if (std::abs(slope - forward) > 1e-4) continue; // a kink
            const FieldSample sample = field->sample(p, time);
            INFO(name << " at " << p.transpose());
            REQUIRE(sample.phi == field->phi(p, time));
            REQUIRE(sample.gradient.dot(direction) == Approx(slope).margin(1e-3));
            double row[ImplicitField::kLongestRow];
            field->phiInRow(p, 0.05 * direction, ImplicitField::kLongestRow, time, row);
            for (int k = 0; k < ImplicitField::kLongestRow; ++k)
                REQUIRE(row[k] == field->phi(p + double(k) * (0.05 * direction), time));
        }
    }
}

TEST_CASE("within its clearance nothing of CSG comes nearer than a particle's radius")
{
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, field] : someOfAll()) {
        int useful = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3d p = random.in(kAround);
            const double time = random.uniform(0, 1);
            const double radius = i % 2 == 0 ? 0.0 : 0.05;
            const double clearance = field->clearance(p, radius, time);
            if (!(clearance > 0.0)) continue;
            ++useful;
            for (int k = 0; k < 5; ++k) {
                const Vec3d there = p + clearance * random.uniform(0, 1) * random.direction();
                INFO(name << " at " << p.transpose() << ", clearance " << clearance);
                REQUIRE(field->phi(there, time) >= radius - 1e-6);
            }
            // Nor later, once what moves has been allowed for.
            const double later = time + random.uniform(0, 0.3);
            const double left = clearance - field->reach(time, later);
            if (left > 0.0) REQUIRE(field->phi(p + left * random.direction(), later) >= radius - 1e-6);
        }
        INFO(name);
        CHECK(useful > 50);
    }
}

TEST_CASE("rounding an edge leaves all surfaces that are further apart than its width")
{
    VDBOUNCE_RANDOM(random);
    const auto sharp = csg(CsgOperation::Union, {ball(), brick()});
    const auto smooth = csg(CsgOperation::Union, {ball(), brick()}, 0.2);
    int changed = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.in(kAround);
        const double difference = sharp->phi(p, 0) - smooth->phi(p, 0);
        REQUIRE(difference >= 0.0);
        REQUIRE(difference <= 0.25 * 0.2 + 1e-15);
        if (std::abs(ball()->phi(p, 0) - brick()->phi(p, 0)) >= 0.2) REQUIRE(difference == 0.0);
        changed += difference > 0.0 ? 1 : 0;
    }
    CHECK(changed > 1000);
}

TEST_CASE("the surface of CSG moves as the operand whose surface it is")
{
    const Motion moving(Motion::Constant{Vec3d(1, 0, 0), Vec3d::Zero(), Vec3d::Zero()});
    const auto a = makeField(BoxShape{Vec3d::Zero(), Vec3d::Ones()});
    const auto hole = asField(Shape(makeField(SphereShape{Vec3d(0, 1, 0), 0.5})), moving);
    const auto field = csg(CsgOperation::Subtraction, {a, hole});
    CHECK_FALSE(field->still());
    CHECK(field->velocity(Vec3d(0, 0.5, 0), 0.0) == Vec3d(1, 0, 0));         // the hole's floor
    CHECK(field->velocity(Vec3d(0, -1, 0), 0.0) == Vec3d(0, 0, 0));          // the box's
    CHECK(field->phi(Vec3d(0.3, 0.5, 0), 0.3) == Approx(0.0).margin(1e-12)); // where the hole's floor has come to
    CHECK(field->reach(0.0, 0.1) == Approx(0.1));
    CHECK(csg(CsgOperation::Union, {ball(), brick()})->still());
}

// Or particles that rest on it would sink in.
TEST_CASE("along its gradient the surface of CSG is as fast as phi falls, where edges are rounded too")
{
    constexpr double kShortly = 1e-6;
    VDBOUNCE_RANDOM(random);
    for (const auto& [name, field] : someOfAll()) {
        int useful = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p = random.in(kAround);
            const double time = random.uniform(0, 1);
            const double phi = field->phi(p, time);
            const double before = (field->phi(p, time - kShortly) - phi) / kShortly;
            const double after = (phi - field->phi(p, time + kShortly)) / kShortly;
            if (std::abs(before - after) > 1e-3) continue; // a kink
            ++useful;
            INFO(name << " at " << p.transpose() << ", time " << time);
            const double falling = field->velocity(p, time).dot(field->sample(p, time).gradient);
            REQUIRE(falling == Approx(0.5 * (before + after)).margin(2e-3));
        }
        INFO(name);
        CHECK(useful > 1800);
    }
}

TEST_CASE("CSG of too few operands, or with a blend that is no width, is refused")
{
    CHECK_THROWS_AS(csg(CsgOperation::Union, {ball()}), UsageError);
    CHECK_THROWS_AS(csg(CsgOperation::Complement, {ball(), brick()}), UsageError);
    CHECK_THROWS_AS(csg(CsgOperation::Union, {ball(), brick()}, -1.0), UsageError);
    CHECK_THROWS_AS(csg(CsgOperation::Union, {ball(), brick()}, std::nan("")), UsageError);
}
