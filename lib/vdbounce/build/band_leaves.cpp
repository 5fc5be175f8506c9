// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/band_leaves.h"

#include "vdbounce/base/box.h"
#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/build/nearest_in_leaf.h"
#include "vdbounce/build/reach_test.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

namespace vdbounce {
namespace {

using TriangleList = std::vector<std::uint32_t>;

// The search in floats may miss the band by its rounding; what it finds is measured again in double.
constexpr double kSearchMargin = 1.0 + 1e-5;

// Triangles looked at between two questions whether to stop.
constexpr std::size_t kTrianglesPerLook = 65536;

// Below this many leaves a side parts are not worth a task of their own.
constexpr int kSmallestTask = 2;

// A cube of leaves, 2^level on a side.
struct Cube {
    Vec3i leaf; // the lowest
    int level;

    int side() const { return 1 << level; }
};

class BandSearch {
public:
    BandSearch(const TriangleMesh& mesh, const LinearTransform& transform, double band, bool wantTriangles,
               Progress& progress)
        : mesh_(mesh), transform_(transform), band_(band), wantTriangles_(wantTriangles), progress_(progress)
    {
    }

    BandLeaves run(const TriangleList& triangles)
    {
        const Cube root = rootCube(triangles);
        origin_ = boxOf(root).centre();
        // Floats are off by half a unit in their last place, as large as they get here, twice over.
        margin_ = 4.0f * std::numeric_limits<float>::epsilon() * float(boxOf(root).size().norm());
        const double reach = band_ + double(margin_);
        reachSquared_ = float(reach * reach) * (1.0f + 1e-6f);
        boundTriangles();
        total_ = std::uint64_t(1) << (3 * std::min(root.level, 20));
        ProgressCounter counter(progress_, total_);
        counter_ = &counter;
        search(root, triangles);
        std::sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
            return std::lexicographical_compare(a->leaf.data(), a->leaf.data() + 3, b->leaf.data(), b->leaf.data() + 3);
        });
        return std::move(found_);
    }

private:
    // The smallest cube of leaves, its side a power of two, that holds the band.
    Cube rootCube(const TriangleList& triangles) const
    {
        Box box;
        for (std::uint32_t t : triangles) {
            for (std::uint32_t p : mesh_.triangles[t]) box.add(transform_.toIndex(mesh_.points[p]));
        }
        const Vec3d reach = band_ * transform_.worldToIndex().rowwise().norm();
        const Vec3i low = ((box.min - reach) / BandLeaf::kSide).array().floor().cast<int>();
        const Vec3i high = ((box.max + reach) / BandLeaf::kSide).array().floor().cast<int>();
        Cube root{low, 0};
        while (root.side() <= (high - low).maxCoeff()) ++root.level;
        return root;
    }

    // World box around the centres of a cube's voxels.
    Box boxOf(const Cube& cube) const
    {
        const double span = BandLeaf::kSide * double(cube.side()) - 1.0;
        const Vec3d centre =
            transform_.toWorld(cube.leaf.cast<double>() * BandLeaf::kSide + Vec3d::Constant(0.5 * span));
        const Vec3d half = 0.5 * span * transform_.indexToWorld().cwiseAbs().rowwise().sum();
        Box box;
        box.min = centre - half;
        box.max = centre + half;
        return box;
    }

