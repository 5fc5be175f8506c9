// SPDX-License-Identifier: Apache-2.0
//
// What a level set knows of distances beyond its samples: bounds, and the way out.
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/index_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// phi from this share of the background on may be the background, looked up in single precision.
constexpr double kBeyondBand = 0.999;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

Vec3i cornerOf(int corner) { return Vec3i(corner & 1, corner >> 1 & 1, corner >> 2 & 1); }

} // namespace

// Whether a voxel's value is a distance, not the background of its side, which only tells the side and at least how far
// away the surface is. What is kept of a background may be off like any value.
bool DistanceField::isDistance(float value) const
{
    return value < background_ - storageError_ && value > storageError_ - interior_;
}

// The true distance changes by at most the way that is travelled, so each of the 8 voxels around a point bounds it.
Interval DistanceField::boundsFromVoxels(const Vec3d& index) const
{
    const Cell cell(index);
    Interval bounds{-kInfinity, kInfinity};
    for (int corner = 0; corner < 8; ++corner) {
        // A voxel beside the box knows nothing: its background is no distance where every voxel of the box is active.
        const Vec3i voxel = cell.voxel + cornerOf(corner);
        if (!indexBox_.contains(voxel.cast<double>())) continue;
        const float value = blocks_.valueAt(voxel);
        const double margin = transform_.vectorToWorld(index - voxel.cast<double>()).norm() + storageError_;
        if (value > 0.0f || isDistance(value)) bounds.lower = std::max(bounds.lower, value - margin);
        if (value < 0.0f || isDistance(value)) bounds.upper = std::min(bounds.upper, value + margin);
    }
    return bounds;
}

// The same of the voxels of a cube near the surface, for a point on the side that `sign` tells: an upper bound on how
// far away the surface is.
double DistanceField::farthestSurface(const SurfaceTree::Cube& cube, const Vec3d& index, double sign) const
{
    double farthest = kInfinity;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3i voxel = cube.voxel + cornerOf(corner);
        const float value = blocks_.valueAt(voxel);
        if (!isDistance(value) || !indexBox_.contains(voxel.cast<double>())) continue;
        const double margin = transform_.vectorToWorld(index - voxel.cast<double>()).norm() + storageError_;
        farthest = std::min(farthest, sign * value + margin);
    }
    return farthest;
}

Interval DistanceField::boundsInBox(const Vec3d& index) const
{
    Interval bounds = boundsFromVoxels(index);
    if (bounds.lower > -kInfinity && bounds.upper < kInfinity) return bounds;

    // Outside of the band the side is sure, and the tree tells how far the surface is.
    const double sign = bounds.lower > -kInfinity ? 1.0 : -1.0;
    double closest = std::max(0.0, sign > 0.0 ? bounds.lower : -bounds.upper);
    // A surface that lies in the box is no farther away than the box is long.
    double farthest = clipped_ ? kInfinity : transform_.vectorToWorld(indexBox_.size()).norm();
    if (const auto cube = surface_.nearestSurface(index)) {
        closest = std::max(closest, clipped_ ? std::min(cube->distance, distanceToBoxSide(index)) : cube->distance);
        farthest = farthestSurface(*cube, index, sign);
    }
    return sign > 0.0 ? Interval{closest, farthest} : Interval{-farthest, -closest};
}

// From inside the box to its nearest side, world units.
double DistanceField::distanceToBoxSide(const Vec3d& index) const
{
    double nearest = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        // The distance between two planes of constant index coordinate is that of the coordinates over the gradient's
        // length.
        const double steepness = transform_.gradientToWorld(Vec3d::Unit(axis)).norm();
        const double way = std::min(index[axis] - indexBox_.min[axis], indexBox_.max[axis] - index[axis]);
        nearest = std::min(nearest, way / steepness);
    }
    return nearest;
}

Interval DistanceField::bounds(const Vec3d& world) const
{
    const Vec3d index = transform_.toIndex(world);
    if (indexBox_.contains(index)) return boundsInBox(index);
    if (!index.allFinite()) return {kNotANumber, kNotANumber};
    if (empty()) return {background_, kInfinity};
    const Vec3d closest = closestPointInBox(indexBox_, index, transform_);
    const double a = transform_.vectorToWorld(index - closest).norm();
    const Interval atBox = boundsInBox(closest);
    // Where the surface goes on beyond the box, nothing is known but how fast distances change.
    if (clipped_) return {atBox.lower - a, atBox.upper + a};
    Interval bounds{-a + std::min(atBox.lower, 0.0), a + std::max(atBox.upper, 0.0)};
    // The angle between the way to the box and any way on to the surface within it is at least a right one.
    if (atBox.lower > 0.0) bounds.lower = std::hypot(a, atBox.lower);
    if (atBox.upper < 0.0) bounds.upper = -std::hypot(a, atBox.upper);
    return bounds;
}

std::optional<Vec3d> DistanceField::nearestOutside(const Vec3d& world) const
{
    const Vec3d index = transform_.toIndex(world);
    if (!index.allFinite()) return std::nullopt;
    const auto cube = surface_.nearestExit(index);
    if (!cube) return std::nullopt;
    std::optional<Vec3d> nearest;
    double shortest = kInfinity;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3i voxel = cube->voxel + cornerOf(corner);
        if (!(blocks_.valueAt(voxel) > 0.0f) || !indexBox_.contains(voxel.cast<double>())) continue;
        const Vec3d place = transform_.toWorld(voxel.cast<double>());
        const double way = (place - world).norm();
        if (way >= shortest) continue;
        shortest = way;
        nearest = place;
    }
    return nearest;
}

double DistanceField::freeDistance(const Vec3d& world, double phi) const
{
    phi -= jump_;
    if (!clipped_ || phi <= 0.0) return phi;
    // Beside a cut the sign changes where B does, which is no nearer than B tells.
    const Vec3d index = transform_.toIndex(world);
    if (indexBox_.contains(index)) return phi;
    return std::max(0.0, phiInBox(closestPointInBox(indexBox_, index, transform_)) - jump_);
}

double DistanceField::clearance(const Vec3d& world, double phi, double radius) const
{
    const double free = freeDistance(world, phi) - radius;
    if (!(free > 0.0)) return 0.0;
    const double fromPhi = free / lipschitz_;
    if (clipped_ || phi < kBeyondBand * background_) return fromPhi;
    const Vec3d index = transform_.toIndex(world);
    if (!indexBox_.contains(index)) return fromPhi;
    // Where those leaves end phi is the background still.
    return fromPhi + leafSide_ * leafDistances_.cellsBetween(Cell(index).voxel);
}

} // namespace vdbounce
