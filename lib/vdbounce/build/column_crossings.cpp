// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/column_crossings.h"

#include "vdbounce/base/box.h"
#include "vdbounce/base/parallel.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <tbb/parallel_sort.h>

namespace vdbounce {
namespace {

constexpr std::size_t kTrianglesPerTask = 4096;
constexpr std::size_t kPointsPerTask = 16384;
constexpr std::int64_t kRowsPerLook = 16; // rows of voxels of a triangle between two questions whether to stop
constexpr int kFinestBits = 24;           // of a voxel's side
constexpr int kAllBits = 50;              // products of two differences stay below 2^104, sums of them within 128 bits

__extension__ using Wide = __int128;

// A point whose x and y are whole multiples of the grain.
struct Grained {
    std::int64_t x;
    std::int64_t y;
    double z;
};

struct BoxSum : Box {
    BoxSum& operator+=(const BoxSum& other)
    {
        add(other);
        return *this;
    }
    using Box::add;
};

// Index coordinates in grains from a base voxel.
class Graining {
public:
    Graining(const ClosedMesh& mesh, const LinearTransform& transform)
    {
        // Points of no triangle may be anywhere, and must not make the grain coarser.
        std::vector<char> used(mesh.pointCount(), 0);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (mesh.group[t] == ClosedMesh::kNone) continue;
            for (std::uint32_t p : mesh.triangles[t]) used[p] = 1;
        }
        points_.resize(mesh.pointCount());
        const BoxSum box = reduceBlocks(points_.size(), kPointsPerTask, BoxSum{}, [&](IndexRange range) {
            BoxSum part;
            for (std::size_t p = range.begin; p < range.end; ++p) {
                if (used[p] != 0) part.add(transform.toIndex(mesh.point(p)));
            }
            return part;
        });
        if (box.empty()) return;
        base_ = box.min.array().floor();
        const double largest = (box.max - base_).maxCoeff() + 1.0;
        bits_ = std::min(kFinestBits, kAllBits - int(std::ceil(std::log2(largest))));
        const double grains = std::ldexp(1.0, bits_);
        forEachIndex(points_.size(), kPointsPerTask, [&](std::size_t p) {
            if (used[p] == 0) return;
            const Vec3d index = transform.toIndex(mesh.point(p));
            const Vec3d local = (index - base_) * grains;
            points_[p] = {std::int64_t(std::nearbyint(local.x())), std::int64_t(std::nearbyint(local.y())), index.z()};
        });
    }

    const Grained& operator[](std::uint32_t p) const { return points_[p]; }
    std::int64_t grains(std::int64_t voxels) const { return voxels * (std::int64_t(1) << bits_); }
    std::int64_t voxelAbove(std::int64_t grains) const { return -floorVoxel(-grains); }
    std::int64_t floorVoxel(std::int64_t grains) const { return grains >> bits_; }
    double toVoxels(std::int64_t grains) const { return std::ldexp(double(grains), -bits_); }
    std::int64_t baseX() const { return std::int64_t(base_.x()); }
    std::int64_t baseY() const { return std::int64_t(base_.y()); }

private:
    Vec3d base_ = Vec3d::Zero();
    int bits_ = kFinestBits;
    std::vector<Grained> points_;
};

// Twice the area of the triangle u, v, p, positive when it runs counter-clockwise. Where p lies on the line it is told
// as if p were moved along x by less than anything, and along y by less than that.
struct EdgeSide {
    Wide twiceArea;
    bool positive;
};

EdgeSide sideOf(const Grained& u, const Grained& v, std::int64_t px, std::int64_t py)
{
    const Wide dx = Wide(v.x) - u.x;
    const Wide dy = Wide(v.y) - u.y;
    const Wide area = dx * (py - u.y) - dy * (px - u.x);
    if (area != 0) return {area, area > 0};
    return {0, dy != 0 ? dy < 0 : dx > 0};
}

class CrossingFinder {
public:
    /// `mirrored`: what runs counter-clockwise in the world runs clockwise in index space.
    CrossingFinder(const Graining& points, bool mirrored, const Progress& progress, std::vector<Crossing>& found)
        : points_(points), mirrored_(mirrored), progress_(progress), found_(found)
    {
    }

