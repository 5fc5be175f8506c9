// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/leaf_blocks.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>

namespace vdbounce {
namespace {

// Entries of the dense index over nodes at most: 4 MiB, enough for a grid of 12,000 voxels a side.
constexpr std::int64_t kLargestDenseIndex = std::int64_t(1) << 20;

constexpr int kLeafBits = BlockLayout::kLeafBits;
constexpr int kLeafSide = BlockLayout::kLeafSide;

std::int32_t tileCode(std::size_t tile) { return ~static_cast<std::int32_t>(tile); }

Vec3i shifted(const Vec3i& v, int bits) { return Vec3i(v.x() >> bits, v.y() >> bits, v.z() >> bits); }

std::size_t flatIndex(const Vec3i& at, const Vec3i& size)
{
    const auto u = [](int i) { return static_cast<std::size_t>(i); };
    return (u(at.x()) * u(size.y()) + u(at.y())) * u(size.z()) + u(at.z());
}

std::size_t entryInNode(const Vec3i& leaf, int side)
{
    const int mask = side - 1;
    return flatIndex(Vec3i(leaf.x() & mask, leaf.y() & mask, leaf.z() & mask), Vec3i::Constant(side));
}

template <class Body> void forEachIn(const Vec3i& from, const Vec3i& to, const Body& body)
{
    for (int x = from.x(); x <= to.x(); ++x) {
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int z = from.z(); z <= to.z(); ++z) body(Vec3i(x, y, z));
        }
    }
}

} // namespace

std::size_t LeafBlocks::NodePlaceHash::operator()(const NodePlace& place) const
{
    // Large odd factors spread neighbouring nodes over the table.
    std::uint64_t hash = static_cast<std::uint32_t>(place.at.x()) * 0x9e3779b97f4a7c15ULL;
    hash ^= static_cast<std::uint32_t>(place.at.y()) * 0xc2b2ae3d27d4eb4fULL;
    hash ^= static_cast<std::uint32_t>(place.at.z()) * 0x165667b19e3779f9ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
}

LeafBlocks::LeafBlocks(float background) : tileValues_{background} {}

std::int32_t LeafBlocks::nodeAt(const Vec3i& node) const
{
    if (!denseNodes_.empty()) {
        const Vec3i at = node - denseMin_;
        const bool inside = (at.array() >= 0).all() && (at.array() < denseSize_.array()).all();
        return inside ? denseNodes_[flatIndex(at, denseSize_)] : tileCode(0);
    }
    const auto found = sparseNodes_.find({node});
    return found != sparseNodes_.end() ? found->second : tileCode(0);
}

std::int32_t LeafBlocks::codeAt(const Vec3i& voxel) const
{
    const Vec3i leaf = shifted(voxel, kLeafBits);
    const std::int32_t node = nodeAt(shifted(leaf, kNodeBits));
    return node >= 0 ? nodes_[static_cast<std::size_t>(node)].code[entryInNode(leaf, kNodeSide)] : node;
}

float LeafBlocks::valueAt(const Vec3i& voxel) const
{
    const Entry entry = entryAt(voxel);
    if (!entry.isBlock()) return tileValue(entry);
    return values_.at(entry.block(), BlockLayout::neighbourhoodOf(voxel) + BlockLayout::kDiagonal);
}

bool LeafBlocks::anyBelow(const Vec3i& min, const Vec3i& max, float limit) const
{
    const Vec3i low = shifted(min, kLeafBits);
    const Vec3i high = shifted(max, kLeafBits);
    const auto tileIsBelow = [&](std::int32_t code) { return tileValue(Entry(code)) < limit; };
    bool found = tileValues_[0] < limit;
    for (const auto& [place, number] : sparseNodes_) {
        const Vec3i first = (place.at * kNodeSide).cwiseMax(low);
        const Vec3i last = (place.at * kNodeSide + Vec3i::Constant(kNodeSide - 1)).cwiseMin(high);
        if (found || (first.array() > last.array()).any()) continue;
        if (number < 0) {
            found = tileIsBelow(number);
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(number)];
        forEachIn(first, last, [&](const Vec3i& leaf) {
            const std::int32_t code = node.code[entryInNode(leaf, kNodeSide)];
            if (code < 0) {
                found = found || tileIsBelow(code);
                return;
            }
            const Vec3i origin = leaf * kLeafSide;
            forEachIn(origin.cwiseMax(min), (origin + Vec3i::Constant(kLeafSide - 1)).cwiseMin(max),
                      [&](const Vec3i& voxel) { found = found || valueAt(voxel) < limit; });
        });
    }
    return found;
}

