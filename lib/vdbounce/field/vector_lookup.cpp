// SPDX-License-Identifier: Apache-2.0
//
// Finds the cells of many points and interpolates there, a vector at a time.

// Highway would leave out its 128-bit emulation, for processors without SSSE3, with compilers before GCC 12.3, which
// compile its products of upper halves wrongly. None are used here, and the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/field/vector_lookup.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/field/vector_interpolation-inl.h"
#include "vdbounce/field/vector_lookup.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Ints = hn::Rebind<std::int32_t, Doubles>;
using Floats = hn::Rebind<float, Doubles>;

// The directory entries of voxels.
hn::Vec<Ints> entriesOf(const LeafBlocks::Directory& directory, const hn::Vec<Ints> (&voxel)[3])
{
    const Ints d;
    constexpr int kNodeBits = LeafBlocks::kNodeBits;
    const auto mask = hn::Set(d, (1 << kNodeBits) - 1);
    auto node = hn::Zero(d);
    auto leaf = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
        const auto leafAt = hn::ShiftRight<BlockLayout::kLeafBits>(voxel[axis]);
        const auto nodeAt = hn::Sub(hn::ShiftRight<kNodeBits>(leafAt), hn::Set(d, directory.nodeMin[axis]));
        node = hn::Add(hn::Mul(node, hn::Set(d, directory.nodeSize[axis])), nodeAt);
        leaf = hn::Or(hn::ShiftLeft<kNodeBits>(leaf), hn::And(leafAt, mask));
    }
    const auto number = hn::GatherIndex(d, directory.nodes, node);
    const auto isTile = hn::Lt(number, hn::Zero(d));
    const auto place = hn::Add(hn::ShiftLeft<3 * kNodeBits>(hn::IfThenZeroElse(isTile, number)), leaf);
    return hn::IfThenElse(isTile, number, hn::GatherIndex(d, directory.entries, place));
}

// Reads whole vectors, so `points` must go on to the end of the last one.
bool locateWhole(const VectorField& field, const double* points, int count, PointChunk& chunk)
{
    const Doubles d;
    const Ints di;
    const Floats df;
    const int lanes = int(hn::Lanes(d));
    chunk.outside = 0;
    // The nearest voxel instead of the one below.
    const auto rounding = hn::Set(d, field.lookup == Lookup::Nearest ? 0.5 : 0.0);
    auto anyTile = hn::Zero(di); // negative where any entry is
    for (int i = 0; i < count; i += lanes) {
        hn::Vec<Doubles> world[3];
        hn::LoadInterleaved3(d, points + 3 * i, world[0], world[1], world[2]);
        for (int axis = 0; axis < 3; ++axis) world[axis] = hn::Sub(world[axis], hn::Set(d, field.origin[axis]));
        hn::Vec<Doubles> index[3];
        auto inside = hn::FirstN(d, std::size_t(lanes));
        for (int axis = 0; axis < 3; ++axis) {
            const double* row = field.worldToIndex + 3 * axis;
            index[axis] = hn::Add(hn::Add(hn::Mul(hn::Set(d, row[0]), world[0]), hn::Mul(hn::Set(d, row[1]), world[1])),
                                  hn::Mul(hn::Set(d, row[2]), world[2]));
            inside = hn::And(inside, hn::And(hn::Ge(index[axis], hn::Set(d, field.boxMin[axis])),
                                             hn::Le(index[axis], hn::Set(d, field.boxMax[axis]))));
        }
        hn::Vec<Ints> voxel[3];
        for (int axis = 0; axis < 3; ++axis) {
            // Points outside are looked up at the box's corner instead, so that every address is a good one.
            const auto safe = hn::IfThenElse(inside, index[axis], hn::Set(d, field.boxMin[axis]));
            const auto floored = hn::Floor(hn::Add(safe, rounding));
            voxel[axis] = hn::DemoteTo(di, floored);
            hn::StoreU(hn::DemoteTo(df, hn::Sub(safe, floored)), df, chunk.at[axis] + i);
        }
        const auto mask = hn::Set(di, BlockLayout::kLeafSide - 1);
        const auto offset = hn::Add(hn::Add(hn::Mul(hn::And(voxel[0], mask), hn::Set(di, kStrideX)),
                                            hn::Mul(hn::And(voxel[1], mask), hn::Set(di, kStrideY))),
                                    hn::And(voxel[2], mask));
        hn::StoreU(offset, di, chunk.offset + i);
        const auto entries = entriesOf(field.directory, voxel);
        hn::StoreU(entries, di, chunk.entry + i);
        anyTile = hn::Or(anyTile, entries);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, inside, bits);
        const std::uint64_t outside = ~std::uint64_t(bits[0]) & ((std::uint64_t(1) << lanes) - 1);
        chunk.outside |= outside << i;
    }
    return chunk.outside == 0 && hn::AllFalse(di, hn::Lt(anyTile, hn::Zero(di)));
}

