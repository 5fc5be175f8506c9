// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_blobs.h"

#include "bench/blob_peers.h"
#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/implicit/blobs.h"

#include <cmath>
#include <cstdio>
#include <random>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kParticles = 1'000'000;
constexpr double kVoxel = 0.1;
constexpr double kBandVx = 3.0;
constexpr std::size_t kCheckedVoxels = 200; // a million distances each

struct ParticleSet {
    std::string name;
    Particles particles;
};

void addParticle(Particles& particles, const Vec3d& voxel, double radiusVx)
{
    particles.position.push_back(voxel * kVoxel);
    particles.radius.push_back(radiusVx * kVoxel);
}

// A body of liquid: as many particles as cubes of their radius fill a box, all of one size.
ParticleSet evenly(double radiusVx)
{
    ParticleSet set;
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> place(0.0, radiusVx * std::cbrt(double(kParticles)));
    for (std::size_t i = 0; i < kParticles; ++i) {
        const double x = place(engine);
        const double y = place(engine);
        addParticle(set.particles, Vec3d(x, y, place(engine)), radiusVx);
    }
    numberInOrder(set.particles);
    set.name = "evenly, radius ";
    return set;
}

// Drops of spray: a thousand clouds of a thousand particles, of sizes up to half larger or smaller.
ParticleSet inClusters(double radiusVx)
{
    constexpr std::size_t kClusters = 1000;
    ParticleSet set;
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<double> place(0.0, 100.0 * radiusVx);
    std::uniform_real_distribution<double> size(0.5, 1.5);
    std::normal_distribution<double> offset(0.0, 3.0 * radiusVx);
    for (std::size_t c = 0; c < kClusters; ++c) {
        const double cx = place(engine);
        const double cy = place(engine);
        const double cz = place(engine);
        for (std::size_t i = 0; i < kParticles / kClusters; ++i) {
            const double x = cx + offset(engine);
            const double y = cy + offset(engine);
            const double z = cz + offset(engine);
            addParticle(set.particles, Vec3d(x, y, z), radiusVx * size(engine));
        }
    }
    numberInOrder(set.particles);
    set.name = "in clusters, mean radius ";
    return set;
}

BlobOptions optionsFor(BlobKernel kernel)
{
    BlobOptions options;
    options.voxelSize = kVoxel;
    options.kernel = kernel;
    options.halfWidthVx = kBandVx;
    return options;
}

void benchSpheres(const ParticleSet& set, const MakeBenchOptions& options, Progress& progress, Cases& cases)
{
    LevelSetGrid ours;
    LevelSetGrid theirs;
    std::vector<double> ourSeconds;
    std::vector<double> theirSeconds;
    for (int r = 0; r < options.repetitions; ++r) {
        throwIfStopped(progress);
        ours = theirs = LevelSetGrid(); // or the ones before would be freed on the clock
        ourSeconds.push_back(seconds([&] { ours = blobs(set.particles, optionsFor(BlobKernel::Sphere)); }));
        theirSeconds.push_back(seconds([&] { theirs = particlesToLevelSet(set.particles, kVoxel, kBandVx); }));
    }
    cases.push_back({"spheres " + set.name + ", " + threadsText(), "s", median(ourSeconds),
                     Peer{kParticlesToLevelSet, median(theirSeconds)}});
    const auto count = [](const LevelSetGrid& grid) { return double(summarize(grid).activeVoxels); };
    cases.push_back(
        {"spheres " + set.name + ", active voxels", "voxels", count(ours), Peer{kParticlesToLevelSet, count(theirs)}});
    const auto error = [&](const LevelSetGrid& grid) {
        return largestSphereErrorVx(grid, set.particles, kCheckedVoxels);
    };
    cases.push_back(
        {"spheres " + set.name + ", largest error", "vx", error(ours), Peer{kParticlesToLevelSet, error(theirs)}});
}

void benchKernel(const ParticleSet& set, BlobKernel kernel, const MakeBenchOptions& options, Progress& progress,
                 Cases& cases)
{
    const std::string name = kernel == BlobKernel::Gaussian ? "Gaussian " : "compact ";
    std::vector<double> times;
    for (int r = 0; r < options.repetitions; ++r) {
        LevelSetGrid grid;
        times.push_back(seconds([&] { grid = blobs(set.particles, optionsFor(kernel), progress); }));
    }
    cases.push_back({name + set.name + ", " + threadsText(), "s", median(times), std::nullopt});
}

} // namespace

Cases benchBlobs(const MakeBenchOptions& options, Progress& progress)
{
    Cases cases;
    const auto measure = [&](ParticleSet set, double radiusVx) {
        char text[32];
        std::snprintf(text, sizeof(text), "%g voxels", radiusVx);
        set.name = countText(kParticles) + " particles " + set.name + text;
        benchSpheres(set, options, progress, cases);
        for (BlobKernel kernel : {BlobKernel::Gaussian, BlobKernel::Compact})
            benchKernel(set, kernel, options, progress, cases);
    };
    for (double radiusVx : {1.0, 2.0, 5.0}) measure(evenly(radiusVx), radiusVx);
    measure(inClusters(2.0), 2.0);
    return cases;
}

} // namespace vdbounce::bench
