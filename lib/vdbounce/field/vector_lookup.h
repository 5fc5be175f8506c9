// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/sample_points.h"

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// The vector code behind samplePoints(), compiled once for each kind of processor.

namespace vdbounce {

/// A field as plain arrays, for vector code to read.
struct VectorField {
    explicit VectorField(const DistanceField& field);

    double worldToIndex[9]; // row by row
    double origin[3];
    double boxMin[3];
    double boxMax[3];
    LeafBlocks::Directory directory;
    Lookup lookup;
    Normal normal;
    Storage storage;
    const void* values;
    const BlockValues::Range* ranges; // of Storage::Fixed8
    /// What the kernel's (phi, gx, gy, gz) is made of: the sum of these four columns times phi in stored units and the
    /// three components of its index-space gradient.
    float columns[4][4];
};

/// Points that are looked up together: enough that their cache misses overlap, few enough that what is known of them
/// stays in the first-level cache.
constexpr int kPointsPerChunk = 64;

/// Where points lie in the field.
struct PointChunk {
    // Vectors read on beyond the last point.
    static constexpr int kRoom = kPointsPerChunk + 4;

    alignas(64) float at[3][kRoom];                   ///< the place in the cell, 0 to 1
    alignas(64) std::int32_t entry[kPointsPerChunk];  ///< the directory's entry: a block's number or ~tile
    alignas(64) std::int32_t offset[kPointsPerChunk]; ///< where in the block the 4^3 values around the cell begin
    std::uint64_t outside; ///< a bit for each point that is not in the box; the rest of it means nothing
};

/// Finds the cells of up to kPointsPerChunk points. Returns whether all of them are in blocks. Needs
/// VectorField::directory.nodes.
bool locatePoints(const VectorField& field, const Vec3d* points, int count, PointChunk& chunk);

/// phi and gradient of the chunk's first `count` points, all of which must be in blocks, as VectorField::lookup and
/// normal ask for them; Normal::Central of Lookup::Cubic and Normal::Analytic of Lookup::Nearest are not among them.
/// `samples` needs room for the next multiple of 4.
void interpolatePoints(const VectorField& field, const PointChunk& chunk, int count, PointSample* samples);

/// The kinds of processor that the vector code was compiled for and that this machine can run, best first.
std::vector<std::string> vectorTargets();

/// Makes both of them use one of vectorTargets(); an empty name stands for the best. For tests and measurements:
/// results do not depend on it. Not safe while lookups run.
void chooseVectorTarget(const std::string& name);

} // namespace vdbounce
