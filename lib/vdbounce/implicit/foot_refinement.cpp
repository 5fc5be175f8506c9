// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/foot_refinement.h"

#include "vdbounce/implicit/cell_triangles.h"
#include "vdbounce/implicit/cubic_feet.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// A cubic is no longer trusted farther than this from the patch's own point, voxels: there are other patches.
constexpr float kTrusted = 1.75f;

// A foot is good when the last step was shorter than this, voxels: the error is its square.
constexpr float kConverged = 0.02f;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Foot {
    float way[3];
    float squared;
    bool upright; // the way to it is perpendicular to the surface
};

// False where the foot is not closer, so that the start remains.
bool take(const Foot& foot, bool rim, FootLeaf& leaf, int v)
{
    if (rim && !foot.upright) {
        leaf.patch[v] = FootLeaf::kNone;
        leaf.squared[v] = FootLeaf::kLost;
        return true;
    }
    // The start is on the surface only to a thousandth of a voxel, so a foot may be that much farther.
    constexpr float kSlack = 1.001f;
    constexpr float kSlackNear = 1e-4f;
    if (!(foot.squared <= kSlack * leaf.squared[v] + kSlackNear)) return false;
    for (int a = 0; a < 3; ++a) leaf.way[a][v] = foot.way[a];
    leaf.squared[v] = foot.squared;
    return true;
}

// The voxel seen from the centre of the patch's cell.
void fromCentre(const SurfacePatch& patch, const FootLeaf& leaf, int v, float (&q)[3])
{
    const int offset[3] = {v >> 6, v >> 3 & 7, v & 7};
    for (int a = 0; a < 3; ++a) q[a] = float(leaf.origin[a] + offset[a] - patch.cell[a]) - 0.5f;
}

// Collects voxels with smooth patches until there are enough to be done at once.
class SmoothVoxels {
public:
    SmoothVoxels(const FittedSurface& surface, const VoxelMetric& metric, FootLeaf& leaf)
        : surface_(surface), metric_(metric), leaf_(leaf)
    {
    }

    void add(const SurfacePatch& patch, int v)
    {
        const auto i = std::size_t(count_++);
        voxels_[i] = v;
        float q[3];
        fromCentre(patch, leaf_, v, q);
        for (int t = 0; t < Cubic::kTerms; ++t) feet_.cubic[t][i] = patch.cubic.c[t];
        for (int a = 0; a < 3; ++a) {
            feet_.voxel[a][i] = q[a];
            feet_.foot[a][i] = q[a] + leaf_.way[a][v];
        }
        if (count_ == CubicFeet::kCount) finish();
    }

    void finish()
    {
        if (count_ == 0) return;
        for (int i = count_; i < CubicFeet::kCount; ++i) repeatFirst(std::size_t(i));
        findCubicFeet(feet_, metric_);
        for (int i = 0; i < count_; ++i) takeFoot(std::size_t(i));
        count_ = 0;
    }

private:
    void repeatFirst(std::size_t i)
    {
        for (auto& term : feet_.cubic) term[i] = term[0];
        for (int a = 0; a < 3; ++a) {
            feet_.voxel[a][i] = feet_.voxel[a][0];
            feet_.foot[a][i] = feet_.foot[a][0];
        }
    }

    void takeFoot(std::size_t i)
    {
        const int v = voxels_[i];
        const SurfacePatch& patch = surface_.patches[std::size_t(leaf_.patch[v])];
        Foot foot{};
        float away = 0.0f;
        for (int a = 0; a < 3; ++a) {
            const float from = feet_.foot[a][i] - patch.at[a];
            away += from * from;
            foot.way[a] = feet_.foot[a][i] - feet_.voxel[a][i];
        }
        foot.upright = feet_.step[i] <= kConverged && away <= kTrusted * kTrusted;
        foot.squared = foot.upright ? feet_.squared[i] : kInfinity;
        if (take(foot, patch.rim != 0, leaf_, v)) {
            erase(v, leaf_.unsure);
        } else {
            insert(v, leaf_.unsure);
        }
    }

