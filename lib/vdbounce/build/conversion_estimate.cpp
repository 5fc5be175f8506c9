// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/conversion_estimate.h"

#include "vdbounce/base/error.h"
#include "vdbounce/build/band_leaves.h"
#include "vdbounce/io/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include <unistd.h>

namespace vdbounce {
namespace {

constexpr double kMemoryShare = 0.75;

// Measured: a leaf while its distances become a grid's, what else is held of a triangle (its box, the lists on the
// way down, how it hangs together), and the line of voxels that crosses a voxel's side.
constexpr double kBytesPerLeaf = 2800.0;
constexpr double kBytesPerTriangle = 110.0;
constexpr double kBytesPerCrossing = 72.0;

// Measured on one core: what a triangle takes by itself, in each leaf, and in each row of voxels of those.
constexpr double kSecondsPerTriangle = 3e-7;
constexpr double kSecondsPerPair = 5e-8;
constexpr double kSecondsPerRow = 7e-9;
constexpr double kSecondsPerLeaf = 1.5e-5;

// Voxel coordinates stay within 30 bits.
constexpr double kFarthestVoxel = 1073741824.0;

double areaOf(const TriangleMesh& mesh)
{
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d& a = mesh.corner(t, 0);
        area += 0.5 * (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
    }
    return area;
}

std::string gigabytes(double bytes) { return numberText(std::round(bytes * 1e-8) / 10.0) + " GB"; }

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

std::uint64_t defaultMaxMemory()
{
    return std::uint64_t(kMemoryShare * double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE)));
}

ConversionEstimate estimateConversion(const TriangleMesh& mesh, const LinearTransform& transform, double exterior,
                                      double interior)
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
        leaves * kBytesPerLeaf + triangles * kBytesPerTriangle + area / (voxel * voxel) * kBytesPerCrossing;
    // A triangle of mean size reaches this far, voxels, and so many rows of voxels and leaves.
    const double reach = std::sqrt(area / triangles) / voxel + 2.0 * band / voxel;
    const double rows = (reach + 1.0) * (reach + 1.0) * (reach / BandLeaf::kSide + 1.0);
    const double pairs = std::pow(reach / BandLeaf::kSide + 1.0, 3.0);
    // Where triangles are larger than leaves their planes fill no more than the leaves that the band has.
    const double leafPairs = std::min(triangles * pairs, triangles + leaves * (1.0 + 4.0 * band / voxel));
    const double share = leafPairs / (triangles * pairs);
    estimate.cpuSeconds = triangles * kSecondsPerTriangle + leafPairs * kSecondsPerPair +
                          share * triangles * rows * kSecondsPerRow + leaves * kSecondsPerLeaf;
    return estimate;
}

void requireConvertible(const TriangleMesh& mesh, const LinearTransform& transform, double exterior, double interior,
                        std::uint64_t maxMemory)
{
    const double voxel = transform.smallestVoxelSize();
    double farthest = 0.0;
    for (const auto& triangle : mesh.triangles) {
        for (std::uint32_t p : triangle)
            farthest = std::max(farthest, transform.toIndex(mesh.points[p]).cwiseAbs().maxCoeff());
    }
    const double band = std::max(exterior, interior);
    if (!(farthest + band / voxel < kFarthestVoxel)) {
        throw UsageError("voxel size " + numberText(voxel),
                         "is too small for a mesh that reaches " + numberText(std::round(farthest)) +
                             " voxels from the origin; 1,073,741,824 are the most",
                         "use larger voxels or move the mesh to the origin");
    }
    const double bytes = estimateConversion(mesh, transform, exterior, interior).bytes;
    if (!(bytes > double(maxMemory))) return;
    throw UsageError("voxel size " + numberText(voxel) + ", band " + numberText(band),
                     "would take about " + gigabytes(bytes) + ", and " + gigabytes(double(maxMemory)) + " are allowed",
                     "use larger voxels, a thinner band, or --max-memory");
}

} // namespace vdbounce