    void add(const TriangleMesh::Triangle& triangle, std::uint32_t group)
    {
        const Grained& a = points_[triangle[0]];
        const Grained& b = points_[triangle[1]];
        const Grained& c = points_[triangle[2]];
        const Wide area = (Wide(b.x) - a.x) * (c.y - a.y) - (Wide(b.y) - a.y) * (c.x - a.x);
        if (area == 0) return; // seen edge on
        const std::int64_t firstX = points_.voxelAbove(std::min({a.x, b.x, c.x}));
        const std::int64_t lastX = points_.floorVoxel(std::max({a.x, b.x, c.x}));
        for (std::int64_t x = firstX; x <= lastX; ++x) {
            if (x % kRowsPerLook == 0) throwIfStopped(progress_);
            const auto [low, high] = spanAt(points_.grains(x), a, b, c);
            for (std::int64_t y = points_.voxelAbove(low); y <= points_.floorVoxel(high); ++y)
                test(x, y, a, b, c, area, group);
        }
    }

private:
    // The triangle's extent along y on the line x, a grain wider so that rounding loses nothing.
    static std::pair<std::int64_t, std::int64_t> spanAt(std::int64_t x, const Grained& a, const Grained& b,
                                                        const Grained& c)
    {
        std::int64_t low = std::max({a.y, b.y, c.y});
        std::int64_t high = std::min({a.y, b.y, c.y});
        const std::array<std::pair<const Grained*, const Grained*>, 3> edges = {{{&a, &b}, {&b, &c}, {&c, &a}}};
        for (const auto& [u, v] : edges) {
            if (x < std::min(u->x, v->x) || x > std::max(u->x, v->x)) continue;
            std::int64_t from = u->y;
            std::int64_t to = v->y;
            if (u->x != v->x) {
                const double part = double(x - u->x) / double(v->x - u->x);
                from = u->y + std::llround(part * double(v->y - u->y));
                to = from;
            }
            low = std::min({low, from, to});
            high = std::max({high, from, to});
        }
        constexpr std::int64_t kRounding = 64; // grains; doubles hold 53 bits, coordinates have 50
        return {low - kRounding, high + kRounding};
    }

    void test(std::int64_t x, std::int64_t y, const Grained& a, const Grained& b, const Grained& c, Wide area,
              std::uint32_t group)
    {
        const std::int64_t px = points_.grains(x);
        const std::int64_t py = points_.grains(y);
        const bool counterClockwise = area > 0;
        const EdgeSide ab = sideOf(a, b, px, py);
        if (ab.positive != counterClockwise) return;
        const EdgeSide bc = sideOf(b, c, px, py);
        if (bc.positive != counterClockwise) return;
        const EdgeSide ca = sideOf(c, a, px, py);
        if (ca.positive != counterClockwise) return;
        const double z =
            (double(bc.twiceArea) * a.z + double(ca.twiceArea) * b.z + double(ab.twiceArea) * c.z) / double(area);
        const std::int64_t voxelX = x + points_.baseX();
        const std::int64_t voxelY = y + points_.baseY();
        found_.push_back({static_cast<std::int32_t>(voxelX >> 3), static_cast<std::int32_t>(voxelY >> 3),
                          std::min(std::max(z, std::min({a.z, b.z, c.z})), std::max({a.z, b.z, c.z})), group,
                          static_cast<std::int16_t>(8 * (voxelX & 7) + (voxelY & 7)),
                          static_cast<std::int16_t>(counterClockwise != mirrored_ ? -1 : 1)});
    }

    const Graining& points_;
    const bool mirrored_;
    const Progress& progress_;
    std::vector<Crossing>& found_;
};

} // namespace

std::vector<Crossing> findCrossings(const ClosedMesh& mesh, const LinearTransform& transform, const Progress& progress)
{
    const Graining points(mesh, transform);
    const bool mirrored = transform.indexToWorld().determinant() < 0.0;
    const std::size_t count = mesh.triangles.size();
    std::vector<std::vector<Crossing>> parts(blockCount(count, kTrianglesPerTask));
    forEachBlock(count, kTrianglesPerTask, [&](std::size_t block, IndexRange range) {
        CrossingFinder finder(points, mirrored, progress, parts[block]);
        for (std::size_t t = range.begin; t < range.end; ++t) {
            if (t % 256 == 0) throwIfStopped(progress);
            if (mesh.group[t] != ClosedMesh::kNone) finder.add(mesh.triangles[t], mesh.group[t]);
        }
    });
    std::size_t total = 0;
    for (const auto& part : parts) total += part.size();
    std::vector<Crossing> crossings;
    crossings.reserve(total);
    for (auto& part : parts) {
        crossings.insert(crossings.end(), part.begin(), part.end());
        std::vector<Crossing>().swap(part);
    }
    throwIfStopped(progress);
    tbb::parallel_sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return std::tie(a.leafX, a.leafY, a.z, a.column, a.group, a.change) <
               std::tie(b.leafX, b.leafY, b.z, b.column, b.group, b.change);
    });
    return crossings;
}

} // namespace vdbounce