LeafBlocks::Node& LeafBlocks::touchNode(const Vec3i& node)
{
    std::int32_t& number = sparseNodes_.try_emplace({node}, tileCode(0)).first->second;
    if (number < 0) {
        const std::int32_t filledWith = number;
        number = static_cast<std::int32_t>(nodes_.size());
        nodes_.emplace_back();
        std::fill_n(nodes_.back().code, kNodeEntries, filledWith);
    }
    return nodes_[static_cast<std::size_t>(number)];
}

std::int32_t& LeafBlocks::touchCode(const Vec3i& leaf)
{
    return touchNode(shifted(leaf, kNodeBits)).code[entryInNode(leaf, kNodeSide)];
}

std::int32_t LeafBlocks::tileCodeFor(float value)
{
    const auto found = std::find(tileValues_.begin(), tileValues_.end(), value);
    const auto tile = static_cast<std::size_t>(found - tileValues_.begin());
    if (found == tileValues_.end()) tileValues_.push_back(value);
    return tileCode(tile);
}

std::size_t LeafBlocks::addLeaf(const Vec3i& origin)
{
    const std::size_t number = origins_.size();
    touchCode(shifted(origin, kLeafBits)) = static_cast<std::int32_t>(number);
    origins_.push_back(origin);
    return number;
}

void LeafBlocks::setTiles(const Vec3i& min, const Vec3i& max, float value)
{
    const std::int32_t code = tileCodeFor(value);
    const Vec3i low = shifted(min, kLeafBits);
    const Vec3i high = shifted(max, kLeafBits);
    forEachIn(shifted(low, kNodeBits), shifted(high, kNodeBits), [&](const Vec3i& place) {
        const Vec3i first = place * kNodeSide;
        const Vec3i last = first + Vec3i::Constant(kNodeSide - 1);
        const bool whole = (first.array() >= low.array()).all() && (last.array() <= high.array()).all();
        std::int32_t& number = sparseNodes_.try_emplace({place}, tileCode(0)).first->second;
        if (whole && number < 0) {
            number = code;
            return;
        }
        Node& node = touchNode(place);
        forEachIn(first.cwiseMax(low), last.cwiseMin(high), [&](const Vec3i& leaf) {
            std::int32_t& present = node.code[entryInNode(leaf, kNodeSide)];
            if (present < 0) present = code;
        });
    });
}

std::vector<Vec3i> LeafBlocks::link()
{
    touchNodesThatMeetOthers();
    indexNodesDensely();
    std::vector<Vec3i> places(nodes_.size());
    for (const auto& [place, number] : sparseNodes_) {
        if (number >= 0) places[static_cast<std::size_t>(number)] = place.at;
    }
    std::vector<std::vector<Vec3i>> found(nodes_.size());
    forEachIndex(nodes_.size(), 1, [&](std::size_t n) { found[n] = tilesNextToOthers(places[n]); });
    std::vector<Vec3i> tiles;
    for (const auto& part : found) tiles.insert(tiles.end(), part.begin(), part.end());
    return tiles;
}

// A node filled by one tile, beside a node that holds something else along their border, needs entries of its own,
// some of which may become blocks.
void LeafBlocks::touchNodesThatMeetOthers()
{
    std::vector<Vec3i> work;
    for (const auto& [place, number] : sparseNodes_) work.push_back(place.at);
    while (!work.empty()) {
        const Vec3i place = work.back();
        work.pop_back();
        forEachIn(Vec3i::Constant(-1), Vec3i::Ones(), [&](const Vec3i& side) {
            const std::int32_t neighbour = nodeAt(place + side);
            if (neighbour >= 0 || borderIs(place, side, neighbour)) return;
            touchNode(place + side);
            work.push_back(place + side);
        });
    }
}

