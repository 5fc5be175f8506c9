// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/first_touch.h"

#include "vdbounce/field/cubic_root.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The shortest stride where there are no cubics, voxels. Two voxels is the thinnest wall that a grid can hold.
constexpr double kShortestStrideVx = 0.25;

// Strides along one path at most: a box of 10,000 voxels crossed a quarter of a voxel at a time.
constexpr double kMostStrides = 1e5;

// Halvings of a bracket that is a stride long: to a ten-millionth of it.
constexpr int kHalvings = 24;

// The first step back from a place that turns out not to be free, as a share of the path; the next are twice as long.
constexpr double kSmallestRetreat = 1e-16;

class PathSearch {
public:
    PathSearch(const DistanceField& field, const Vec3d& from, const Vec3d& to, double radius)
        : field_(field), from_(from), way_(to - from), length_(way_.norm()), radius_(radius),
          indexFrom_(field.transform().toIndex(from)), indexWay_(field.transform().toIndex(to) - indexFrom_)
    {
    }

    // The cubic of a cell and phi() round differently: what is free must be free to phi() too.
    std::optional<double> search() const
    {
        const auto touch = find();
        if (!touch) return touch;
        double back = kSmallestRetreat;
        double t = *touch;
        while (t > 0.0 && field_.phi(at(t)) - radius_ < 0.0) {
            t = std::max(0.0, *touch - back);
            back *= 2.0;
        }
        return t;
    }

private:
    std::optional<double> find() const
    {
        if (!(length_ > 0.0) || !std::isfinite(length_) || field_.empty()) return std::nullopt;
        Span near{0.0, 1.0};
        if (!field_.clipped()) {
            // phi outside the box is at least the distance to it.
            Box reach = field_.worldBox();
            reach.min -= Vec3d::Constant(radius_);
            reach.max += Vec3d::Constant(radius_);
            near = clipToBox(reach, from_, way_, near);
        }
        if (!(near.begin <= near.end)) return std::nullopt;
        if (field_.options().lookup != Lookup::Trilinear) return byStrides(near);
        const Span inBox = clipToBox(field_.indexBox(), indexFrom_, indexWay_, near);
        if (!(inBox.begin <= inBox.end)) return byStrides(near);
        if (const auto touch = byStrides({near.begin, inBox.begin})) return touch;
        if (const auto touch = byCells(inBox)) return touch;
        return byStrides({inBox.end, near.end});
    }

    Vec3d at(double t) const { return from_ + t * way_; }

    std::optional<double> byStrides(const Span& span) const
    {
        const double shortest =
            std::max(kShortestStrideVx * field_.voxelSize() / length_, (span.end - span.begin) / kMostStrides);
        double free = span.begin;
        double t = span.begin;
        while (t <= span.end) {
            const Vec3d here = at(t);
            const double phi = field_.phi(here);
            if (phi - radius_ < 0.0) return halve(free, t);
            if (t == span.end) break;
            const double stride = (field_.freeDistance(here, phi) - radius_) / (field_.lipschitz() * length_);
            free = t;
            t = std::min(span.end, std::max(t + std::max(stride, shortest), std::nextafter(t, kInfinity)));
        }
        return std::nullopt;
    }

    double halve(double free, double inside) const
    {
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (free + inside);
            (field_.phi(at(middle)) - radius_ < 0.0 ? inside : free) = middle;
        }
        return free;
    }

    std::optional<double> byCells(const Span& span) const
    {
        double t = span.begin;
        while (t < span.end) {
            // The cell that the path goes on in, also where it has just reached that cell's side.
            const double ahead = std::min(span.end, std::nextafter(t, kInfinity));
            const Vec3d floored = cellAt(t);
            const double leave = std::max(ahead, std::min(span.end, leaves(floored)));
            std::array<double, 8> corners = field_.cellCorners(floored.cast<int>());
            for (double& corner : corners) corner -= radius_;
            const double least = *std::min_element(corners.begin(), corners.end());
            if (least < 0.0) {
                if (const auto touch = inCell(corners, floored, t, leave)) return touch;
            }
            // No point of this cell is nearer than `least` over the steepest slope.
            const double stride = std::max(0.0, least) / (field_.lipschitz() * length_);
            t = std::max(leave, t + stride);
        }
        return std::nullopt;
    }

    // On a side between two cells: the one ahead.
    Vec3d cellAt(double t) const
    {
        const Vec3d index = indexFrom_ + t * indexWay_;
        Vec3d cell = index.array().floor();
        for (int axis = 0; axis < 3; ++axis) {
            if (indexWay_[axis] < 0.0 && index[axis] <= cell[axis]) cell[axis] -= 1.0;
            // Rounding may have put the point a hair before the side that it was to be on.
            if (indexWay_[axis] > 0.0 && (cell[axis] + 1.0 - indexFrom_[axis]) / indexWay_[axis] <= t)
                cell[axis] += 1.0;
            if (indexWay_[axis] < 0.0 && (cell[axis] - indexFrom_[axis]) / indexWay_[axis] <= t) cell[axis] -= 1.0;
        }
        // The box's own far sides belong to the cell before them.
        return cell.cwiseMax(field_.indexBox().min)
            .cwiseMin((field_.indexBox().max.array() - 1.0).matrix().cwiseMax(field_.indexBox().min));
    }

    double leaves(const Vec3d& cell) const
    {
        double t = kInfinity;
        for (int axis = 0; axis < 3; ++axis) {
            if (indexWay_[axis] == 0.0) continue;
            const double side = indexWay_[axis] > 0.0 ? cell[axis] + 1.0 : cell[axis];
            t = std::min(t, (side - indexFrom_[axis]) / indexWay_[axis]);
        }
        return t;
    }

    std::optional<double> inCell(const std::array<double, 8>& corners, const Vec3d& cell, double begin,
                                 double end) const
    {
        double places[2][3];
        for (int axis = 0; axis < 3; ++axis) {
            places[0][axis] = std::clamp(indexFrom_[axis] + begin * indexWay_[axis] - cell[axis], 0.0, 1.0);
            places[1][axis] = std::clamp(indexFrom_[axis] + end * indexWay_[axis] - cell[axis], 0.0, 1.0);
        }
        const auto touch = firstBelowZero(trilinearAlong(corners, places[0], places[1]));
        if (!touch) return std::nullopt;
        return begin + *touch * (end - begin);
    }

    const DistanceField& field_;
    const Vec3d from_;
    const Vec3d way_;
    const double length_;
    const double radius_;
    const Vec3d indexFrom_;
    const Vec3d indexWay_;
};

} // namespace

std::optional<double> firstTouch(const DistanceField& field, const Vec3d& from, const Vec3d& to, double radius)
{
    return PathSearch(field, from, to, radius).search();
}

} // namespace vdbounce
