// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/eikonal_residual.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace vdbounce {
namespace {

constexpr std::size_t kBlocksPerTask = 64;
constexpr int kSide = BlockLayout::kLeafSide;
constexpr int kStrides[3] = {BlockLayout::kStrideX, BlockLayout::kStrideY, 1};

// How much the slopes before and behind a voxel may differ for phi to count as smooth there. Around a ball of r voxels
// they differ by 1/r; what a crease adds below this changes a central difference by half of it, less than kOff.
constexpr float kCrease = 0.15f;

// No distance changes faster than this along any way, but for rounding, to half floats at worst. What does is a fault
// and no crease.
constexpr float kSteepest = 1.02f;

// Counts of residuals between 2^-20 and 2^4, eight bins for every power of two, so that a bin is the upper bits of a
// float.
class Histogram {
public:
    void add(float residual)
    {
        std::uint32_t bits;
        std::memcpy(&bits, &residual, sizeof bits);
        const int bin = int(bits >> kDropped) - kFirst;
        ++counts_[std::size_t(std::clamp(bin, 0, kBins - 1))];
    }

    Histogram& operator+=(const Histogram& other)
    {
        for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
        return *this;
    }

    // The middle of the bin that holds the middle one of all.
    double median(std::uint64_t count) const
    {
        int bin = 0;
        for (std::uint64_t below = counts_[0]; below * 2 < count; below += counts_[std::size_t(bin)]) ++bin;
        if (bin == 0) return 0.0;
        const std::uint32_t bits = std::uint32_t(bin + kFirst) << kDropped | 1u << (kDropped - 1);
        float value;
        std::memcpy(&value, &bits, sizeof value);
        return double(value);
    }

private:
    static constexpr int kDropped = 20;           // bits of a float below those that make a bin
    static constexpr int kFirst = (127 - 20) * 8; // 2^-20
    static constexpr int kBins = 24 * 8;

    std::array<std::uint64_t, kBins> counts_{};
};

struct Measured : EikonalResidual {
    Histogram histogram;
    double residualSum = 0.0;
    double slopeSum = 0.0;
    std::size_t block = 0; // of the largest
    int voxel = -1;

    Measured& operator+=(const Measured& other)
    {
        voxels += other.voxels;
        creaseVoxels += other.creaseVoxels;
        offVoxels += other.offVoxels;
        residualSum += other.residualSum;
        slopeSum += other.slopeSum;
        histogram += other.histogram;
        // The first of equals.
        if (other.voxel >= 0 && (voxel < 0 || other.largest > largest)) {
            largest = other.largest;
            block = other.block;
            voxel = other.voxel;
        }
        return *this;
    }
};

// A row of voxels: what central differences tell of each.
struct Row {
    float length[kSide]; // of the gradient, world space
    float bend[kSide];   // the largest of the three axes'; 0 where none bends as a crease does
    bool known[kSide];   // the voxel and its neighbours hold distances
};

class Residuals {
public:
    explicit Residuals(const DistanceField& field)
        : blocks_(field.blocks()), exterior_(float(field.background() - field.storageError())),
          interior_(float(field.interior() - field.storageError()))
    {
        for (int i = 0; i < 3; ++i) {
            perSide_[i] = float(1.0 / field.transform().voxelSize()[i]);
            for (int j = 0; j < 3; ++j) toWorld_[i][j] = float(field.transform().gradientToWorld()(i, j));
        }
    }

    void measure(std::size_t b, Measured& sum) const
    {
        float copy[BlockLayout::kSize];
        const float* values = copy;
        if (blocks_.values().storage() == Storage::Float) {
            values = blocks_.values().floats().data() + b * BlockLayout::kSize;
        } else {
            blocks_.values().decode(b, copy);
        }
        values += BlockLayout::kDiagonal;
        for (int x = 0; x < kSide; ++x) {
            for (int y = 0; y < kSide; ++y) {
                const float* v = values + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY;
                const Row row = rowAt(v);
                for (int z = 0; z < kSide; ++z) {
                    if (row.known[z]) add(row.length[z], row.bend[z], v + z, b, (x * kSide + y) * kSide + z, sum);
                }
            }
        }
    }

private:
    // By how much the slopes before and behind differ where both may be a distance's, else 0.
    static float bendOf(float before, float middle, float after, float perSide)
    {
        const float slopeBefore = (middle - before) * perSide;
        const float slopeAfter = (after - middle) * perSide;
        const float steeper = std::max(std::abs(slopeBefore), std::abs(slopeAfter));
        return steeper <= kSteepest ? std::abs(slopeAfter - slopeBefore) : 0.0f;
    }

