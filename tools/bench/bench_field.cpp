// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_field.h"

#include "bench/field_peers.h"
#include "bench/field_variants.h"
#include "bench/point_sets.h"
#include "bench/stopwatch.h"
#include "bench/thread_counts.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/sample_points.h"
#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <memory>

namespace vdbounce::bench {
namespace {

constexpr double kNearVx = 2.0;
constexpr std::size_t kPeerPoints = 200'000; // a repetition: a fifth of a second for the slowest
constexpr std::size_t kPointsPerTask = 1024; // so that many threads share evenly

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

    // Of all peers that compute the same, over the points that they looked up.
    double worstDisagreement() const { return worstDisagreement_; }

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
        std::vector<Vec3d> points = pointsNearSurface(field, count, {-kNearVx, kNearVx});
        const auto measure = [&](const std::string& order) {
            throwIfStopped(progress);
            PointsBench bench(field, peers, points, options.repetitions);
            onOneAndAllThreads([&](const std::string& threads) {
                bench.run(subject.name + ", " + countText(count) + " points " + order + ", " + threads, cases);
            });
            disagreement = std::max(disagreement, bench.worstDisagreement());
        };
        measure("near the surface, random order");
        if (count == options.points.front()) benchVariants(subject, field, points, options, cases);
        points = inLeafOrder(field, points);
        measure("near the surface, leaf order");
        points = pointsInBox(field, count);
        measure("spread over the box, random order");
    }
    benchBounds(subject, field, options, cases);
    cases.push_back({subject.name + ", largest difference of phi to the peers'", "vx", disagreement, std::nullopt});
    return cases;
}

} // namespace vdbounce::bench
