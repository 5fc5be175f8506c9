// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/hole_winding.h"

#include <cmath>

namespace vdbounce {
namespace {

// Caps that cannot take more than this off a whole winding number leave no doubt.
constexpr double kCertain = 0.25;

class LeafFiller {
public:
    LeafFiller(const HoleCaps& caps, const LinearTransform& transform, const Vec3i& leaf, LeafWinding& winding)
        : caps_(caps), transform_(transform), origin_(leaf * BandLeaf::kSide), winding_(winding)
    {
    }

    HoleCaps::Range rangeOf(const Vec3i& low, int side) const
    {
        const double half = 0.5 * (side - 1);
        const Vec3d centre = transform_.toWorld((origin_ + low).cast<double>() + Vec3d::Constant(half));
        return caps_.around(centre, half * transform_.voxelDiagonal());
    }

    void fill(const Vec3i& low, int side, const HoleCaps::Range& range)
    {
        const double fromHalf = std::abs(range.middle - std::floor(range.middle) - 0.5);
        if (side == 1 || fromHalf > range.uncertainty) return set(low, side, float(range.middle));
        const int half = side / 2;
        for (int child = 0; child < 8; ++child) {
            const Vec3i part = low + half * Vec3i(child >> 2, child >> 1 & 1, child & 1);
            fill(part, half, rangeOf(part, half));
        }
    }

private:
    void set(const Vec3i& low, int side, float value)
    {
        for (int x = low.x(); x < low.x() + side; ++x) {
            for (int y = low.y(); y < low.y() + side; ++y) {
                for (int z = low.z(); z < low.z() + side; ++z) winding_.value[std::size_t(64 * x + 8 * y + z)] = value;
            }
        }
    }

    const HoleCaps& caps_;
    const LinearTransform& transform_;
    const Vec3i origin_;
    LeafWinding& winding_;
};

} // namespace

std::vector<LeafWinding> doubtfulWindings(const SolidGroups& solids, const std::vector<std::uint32_t>& open,
                                          const LinearTransform& transform, const Vec3i& leaf)
{
    std::vector<LeafWinding> windings;
    for (std::uint32_t g : open) {
        windings.emplace_back();
        windings.back().group = g;
        LeafFiller filler(*solids.groups[g].caps, transform, leaf, windings.back());
        const HoleCaps::Range range = filler.rangeOf(Vec3i::Zero(), BandLeaf::kSide);
        if (std::abs(range.middle) + range.uncertainty < kCertain) {
            windings.pop_back();
        } else {
            filler.fill(Vec3i::Zero(), BandLeaf::kSide, range);
        }
    }
    return windings;
}

} // namespace vdbounce
