// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/distance_field.h"

#include "vdbounce/field/field_build.h"
#include "vdbounce/field/index_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// What is known of a point that is not finite.
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

// The derivative of a Catmull-Rom spline is up to 1.5 times the largest difference of the four values, and its weights
// along the two other axes sum up to 1.25 each without their signs.
constexpr double kSplineSteepness = 1.5 * 1.25 * 1.25;

// From one side of a leaf to the opposite, world units.
double shortestWayAcross(const LinearTransform& transform)
{
    double steepest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        steepest = std::max(steepest, transform.gradientToWorld(Vec3d::Unit(axis)).norm());
    return BlockLayout::kLeafSide / steepest;
}

} // namespace

DistanceField::DistanceField(const LevelSetGrid& grid, const FieldOptions& options) : options_(options)
{
    FieldParts parts = buildFieldParts(grid, options.storage, options.lookup == Lookup::Cubic ? 1 : 0);
    transform_ = parts.transform;
    blocks_ = std::move(parts.blocks);
    indexBox_ = parts.indexBox;
    background_ = parts.background;
    interior_ = parts.interior;
    storageError_ = parts.storageError;
    lipschitz_ = parts.lipschitz;
    surface_ = std::move(parts.surface);
    leafDistances_ = LeafDistances(blocks_, indexBox_, background_);
    leafSide_ = shortestWayAcross(transform_);
    if (options.lookup == Lookup::Nearest) jump_ = lipschitz_ * transform_.voxelDiagonal();
    // The three components of the spline's gradient may be steepest each for another cell's sake.
    if (options.lookup == Lookup::Cubic)
        lipschitz_ *= kSplineSteepness * (transform_.orthogonal() ? std::sqrt(3.0) : 3.0);
    clipped_ = surfaceReachesBox();
    worldBox_ = boxInWorld();
}

DistanceField::Cell::Cell(const Vec3d& index)
{
    const Vec3d floored = index.array().floor();
    voxel = floored.cast<int>();
    at = index - floored;
}

DistanceField::Neighbourhood DistanceField::neighbourhood(const Cell& cell, float (&copy)[64], float& constant) const
{
    const LeafBlocks::Entry entry = blocks_.entryAt(cell.voxel);
    if (!entry.isBlock()) {
        constant = blocks_.tileValue(entry);
        return {nullptr, 0, 0};
    }
    const int offset = BlockLayout::neighbourhoodOf(cell.voxel);
    const BlockValues& values = blocks_.values();
    if (values.storage() == Storage::Float) {
        const std::size_t place = entry.block() * BlockLayout::kSize + std::size_t(offset);
        return {values.floats().data() + place, BlockLayout::kStrideX, BlockLayout::kStrideY};
    }
    values.decodeNeighbourhood(entry.block(), offset, copy);
    return {copy, 16, 4};
}

// interpolate(neighbourhood, place in the cell), or where all values around are one: that, without any gradient.
template <class Interpolate> auto DistanceField::inCell(const Cell& cell, const Interpolate& interpolate) const
{
    float copy[64];
    float constant = 0.0f;
    const Neighbourhood near = neighbourhood(cell, copy, constant);
    using Result = decltype(interpolate(near, cell.at));
    return near.values == nullptr ? Result{double(constant)} : interpolate(near, cell.at);
}

double DistanceField::phiInBox(const Vec3d& index) const
{
    const Cell cell(options_.lookup == Lookup::Nearest ? Vec3d(index.array() + 0.5) : index);
    return inCell(cell, [&](const Neighbourhood& near, const Vec3d& at) {
        if (options_.lookup == Lookup::Nearest) return double(*near.cellValues());
        if (options_.lookup == Lookup::Cubic) return tricubic(near.values, near.strideX, near.strideY, at).phi;
        return trilinear(near.cellValues(), near.strideX, near.strideY, at);
    });
}

