// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/column_sign.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/build/column_counts.h"
#include "vdbounce/build/hole_winding.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vdbounce {
namespace {

constexpr int kSide = BandLeaf::kSide;
constexpr int kColumns = kSide * kSide;
constexpr std::size_t kLeafColumnsPerTask = 8;

// A winding number nearer to a half than this part of the way to a whole is not sure.
constexpr double kUnsure = 0.5;

// Of a voxel where crossings say otherwise by their parity than by their sum.
constexpr float kOverlapConfidence = 0.5f;

// What lies above one 8 x 8 square of the lattice.
struct LeafColumn {
    int x;
    int y;
    IndexRange leaves;
    IndexRange crossings;
};

std::vector<LeafColumn> leafColumns(const BandLeaves& leaves, const std::vector<Crossing>& crossings)
{
    std::vector<LeafColumn> columns;
    std::size_t leaf = 0;
    std::size_t crossing = 0;
    while (leaf < leaves.size() || crossing < crossings.size()) {
        const auto leafAt = [&](std::size_t i) { return std::make_pair(leaves[i]->leaf.x(), leaves[i]->leaf.y()); };
        const auto crossingAt = [&](std::size_t i) { return std::make_pair(crossings[i].leafX, crossings[i].leafY); };
        auto at = leaf < leaves.size() ? leafAt(leaf) : crossingAt(crossing);
        if (crossing < crossings.size()) at = std::min(at, crossingAt(crossing));
        LeafColumn column{at.first, at.second, {leaf, leaf}, {crossing, crossing}};
        while (leaf < leaves.size() && leafAt(leaf) == at) column.leaves.end = ++leaf;
        while (crossing < crossings.size() && crossingAt(crossing) == at) column.crossings.end = ++crossing;
        columns.push_back(column);
    }
    return columns;
}

struct ColumnResult {
    std::vector<InsideRun> inside;
    std::vector<SplitLeaf> split;
    Doubt holes;
    Doubt overlaps;

    ColumnResult& operator+=(const ColumnResult& other)
    {
        inside.insert(inside.end(), other.inside.begin(), other.inside.end());
        split.insert(split.end(), other.split.begin(), other.split.end());
        holes += other.holes;
        overlaps += other.overlaps;
        return *this;
    }
};

// Goes up one leaf column.
class ColumnWalk {
public:
    ColumnWalk(const SolidGroups& solids, const std::vector<std::uint32_t>& open,
               const std::vector<Crossing>& crossings, const LinearTransform& transform, const LeafColumn& column,
               ColumnResult& result)
        : solids_(solids), open_(open), transform_(transform), column_(column),
          next_(crossings.data() + column.crossings.begin), end_(crossings.data() + column.crossings.end),
          result_(result)
    {
    }

    // Says which of the leaves below leaf z that were not passed yet are inside.
    void passGap(int z)
    {
        if (!started_) {
            started_ = true;
            z_ = next_ == end_ ? z : std::min(z, int(std::floor(next_->z)) >> 3);
        }
        while (z_ < z) {
            const int until = sameUntil(z);
            if (until > z_) {
                if (total_[0] > 0) addRun(z_, until);
                z_ = until;
            } else {
                passEmptyLeaf();
                ++z_;
            }
        }
    }

    void passRest() { passGap(next_ == end_ ? z_ : std::max(z_, (int(std::floor(end_[-1].z)) >> 3) + 1)); }

    void passLeaf(BandLeaf& leaf, bool wantConfidence)
    {
        const std::vector<LeafWinding> windings = doubtfulWindings(solids_, open_, transform_, leaf.leaf);
        forEachVoxel(leaf.leaf.z(), [&](int v, int column) {
            float& distance = leaf.distance[std::size_t(v)];
            const Side side = sideOf(v, column, windings);
            if (std::isfinite(distance)) note(side, transform_.toWorld(leaf.voxel(v).cast<double>()));
            if (side.inside && distance > 0.0f) distance = -distance;
            if (!wantConfidence || !(side.confidence < 1.0f)) return;
            if (leaf.confidence == nullptr) {
                leaf.confidence = std::make_unique<LeafArray<float>>();
                leaf.confidence->fill(1.0f);
            }
            (*leaf.confidence)[std::size_t(v)] = side.confidence;
        });
        z_ = leaf.leaf.z() + 1;
    }

private:
    struct Side {
        bool inside;
        bool besideHole; // the methods disagree, because of a hole
        bool overlap;    // or because of bodies that overlap
        float confidence;
    };

    // Voxel by voxel, each slice once crossings are added up to there.
    template <class Body> void forEachVoxel(int leafZ, const Body& body)
    {
        for (int z = 0; z < kSide; ++z) {
            advance(leafZ * kSide + z);
            for (int column = 0; column < kColumns; ++column) body(column * kSide + z, column);
        }
    }

    void advance(int voxelZ)
    {
        for (; next_ != end_ && next_->z <= double(voxelZ); ++next_) {
            const auto column = std::size_t(next_->column);
            const SolidGroup& group = solids_.groups[next_->group];
            const auto [before, after] = counts_[column].add(next_->group, next_->change);
            total_[column] += group.weight * (int(group.holds(after)) - int(group.holds(before)));
        }
    }

