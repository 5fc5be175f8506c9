// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_leaf.h"

#include <cstdint>
#include <cstring>

namespace vdbounce {
namespace {

using Word = openvdb::Index64;
constexpr int kWords = int(CsgLeaf::NodeMaskType::WORD_COUNT);
constexpr int kWordVoxels = 64;
constexpr int kVoxels = kWords * kWordVoxels;
static_assert(kVoxels == int(CsgLeaf::SIZE));

// Of kVoxels values. Without a way out in the middle, so that many are compared at once.
bool allWithin(const float* values, float least, float greatest)
{
    std::int32_t beyond = 0;
    for (int i = 0; i < kVoxels; ++i) beyond |= std::int32_t(values[i] < least) | std::int32_t(values[i] > greatest);
    return beyond == 0;
}

std::unique_ptr<CsgLeaf> emptyLeaf(const openvdb::Coord& origin)
{
    return std::make_unique<CsgLeaf>(openvdb::PartialCreate(), origin, 0.0f); // voxels come with buffer().data()
}

// 64 bytes that are 0 or 1 as bits, the first the lowest.
Word packed(const std::uint8_t (&flags)[kWordVoxels])
{
    Word bits = 0;
    for (int i = 0; i < 8; ++i) {
        std::uint64_t eight;
        std::memcpy(&eight, flags + 8 * i, sizeof(eight));
        // Each byte is added to the highest byte at its own place.
        bits |= ((eight * 0x0102040810204080ull) >> 56) << (8 * i);
    }
    return bits;
}

// One of two operands in a word's voxels.
struct Row {
    const float* values;
    Word active;
};

// Combines 64 voxels into `out` and returns which are active. `Blended` keeps the smooth minimum's division out of
// the other's loop.
template <bool Blended> Word combineRow(const CsgRule& rule, const Row& a, const Row& b, float* out)
{
    std::uint8_t fromA[kWordVoxels];
    std::uint8_t fromB[kWordVoxels];
    std::uint8_t within[kWordVoxels];
    for (int i = 0; i < kWordVoxels; ++i) {
        const float x = rule.signA * a.values[i];
        const float y = rule.signB * b.values[i];
        const float least = Blended ? rule.minimum(x, y) : std::min(x, y);
        const float kept = rule.clamped(least);
        out[i] = rule.signOut * kept;
        fromA[i] = x <= y;
        fromB[i] = y <= x;
        within[i] = kept == least;
    }
    return ((packed(fromA) & a.active) | (packed(fromB) & b.active)) & packed(within);
}

CsgMade<CsgLeaf> tileIfUniform(std::unique_ptr<CsgLeaf> leaf)
{
    const float* values = leaf->buffer().data();
    if (leaf->getValueMask().isOff() && allWithin(values, values[0], values[0])) return {nullptr, values[0], false};
    return {std::move(leaf), 0.0f, false};
}

CsgMade<CsgLeaf> combineVoxels(const CsgRule& rule, const CsgPiece<CsgLeaf>& a, const CsgPiece<CsgLeaf>& b,
                               const openvdb::Coord& origin)
{
    float tile[kWordVoxels];
    std::fill_n(tile, kWordVoxels, a.node == nullptr ? a.value : b.value);
    const auto row = [&](const CsgPiece<CsgLeaf>& piece, int word) {
        if (piece.node == nullptr) return Row{tile, piece.active ? ~Word(0) : Word(0)};
        return Row{piece.node->buffer().data() + word * kWordVoxels,
                   piece.node->getValueMask().template getWord<Word>(openvdb::Index(word))};
    };
    auto leaf = emptyLeaf(origin);
    float* out = leaf->buffer().data();
    for (int word = 0; word < kWords; ++word) {
        const Row rowA = row(a, word);
        const Row rowB = row(b, word);
        float* target = out + word * kWordVoxels;
        leaf->getValueMask().template getWord<Word>(openvdb::Index(word)) =
            rule.blend > 0.0f ? combineRow<true>(rule, rowA, rowB, target)
                              : combineRow<false>(rule, rowA, rowB, target);
    }
    return tileIfUniform(std::move(leaf));
}

// The leaf times `sign`, where all of it is within the band; else nothing. Looks at the copy, which is at hand, while
// the source's values come from memory.
std::unique_ptr<CsgLeaf> copyWithin(const CsgBand& band, const CsgLeaf& source, float sign)
{
    auto leaf = emptyLeaf(source.origin());
    float* out = leaf->buffer().data();
    std::copy_n(source.buffer().data(), kVoxels, out);
    if (sign < 0.0f) {
        for (int i = 0; i < kVoxels; ++i) out[i] = -out[i];
    }
    if (!allWithin(out, -band.interior, band.exterior)) return nullptr;
    leaf->setValueMask(source.getValueMask());
    return leaf;
}

} // namespace

CsgMade<CsgLeaf> combineLeaves(const CsgRule& rule, const CsgPiece<CsgLeaf>& a, const CsgPiece<CsgLeaf>& b,
                               const openvdb::Coord& origin)
{
    // Most leaves meet a tile that leaves them as they are.
    const bool onlyA = b.node == nullptr && !b.active && rule.signB * b.value >= rule.high;
    const bool onlyB = a.node == nullptr && !a.active && rule.signA * a.value >= rule.high;
    if (onlyA || onlyB) {
        const CsgLeaf& source = onlyA ? *a.node : *b.node;
        const float sign = rule.signOut * (onlyA ? rule.signA : rule.signB);
        if (auto copy = copyWithin(rule.band(), source, sign)) return {std::move(copy), 0.0f, false};
    }
    return combineVoxels(rule, a, b, origin);
}

} // namespace vdbounce
