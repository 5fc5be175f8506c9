// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/conversion_estimate.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/voxel_limits.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/field/option_checks.h"
#include "vdbounce/io/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Measured on the bunny, the armadillo, the dragon and balls of 400 to 2 million triangles, at 0.05 to 30 voxels a
// triangle's side: a leaf while its distances become a grid's; before that, beside what crosses its columns; the
// crossings of a surface as large as a voxel's side, sorted; what else is held of a triangle (its box, the lists on
// the way down, how it hangs together); and what threads take before there is anything to do. Together 0.8 to 1.5
// times what it took.
constexpr double kBytesPerLeaf = 2800.0;
constexpr double kBytesPerUnsignedLeaf = 2100.0;
constexpr double kBytesPerCrossing = 36.0;
constexpr double kBytesPerTriangle = 110.0;
constexpr double kBytesAtLeast = 5e6;

// Measured on one core: what a triangle takes by itself, in each leaf, and in each row of voxels of those. Together 0.6
// to 1.4 times what it took.
constexpr double kSecondsPerTriangle = 3e-7;
constexpr double kSecondsPerPair = 5e-8;
constexpr double kSecondsPerRow = 7e-9;
constexpr double kSecondsPerLeaf = 1.5e-5;

double areaOf(const TriangleMesh& mesh)
{
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d& a = mesh.corner(t, 0);
        area += 0.5 * (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
    }
    return area;
}

// Leaves within `band` of a surface of that area, no more than there are in the box around it.
double leavesWithin(double area, const Box& box, double voxel, double band)
{
    const double side = voxel * BandLeaf::kSide;
    const double thickness = 2.0 * band + side;
    const double near = area * thickness + 4.0 / 3.0 * M_PI * std::pow(0.5 * thickness, 3.0);
    const double all = (box.size() + Vec3d::Constant(2.0 * band + side)).prod();
    return std::min(near, all) / (side * side * side) + 8.0;
}

} // namespace

ConversionEstimate estimateConversion(const TriangleMesh& mesh, const LinearTransform& transform, double exterior,
                                      double interior, double beside)
{
    const double voxelVolume = std::abs(transform.indexToWorld().determinant());
    const double voxel = std::cbrt(voxelVolume);
    const double band = std::max(exterior, interior);
    const double area = areaOf(mesh);
    const Box box = boundingBox(mesh);
    const double triangles = double(mesh.triangles.size());
    const double leaves = leavesWithin(area, box, voxel, band);
    // A mesh that is no more than a point still has a ball of voxels around it.
    const double around = 4.0 / 3.0 * M_PI * exterior * exterior * exterior;
    ConversionEstimate estimate;
    estimate.activeVoxels = (area * (exterior + interior) + around) / voxelVolume;
    estimate.bytes =
        kBytesAtLeast + triangles * kBytesPerTriangle + leaves * beside +
        std::max(leaves * kBytesPerLeaf, leaves * kBytesPerUnsignedLeaf + area / (voxel * voxel) * kBytesPerCrossing);
    // A triangle of mean size reaches so many voxels along itself and across, and so many rows of voxels and leaves.
    const double across = 2.0 * band / voxel;
    const double along = std::sqrt(area / triangles) / voxel + across;
    const double layers = across / BandLeaf::kSide + 1.0;
    const double rows = (along + 1.0) * (along + 1.0) * layers;
    const double pairs = std::pow(along / BandLeaf::kSide + 1.0, 2.0) * layers;
    estimate.cpuSeconds =
        triangles * (kSecondsPerTriangle + pairs * kSecondsPerPair + rows * kSecondsPerRow) + leaves * kSecondsPerLeaf;
    return estimate;
}

void requireConvertible(const TriangleMesh& mesh, const LinearTransform& transform, double exterior, double interior,
                        std::uint64_t maxMemory, double beside)
{
    const double voxel = transform.smallestVoxelSize();
    double farthest = 0.0;
    for (const auto& triangle : mesh.triangles) {
        for (std::uint32_t p : triangle)
            farthest = std::max(farthest, transform.toIndex(mesh.points[p]).cwiseAbs().maxCoeff());
    }
    const double band = std::max(exterior, interior);
    if (!(farthest + band / voxel < kFarthestVoxel)) refuseFarVoxels(voxel, farthest, "a mesh that", "the mesh");
    const double bytes = estimateConversion(mesh, transform, exterior, interior, beside).bytes;
    if (!(bytes > double(maxMemory))) return;
    throw UsageError("voxel size " + numberText(voxel) + ", band " + numberText(band),
                     "would take about " + sizeText(bytes) + ", and " + sizeText(double(maxMemory)) + " are allowed",
                     "use larger voxels, a thinner band, or --max-memory");
}

} // namespace vdbounce
