// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_collide.h"

#include "bench/collide_peers.h"
#include "bench/point_sets.h"
#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/base/random_numbers.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <memory>
#include <vector>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kParticlesPerTask = 8192;
constexpr std::uint64_t kPlaceSeed = 1;
constexpr std::uint64_t kVelocitySeed = 2;

// The sphere of NanoVDB's example, and from how far above its surface the column lands on it.
constexpr double kSphereRadius = 100.0;
const Vec3d kSphereCentre(-20.0, 0.0, 0.0);
constexpr double kSphereBandVx = 3.0;
constexpr double kLandingHeight = 3.0;
constexpr double kColumnDt = 0.01;
constexpr double kColumnGravity = 9.8;
constexpr int kColumnSteps = 100;

constexpr double kMeshDim = 128.0;
constexpr double kMeshBandVx = 6.0;
constexpr double kMeshRadiusVx = 0.25;
constexpr double kMeshSpeedVx = 0.2;   // voxels a step
constexpr std::size_t kNearOneOf = 10; // one of so many begins near the surface
constexpr double kNearVx = 2.0;
constexpr double kMeshFallVx = 0.0125; // voxels a step, each step: by the end of 20 more than the first speed
constexpr double kMeshDt = 0.01;
constexpr int kMeshSteps = 20;

struct Situation {
    std::string name;
    Particles start;
    ColliderSet colliders;
    PassOptions pass;
    int steps;
    std::vector<CollidePeer> peers;
};

class SituationBench {
public:
    SituationBench(const Situation& situation, int repetitions, Progress& progress)
        : situation_(situation), repetitions_(repetitions), progress_(progress), tally_(situation.colliders.size())
    {
    }

    // A case for each way to call and each peer.
    void run(const std::string& threads, Cases& cases)
    {
        std::vector<double> together;
        std::vector<double> single;
        std::vector<std::vector<double>> theirs(situation_.peers.size());
        for (int r = 0; r < repetitions_; ++r) {
            together.push_back(timeOurs(situation_.steps));
            single.push_back(timeOurs(1));
            for (std::size_t p = 0; p < theirs.size(); ++p) theirs[p].push_back(timePeer(situation_.peers[p]));
        }
        const std::string steps = std::to_string(situation_.steps) + " steps, ";
        for (std::size_t p = 0; p < theirs.size(); ++p) {
            const Peer peer{situation_.peers[p].name, median(theirs[p])};
            cases.push_back(
                {situation_.name + ", " + steps + "in one call, " + threads, kUnit, median(together), peer});
        }
        for (std::size_t p = 0; p < theirs.size(); ++p) {
            const Peer peer{situation_.peers[p].name, median(theirs[p])};
            cases.push_back({situation_.name + ", " + steps + "one a call, " + threads, kUnit, median(single), peer});
        }
    }

    // What the steps were, the same in all runs.
    void addShares(Cases& cases) const
    {
        const auto add = [&](const char* what, std::uint64_t count) {
            const double share = double(count) / double(tally_.free + tally_.near);
            cases.push_back({situation_.name + ", particle steps " + what, "%", 100.0 * share, std::nullopt});
        };
        add("without a lookup", tally_.free);
        add("with a lookup", tally_.near);
        add("with a search along the path", tally_.swept);
        add("with contact", tally_.contacts);
        add("unresolved", tally_.unresolved);
    }

private:
    static constexpr const char* kUnit = "ns/particle step";

    double nanosecondsAStep(double time) const
    {
        return time * 1e9 / (double(situation_.start.size()) * double(situation_.steps));
    }

    double timeOurs(int stepsPerCall)
    {
        particles_ = situation_.start;
        ParticlePass pass(particles_, situation_.colliders, situation_.pass);
        tally_ = StepTally(situation_.colliders.size());
        pass.advance(0); // looks every particle up once, which a run does once for all its steps
        return nanosecondsAStep(seconds([&] {
            for (int s = 0; s < situation_.steps; s += stepsPerCall) {
                throwIfStopped(progress_);
                tally_ += pass.advance(stepsPerCall).tally;
            }
        }));
    }

    double timePeer(const CollidePeer& peer)
    {
        throwIfStopped(progress_);
        peer.place(situation_.start);
        return nanosecondsAStep(seconds([&] { peer.advance(situation_.steps); }));
    }

    const Situation& situation_;
    int repetitions_;
    Progress& progress_;
    Particles particles_;
    StepTally tally_;
};

void measure(const Situation& situation, const CollideBenchOptions& options, Progress& progress, Cases& cases)
{
    SituationBench bench(situation, options.repetitions, progress);
    onOneAndAllThreads([&](const std::string& threads) { bench.run(threads, cases); });
    bench.addShares(cases);
}

