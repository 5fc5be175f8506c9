// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/sign_choice.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/mesh_tree.h"
#include "vdbounce/build/rim_loops.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace vdbounce {
namespace {

constexpr std::uint32_t kNone = MeshTopology::kNone;

// Rim edges of a component whose holes' caps have less than this part of its area leave it a body.
constexpr double kSmallHoles = 0.05;

// Triangles of a component beside which its sides are looked at, half a voxel off.
constexpr std::size_t kProbes = 48;
constexpr double kProbeVx = 0.5;

// A winding number this near to a half tells nothing.
constexpr double kUnclear = 0.2;

// The part of its probes that must tell the sides apart.
constexpr double kClearShare = 0.5;

// Fewer triangles do not wind around anything by themselves.
constexpr std::size_t kFewestAround = 3;

constexpr std::size_t kComponentsPerTask = 4;

struct Decision {
    SignMethod method;
    const char* reason;
    bool plain = false;
};

// Of each component's holes, were they circles.
std::vector<double> holeAreas(const MeshTopology& topology, const std::vector<Vec3d>& points)
{
    std::vector<double> area(topology.components.size(), 0.0);
    for (const RimLoop& loop : findRimLoops(topology)) area[loop.component] += circleArea(loop, points);
    return area;
}

// The open components as a mesh of their own, to be asked for winding numbers and crossings.
class Prober {
public:
    Prober(const MeshTopology& topology, const std::vector<Vec3d>& points, const std::vector<char>& open)
        : topology_(topology)
    {
        mesh_.points = points;
        for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
            const std::uint32_t component = topology.component[t];
            if (component != kNone && open[component] != 0) mesh_.triangles.push_back(topology.triangles[t]);
        }
        tree_ = std::make_unique<const MeshTree>(mesh_);
        byComponent_.resize(topology.components.size());
        for (std::uint32_t t = 0; t < topology.triangles.size(); ++t) {
            const std::uint32_t component = topology.component[t];
            if (component != kNone && open[component] != 0) byComponent_[component].push_back(t);
        }
    }

    Decision decide(std::uint32_t component, double offset) const
    {
        const std::vector<std::uint32_t>& triangles = byComponent_[component];
        const std::size_t stride = std::max<std::size_t>(1, triangles.size() / kProbes);
        std::vector<Probe> probes;
        for (std::size_t i = 0; i < triangles.size(); i += stride) {
            const auto& corners = topology_.triangles[triangles[i]];
            const Vec3d& a = mesh_.points[corners[0]];
            const Vec3d& b = mesh_.points[corners[1]];
            const Vec3d& c = mesh_.points[corners[2]];
            const Vec3d across = (b - a).cross(c - a);
            if (!(across.norm() > 0.0)) continue;
            const Vec3d step = offset * across.normalized();
            const Vec3d middle = (a + b + c) / 3.0;
            probes.push_back({middle + step, middle - step});
        }
        const auto enough = [&](const auto& tells) {
            const auto count = std::count_if(probes.begin(), probes.end(), tells);
            return !probes.empty() && double(count) >= kClearShare * double(probes.size());
        };
        const Decision winding{SignMethod::Winding, "open, but winding numbers tell its sides apart"};
        if (enough([&](const Probe& probe) { return windingTells(*tree_, probe); })) return winding;
        // Within others, which wind around both of its sides, it has to be asked by itself.
        if (triangles.size() >= kFewestAround) {
            const TriangleMesh own = ownMesh(triangles);
            const MeshTree ownTree(own);
            if (enough([&](const Probe& probe) { return windingTells(ownTree, probe); })) return winding;
        }
        if (enough([&](const Probe& probe) { return raysTell(probe); }))
            return {SignMethod::Parity, "open, and only crossings of rays tell its sides apart"};
        return {SignMethod::Unsigned, "open, and it encloses nothing"};
    }

private:
    // Either side of the surface.
    struct Probe {
        Vec3d one;
        Vec3d other;
    };

    TriangleMesh ownMesh(const std::vector<std::uint32_t>& triangles) const
    {
        TriangleMesh own;
        for (std::uint32_t t : triangles) {
            const auto first = static_cast<std::uint32_t>(own.points.size());
            for (std::uint32_t p : topology_.triangles[t]) own.points.push_back(mesh_.points[p]);
            own.triangles.push_back({first, first + 1, first + 2});
        }
        return own;
    }