FieldSample DistanceField::sampleInBox(const Vec3d& index) const
{
    const bool central = options_.normal == Normal::Central;
    if (options_.lookup == Lookup::Nearest) {
        const Cell nearest(Vec3d(index.array() + 0.5));
        FieldSample sample = inCell(nearest, [](const Neighbourhood& near, const Vec3d&) {
            return FieldSample{double(*near.cellValues()), centralDifferences(near.values, near.strideX, near.strideY)};
        });
        if (!central) sample.gradient = cellSampleInBox(index).gradient;
        return sample;
    }
    return inCell(Cell(index), [&](const Neighbourhood& near, const Vec3d& at) {
        if (options_.lookup == Lookup::Cubic) {
            FieldSample sample = tricubic(near.values, near.strideX, near.strideY, at);
            if (central) sample.gradient = trilinearWithGradient(near.values, near.strideX, near.strideY, at).gradient;
            return sample;
        }
        return central ? trilinearWithGradient(near.values, near.strideX, near.strideY, at)
                       : trilinearWithCellGradient(near.cellValues(), near.strideX, near.strideY, at);
    });
}

// phi with the gradient of the trilinear cell itself, which reaches no voxel beside the box.
FieldSample DistanceField::cellSampleInBox(const Vec3d& index) const
{
    return inCell(Cell(index), [](const Neighbourhood& near, const Vec3d& at) {
        return trilinearWithCellGradient(near.cellValues(), near.strideX, near.strideY, at);
    });
}

std::array<double, 8> DistanceField::cellCorners(const Vec3i& voxel) const
{
    Cell cell(Vec3d::Zero());
    cell.voxel = voxel;
    float copy[64];
    float constant = 0.0f;
    const Neighbourhood near = neighbourhood(cell, copy, constant);
    std::array<double, 8> corners;
    corners.fill(double(constant));
    if (near.values == nullptr) return corners;
    for (int i = 0; i < 8; ++i) {
        const int place = (i & 1) * near.strideX + (i >> 1 & 1) * near.strideY + (i >> 2 & 1);
        corners[std::size_t(i)] = double(near.cellValues()[place]);
    }
    return corners;
}

double DistanceField::phi(const Vec3d& world) const
{
    const Vec3d index = transform_.toIndex(world);
    if (indexBox_.contains(index)) return phiInBox(index);
    if (!index.allFinite()) return kNotANumber;
    if (empty()) return background_;
    const Vec3d closest = closestPointInBox(indexBox_, index, transform_);
    const double a = transform_.vectorToWorld(index - closest).norm();
    const double b = phiInBox(closest);
    return std::copysign(std::hypot(a, b), b);
}

FieldSample DistanceField::sample(const Vec3d& world) const
{
    const Vec3d index = transform_.toIndex(world);
    if (indexBox_.contains(index)) {
        FieldSample sample = sampleInBox(index);
        sample.gradient = transform_.gradientToWorld(sample.gradient);
        return sample;
    }
    if (!index.allFinite()) return {kNotANumber, Vec3d::Constant(kNotANumber)};
    if (empty()) return {background_, Vec3d::Zero()};
    return sampleOutside(index);
}

Vec3d DistanceField::slope(const Vec3d& world) const
{
    const Vec3d index = transform_.toIndex(world);
    if (indexBox_.contains(index)) return transform_.gradientToWorld(cellSampleInBox(index).gradient);
    return sample(world).gradient;
}