    float lengthOf(float x, float y, float z) const
    {
        const float a = (toWorld_[0][0] * x + toWorld_[0][1] * y) + toWorld_[0][2] * z;
        const float b = (toWorld_[1][0] * x + toWorld_[1][1] * y) + toWorld_[1][2] * z;
        const float c = (toWorld_[2][0] * x + toWorld_[2][1] * y) + toWorld_[2][2] * z;
        return std::sqrt((a * a + b * b) + c * c);
    }

    // Plain loops over a row, which the compiler turns into vector code.
    Row rowAt(const float* v) const
    {
        Row row;
        float slope[3][kSide];
        float low[kSide];
        float high[kSide];
        for (int z = 0; z < kSide; ++z) {
            row.bend[z] = 0.0f;
            low[z] = high[z] = v[z];
        }
        for (int axis = 0; axis < 3; ++axis) {
            const float* before = v - kStrides[axis];
            const float* after = v + kStrides[axis];
            for (int z = 0; z < kSide; ++z) {
                slope[axis][z] = 0.5f * (after[z] - before[z]);
                row.bend[z] = std::max(row.bend[z], bendOf(before[z], v[z], after[z], perSide_[axis]));
                low[z] = std::min(low[z], std::min(before[z], after[z]));
                high[z] = std::max(high[z], std::max(before[z], after[z]));
            }
        }
        for (int z = 0; z < kSide; ++z) {
            row.length[z] = lengthOf(slope[0][z], slope[1][z], slope[2][z]);
            row.known[z] = low[z] > -interior_ && high[z] < exterior_;
        }
        return row;
    }

    // |grad phi| by whichever one-sided differences fit best, at a crease.
    float bestLength(const float* v, float central) const
    {
        float before[3];
        float after[3];
        for (int axis = 0; axis < 3; ++axis) {
            before[axis] = v[0] - v[-kStrides[axis]];
            after[axis] = v[kStrides[axis]] - v[0];
            if (bendOf(v[-kStrides[axis]], v[0], v[kStrides[axis]], perSide_[axis]) <= kCrease)
                before[axis] = after[axis] = 0.5f * (before[axis] + after[axis]);
        }
        float best = central;
        for (int sides = 0; sides < 8; ++sides) {
            const float length =
                lengthOf((sides & 1) != 0 ? after[0] : before[0], (sides & 2) != 0 ? after[1] : before[1],
                         (sides & 4) != 0 ? after[2] : before[2]);
            if (std::abs(length - 1.0f) < std::abs(best - 1.0f)) best = length;
        }
        return best;
    }

    void add(float length, float bend, const float* v, std::size_t block, int voxel, Measured& sum) const
    {
        if (bend > kCrease) {
            length = bestLength(v, length);
            ++sum.creaseVoxels;
        }
        const float residual = std::abs(length - 1.0f);
        ++sum.voxels;
        sum.slopeSum += double(length);
        sum.residualSum += double(residual);
        sum.histogram.add(residual);
        if (residual > float(EikonalResidual::kOff)) ++sum.offVoxels;
        if (sum.voxel < 0 || double(residual) > sum.largest) {
            sum.largest = double(residual);
            sum.block = block;
            sum.voxel = voxel;
        }
    }

    const LeafBlocks& blocks_;
    const float exterior_;
    const float interior_;
    float perSide_[3];
    float toWorld_[3][3];
};

} // namespace

EikonalResidual eikonalResidual(const DistanceField& field)
{
    const Residuals residuals(field);
    Measured sum = reduceBlocks(field.blocks().blockCount(), kBlocksPerTask, Measured{}, [&](IndexRange range) {
        Measured part;
        for (std::size_t b = range.begin; b < range.end; ++b) residuals.measure(b, part);
        return part;
    });
    if (sum.voxels == 0) return sum;
    sum.mean = sum.residualSum / double(sum.voxels);
    sum.slope = sum.slopeSum / double(sum.voxels);
    sum.median = sum.histogram.median(sum.voxels);
    const Vec3i inBlock(sum.voxel / (kSide * kSide), sum.voxel / kSide % kSide, sum.voxel % kSide);
    sum.where = field.transform().toWorld((field.blocks().origins()[sum.block] + inBlock).cast<double>());
    return sum;
}

} // namespace vdbounce