    void boundTriangles()
    {
        boxes_.resize(mesh_.triangles.size());
        tbb::parallel_for(std::size_t(0), boxes_.size(), [&](std::size_t t) {
            const Vec3d a = mesh_.corner(t, 0) - origin_;
            const Vec3d b = mesh_.corner(t, 1) - origin_;
            const Vec3d c = mesh_.corner(t, 2) - origin_;
            const Vec3d low = a.cwiseMin(b).cwiseMin(c);
            const Vec3d high = a.cwiseMax(b).cwiseMax(c);
            for (int axis = 0; axis < 3; ++axis) {
                boxes_[t].min[std::size_t(axis)] = float(low[axis]);
                boxes_[t].max[std::size_t(axis)] = float(high[axis]);
            }
        });
        for (const FloatBox& box : boxes_) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                largest_ = std::max(largest_, double(box.max[axis]) - double(box.min[axis]));
        }
    }

    void search(const Cube& cube, TriangleList list)
    {
        throwIfStopped(progress_);
        if (cube.level == 0) {
            measure(cube.leaf, list);
            counter_->add(1);
            return;
        }
        std::array<TriangleList, 8> lists;
        split(cube, list, lists);
        TriangleList().swap(list);
        const auto child = [&](unsigned which) {
            const Cube part = childOf(cube, which);
            if (lists[which].empty()) {
                counter_->add(std::min(total_, std::uint64_t(1) << (3 * std::min(part.level, 20))));
                return;
            }
            search(part, std::move(lists[which]));
        };
        if (cube.side() >= 2 * kSmallestTask) {
            tbb::parallel_for(0u, 8u, child);
        } else {
            for (unsigned which = 0; which < 8; ++which) child(which);
        }
    }

    // One of the eight halves of a cube.
    static Cube childOf(const Cube& cube, unsigned which)
    {
        const int half = cube.side() / 2;
        return {cube.leaf + half * Vec3i(int(which >> 2), int(which >> 1 & 1), int(which & 1)), cube.level - 1};
    }

    // The box around a triangle that is larger than a cube and aslant holds many cubes that it comes nowhere near.
    void lookCloser(const Cube& cube, const TriangleList& list, std::vector<std::uint8_t>& reached) const
    {
        std::array<Vec3d, 8> centres;
        for (unsigned which = 0; which < 8; ++which) centres[which] = boxOf(childOf(cube, which)).centre();
        const Vec3d size = boxOf(childOf(cube, 0)).size();
        const double ball = 0.5 * size.norm() + band_ * kSearchMargin;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const FloatBox& box = boxes_[list[i]];
            bool large = false;
            for (std::size_t axis = 0; axis < 3; ++axis)
                large = large || double(box.max[axis] - box.min[axis]) > size[Eigen::Index(axis)];
            for (unsigned which = 0; large && which < 8; ++which) {
                if ((reached[i] >> which & 1u) != 0 && distanceSquared(list[i], centres[which]) > ball * ball)
                    reached[i] = static_cast<std::uint8_t>(reached[i] & ~(1u << which));
            }
        }
    }

    // Each child's triangles, in order: those that come within reach of one of its voxels.
    void split(const Cube& cube, const TriangleList& list, std::array<TriangleList, 8>& lists) const
    {
        EightBoxes children;
        for (unsigned which = 0; which < 8; ++which) {
            const Box box = boxOf(childOf(cube, which));
            for (int axis = 0; axis < 3; ++axis) {
                children.min[axis][which] = float(box.min[axis] - origin_[axis]);
                children.max[axis][which] = float(box.max[axis] - origin_[axis]);
            }
        }
        std::vector<std::uint8_t> reached(list.size());
        findReached(boxes_.data(), list.data(), list.size(), children, reachSquared_, reached.data());
        if (boxOf(childOf(cube, 0)).size().minCoeff() < largest_) lookCloser(cube, list, reached);
        std::array<std::size_t, 8> counts{};
        for (std::uint8_t bits : reached) {
            for (unsigned which = 0; which < 8; ++which) counts[which] += bits >> which & 1u;
        }
        for (unsigned which = 0; which < 8; ++which) {
            // One more, because each is written before it is known to be wanted.
            lists[which].resize(counts[which] + 1);
            std::uint32_t* to = lists[which].data();
            for (std::size_t i = 0; i < list.size() && counts[which] > 0; ++i) {
                *to = list[i];
                to += reached[i] >> which & 1u;
            }
            lists[which].pop_back();
        }
    }

    double distanceSquared(std::uint32_t t, const Vec3d& p) const
    {
        return (closestPointOnTriangle(p, mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)) - p)
            .squaredNorm();
    }

    void measure(const Vec3i& leaf, const TriangleList& list)
    {
        LeafPlace place;
        const Vec3d first = leaf.cast<double>() * BandLeaf::kSide;
        place.origin = transform_.toWorld(first);
        place.indexToWorld = transform_.indexToWorld();
        place.worldToIndex = transform_.worldToIndex();
        place.reach = band_ * kSearchMargin;
        NearestInLeaf nearest;
        nearest.clear(place.reach);
        for (std::size_t begin = 0; begin < list.size(); begin += kTrianglesPerLook) {
            throwIfStopped(progress_);
            findNearestInLeaf(mesh_, list.data() + begin, std::min(kTrianglesPerLook, list.size() - begin), place,
                              nearest);
        }
        auto result = std::make_unique<BandLeaf>();
        result->leaf = leaf;
        if (wantTriangles_) result->triangle = std::make_unique<LeafArray<std::uint32_t>>();
        bool any = false;
        for (int v = 0; v < BandLeaf::kVoxels; ++v) {
            float& distance = result->distance[std::size_t(v)];
            distance = std::numeric_limits<float>::infinity();
            const std::uint32_t t = nearest.triangle[v];
            if (wantTriangles_) (*result->triangle)[std::size_t(v)] = t;
            if (t == NearestInLeaf::kNone) continue;
            const Vec3d p = transform_.toWorld(result->voxel(v).cast<double>());
            const double exact =
                (closestPointOnTriangle(p, mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)) - p).norm();
            if (!(exact < band_)) continue;
            distance = float(exact);
            any = true;
        }
        if (!any) return;
        const std::lock_guard<std::mutex> lock(adding_);
        found_.push_back(std::move(result));
    }

    const TriangleMesh& mesh_;
    const LinearTransform& transform_;
    const double band_;
    const bool wantTriangles_;
    Progress& progress_;
    Vec3d origin_ = Vec3d::Zero(); // of the boxes in floats
    float margin_ = 0.0f;
    float reachSquared_ = 0.0f;
    std::vector<FloatBox> boxes_; // of the triangles, relative to origin_
    double largest_ = 0.0;        // side of any of them
    std::uint64_t total_ = 0;
    ProgressCounter* counter_ = nullptr;
    std::mutex adding_;
    BandLeaves found_;
};

} // namespace

BandLeaves measureBandLeaves(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                             const LinearTransform& transform, double band, bool wantTriangles, Progress& progress)
{
    throwIfStopped(progress);
    if (triangles.empty()) return {};
    return BandSearch(mesh, transform, band, wantTriangles, progress).run(triangles);
}

} // namespace vdbounce
