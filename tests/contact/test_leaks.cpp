// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/one_particle.h"
#include "support/random.h"
#include "support/run_tool.h"
#include "support/still_colliders.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/mesh_file.h"

#include <cmath>
#include <functional>
#include <sstream>

/// @file
/// Random shots at shapes whose walls are as thin as a grid can hold. VDBOUNCE_SHOTS sets how many each gets.

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using FieldPtr = std::shared_ptr<const DistanceField>;

constexpr int kSteps = 5;
constexpr std::size_t kShotsPerBlock = 1024;

std::uint64_t shotsAShape()
{
    const char* asked = std::getenv("VDBOUNCE_SHOTS");
    return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 200000;
}

struct Target {
    FieldPtr field;
    Box box; // where shots start and aim
    /// Whether a straight way leads through the wall and not around it; both ends are outside.
    std::function<bool(const Vec3d&, const Vec3d&)> passes;
};

// The same field with other answers to a hit.
struct Surfaces {
    explicit Surfaces(const FieldPtr& field)
    {
        VDBOUNCE_RANDOM(random);
        for (int i = 0; i < 16; ++i) {
            // The corners of the range, too.
            const double e = i < 4 ? i & 1 : random.uniform(0, 1);
            const double mu = i < 4 ? i & 2 : random.uniform(0, 2);
            all.push_back(std::make_unique<StillColliders>(std::vector<Collider>{{"target", field, e, mu}}));
        }
    }
    std::vector<std::unique_ptr<StillColliders>> all;
};

Vec3d outsideIn(Random& random, const Target& target, double radius)
{
    for (;;) {
        const Vec3d p = random.in(target.box);
        if (target.field->phi(p) - radius >= 0.0) return p;
    }
}

// The last free place on the way to somewhere: phi is the radius there, to rounding.
Vec3d onSurface(Random& random, const Target& target, double radius)
{
    Vec3d free = outsideIn(random, target, radius);
    Vec3d inside = free;
    for (int i = 0; i < 50 && target.field->phi(inside) - radius >= 0.0; ++i) inside = random.in(target.box);
    if (target.field->phi(inside) - radius >= 0.0) return free;
    for (int i = 0; i < 80; ++i) {
        const Vec3d middle = 0.5 * (free + inside);
        (target.field->phi(middle) - radius < 0.0 ? inside : free) = middle;
    }
    return free;
}

struct Shots {
    std::uint64_t leaks = 0;
    std::uint64_t contacts = 0;
    std::uint64_t unresolved = 0;
    std::string first; // of the leaks

    Shots& operator+=(const Shots& other)
    {
        if (leaks == 0) first = other.first;
        leaks += other.leaks;
        contacts += other.contacts;
        unresolved += other.unresolved;
        return *this;
    }
};

void shoot(const Target& target, const Surfaces& surfaces, std::uint64_t seed, Shots& shots)
{
    Random random(seed);
    const double voxel = target.field->voxelSize();
    const PlacedColliders& colliders = *surfaces.all[seed % surfaces.all.size()];
    StepOptions options;
    options.dt = 0.01;
    if (seed % 2 == 0) options.gravity = Vec3d::Zero();
    const double radius = seed % 3 == 0 ? 0.0 : random.uniform(0, 1) * voxel;
    const bool touches = seed % 4 == 0;
    const Vec3d from = touches ? onSurface(random, target, radius) : outsideIn(random, target, radius);
    Vec3d way = random.in(target.box) - from;
    if (seed % 5 == 0) {
        // Grazing: along the surface that is nearest where it starts or, from afar, where it aims.
        const Vec3d normal = target.field->sample(touches ? from : Vec3d(from + way)).gradient;
        way -= 0.9999 * way.dot(normal) / std::max(normal.squaredNorm(), 1e-6) * normal;
    }
    MovingParticle particle =
        placed(from, voxel / options.dt * std::pow(10.0, random.uniform(-1, 7)) * way.normalized(), colliders, radius);
    StepTally tally(1);
    for (int s = 0; s < kSteps; ++s) {
        const MovingParticle before = particle;
        step(particle, colliders, options, tally);
        const bool inside = !(colliders.probe(particle.position, radius).gap >= 0.0);
        if (!inside && !target.passes(before.position, particle.position)) continue;
        if (shots.leaks++ == 0) {
            std::ostringstream text;
            text.precision(17);
            text << "shot " << seed << ", step " << s << (inside ? " ends inside" : " passes through") << ": from "
                 << before.position.transpose() << ", velocity " << before.velocity.transpose() << ", radius " << radius
                 << ", restitution " << colliders[0].restitution << ", mu " << colliders[0].friction << ", gravity "
                 << options.gravity.y() << ", to " << particle.position.transpose();
            shots.first = text.str();
        }
        break;
    }
    shots.contacts += tally.contacts;
    shots.unresolved += tally.unresolved;
}

