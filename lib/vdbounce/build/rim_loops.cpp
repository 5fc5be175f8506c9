// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/rim_loops.h"

#include <cmath>
#include <unordered_map>

namespace vdbounce {
namespace {

// Follows edges until a point comes up again, and cuts off the loop between.
class LoopTracer {
public:
    explicit LoopTracer(const MeshTopology& topology) : topology_(topology)
    {
        for (std::uint32_t e = 0; e < topology.rim.size(); ++e) {
            for (std::uint32_t i = 0; i < topology.rim[e].times; ++i)
                leaving_[key(topology.rim[e].component, topology.rim[e].from)].push_back(e);
        }
    }

    std::vector<RimLoop> trace()
    {
        for (const MeshTopology::RimEdge& edge : topology_.rim) {
            while (!leaving_[key(edge.component, edge.from)].empty()) follow(edge.component, edge.from);
        }
        return std::move(loops_);
    }

private:
    static std::uint64_t key(std::uint32_t component, std::uint32_t point)
    {
        return (std::uint64_t(component) << 32) | point;
    }

    void follow(std::uint32_t component, std::uint32_t start)
    {
        std::vector<std::uint32_t> way{start};
        std::unordered_map<std::uint32_t, std::size_t> placeOf{{start, 0}};
        while (!way.empty()) {
            std::vector<std::uint32_t>& leaving = leaving_[key(component, way.back())];
            if (leaving.empty()) return; // all that could close is closed
            const std::uint32_t next = topology_.rim[leaving.back()].to;
            leaving.pop_back();
            const auto seen = placeOf.find(next);
            if (seen == placeOf.end()) {
                placeOf[next] = way.size();
                way.push_back(next);
                continue;
            }
            RimLoop loop{component, {}};
            loop.points.assign(way.begin() + std::ptrdiff_t(seen->second), way.end());
            while (way.size() > seen->second + 1) {
                placeOf.erase(way.back());
                way.pop_back();
            }
            loops_.push_back(std::move(loop));
        }
    }

    const MeshTopology& topology_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> leaving_; // edges not yet followed
    std::vector<RimLoop> loops_;
};

} // namespace

std::vector<RimLoop> findRimLoops(const MeshTopology& topology) { return LoopTracer(topology).trace(); }

double loopLength(const RimLoop& loop, const std::vector<Vec3d>& points)
{
    double length = 0.0;
    for (std::size_t i = 0; i < loop.points.size(); ++i)
        length += (points[loop.points[(i + 1) % loop.points.size()]] - points[loop.points[i]]).norm();
    return length;
}

double circleArea(const RimLoop& loop, const std::vector<Vec3d>& points)
{
    const double length = loopLength(loop, points);
    return length * length / (4.0 * M_PI);
}

} // namespace vdbounce
