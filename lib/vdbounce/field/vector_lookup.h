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

/// Trilinear phi and central-difference gradient of up to kPointsPerChunk points. Those outside the box are left out,
/// and their numbers put into `outside`. Returns how many those are. Needs VectorField::directory.nodes.
int lookUpChunk(const VectorField& field, const Vec3d* points, int count, PointSample* samples, int* outside);

/// The directory entries of up to kPointsPerChunk points: block numbers, or below 0 for points in tiles and outside the
/// box. Needs VectorField::directory.nodes.
void findEntries(const VectorField& field, const Vec3d* points, int count, std::int32_t* entries);

/// The kinds of processor that the vector code was compiled for and that this machine can run, best first.
std::vector<std::string> vectorTargets();

/// Makes lookUpChunk use one of vectorTargets(); an empty name stands for the best. For tests and measurements: results
/// do not depend on it. Not safe while lookups run.
void chooseVectorTarget(const std::string& name);

} // namespace vdbounce