void requireNoLeaks(const Target& target)
{
    VDBOUNCE_RANDOM(random);
    const Surfaces surfaces(target.field);
    const std::uint64_t seed = random.seed();
    const std::uint64_t count = shotsAShape();
    const Shots shots = reduceBlocks(count, kShotsPerBlock, Shots(), [&](IndexRange range) {
        Shots part;
        for (std::size_t i = range.begin; i < range.end; ++i) shoot(target, surfaces, seed + i, part);
        return part;
    });
    INFO(shots.leaks << " leaks in " << count << " shots with " << shots.contacts << " contacts, " << shots.unresolved
                     << " unresolved; the first: " << shots.first);
    CHECK(shots.leaks == 0);
    CHECK(shots.contacts > count / 4);
}

bool never(const Vec3d&, const Vec3d&) { return false; }

} // namespace

TEST_CASE("no shot leaks through a plate two voxels thick")
{
    const double voxel = 0.05;
    const double middle = 0.013;
    const Phi phi = [=](const Vec3d& p) {
        const Vec3d d = Vec3d(std::abs(p.x()), std::abs(p.y() - middle), std::abs(p.z())) - Vec3d(1.0, voxel, 1.0);
        return d.cwiseMax(0.0).norm() + std::min(0.0, d.maxCoeff());
    };
    Target target;
    target.field = std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(voxel), 26)));
    target.box = {Vec3d(-1.1, -0.5, -1.1), Vec3d(1.1, 0.5, 1.1)};
    target.passes = [=](const Vec3d& from, const Vec3d& to) {
        if ((from.y() - middle) * (to.y() - middle) >= 0.0) return false;
        const Vec3d crossing = from + (middle - from.y()) / (to.y() - from.y()) * (to - from);
        // Trilinear interpolation rounds the rims off.
        return std::max(std::abs(crossing.x()), std::abs(crossing.z())) < 1.0 - 1.5 * voxel;
    };
    requireNoLeaks(target);
}

TEST_CASE("no shot leaks through a spherical shell two voxels thick, from either side")
{
    const double voxel = 0.05;
    const double radius = 0.9;
    const Phi phi = [=](const Vec3d& p) { return std::abs((p - Vec3d(0.01, 0, 0)).norm() - radius) - voxel; };
    Target target;
    target.field = std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(voxel), 24)));
    target.box = {Vec3d::Constant(-1.3), Vec3d::Constant(1.3)};
    target.passes = [=](const Vec3d& from, const Vec3d& to) {
        return ((from - Vec3d(0.01, 0, 0)).norm() < radius) != ((to - Vec3d(0.01, 0, 0)).norm() < radius);
    };
    requireNoLeaks(target);
}

TEST_CASE("no shot leaks into a torus")
{
    const Phi phi = [](const Vec3d& p) { return std::hypot(std::hypot(p.x(), p.z()) - 0.7, p.y()) - 0.25; };
    Target target;
    target.field = std::make_shared<const DistanceField>(levelSet(bandGrid(phi, uniformTransform(0.04), 30)));
    target.box = {Vec3d(-1.1, -0.5, -1.1), Vec3d(1.1, 0.5, 1.1)};
    target.passes = never;
    requireNoLeaks(target);
}

TEST_CASE("no shot leaks into the bunny")
{
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    Box box;
    for (const Vec3d& p : mesh.points) box.add(p);
    MeshToLevelSetOptions options;
    options.voxelSize = box.size().maxCoeff() / 64;
    Target target;
    target.field = std::make_shared<const DistanceField>(meshToLevelSet(mesh, options).grid);
    const Vec3d margin = Vec3d::Constant(6 * options.voxelSize);
    target.box = {box.min - margin, box.max + margin};
    target.passes = never;
    requireNoLeaks(target);
}
