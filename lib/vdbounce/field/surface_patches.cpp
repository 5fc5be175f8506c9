// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/surface_patches.h"

#include "vdbounce/base/disjoint_sets.h"
#include "vdbounce/field/tetrahedra_cut.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vdbounce {
namespace {

constexpr int kSide = BlockLayout::kLeafSide;
constexpr int kCells = kSide * kSide * kSide;
constexpr int kCellStrides[3] = {kSide * kSide, kSide, 1};
constexpr std::uint32_t kUncut = 0xffffffff;

using Patch = SurfacePatches::Patch;

// Which voxels of the block, and of the next ones' first layers, are inside: a bit for each z.
class InsideBits {
public:
    explicit InsideBits(const float* values)
    {
        for (int x = 0; x <= kSide; ++x) {
            for (int y = 0; y <= kSide; ++y) {
                const float* v =
                    values + BlockLayout::kDiagonal + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY;
                unsigned bits = 0;
                for (int z = 0; z <= kSide; ++z) bits |= unsigned(v[z] < 0.0f) << z;
                rows_[x][y] = bits;
                any_ |= bits;
                all_ &= bits;
            }
        }
    }

    bool oneSide() const { return any_ == 0 || all_ == kRow; }

    bool rowOneSide(int x, int y) const
    {
        const unsigned any = rows_[x][y] | rows_[x][y + 1] | rows_[x + 1][y] | rows_[x + 1][y + 1];
        const unsigned all = rows_[x][y] & rows_[x][y + 1] & rows_[x + 1][y] & rows_[x + 1][y + 1];
        return any == 0 || all == kRow;
    }

    // The corners of a cell that are inside, as TetrahedraCut numbers them.
    unsigned corners(int x, int y, int z) const
    {
        unsigned bits = 0;
        for (int c = 0; c < 8; ++c) bits |= (rows_[x + (c & 1)][y + (c >> 1 & 1)] >> (z + (c >> 2 & 1)) & 1u) << c;
        return bits;
    }

private:
    static constexpr unsigned kRow = (1u << (kSide + 1)) - 1;

    unsigned rows_[kSide + 1][kSide + 1];
    unsigned any_ = 0;
    unsigned all_ = kRow;
};

class Cutter {
public:
    Cutter(const BlockCells& cells, const Mat3d& areaToWorld)
        : block_(cells), areaToWorld_(areaToWorld), table_(TetrahedraCut::table())
    {
    }

    SurfacePatches cut()
    {
        const InsideBits inside(block_.values);
        if (inside.oneSide()) return {};
        for (int x = 0; x < kSide; ++x) {
            for (int y = 0; y < kSide; ++y) {
                if (inside.rowOneSide(x, y)) continue;
                for (int z = 0; z < kSide; ++z) cutCell(Vec3i(x, y, z), inside.corners(x, y, z));
            }
        }
        joinNeighbours();
        return collect();
    }

private:
    static int indexOf(const Vec3i& cell) { return (cell.x() * kSide + cell.y()) * kSide + cell.z(); }

    void cutCell(const Vec3i& cell, unsigned corners)
    {
        if (corners == 0 || corners == 255) return;
        const Vec3i voxel = block_.origin + cell;
        if ((voxel.array() < block_.boxMin.array()).any() || (voxel.array() >= block_.boxMax.array()).any()) return;
        const TetrahedraCut::Case& cut = table_.cases[corners];
        Cell& entry = cells_[std::size_t(indexOf(cell))];
        entry = {std::uint32_t(parts_.size()), std::uint8_t(corners)};
        parts_.resize(parts_.size() + cut.parts);
        places_.push_back(cell);
        Vec3d points[TetrahedraCut::kEdges];
        findCrossings(cell, cut, points);
        for (std::size_t t = 0; t < cut.triangles; ++t) {
            const auto& triangle = cut.corners[t];
            addTriangle(points[triangle[0]], points[triangle[1]], points[triangle[2]],
                        parts_[entry.firstPart + cut.partOfTriangle[t]]);
        }
        markOpen(voxel, cut, entry.firstPart);
    }

    // Where the surface crosses the edges, linearly, from the block's first voxel.
    void findCrossings(const Vec3i& cell, const TetrahedraCut::Case& cut, Vec3d (&points)[TetrahedraCut::kEdges]) const
    {
        const float* v = block_.values + BlockLayout::kDiagonal + cell.x() * BlockLayout::kStrideX +
                         cell.y() * BlockLayout::kStrideY + cell.z();
        for (std::size_t e = 0; e < TetrahedraCut::kEdges; ++e) {
            if (cut.partOfEdge[e] == TetrahedraCut::kNone) continue;
            const int from = table_.edges[e].from;
            const int along = table_.edges[e].to - from; // the axes that the edge follows, as bits
            const double a = valueAt(v, from);
            const double t = a / (a - valueAt(v, table_.edges[e].to));
            for (int axis = 0; axis < 3; ++axis)
                points[e][axis] = cell[axis] + (from >> axis & 1) + ((along >> axis & 1) != 0 ? t : 0.0);
        }
    }