alignas(16) constexpr float kPhiOnly[4] = {1.0f, 0.0f, 0.0f, 0.0f};

bool locate(const VectorField& field, const Vec3d* points, int count, PointChunk& chunk)
{
    static_assert(sizeof(Vec3d) == 3 * sizeof(double));
    if (count % int(hn::MaxLanes(Doubles())) == 0) {
        return locateWhole(field, points->data(), count, chunk);
    }
    double padded[3 * kPointsPerChunk] = {};
    for (int i = 0; i < 3 * count; ++i) padded[i] = points->data()[i];
    return locateWhole(field, padded, count, chunk);
}

template <class Method, Storage storage>
void interpolateStored(const VectorField& field, const PointChunk& chunk, int count, PointSample* samples)
{
    using Type = typename Stored<storage>::Type;
    const Type* values = static_cast<const Type*>(field.values);
    for (int i = 0; i < count; i += kPointsPerVector) {
        Neighbourhoods<storage> near;
        float offset[4] = {};
        float step[4] = {};
        for (int k = 0; k < kPointsPerVector; ++k) {
            const int p = i + k < count ? i + k : i;
            const std::size_t block = std::size_t(chunk.entry[p]);
            near.from[k] = values + block * BlockLayout::kSize + chunk.offset[p];
            if constexpr (storage == Storage::Fixed8) {
                offset[k] = field.ranges[block].offset;
                step[k] = field.ranges[block].step;
            }
        }
        V sample = Method::interpolate(near, chunk.at[0] + i, chunk.at[1] + i, chunk.at[2] + i);
        if constexpr (storage == Storage::Fixed8) {
            sample = hn::Add(hn::Mul(sample, ofEachPoint(step)), hn::Mul(ofEachPoint(offset), everyPoint(kPhiOnly)));
        }
        hn::StoreU(toWorld(field, sample), Lanes(), &samples[i].phi);
    }
}

template <class Method>
void interpolateBy(const VectorField& field, const PointChunk& chunk, int count, PointSample* samples)
{
    switch (field.storage) {
    case Storage::Float: interpolateStored<Method, Storage::Float>(field, chunk, count, samples); break;
    case Storage::Half: interpolateStored<Method, Storage::Half>(field, chunk, count, samples); break;
    case Storage::Fixed8: interpolateStored<Method, Storage::Fixed8>(field, chunk, count, samples); break;
    }
}

void interpolateChunk(const VectorField& field, const PointChunk& chunk, int count, PointSample* samples)
{
    switch (field.lookup) {
    case Lookup::Nearest: interpolateBy<NearestCentral>(field, chunk, count, samples); break;
    case Lookup::Cubic: interpolateBy<CubicAnalytic>(field, chunk, count, samples); break;
    case Lookup::Trilinear:
        if (field.normal == Normal::Central) {
            interpolateBy<TrilinearCentral>(field, chunk, count, samples);
        } else {
            interpolateBy<TrilinearAnalytic>(field, chunk, count, samples);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(locate);
HWY_EXPORT(interpolateChunk);

bool locatePoints(const VectorField& field, const Vec3d* points, int count, PointChunk& chunk)
{
    return HWY_DYNAMIC_DISPATCH(locate)(field, points, count, chunk);
}

void interpolatePoints(const VectorField& field, const PointChunk& chunk, int count, PointSample* samples)
{
    HWY_DYNAMIC_DISPATCH(interpolateChunk)(field, chunk, count, samples);
}

std::vector<std::string> vectorTargets()
{
    // The last is the one that any processor can run.
    std::vector<std::string> names;
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.push_back(hwy::TargetName(target));
    if (names.empty() || names.back() != hwy::TargetName(HWY_STATIC_TARGET)) {
        names.push_back(hwy::TargetName(HWY_STATIC_TARGET));
    }
    return names;
}

void chooseVectorTarget(const std::string& name)
{
    std::int64_t chosen = name.empty() ? hwy::SupportedTargets() : HWY_STATIC_TARGET;
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name == hwy::TargetName(target)) chosen = target;
    }
    hwy::GetChosenTarget().Update(chosen);
}

} // namespace vdbounce
#endif