    const FittedSurface& surface_;
    const VoxelMetric& metric_;
    FootLeaf& leaf_;
    CubicFeet feet_;
    int voxels_[CubicFeet::kCount];
    int count_ = 0;
};

// Points and needles have no normal, and the way past them may lead beyond the surface's end.
bool isUpright(const PatchTriangle& triangle, const Eigen::Vector3f& way)
{
    constexpr float kUprightSquared = 0.9f; // the cosine's: within 18 degrees
    if (!(way.squaredNorm() > 0.0f)) return true;
    const Eigen::Vector3f normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const float along = normal.dot(way);
    const float both = normal.squaredNorm() * way.squaredNorm();
    return both > 0.0f && along * along >= kUprightSquared * both;
}

Foot footOnTriangles(const FittedSurface& surface, const SurfacePatch& patch, const VoxelMetric& metric,
                     const float (&q)[3])
{
    const Eigen::Vector3f from = (metric.toSpace * Vec3d(q[0], q[1], q[2])).cast<float>();
    Foot foot{{0.0f, 0.0f, 0.0f}, kInfinity, false};
    Eigen::Vector3f best = Eigen::Vector3f::Zero();
    for (std::uint32_t t = 0; t < patch.triangles; ++t) {
        const PatchTriangle& triangle = surface.triangles[patch.firstTriangle + t];
        const Eigen::Vector3f way = closestPoint(triangle, from) - from;
        const float squared = way.squaredNorm();
        if (!(squared <= foot.squared)) continue;
        // One of the triangles that share a point is enough.
        foot.upright = isUpright(triangle, way) || (squared == foot.squared && foot.upright);
        foot.squared = squared;
        best = way;
    }
    const Vec3d way = metric.toIndex * best.cast<double>();
    for (int a = 0; a < 3; ++a) foot.way[a] = float(way[a]);
    return foot;
}

// The closest point of a smooth patch within its cell, or no farther beyond than this, voxels from its centre.
constexpr float kOwnCell = 0.75f;

Foot footOnCubic(const SurfacePatch& patch, const VoxelMetric& metric, const float (&q)[3])
{
    CubicFeet feet;
    for (std::size_t i = 0; i < CubicFeet::kCount; ++i) {
        for (int t = 0; t < Cubic::kTerms; ++t) feet.cubic[t][i] = patch.cubic.c[t];
        for (int a = 0; a < 3; ++a) {
            feet.voxel[a][i] = q[a];
            feet.foot[a][i] = patch.at[a];
        }
    }
    findCubicFeet(feet, metric);
    Foot foot{{0.0f, 0.0f, 0.0f}, feet.squared[0], feet.step[0] <= kConverged};
    for (int a = 0; a < 3; ++a) {
        foot.way[a] = feet.foot[a][0] - q[a];
        foot.upright = foot.upright && std::abs(feet.foot[a][0]) <= kOwnCell;
    }
    if (foot.upright) return foot;
    // Else its own point, which is on the surface at least.
    for (int a = 0; a < 3; ++a) foot.way[a] = patch.at[a] - q[a];
    foot.squared = metric.squared(foot.way);
    return foot;
}

// A lower bound of the distance from q to the cell around the origin, squared.
float cellDistanceSquared(const VoxelMetric& metric, const float (&q)[3])
{
    float squared = 0.0f;
    for (const float c : q) {
        const float beyond = std::max(std::abs(c) - 0.5f, 0.0f);
        squared += beyond * beyond;
    }
    return metric.shortest * metric.shortest * squared;
}

// No triangle of the patch is closer than that.
bool beyond(const SurfacePatch& patch, const VoxelMetric& metric, const float (&q)[3], float squared)
{
    if (patch.triangles == 0) return false;
    const float way[3] = {patch.at[0] - q[0], patch.at[1] - q[1], patch.at[2] - q[2]};
    const float nearest = std::sqrt(metric.squared(way)) - patch.reach;
    return nearest > 0.0f && nearest * nearest >= squared;
}