    static double valueAt(const float* v, int corner)
    {
        return double(
            v[(corner & 1) * BlockLayout::kStrideX + (corner >> 1 & 1) * BlockLayout::kStrideY + (corner >> 2 & 1)]);
    }

    void addTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, Patch& part) const
    {
        const Vec3d vectorArea = 0.5 * (b - a).cross(c - a);
        part.vectorArea += vectorArea;
        part.volume += a.dot(vectorArea) / 3.0;
        part.area += (areaToWorld_ * vectorArea).norm();
        part.place = a;
    }

    // A part of the surface that crosses the box's side ends there.
    void markOpen(const Vec3i& voxel, const TetrahedraCut::Case& cut, std::uint32_t firstPart)
    {
        for (int axis = 0; axis < 3; ++axis) {
            if (voxel[axis] == block_.boxMin[axis]) markOpen(table_.lowFace[std::size_t(axis)], cut, firstPart);
            if (voxel[axis] + 1 == block_.boxMax[axis]) markOpen(table_.highFace[std::size_t(axis)], cut, firstPart);
        }
    }
    void markOpen(const std::array<std::uint8_t, TetrahedraCut::kFaceEdges>& face, const TetrahedraCut::Case& cut,
                  std::uint32_t firstPart)
    {
        for (std::uint8_t edge : face) {
            if (cut.partOfEdge[edge] != TetrahedraCut::kNone) parts_[firstPart + cut.partOfEdge[edge]].open = true;
        }
    }

    // The part of a cell's surface that crosses an edge, or kUncut.
    std::uint32_t partAt(int cell, std::uint8_t edge) const
    {
        const Cell& entry = cells_[std::size_t(cell)];
        if (entry.firstPart == kUncut) return kUncut;
        const std::uint8_t part = table_.cases[entry.corners].partOfEdge[edge];
        return part == TetrahedraCut::kNone ? kUncut : entry.firstPart + part;
    }

    void joinNeighbours()
    {
        DisjointSets sets(parts_.size());
        for (const Vec3i& cell : places_) {
            for (int axis = 0; axis < 3; ++axis) {
                if (cell[axis] == 0) continue;
                const int index = indexOf(cell);
                for (std::size_t e = 0; e < TetrahedraCut::kFaceEdges; ++e) {
                    const std::uint32_t here = partAt(index, table_.lowFace[std::size_t(axis)][e]);
                    const std::uint32_t before =
                        partAt(index - kCellStrides[axis], table_.highFace[std::size_t(axis)][e]);
                    if (here != kUncut && before != kUncut) sets.join(here, before);
                }
            }
        }
        patchOfPart_.resize(parts_.size());
        for (std::uint32_t i = 0; i < parts_.size(); ++i) {
            const std::uint32_t first = sets.find(i);
            patchOfPart_[i] = first == i ? patchCount_++ : patchOfPart_[first];
        }
    }

    SurfacePatches collect() const
    {
        SurfacePatches result;
        result.patches.resize(patchCount_);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            Patch& patch = result.patches[patchOfPart_[i]];
            patch.area += parts_[i].area;
            patch.volume += parts_[i].volume;
            patch.vectorArea += parts_[i].vectorArea;
            patch.place = parts_[i].place;
            patch.open = patch.open || parts_[i].open;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = std::size_t(axis);
            result.low[a] = sideOf(axis, 0, table_.lowFace[a]);
            result.high[a] = sideOf(axis, kSide - 1, table_.highFace[a]);
        }
        return result;
    }

    // What crosses a side of the block; nothing where that is also a side of the box. Cells beyond the box are uncut.
    std::vector<std::uint16_t> sideOf(int axis, int layer,
                                      const std::array<std::uint8_t, TetrahedraCut::kFaceEdges>& face) const
    {
        const int plane = block_.origin[axis] + (layer == 0 ? 0 : kSide);
        if (plane <= block_.boxMin[axis] || plane >= block_.boxMax[axis]) return {};
        const int across = (axis + 1) % 3;
        const int along = (axis + 2) % 3;
        std::vector<std::uint16_t> crossing;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const int cell = layer * kCellStrides[axis] + i * kCellStrides[across] + j * kCellStrides[along];
                for (std::uint8_t edge : face) {
                    const std::uint32_t part = partAt(cell, edge);
                    if (part != kUncut) crossing.push_back(std::uint16_t(patchOfPart_[part]));
                }
            }
        }
        return crossing;
    }

    struct Cell {
        std::uint32_t firstPart = kUncut;
        std::uint8_t corners = 0; // inside
    };

    const BlockCells block_;
    const Mat3d areaToWorld_;
    const TetrahedraCut& table_;
    std::array<Cell, kCells> cells_;
    std::vector<Vec3i> places_; // of cells that are cut
    std::vector<Patch> parts_;  // of the surface, cell by cell
    std::vector<std::uint32_t> patchOfPart_;
    std::uint32_t patchCount_ = 0;
};

} // namespace

SurfacePatches cutSurface(const BlockCells& cells, const Mat3d& areaToWorld)
{
    return Cutter(cells, areaToWorld).cut();
}

} // namespace vdbounce