Particles atRest(std::vector<Vec3d> positions)
{
    Particles particles;
    particles.position = std::move(positions);
    numberInOrder(particles);
    particles.ensureVelocity();
    return particles;
}

Particles column(std::size_t count, double top)
{
    std::vector<Vec3d> positions(count);
    forEachIndex(count, kParticlesPerTask, [&](std::size_t i) {
        CounterRandom random(kPlaceSeed, i);
        const double x = random.uniform();
        positions[i] = Vec3d(x, top, random.uniform());
    });
    return atRest(std::move(positions));
}

LevelSetGrid exampleSphere()
{
    openvdb::initialize();
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        float(kSphereRadius), openvdb::Vec3f(openvdb::Vec3d(kSphereCentre.data())), 1.0f, float(kSphereBandVx));
    return toLevelSetGrid(grid, "sphere");
}

Situation columnSituation(const std::string& name, const LevelSetGrid& sphere, double top,
                          const CollideBenchOptions& options)
{
    Collider collider{"sphere", std::make_shared<const DistanceField>(sphere)};
    collider.restitution = 0.5;
    collider.friction = 0.3;
    PassOptions pass;
    pass.step.dt = kColumnDt;
    pass.step.gravity = Vec3d(0.0, -kColumnGravity, 0.0);
    pass.defaults.radius = 0.5;
    return {name + ", " + countText(options.particles) + " particles",
            column(options.particles, top),
            ColliderSet({collider}),
            pass,
            kColumnSteps,
            {nanoCollision(sphere, pass.step, top)}};
}

// Nine of ten anywhere outside, each tenth near the surface: neighbours in memory have nothing in common.
Particles aroundMesh(const DistanceField& field, const Box& box, std::size_t count)
{
    std::vector<Vec3d> positions = pointsOutside(field, box, kMeshRadiusVx * field.voxelSize(), count);
    const std::vector<Vec3d> near = pointsNearSurface(field, count / kNearOneOf, {kMeshRadiusVx, kNearVx});
    for (std::size_t i = 0; i < near.size(); ++i) positions[i * kNearOneOf] = near[i];
    Particles particles = atRest(std::move(positions));
    const double speed = kMeshSpeedVx * field.voxelSize() / kMeshDt;
    forEachIndex(count, kParticlesPerTask, [&](std::size_t i) {
        CounterRandom random(kVelocitySeed, i);
        const Vec3d direction = 2.0 * random.uniformVector() - Vec3d::Ones();
        particles.velocity[i] = speed * direction.normalized();
    });
    return particles;
}

} // namespace

Cases benchColumn(const CollideBenchOptions& options, Progress& progress)
{
    Cases cases;
    const LevelSetGrid sphere = exampleSphere();
    const LevelSetSummary summary = summarize(sphere);
    // The height of its voxels, as the example has it.
    const double top = summary.indexMax.y() - summary.indexMin.y() + 1;
    measure(columnSituation("column above a sphere", sphere, top, options), options, progress, cases);
    const double besideAxis = 0.5 - kSphereCentre.x();
    const double surface = std::sqrt(kSphereRadius * kSphereRadius - besideAxis * besideAxis);
    measure(columnSituation("column landing on a sphere", sphere, surface + kLandingHeight, options), options, progress,
            cases);
    return cases;
}

Cases benchMeshBox(const std::string& name, const TriangleMesh& mesh, const CollideBenchOptions& options,
                   Progress& progress)
{
    const Box box = boundingBox(mesh);
    MeshToLevelSetOptions make;
    make.voxelSize = box.size().maxCoeff() / kMeshDim;
    make.exteriorVx = kMeshBandVx;
    make.interiorVx = kMeshBandVx;
    const auto field = std::make_shared<const DistanceField>(meshToLevelSet(mesh, make, progress).grid);
    Collider collider{name, field};
    collider.restitution = 0.3;
    collider.friction = 0.5;
    PassOptions pass;
    pass.step.dt = kMeshDt;
    pass.step.gravity = Vec3d(0.0, -kMeshFallVx * make.voxelSize / (kMeshDt * kMeshDt), 0.0);
    pass.defaults.radius = kMeshRadiusVx * make.voxelSize;
    const Situation situation{name + " box, " + countText(options.particles) + " particles",
                              aroundMesh(*field, box, options.particles),
                              ColliderSet({collider}),
                              pass,
                              kMeshSteps,
                              {gravityAndMove(pass.step), gravityAndMoveInBlocks(pass.step)}};
    Cases cases;
    measure(situation, options, progress, cases);
    return cases;
}

} // namespace vdbounce::bench
