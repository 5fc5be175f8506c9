// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_field.h"

#include "bench/field_peers.h"
#include "bench/point_sets.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/sample_points.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

constexpr double kNearVx = 2.0;
constexpr std::size_t kPeerPoints = 200'000; // a repetition: a fifth of a second for the slowest
constexpr std::size_t kPointsPerTask = 4096;

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double nanosecondsAPoint(std::size_t count, const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / double(count);
}

// The largest difference of phi, voxels.
double largestDifference(const PointSample* a, const PointSample* b, std::size_t count, double voxelSize)
{
    double largest = 0.0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(double(a[i].phi) - double(b[i].phi)));
    return largest / voxelSize;
}

// Measures one set of points on one field.
class PointsBench {
public:
    PointsBench(const DistanceField& field, const std::vector<FieldPeer>& peers, const std::vector<Vec3d>& points,
                int repetitions)
        : field_(field), peers_(peers), points_(points), repetitions_(repetitions), samples_(points.size()),
          peerSamples_(std::min(points.size(), kPeerPoints))
    {
    }

    // A case for each peer.
    void run(const std::string& name, Cases& cases)
    {
        std::vector<double> ours;
        std::vector<std::vector<double>> theirs(peers_.size());
        for (int r = 0; r < repetitions_; ++r) {
            ours.push_back(nanosecondsAPoint(
                points_.size(), [&] { samplePoints(field_, points_.data(), points_.size(), samples_.data()); }));
            for (std::size_t p = 0; p < peers_.size(); ++p) theirs[p].push_back(runPeer(peers_[p], r));
        }
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            cases.push_back({name, "ns/point", median(ours), Peer{peers_[p].name, median(theirs[p])}});
        }
    }

    double time()
    {
        std::vector<double> ours;
        for (int r = 0; r < repetitions_; ++r) {
            ours.push_back(nanosecondsAPoint(
                points_.size(), [&] { samplePoints(field_, points_.data(), points_.size(), samples_.data()); }));
        }
        return median(ours);
    }

    // Of all peers that compute the same, over the points that they looked up.
    double worstDisagreement() const { return worstDisagreement_; }
    const std::vector<PointSample>& samples() const { return samples_; }

private:
    double runPeer(const FieldPeer& peer, int repetition)
    {
        const std::size_t count = peerSamples_.size();
        const std::size_t begin = (points_.size() - count) * std::size_t(repetition) / std::size_t(repetitions_);
        const double time = nanosecondsAPoint(count, [&] {
            forEachBlock(count, kPointsPerTask, [&](std::size_t, IndexRange range) {
                peer.lookUp(points_.data() + begin + range.begin, range.end - range.begin,
                            peerSamples_.data() + range.begin);
            });
        });
        if (peer.sameGradient) {
            worstDisagreement_ =
                std::max(worstDisagreement_,
                         largestDifference(samples_.data() + begin, peerSamples_.data(), count, field_.voxelSize()));
        }
        return time;
    }

    const DistanceField& field_;
    const std::vector<FieldPeer>& peers_;
    const std::vector<Vec3d>& points_;
    int repetitions_;
    std::vector<PointSample> samples_;
    std::vector<PointSample> peerSamples_;
    double worstDisagreement_ = 0.0;
};

std::string countText(std::size_t count)
{
    int exponent = 0;
    for (; count >= 10 && count % 10 == 0; count /= 10) ++exponent;
    return std::to_string(count) + "e" + std::to_string(exponent);
}

void onOneAndAllThreads(const std::function<void(const std::string& threads)>& body)
{
    const auto all = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        body("1 thread");
    }
    if (all > 1) body(std::to_string(all) + " threads");
}

// The same points with values kept in fewer bits: what it saves and what it costs.
void benchStorage(const FieldSubject& subject, const DistanceField& exact, const std::vector<Vec3d>& points,
                  const FieldBenchOptions& options, Cases& cases)
{
    const std::vector<FieldPeer> noPeers;
    PointsBench floats(exact, noPeers, points, options.repetitions);
    const double leaves = double(exact.blocks().blockCount());
    const std::pair<const char*, Storage> storages[] = {{"half", Storage::Half}, {"fixed8", Storage::Fixed8}};
    for (const auto& [word, storage] : storages) {
        const DistanceField field(subject.grid, {Lookup::Trilinear, Normal::Central, storage});
        const std::string name = subject.name + ", storage " + word;
        PointsBench small(field, noPeers, points, options.repetitions);
        double floatTime = 0.0;
        double time = 0.0;
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            floatTime = floats.time();
            time = small.time();
        }
        cases.push_back(
            {name + ", near the surface, random order, 1 thread", "ns/point", time, Peer{"storage float", floatTime}});
        cases.push_back({name + ", memory", "bytes/leaf", double(field.blocks().values().memoryBytes()) / leaves,
                         Peer{"storage float", double(exact.blocks().values().memoryBytes()) / leaves}});
        const double error =
            largestDifference(small.samples().data(), floats.samples().data(), points.size(), exact.voxelSize());
        cases.push_back({name + ", largest error of phi", "vx", error,
                         Peer{"its bound", field.storageError() / exact.voxelSize()}});
    }
}

} // namespace

FieldSubject sphereSubject()
{
    openvdb::initialize();
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(256.0f, openvdb::Vec3f(0.0f), 1.0f, 3.0f);
    return {"sphere of radius 256", toLevelSetGrid(grid, "sphere")};
}

Cases benchField(const FieldSubject& subject, const FieldBenchOptions& options, Progress& progress)
{
    Cases cases;
    const DistanceField field(subject.grid);
    const std::vector<FieldPeer> peers = fieldPeers(subject.grid);
    double disagreement = 0.0;
    for (std::size_t count : options.points) {
        std::vector<Vec3d> points = pointsNearSurface(field, count, kNearVx);
        const auto measure = [&](const std::string& order) {
            throwIfStopped(progress);
            PointsBench bench(field, peers, points, options.repetitions);
            onOneAndAllThreads([&](const std::string& threads) {
                bench.run(subject.name + ", " + countText(count) + " points " + order + ", " + threads, cases);
            });
            disagreement = std::max(disagreement, bench.worstDisagreement());
        };
        measure("near the surface, random order");
        if (count == options.points.front()) benchStorage(subject, field, points, options, cases);
        points = inLeafOrder(field, points);
        measure("near the surface, leaf order");
        points = pointsInBox(field, count);
        measure("spread over the box, random order");
    }
    cases.push_back({subject.name + ", largest difference of phi to the peers'", "vx", disagreement, std::nullopt});
    return cases;
}

} // namespace vdbounce::bench
