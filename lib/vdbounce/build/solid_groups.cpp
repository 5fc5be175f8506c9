// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/solid_groups.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/column_counts.h"
#include "vdbounce/build/rim_loops.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <unordered_map>

namespace vdbounce {
namespace {

constexpr std::uint32_t kNone = MeshTopology::kNone;
static_assert(kNone == ClosedMesh::kNone);

// Caps of less than this part of a component's own area hardly change what it holds: it is a body by itself.
constexpr double kNearlyClosed = 0.05;

// A cone's tip is moved by this part of its rim's length, so that no flat rim's cone holds voxel centres: there its
// winding number says nothing.
constexpr double kOffPlane = 1e-4;
const Vec3d kOffDirection(0.5377, 0.3183, 0.7809); // no direction of a modelled mesh is likely to be this

Vec3d tipOf(const RimLoop& loop, const std::vector<Vec3d>& points)
{
    Vec3d sum = Vec3d::Zero();
    for (std::uint32_t p : loop.points) sum += points[p];
    return sum / double(loop.points.size()) + kOffPlane * loopLength(loop, points) * kOffDirection;
}

class Grouping {
public:
    Grouping(MeshTopology& topology, const std::vector<Vec3d>& points, const std::vector<char>& solid)
        : topology_(topology), points_(points), solid_(solid), loops_(findRimLoops(topology))
    {
    }

    SolidGroups group()
    {
        nameGroups();
        takeTriangles();
        addCaps();
        makeCaps();
        return std::move(solids_);
    }

private:
    void nameGroups()
    {
        std::vector<double> capArea(topology_.components.size(), 0.0);
        for (const RimLoop& loop : loops_) capArea[loop.component] += circleArea(loop, points_);
        groupOf_.assign(topology_.components.size(), kNone);
        std::uint32_t open = kNone;
        for (std::size_t c = 0; c < groupOf_.size(); ++c) {
            if (solid_[c] == 0) continue;
            const MeshTopology::Component& component = topology_.components[c];
            const bool closed = component.bounded || (component.openEdges == 0 && !component.orientable);
            const bool apart = closed || capArea[c] < kNearlyClosed * component.area;
            if (apart || open == kNone) {
                groupOf_[c] = static_cast<std::uint32_t>(solids_.groups.size());
                solids_.groups.emplace_back();
                if (!apart) open = groupOf_[c];
            } else {
                groupOf_[c] = open;
            }
            SolidGroup& group = solids_.groups[groupOf_[c]];
            group.volume += component.volume;
            group.rule = component.bounded ? SolidGroup::Rule::Winding
                                           : (closed ? SolidGroup::Rule::Parity : SolidGroup::Rule::Open);
        }
    }

    void takeTriangles()
    {
        ClosedMesh& mesh = solids_.mesh;
        mesh.points = &points_;
        mesh.triangles = std::move(topology_.triangles);
        mesh.group = std::move(topology_.component);
        for (std::uint32_t& number : mesh.group) number = number == kNone ? kNone : groupOf_[number];
        solids_.ownTriangles = mesh.triangles.size();
    }

    void addCaps()
    {
        ClosedMesh& mesh = solids_.mesh;
        for (const RimLoop& loop : loops_) {
            const std::uint32_t group = groupOf_[loop.component];
            // Parity needs none: its edges are even, whichever way their triangles run.
            if (group == kNone || solids_.groups[group].rule == SolidGroup::Rule::Parity) continue;
            const auto tip = static_cast<std::uint32_t>(mesh.pointCount());
            mesh.tips.push_back(tipOf(loop, points_));
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                mesh.triangles.push_back({tip, loop.points[(i + 1) % loop.points.size()], loop.points[i]});
                mesh.group.push_back(group);
            }
        }
    }

    void makeCaps()
    {
        const ClosedMesh& mesh = solids_.mesh;
        std::vector<TriangleMesh> cones(solids_.groups.size());
        for (std::size_t t = solids_.ownTriangles; t < mesh.triangles.size(); ++t) {
            TriangleMesh& part = cones[mesh.group[t]];
            const auto first = static_cast<std::uint32_t>(part.points.size());
            for (std::uint32_t p : mesh.triangles[t]) part.points.push_back(mesh.point(p));
            part.triangles.push_back({first, first + 1, first + 2});
        }
        for (std::size_t g = 0; g < cones.size(); ++g) {
            if (cones[g].triangles.empty()) continue;
            SolidGroup& group = solids_.groups[g];
            group.caps = std::make_shared<const HoleCaps>(std::move(cones[g]));
            group.capsAreWalls = group.caps->fitAsWalls();
        }
    }

    MeshTopology& topology_;
    const std::vector<Vec3d>& points_;
    const std::vector<char>& solid_;
    const std::vector<RimLoop> loops_;
    SolidGroups solids_;
    std::vector<std::uint32_t> groupOf_;
};

} // namespace

SolidGroups groupSolids(MeshTopology topology, const std::vector<Vec3d>& points, const std::vector<char>& solid)
{
    return Grouping(topology, points, solid).group();
}

} // namespace vdbounce
