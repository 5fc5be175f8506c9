// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/box.h"
#include "vdbounce/base/interval.h"
#include "vdbounce/base/vector.h"
#include "vdbounce/field/field_options.h"
#include "vdbounce/field/leaf_blocks.h"
#include "vdbounce/field/leaf_distances.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/field/stencil.h"
#include "vdbounce/field/surface_tree.h"
#include "vdbounce/io/level_set_grid.h"

#include <array>
#include <optional>

namespace vdbounce {

/// A level set made ready for lookup: signed distance, its gradient and bounds on it, anywhere in space. Read-only
/// after construction and safe to use from any number of threads.
///
/// phi is in world units, negative inside. All points are in world space.
///
/// In the grid's box phi is trilinear of the 8 voxels around the point, and the gradient interpolates their central
/// differences the same way, carried to world space by the inverse transpose; or both are what FieldOptions asks for.
/// Outside phi is sign(B) sqrt(A^2 + B^2), with A the distance to the closest point of the box and B = phi there, and
/// the gradient is the derivative of that.
///
/// The box is that of the active voxels' centres. Between the narrow band and the box phi is the background with the
/// sign of the side, a lower bound on the distance, and the gradient is zero. Method: lecture, slides 26, 28 and 29.
///
///     LevelSetGrid grid = readLevelSet("bunny.vdb");
///     DistanceField field(grid);
///     FieldSample s = field.sample(Vec3d(0, 1, 0)); // s.phi, s.gradient
///
/// Cost: a copy of the voxels with a halo (see Storage for its size); a lookup reads one block. For many points at once
/// see samplePoints(), which is several times as fast.
class DistanceField {
public:
    /// Throws InputError, naming the grid and the voxel, for values that are not finite.
    explicit DistanceField(const LevelSetGrid& grid, const FieldOptions& options = {});

    const FieldOptions& options() const { return options_; }

    double phi(const Vec3d& world) const;
    FieldSample sample(const Vec3d& world) const;

    /// The derivative of phi as it is interpolated trilinearly, which jumps from cell to cell: unlike the gradient's
    /// central differences it reaches no further than the 8 voxels around the point. World space.
    Vec3d slope(const Vec3d& world) const;

    /// sample()'s gradient, and slope(), for little more than one of them.
    void gradients(const Vec3d& world, Vec3d& gradient, Vec3d& slope) const;

    /// lower <= true distance <= upper, provided that the grid's voxels hold true distances (active ones that are
    /// clamped to a band do not) and that the surface lies in the grid's box. In the band within a voxel's diagonal of
    /// the truth, elsewhere in the box within two and a half; outside sqrt(A^2+B^2) and A+|B|, with the bounds at the
    /// closest point for B. Where the box cuts the surface off (clipped()), the bounds allow for any surface beyond.
    /// Cost: in the band 8 voxels, elsewhere some microseconds. In a band thinner than half a voxel's diagonal, where
    /// no voxel may tell how near the surface is, the far bound may be infinite.
    Interval bounds(const Vec3d& world) const;

    /// A place outside, phi > 0 there, on the far side of the surface near `world`: a voxel's centre. From anywhere
    /// inside the straight way to it leads out, and is at most two and a half voxel diagonals longer than the shortest
    /// that leads to any voxel outside. Nothing where no voxel at the surface is outside.
    std::optional<Vec3d> nearestOutside(const Vec3d& world) const;

    /// No two points in the box differ in phi by more than this times their distance, or with Lookup::Nearest their
    /// distance and a voxel's diagonal. At least 1.
    double lipschitz() const { return lipschitz_; }

    /// A distance that can be travelled from `world` in any direction, times lipschitz(), without phi becoming less
    /// than 0, given that phi there is `phi`: phi itself, but for a surface that its box cuts off, where phi outside
    /// jumps, and less a jump for Lookup::Nearest.
    double freeDistance(const Vec3d& world, double phi) const;

