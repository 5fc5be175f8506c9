// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/band_leaves.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/build/triangle_distance.h"
#include "vdbounce/io/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <tbb/parallel_sort.h>
#include <unistd.h>

namespace vdbounce {
namespace {

constexpr std::size_t kTrianglesPerTask = 1024;
constexpr std::size_t kLeavesPerTask = 16;
constexpr double kSliver = 1e-7;      // sine of the angle at a below which rounding turns the normal
constexpr double kMemoryShare = 0.75; // of the machine's memory
constexpr double kBytesPerLeaf =
    8192.0; // distances, regions, flags and the grid's own leaf, and the lists of triangles
constexpr double kBytesPerLatticeCell = 12.0; // which leaf it is, and its region
constexpr double kLargestLeaf = 134217728.0;  // 2^27: voxel coordinates stay within 30 bits

struct LeafTriangle {
    std::int32_t x, y, z;
    std::uint32_t triangle;

    bool sameLeaf(const LeafTriangle& o) const { return x == o.x && y == o.y && z == o.z; }
    bool operator<(const LeafTriangle& o) const
    {
        return std::tie(x, y, z, triangle) < std::tie(o.x, o.y, o.z, o.triangle);
    }
};

struct Triangle {
    Vec3d a, b, c;
    Vec3d normal; // unit; zero for a sliver, whose plane is too uncertain to exclude anything

    Triangle(const TriangleMesh& mesh, std::uint32_t t)
        : a(mesh.corner(t, 0)), b(mesh.corner(t, 1)), c(mesh.corner(t, 2))
    {
        normal = (b - a).cross(c - a);
        const double length = normal.norm();
        const bool sliver = length <= kSliver * (b - a).norm() * (c - a).norm();
        normal = sliver ? Vec3d(Vec3d::Zero()) : Vec3d(normal / length);
    }
    double distanceSquared(const Vec3d& p) const { return (closestPointOnTriangle(p, a, b, c) - p).squaredNorm(); }
    double planeDistance(const Vec3d& p) const { return std::abs((p - a).dot(normal)); }
};

// Appends the leaves in which any voxel centre may be closer than `band` to the triangle.
void appendReachedLeaves(const TriangleMesh& mesh, std::uint32_t t, double voxelSize, double band,
                         std::vector<LeafTriangle>& pairs, const Progress& progress)
{
    const Triangle triangle(mesh, t);
    const double leafSize = voxelSize * BandLeaf::kSide;
    const double halfSpan = 0.5 * voxelSize * (BandLeaf::kSide - 1); // of the voxel centres
    const double reach = band + halfSpan * std::sqrt(3.0);
    const Vec3d low = triangle.a.cwiseMin(triangle.b).cwiseMin(triangle.c) - Vec3d::Constant(band);
    const Vec3d high = triangle.a.cwiseMax(triangle.b).cwiseMax(triangle.c) + Vec3d::Constant(band);
    const Vec3i from = (low / leafSize).array().floor().cast<int>();
    const Vec3i to = (high / leafSize).array().floor().cast<int>();
    for (int x = from.x(); x <= to.x(); ++x) {
        throwIfStopped(progress); // a large triangle spans millions of leaves
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int z = from.z(); z <= to.z(); ++z) {
                const Vec3d centre = Vec3d(x, y, z) * leafSize + Vec3d::Constant(halfSpan);
                if (triangle.planeDistance(centre) > reach || triangle.distanceSquared(centre) > reach * reach)
                    continue;
                pairs.push_back({x, y, z, t});
            }
        }
    }
}

std::vector<LeafTriangle> sortedPairs(const TriangleMesh& mesh, double voxelSize, double band, Progress& progress)
{
    ProgressCounter counter(progress, 0);
    const std::size_t count = mesh.triangles.size();
    std::vector<std::vector<LeafTriangle>> parts(blockCount(count, kTrianglesPerTask));
    forEachBlock(count, kTrianglesPerTask, [&](std::size_t block, IndexRange range) {
        for (std::size_t t = range.begin; t < range.end; ++t) {
            appendReachedLeaves(mesh, static_cast<std::uint32_t>(t), voxelSize, band, parts[block], progress);
        }
        counter.add(range.end - range.begin);
    });
    std::vector<LeafTriangle> pairs;
    for (auto& part : parts) {
        pairs.insert(pairs.end(), part.begin(), part.end());
        std::vector<LeafTriangle>().swap(part);
    }
    tbb::parallel_sort(pairs.begin(), pairs.end());
    return pairs;
}