// True when every entry of the node at `place` along the border that faces `side` has this code.
bool LeafBlocks::borderIs(const Vec3i& place, const Vec3i& side, std::int32_t code) const
{
    const std::int32_t number = nodeAt(place);
    if (number < 0) return number == code;
    const Node& node = nodes_[static_cast<std::size_t>(number)];
    const int last = kNodeSide - 1;
    const Vec3i from = side.unaryExpr([&](int s) { return s > 0 ? last : 0; });
    const Vec3i to = side.unaryExpr([&](int s) { return s < 0 ? 0 : last; });
    bool same = true;
    forEachIn(from, to, [&](const Vec3i& leaf) { same = same && node.code[entryInNode(leaf, kNodeSide)] == code; });
    return same;
}

// The tiles of a node for which any of the 26 leaves around is a block or a tile of another value.
std::vector<Vec3i> LeafBlocks::tilesNextToOthers(const Vec3i& place) const
{
    constexpr int kSide = kNodeSide + 2;
    const Vec3i size = Vec3i::Constant(kSide);
    const Vec3i first = place * kNodeSide;
    std::vector<std::int32_t> window(static_cast<std::size_t>(kSide) * kSide * kSide);
    forEachIn(Vec3i::Zero(), Vec3i::Constant(kSide - 1), [&](const Vec3i& at) {
        const Vec3i leaf = first + at - Vec3i::Ones();
        window[flatIndex(at, size)] = codeAt(leaf * kLeafSide);
    });

    std::vector<Vec3i> tiles;
    forEachIn(Vec3i::Zero(), Vec3i::Constant(kNodeSide - 1), [&](const Vec3i& at) {
        const std::int32_t code = window[flatIndex(at + Vec3i::Ones(), size)];
        if (code >= 0) return;
        for (int n = 0; n < 27; ++n) {
            if (window[flatIndex(at + Vec3i(n / 9, n / 3 % 3, n % 3), size)] == code) continue;
            tiles.push_back((first + at) * kLeafSide);
            return;
        }
    });
    return tiles;
}

void LeafBlocks::indexNodesDensely()
{
    if (sparseNodes_.empty()) return;
    Vec3i low = sparseNodes_.begin()->first.at;
    Vec3i high = low;
    for (const auto& [place, number] : sparseNodes_) {
        low = low.cwiseMin(place.at);
        high = high.cwiseMax(place.at);
    }
    const Eigen::Matrix<std::int64_t, 3, 1> size = (high - low + Vec3i::Ones()).cast<std::int64_t>();
    if (size.x() * size.y() > kLargestDenseIndex || size.prod() > kLargestDenseIndex) return;
    denseMin_ = low;
    denseSize_ = high - low + Vec3i::Ones();
    denseNodes_.assign(static_cast<std::size_t>(size.prod()), tileCode(0));
    for (const auto& [place, number] : sparseNodes_) denseNodes_[flatIndex(place.at - denseMin_, denseSize_)] = number;
}

LeafBlocks::Directory LeafBlocks::directory() const
{
    // Vector code counts entries in 32 bits.
    const bool countable = nodes_.size() < (std::size_t(1) << 31) / kNodeEntries;
    return {denseNodes_.empty() || !countable ? nullptr : denseNodes_.data(), denseMin_, denseSize_,
            nodes_.empty() ? nullptr : nodes_.front().code, tileValues_.data()};
}

std::size_t LeafBlocks::memoryBytes() const
{
    const std::size_t sparse = sparseNodes_.size() * (sizeof(NodePlace) + sizeof(std::int32_t) + 2 * sizeof(void*));
    return values_.memoryBytes() + nodes_.size() * sizeof(Node) + denseNodes_.size() * sizeof(std::int32_t) + sparse +
           origins_.size() * sizeof(Vec3i);
}

} // namespace vdbounce