void DistanceField::gradients(const Vec3d& world, Vec3d& gradient, Vec3d& ownSlope) const
{
    const Vec3d index = transform_.toIndex(world);
    if (!indexBox_.contains(index)) {
        gradient = sample(world).gradient;
        ownSlope = gradient;
        return;
    }
    if (options_.lookup != Lookup::Trilinear || options_.normal != Normal::Central) {
        gradient = sample(world).gradient;
        ownSlope = slope(world);
        return;
    }
    struct Both {
        Vec3d gradient = Vec3d::Zero();
        Vec3d slope = Vec3d::Zero();
        explicit Both(double) {} // of one value everywhere
        Both(const Vec3d& g, const Vec3d& s) : gradient(g), slope(s) {}
    };
    const Both both = inCell(Cell(index), [](const Neighbourhood& near, const Vec3d& at) {
        return Both(trilinearWithGradient(near.values, near.strideX, near.strideY, at).gradient,
                    trilinearWithCellGradient(near.cellValues(), near.strideX, near.strideY, at).gradient);
    });
    gradient = transform_.gradientToWorld(both.gradient);
    ownSlope = transform_.gradientToWorld(both.slope);
}

// The part of a world vector that points along the face or edge of the box on which `closest` lies; `offset` leads from
// there to the point that it is closest to, so it is perpendicular to both.
Vec3d DistanceField::alongBox(const Vec3d& closest, const Vec3d& offset, const Vec3d& vector) const
{
    int freeAxes = 0;
    int freeAxis = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (closest[axis] <= indexBox_.min[axis] || closest[axis] >= indexBox_.max[axis]) continue;
        ++freeAxes;
        freeAxis = axis;
    }
    if (freeAxes == 0) return Vec3d::Zero();
    const Vec3d edge = transform_.vectorToWorld(Vec3d::Unit(freeAxis)).normalized();
    if (freeAxes == 1) return edge.dot(vector) * edge;
    const Vec3d normal = offset.normalized();
    return vector - normal.dot(vector) * normal;
}

// phi as it is looked up in the box, with a gradient for sliding along its side.
FieldSample DistanceField::sampleOnBox(const Vec3d& index) const
{
    if (options_.lookup == Lookup::Cubic) {
        return inCell(Cell(index), [](const Neighbourhood& near, const Vec3d& at) {
            return tricubic(near.values, near.strideX, near.strideY, at);
        });
    }
    FieldSample sample = cellSampleInBox(index);
    if (options_.lookup == Lookup::Nearest) sample.phi = phiInBox(index);
    return sample;
}

FieldSample DistanceField::sampleOutside(const Vec3d& index) const
{
    const Vec3d closest = closestPointInBox(indexBox_, index, transform_);
    const Vec3d offset = transform_.vectorToWorld(index - closest);
    const double a = offset.norm();
    const FieldSample atBox = sampleOnBox(closest);
    const double b = atBox.phi;
    const double magnitude = std::hypot(a, b);
    // d/dx of sqrt(A^2 + B^2) is (A dA/dx + B dB/dx) / sqrt: A grows along the offset, and B changes only as the
    // closest point slides along its face or edge of the box.
    const Vec3d sliding = alongBox(closest, offset, transform_.gradientToWorld(atBox.gradient));
    const Vec3d gradient = (offset + b * sliding) / magnitude;
    return {std::copysign(magnitude, b), std::copysign(1.0, b) * gradient};
}

// The world box around the index box.
Box DistanceField::boxInWorld() const
{
    Box box;
    if (empty()) return box;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index((corner & 1) != 0 ? indexBox_.max.x() : indexBox_.min.x(),
                          (corner & 2) != 0 ? indexBox_.max.y() : indexBox_.min.y(),
                          (corner & 4) != 0 ? indexBox_.max.z() : indexBox_.min.z());
        box.add(transform_.toWorld(index));
    }
    return box;
}

bool DistanceField::surfaceReachesBox() const
{
    if (empty()) return false;
    const Vec3i low = indexBox_.min.cast<int>();
    const Vec3i high = indexBox_.max.cast<int>();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3i first = low;
        Vec3i last = high;
        last[axis] = low[axis];
        if (blocks_.anyBelow(first, last, 0.0f)) return true;
        first[axis] = last[axis] = high[axis];
        if (blocks_.anyBelow(first, last, 0.0f)) return true;
    }
    return false;
}

} // namespace vdbounce