// Looks for a closer point in the 27 cells around the voxel's point; true when there is one.
bool searchAround(const FittedSurface& surface, const VoxelMetric& metric, FootLeaf& leaf, int v)
{
    const Vec3i voxel = leaf.voxel(v);
    Vec3i cell;
    for (int a = 0; a < 3; ++a) cell[a] = voxel[a] + int(std::floor(leaf.way[a][v]));
    const std::int32_t own = leaf.patch[v];
    bool found = false;
    std::size_t near = 0;
    for (int n = 0; n < 27; ++n) {
        const Vec3i there = cell + Vec3i(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
        float q[3];
        for (int a = 0; a < 3; ++a) q[a] = float(voxel[a] - there[a]) - 0.5f;
        if (cellDistanceSquared(metric, q) >= leaf.squared[v]) continue;
        const std::int32_t number = surface.patchOf(there, near);
        if (number < 0 || number == own) continue;
        const SurfacePatch& patch = surface.patches[std::size_t(number)];
        if (patch.rim != 0 || beyond(patch, metric, q, leaf.squared[v])) continue;
        const Foot foot =
            patch.triangles > 0 ? footOnTriangles(surface, patch, metric, q) : footOnCubic(patch, metric, q);
        const Margin margin = Margin::ofRefined();
        if (!(foot.squared < margin.factor * leaf.squared[v] - margin.offset)) continue;
        for (int a = 0; a < 3; ++a) leaf.way[a][v] = foot.way[a];
        leaf.squared[v] = foot.squared;
        leaf.patch[v] = number;
        found = true;
    }
    return found;
}

// Cells that a search walks through at most. It ends earlier, having come closer each time.
constexpr int kWalk = 16;

} // namespace

void refineFeet(const FittedSurface& surface, const VoxelMetric& metric, const VoxelSet& which, FootLeaf& leaf)
{
    SmoothVoxels smooth(surface, metric, leaf);
    for (int v = 0; v < FootLeaf::kVoxels; ++v) {
        if (!contains(which, v) || leaf.patch[v] == FootLeaf::kNone) continue;
        const SurfacePatch& patch = surface.patches[std::size_t(leaf.patch[v])];
        if (patch.triangles == 0) {
            smooth.add(patch, v);
            continue;
        }
        float q[3];
        fromCentre(patch, leaf, v, q);
        take(footOnTriangles(surface, patch, metric, q), patch.rim != 0, leaf, v);
        insert(v, leaf.unsure);
    }
    smooth.finish();
}

void searchFeet(const FittedSurface& surface, const VoxelMetric& metric, Unsure which, FootLeaf& leaf)
{
    for (int v = 0; v < FootLeaf::kVoxels; ++v) {
        if (!contains(leaf.unsure, v) || leaf.patch[v] == FootLeaf::kNone) continue;
        const bool smooth = surface.patches[std::size_t(leaf.patch[v])].triangles == 0;
        if (which == Unsure::BeyondPatch && !smooth) continue;
        for (int i = 0; i < kWalk && leaf.patch[v] != FootLeaf::kNone; ++i) {
            if (!searchAround(surface, metric, leaf, v)) break;
        }
    }
}

bool outsideOfPatch(const FittedSurface& surface, const FootLeaf& leaf, int v)
{
    const SurfacePatch& patch = surface.patches[std::size_t(leaf.patch[v])];
    float gradient[3] = {patch.cubic.c[1], patch.cubic.c[2], patch.cubic.c[3]};
    if (patch.triangles == 0) {
        float u[3];
        fromCentre(patch, leaf, v, u);
        for (int a = 0; a < 3; ++a) u[a] += leaf.way[a][v];
        float value = 0.0f;
        float second[6];
        patch.cubic.at(u, value, gradient, second);
    }
    return gradient[0] * leaf.way[0][v] + gradient[1] * leaf.way[1][v] + gradient[2] * leaf.way[2][v] <= 0.0f;
}

} // namespace vdbounce