    /// How far a particle at `world`, where phi is `phi`, can move in any direction without phi falling below its
    /// radius: freeDistance() less the radius, over lipschitz(); beyond the band also what whole leaves lie between it
    /// and the band. World units, >= 0.
    double clearance(const Vec3d& world, double phi, double radius) const;

    const LinearTransform& transform() const { return transform_; }
    double voxelSize() const { return transform_.smallestVoxelSize(); }
    double background() const { return background_; }
    /// The width of the band inside, world units: phi is its negative where the surface is farther.
    double interior() const { return interior_; }

    /// The most that a voxel is off for the storage that was asked for, measured over all of them; 0 for
    /// Storage::Float. phi in the box is off by no more, with Lookup::Cubic by up to 2 times as much. A gradient's
    /// component along a grid axis is off by no more than this over the voxel's side there, with Normal::Analytic by up
    /// to 2 times and with Lookup::Cubic 5 times as much.
    double storageError() const { return storageError_; }
    bool empty() const { return indexBox_.empty(); }

    /// The box of the active voxels' centres, index space.
    const Box& indexBox() const { return indexBox_; }
    /// The world box around it.
    const Box& worldBox() const { return worldBox_; }

    /// True when the surface reaches the side of the grid's box, so that what lies outside of it is not known.
    bool clipped() const { return clipped_; }

    /// The values of the 8 voxels around the cell above `voxel`: corner i is (i & 1, i >> 1 & 1, i >> 2 & 1) in x, y,
    /// z from it.
    std::array<double, 8> cellCorners(const Vec3i& voxel) const;

    /// The voxels as they are laid out for lookup.
    const LeafBlocks& blocks() const { return blocks_; }

    const SurfaceTree& surface() const { return surface_; }

    std::size_t memoryBytes() const
    {
        return blocks_.memoryBytes() + surface_.memoryBytes() + leafDistances_.memoryBytes();
    }

private:
    // The cell of a point: the voxel below it, and the point's place in between.
    struct Cell {
        explicit Cell(const Vec3d& index);
        Vec3i voxel;
        Vec3d at;
    };

    double phiInBox(const Vec3d& index) const;
    FieldSample sampleInBox(const Vec3d& index) const;
    FieldSample cellSampleInBox(const Vec3d& index) const;
    FieldSample sampleOnBox(const Vec3d& index) const;
    FieldSample sampleOutside(const Vec3d& index) const;
    Vec3d alongBox(const Vec3d& closest, const Vec3d& offset, const Vec3d& vector) const;
    Interval boundsInBox(const Vec3d& index) const;
    Interval boundsFromVoxels(const Vec3d& index) const;
    double farthestSurface(const SurfaceTree::Cube& cube, const Vec3d& index, double sign) const;
    double distanceToBoxSide(const Vec3d& index) const;
    bool isDistance(float value) const;

    // The 4^3 values around a cell: in place where a block holds them, else copied to `copy`; null where all are one
    // value.
    struct Neighbourhood {
        const float* values;
        int strideX;
        int strideY;

        // The cell's own 8 values, which start one further along each axis.
        const float* cellValues() const { return values + strideX + strideY + 1; }
    };
    Neighbourhood neighbourhood(const Cell& cell, float (&copy)[64], float& constant) const;

    template <class Interpolate> auto inCell(const Cell& cell, const Interpolate& interpolate) const;
    bool surfaceReachesBox() const;
    Box boxInWorld() const;

    LinearTransform transform_;
    LeafBlocks blocks_;
    SurfaceTree surface_;
    Box indexBox_;
    Box worldBox_; // asked for by every ray and every sweep
    float background_ = 0.0f;
    float interior_ = 0.0f;
    double storageError_ = 0.0;
    double lipschitz_ = 1.0;
    LeafDistances leafDistances_;
    double leafSide_ = 0.0; // the shortest way across a leaf, world units
    double jump_ = 0.0;     // of phi from voxel to voxel with Lookup::Nearest
    FieldOptions options_;
    bool clipped_ = false;
};

} // namespace vdbounce
