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

// Caps of less than this part of a component's own area hardly change what it holds: it is a body by itself.
constexpr double kNearlyClosed = 0.05;

Vec3d tipOf(const RimLoop& loop, const std::vector<Vec3d>& points)
{
    Vec3d sum = Vec3d::Zero();
    for (std::uint32_t p : loop.points) sum += points[p];
    return sum / double(loop.points.size());
}

class Grouping {
public:
    Grouping(const MeshTopology& topology, const std::vector<Vec3d>& points, const std::vector<char>& solid)
        : topology_(topology), points_(points), solid_(solid), loops_(findRimLoops(topology))
    {
    }

    SolidGroups group()
    {
        nameGroups();
        copyTriangles();
        addCaps();
        for (std::uint32_t g = 0; g < solids_.groups.size(); ++g) {
            if (solids_.groups[g].rule == SolidGroup::Rule::Open) makeCaps(g);
        }
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

    void copyTriangles()
    {
        ClosedMesh& mesh = solids_.mesh;
        mesh.points = points_;
        for (std::size_t t = 0; t < topology_.triangles.size(); ++t) {
            const std::uint32_t component = topology_.component[t];
            if (component == kNone || groupOf_[component] == kNone) continue;
            mesh.triangles.push_back(topology_.triangles[t]);
            mesh.group.push_back(groupOf_[component]);
        }
        solids_.ownTriangles = mesh.triangles.size();
    }

    void addCaps()
    {
        ClosedMesh& mesh = solids_.mesh;
        for (const RimLoop& loop : loops_) {
            const std::uint32_t group = groupOf_[loop.component];
            // Parity needs none: its edges are even, whichever way their triangles run.
            if (group == kNone || solids_.groups[group].rule == SolidGroup::Rule::Parity) continue;
            const auto tip = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(tipOf(loop, points_));
            for (std::size_t i = 0; i < loop.points.size(); ++i) {
                mesh.triangles.push_back({tip, loop.points[(i + 1) % loop.points.size()], loop.points[i]});
                mesh.group.push_back(group);
            }
        }
    }

    void makeCaps(std::uint32_t number)
    {
        const ClosedMesh& mesh = solids_.mesh;
        TriangleMesh cones;
        for (std::size_t t = solids_.ownTriangles; t < mesh.triangles.size(); ++t) {
            if (mesh.group[t] != number) continue;
            const auto first = static_cast<std::uint32_t>(cones.points.size());
            for (std::uint32_t p : mesh.triangles[t]) cones.points.push_back(mesh.points[p]);
            cones.triangles.push_back({first, first + 1, first + 2});
        }
        SolidGroup& group = solids_.groups[number];
        group.caps = std::make_shared<const HoleCaps>(std::move(cones));
        group.capsAreWalls = group.caps->fitAsWalls();
    }

    const MeshTopology& topology_;
    const std::vector<Vec3d>& points_;
    const std::vector<char>& solid_;
    const std::vector<RimLoop> loops_;
    SolidGroups solids_;
    std::vector<std::uint32_t> groupOf_;
};

} // namespace

SolidGroups groupSolids(const MeshTopology& topology, const std::vector<Vec3d>& points, const std::vector<char>& solid)
{
    return Grouping(topology, points, solid).group();
}

} // namespace vdbounce