    static bool windingTells(const MeshTree& tree, const Probe& probe)
    {
        const double a = std::abs(tree.windingNumber(probe.one));
        const double b = std::abs(tree.windingNumber(probe.other));
        return std::abs(a - 0.5) > kUnclear && std::abs(b - 0.5) > kUnclear && (a > 0.5) != (b > 0.5);
    }

    bool raysTell(const Probe& probe) const
    {
        const int a = tree_->raysInside(probe.one);
        const int b = tree_->raysInside(probe.other);
        return a != b && a % MeshTree::kRays == 0 && b % MeshTree::kRays == 0;
    }

    const MeshTopology& topology_;
    TriangleMesh mesh_;
    std::unique_ptr<const MeshTree> tree_;
    std::vector<std::vector<std::uint32_t>> byComponent_;
};

void summarize(ComponentSigns& signs, const MeshTopology& topology, const std::vector<Decision>& decisions)
{
    std::map<std::pair<SignMethod, std::string>, SignChoice> choices;
    std::map<SignMethod, double> area;
    for (std::size_t c = 0; c < decisions.size(); ++c) {
        signs.method.push_back(decisions[c].method);
        SignChoice& choice = choices[{decisions[c].method, decisions[c].reason}];
        choice.method = decisions[c].method;
        choice.reason = decisions[c].reason;
        choice.plain = decisions[c].plain;
        ++choice.components;
        choice.triangles += topology.components[c].triangles;
        area[decisions[c].method] += topology.components[c].area;
    }
    double most = -1.0;
    for (const auto& [method, sum] : area) {
        if (sum > most) signs.overall = method;
        most = std::max(most, sum);
    }
    for (const auto& entry : choices) signs.choices.push_back(entry.second);
}

} // namespace

std::vector<char> ComponentSigns::having(SignMethod wanted) const
{
    std::vector<char> flags(method.size());
    std::transform(method.begin(), method.end(), flags.begin(),
                   [&](SignMethod m) { return m == wanted ? char(1) : char(0); });
    return flags;
}

bool ComponentSigns::needsRays(const MeshTopology& topology) const
{
    for (std::size_t c = 0; c < method.size(); ++c) {
        if (method[c] == SignMethod::Parity && topology.components[c].openEdges > 0) return true;
    }
    return false;
}

ComponentSigns chooseSigns(const MeshTopology& topology, const std::vector<Vec3d>& points, double voxelSize,
                           const Progress& progress)
{
    const std::vector<double> holes = holeAreas(topology, points);
    std::vector<Decision> decisions;
    std::vector<char> open(topology.components.size(), 0);
    bool anyOpen = false;
    for (std::size_t c = 0; c < topology.components.size(); ++c) {
        const MeshTopology::Component& component = topology.components[c];
        if (component.bounded) {
            decisions.push_back(component.turned > 0
                                    ? Decision{SignMethod::Winding, "closed, once its faces were made to agree"}
                                    : Decision{SignMethod::Winding, "closed, and its faces agree", true});
        } else if (component.openEdges == 0) {
            decisions.push_back({SignMethod::Parity, "closed, but its faces cannot be made to agree"});
        } else if (component.orientable && holes[c] < kSmallHoles * component.area) {
            decisions.push_back({SignMethod::Winding, "open, but its holes are small"});
        } else {
            decisions.push_back({SignMethod::Unsigned, ""});
            open[c] = 1;
            anyOpen = true;
        }
    }
    if (anyOpen) {
        const Prober prober(topology, points, open);
        forEachIndex(open.size(), kComponentsPerTask, [&](std::size_t c) {
            if (open[c] == 0) return;
            throwIfStopped(progress);
            decisions[c] = prober.decide(static_cast<std::uint32_t>(c), kProbeVx * voxelSize);
        });
    }
    ComponentSigns signs;
    summarize(signs, topology, decisions);
    return signs;
}

const char* signMethodName(SignMethod method)
{
    switch (method) {
    case SignMethod::Auto: return "auto";
    case SignMethod::Winding: return "winding";
    case SignMethod::Parity: return "parity";
    case SignMethod::Flood: return "flood";
    case SignMethod::Unsigned: return "unsigned";
    }
    return "";
}

} // namespace vdbounce