// The distances of one leaf's voxels to the triangles of its list; false when none is within the band.
bool measureLeaf(const TriangleMesh& mesh, const LeafTriangle* list, std::size_t count, double voxelSize, double band,
                 BandLeaf& leaf)
{
    leaf.leaf = Vec3i(list[0].x, list[0].y, list[0].z);
    std::array<double, BandLeaf::kVoxels> nearest2;
    nearest2.fill(band * band);
    bool reached = false;
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle triangle(mesh, list[i].triangle);
        for (int offset = 0; offset < BandLeaf::kVoxels; ++offset) {
            const Vec3d p = leaf.voxel(offset).cast<double>() * voxelSize;
            double& best = nearest2[static_cast<std::size_t>(offset)];
            const double plane = triangle.planeDistance(p);
            if (plane * plane >= best) continue;
            const double d2 = triangle.distanceSquared(p);
            if (d2 < best) {
                best = d2;
                reached = true;
            }
        }
    }
    for (std::size_t offset = 0; offset < nearest2.size(); ++offset) {
        const bool within = nearest2[offset] < band * band;
        leaf.distance[offset] = within ? float(std::sqrt(nearest2[offset])) : std::numeric_limits<float>::infinity();
    }
    return reached;
}

void requireIndexable(const TriangleMesh& mesh, double voxelSize, double band)
{
    const Box box = boundingBox(mesh);
    const double farthest = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()) + band;
    if (farthest / (voxelSize * BandLeaf::kSide) >= kLargestLeaf) {
        throw UsageError("voxel size " + std::to_string(voxelSize),
                         "is too small for a mesh that reaches " + std::to_string(farthest) + " from the origin",
                         "use larger voxels or move the mesh to the origin");
    }
}

double surfaceArea(const TriangleMesh& mesh)
{
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d& a = mesh.corner(t, 0);
        area += 0.5 * (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
    }
    return area;
}

// Refuses what would not fit before any of it is taken: the leaves that the band fills, by the surface's area, and the
// lattice of leaves around all, by the mesh's box.
void requireMemory(const TriangleMesh& mesh, double voxelSize, double band)
{
    const double leafSize = voxelSize * BandLeaf::kSide;
    const Vec3d lattice = (boundingBox(mesh).size() + Vec3d::Constant(2.0 * band)) / leafSize + Vec3d::Constant(3.0);
    const double inLattice = lattice.prod();
    const double reached = surfaceArea(mesh) * (2.0 * band + 2.0 * leafSize) / std::pow(leafSize, 3.0) + 8.0;
    const double bytes = std::min(reached, inLattice) * kBytesPerLeaf + inLattice * kBytesPerLatticeCell;
    const double available = kMemoryShare * double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
    if (!(bytes > available)) return;
    throw UsageError("voxel size " + numberText(voxelSize) + ", band " + numberText(band),
                     "would take about " + numberText(std::round(bytes * 1e-8) / 10.0) +
                         " GB, and three quarters of this machine are " +
                         numberText(std::round(available * 1e-8) / 10.0) + " GB",
                     "use larger voxels or a thinner band");
}

} // namespace

std::vector<BandLeaf> measureBandLeaves(const TriangleMesh& mesh, double voxelSize, double band, Progress& progress)
{
    requireIndexable(mesh, voxelSize, band);
    requireMemory(mesh, voxelSize, band);
    throwIfStopped(progress);
    const std::vector<LeafTriangle> pairs = sortedPairs(mesh, voxelSize, band, progress);
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i == 0 || !pairs[i].sameLeaf(pairs[i - 1])) begins.push_back(i);
    }
    const std::size_t count = begins.size();
    begins.push_back(pairs.size());

    std::vector<BandLeaf> leaves(count);
    std::vector<char> reached(count);
    ProgressCounter counter(progress, pairs.size());
    forEachBlock(count, kLeavesPerTask, [&](std::size_t, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            reached[i] =
                measureLeaf(mesh, pairs.data() + begins[i], begins[i + 1] - begins[i], voxelSize, band, leaves[i]) ? 1
                                                                                                                   : 0;
        }
        counter.add(begins[range.end] - begins[range.begin]);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (reached[i] != 0) leaves[kept++] = leaves[i];
    }
    leaves.resize(kept);
    return leaves;
}

} // namespace vdbounce