    // Up to where, at most z, all empty leaves are as the first voxel of the next: where no cap is crossed, and all
    // columns agree.
    int sameUntil(int z)
    {
        advance(z_ * kSide);
        const bool agree =
            std::all_of(total_.begin(), total_.end(), [this](int total) { return (total > 0) == (total_[0] > 0); });
        if (!open_.empty() || !agree) return z_;
        return next_ == end_ ? z : std::min(z, int(std::floor(next_->z)) >> 3);
    }

    void passEmptyLeaf()
    {
        const Vec3i leaf(column_.x, column_.y, z_);
        const std::vector<LeafWinding> windings = doubtfulWindings(solids_, open_, transform_, leaf);
        SplitLeaf split{leaf, {}};
        forEachVoxel(z_, [&](int v, int column) {
            if (sideOf(v, column, windings).inside) split.inside.set(std::size_t(v));
        });
        if (split.inside.all()) {
            addRun(z_, z_ + 1);
        } else if (split.inside.any()) {
            result_.split.push_back(split);
        }
    }

    void addRun(int begin, int end)
    {
        if (!result_.inside.empty()) {
            InsideRun& last = result_.inside.back();
            if (last.leafX == column_.x && last.leafY == column_.y && last.zEnd == begin) {
                last.zEnd = end;
                return;
            }
        }
        result_.inside.push_back({column_.x, column_.y, begin, end});
    }

    Side sideOf(int v, int column, const std::vector<LeafWinding>& windings) const
    {
        int total = total_[std::size_t(column)];
        if (windings.empty()) {
            const bool overlap = total > 0 && overlaps(column);
            return {total > 0, false, overlap, overlap ? kOverlapConfidence : 1.0f};
        }
        double sureness = 1.0;
        bool disagree = false;
        for (const LeafWinding& leaf : windings) {
            const SolidGroup& group = solids_.groups[leaf.group];
            const int count = counts_[std::size_t(column)].of(leaf.group);
            const double winding = std::abs(double(count) - double(leaf.value[std::size_t(v)]));
            const bool held = winding > 0.5;
            if (!group.capsAreWalls) total += group.weight * (int(held) - int(group.holds(count)));
            sureness = std::min(sureness, 2.0 * std::abs(winding - 0.5));
            // Caps taken for walls would say otherwise.
            disagree = disagree || held != group.holds(count);
        }
        return {total > 0, disagree || sureness < kUnsure, false, float(sureness)};
    }

    bool overlaps(int column) const
    {
        int sum = 0;
        for (const auto& [group, count] : counts_[std::size_t(column)].all()) sum += count;
        return (sum & 1) == 0;
    }

    void note(const Side& side, const Vec3d& place)
    {
        if (side.besideHole) result_.holes += Doubt{1, double(side.confidence), place};
        if (side.overlap) result_.overlaps += Doubt{1, double(side.confidence), place};
    }

    const SolidGroups& solids_;
    const std::vector<std::uint32_t>& open_;
    const LinearTransform& transform_;
    const LeafColumn& column_;
    const Crossing* next_;
    const Crossing* end_;
    ColumnResult& result_;
    bool started_ = false;
    int z_ = 0; // the first leaf not yet passed
    std::array<ColumnCounts, kColumns> counts_;
    std::array<int, kColumns> total_{};
};

} // namespace

Doubt& Doubt::operator+=(const Doubt& other)
{
    if (other.voxels > 0 && (voxels == 0 || other.confidence < confidence)) {
        confidence = other.confidence;
        place = other.place;
    }
    voxels += other.voxels;
    return *this;
}

ColumnSigns signByColumns(BandLeaves& leaves, const SolidGroups& solids, const std::vector<Crossing>& crossings,
                          const LinearTransform& transform, bool wantConfidence, const Progress& progress)
{
    ColumnSigns signs;
    std::vector<std::uint32_t> open;
    for (std::uint32_t g = 0; g < solids.groups.size(); ++g) {
        const SolidGroup& group = solids.groups[g];
        if (group.caps != nullptr && (wantConfidence || !group.capsAreWalls)) open.push_back(g);
    }
    const std::vector<LeafColumn> columns = leafColumns(leaves, crossings);
    ColumnResult result = reduceBlocks(columns.size(), kLeafColumnsPerTask, ColumnResult{}, [&](IndexRange range) {
        ColumnResult part;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            throwIfStopped(progress);
            ColumnWalk walk(solids, open, crossings, transform, columns[i], part);
            for (std::size_t leaf = columns[i].leaves.begin; leaf < columns[i].leaves.end; ++leaf) {
                walk.passGap(leaves[leaf]->leaf.z());
                walk.passLeaf(*leaves[leaf], wantConfidence);
            }
            walk.passRest();
        }
        return part;
    });
    signs.inside = std::move(result.inside);
    signs.split = std::move(result.split);
    signs.holes = result.holes;
    signs.overlaps = result.overlaps;
    return signs;
}

} // namespace vdbounce
