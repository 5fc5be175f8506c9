// SPDX-License-Identifier: Apache-2.0
#include "support/one_particle.h"
#include "support/random.h"
#include "support/stability_table.h"
#include "support/still_colliders.h"

#include "vdbounce/implicit/csg_field.h"
#include "vdbounce/implicit/shapes.h"

#include <cmath>
#include <sstream>

/// @file
/// How far the sizes of shapes by formula can go.

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const ImplicitField>;

// All shapes about one unit large, `scale` times as large, at `place`.
std::vector<std::pair<const char*, FieldPtr>> shapesAt(double scale, const Vec3d& place)
{
    const auto at = [&](double x, double y, double z) { return Vec3d(place + scale * Vec3d(x, y, z)); };
    return {{"sphere", makeField(SphereShape{at(0.2, 0.3, 0.1), 0.5 * scale})},
            {"box", makeField(BoxShape{place, scale * Vec3d(0.8, 0.3, 0.5), Eigen::Quaterniond(1, 0.2, 0.1, 0.3)})},
            {"capsule", makeField(CapsuleShape{at(-0.5, 0, 0), at(0.5, 0.3, 0), 0.2 * scale})},
            {"cylinder", makeField(CylinderShape{at(0, -0.4, 0), at(0.1, 0.4, 0), 0.6 * scale})},
            {"cone", makeField(ConeShape{at(0, -0.4, 0), at(0, 0.8, 0), 0.7 * scale, 0.0})},
            {"torus", makeField(TorusShape{place, Vec3d(0, 1, 0.3), 0.7 * scale, 0.2 * scale})},
            {"ellipsoid", makeField(EllipsoidShape{place, scale * Vec3d(0.9, 0.3, 0.5)})}};
}

// The largest difference of phi from that of shapes of one unit, in their sizes.
double worstAt(double scale, const Vec3d& place)
{
    VDBOUNCE_RANDOM(random);
    const auto unit = shapesAt(1.0, Vec3d::Zero());
    const auto scaled = shapesAt(scale, place);
    double worst = 0.0;
    for (std::size_t s = 0; s < unit.size(); ++s) {
        for (int i = 0; i < 1000; ++i) {
            const Vec3d p = random.in(Box{Vec3d::Constant(-2), Vec3d::Constant(2)});
            const Vec3d q = place + scale * p;
            // What rounding the place has moved it is not the shape's fault.
            const Vec3d rounded = (q - place) / scale;
            worst =
                std::max(worst, std::abs(scaled[s].second->phi(q, 0.0) / scale - unit[s].second->phi(rounded, 0.0)));
        }
    }
    return worst;
}

// Of shots at a wall around y = 0, from above and 0.1 to 1e7 of its thicknesses a step fast: those that come out below.
int leaksThrough(const FieldPtr& wall, double thickness, int shots)
{
    VDBOUNCE_RANDOM(random);
    StepOptions options;
    options.dt = 0.01;
    options.gravity = Vec3d::Zero();
    int leaks = 0;
    for (int i = 0; i < shots; ++i) {
        const StillColliders colliders({{"wall", wall, random.uniform(0, 1), random.uniform(0, 1)}});
        const double speed = thickness / options.dt * std::pow(10.0, random.uniform(-1, 7));
        // So near that slow ones get there.
        const double above = thickness + speed * options.dt * random.uniform(0, 5);
        const Vec3d way(random.uniform(-0.1, 0.1), -1, random.uniform(-0.1, 0.1));
        const Vec3d from(random.uniform(-0.5, 0.5), above, random.uniform(-0.5, 0.5));
        MovingParticle particle = placed(from, speed * way, colliders, i % 2 == 0 ? 0.0 : 0.1 * thickness);
        StepTally tally(1);
        for (int s = 0; s < 20; ++s) {
            step(particle, colliders, options, tally);
            const bool beside = std::abs(particle.position.x()) > 0.9 || std::abs(particle.position.z()) > 0.9;
            if (beside) break;
            if (colliders.probe(particle.position, particle.radius).gap >= 0.0 && particle.position.y() > 0.0) continue;
            ++leaks;
            break;
        }
    }
    return leaks;
}

} // namespace

TEST_CASE("shapes by formula have the same phi at any size, and far from the origin", "[extremes]")
{
    double worst = 0.0;
    for (double scale : {1e-100, 1e-9, 1e-3, 1e3, 1e9, 1e100}) {
        INFO("scale " << scale);
        worst = std::max(worst, worstAt(scale, Vec3d::Zero()));
        CHECK(worst < 1e-12);
    }
    stabilityRow("size of shapes by formula", "1e-100 to 1e100 world units", "largest error of phi, of the size",
                 worst);
    worst = worstAt(1.0, Vec3d(1e6, -3e5, 2e6));
    CHECK(worst < 1e-8);
    stabilityRow("shapes by formula away from the origin", "2e6 times their size", "largest error of phi, of the size",
                 worst);
}

TEST_CASE("thin boxes by formula hold at any speed", "[extremes]")
{
    for (double thickness : {1e-3, 1e-6, 1e-9}) {
        const auto wall = makeField(BoxShape{Vec3d::Zero(), Vec3d(1, 0.5 * thickness, 1)});
        const int leaks = leaksThrough(wall, thickness, 1000);
        std::ostringstream range;
        range << thickness << " of its width";
        stabilityRow("thickness of a box by formula", range.str(), "leaks of 1000 shots, 0.1 to 1e7 thicknesses a step",
                     leaks);
        CHECK(leaks == 0);
    }
}

TEST_CASE("what CSG leaves of a box holds while it is not too thin", "[extremes]")
{
    for (double thickness : {1e-2, 1e-4}) {
        // A box of side 2 less all but a slice.
        const auto whole = makeField(BoxShape{Vec3d(0, -1 + 0.5 * thickness, 0), Vec3d(1, 1, 1)});
        const auto rest = makeField(BoxShape{Vec3d(0, -2 - 0.5 * thickness, 0), Vec3d(2, 2, 2)});
        const FieldPtr slice =
            std::make_shared<const CsgField>(CsgOperation::Subtraction, std::vector<FieldPtr>{whole, rest});
        const int leaks = leaksThrough(slice, thickness, 1000);
        std::ostringstream range;
        range << thickness / 2 << " of the box";
        stabilityRow("thickness of what CSG leaves", range.str(), "leaks of 1000 shots, 0.1 to 1e7 thicknesses a step",
                     leaks);
        if (thickness > 2.0 / 256.0) CHECK(leaks == 0);
    }
}
