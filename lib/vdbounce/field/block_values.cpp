// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/block_values.h"

#include <Imath/half.h>
#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr std::size_t kSize = BlockLayout::kSize;

// Half floats reach 65504. The largest value is scaled to just below 2^15, so that those 2^29 times smaller still
// have all of their 11 bits.
constexpr int kHalfExponent = 15;

constexpr float kLargestByte = 255.0f;

std::uint16_t toHalf(float value) { return Imath::half(value).bits(); }

float fromHalf(std::uint16_t bits)
{
    Imath::half half;
    half.setBits(bits);
    return half;
}

float fromByte(const BlockValues::Range& range, std::uint8_t byte) { return range.offset + range.step * float(byte); }

BlockValues::Range rangeOf(const float* values)
{
    const auto [smallest, largest] = std::minmax_element(values, values + kSize);
    return {*smallest, (*largest - *smallest) / kLargestByte};
}

} // namespace

void BlockValues::allocate(Storage storage, std::size_t blocks, float largest)
{
    storage_ = storage;
    blockCount_ = blocks;
    const std::size_t count = blocks * kSize;
    if (storage == Storage::Float) floats_.resize(count);
    if (storage == Storage::Half) {
        int exponent = 0;
        std::frexp(largest, &exponent); // largest < 2^exponent
        halfUnit_ = std::ldexp(1.0f, exponent - kHalfExponent);
        halves_.resize(count);
    }
    if (storage == Storage::Fixed8) {
        bytes_.resize(count);
        ranges_.resize(blocks);
    }
}

float BlockValues::encode(std::size_t block, const float* values)
{
    const std::size_t first = block * kSize;
    if (storage_ == Storage::Float) {
        std::copy_n(values, kSize, floats_.begin() + std::ptrdiff_t(first));
        return 0.0f;
    }
    if (storage_ == Storage::Fixed8) ranges_[block] = rangeOf(values);
    float error = 0.0f;
    for (std::size_t i = 0; i < kSize; ++i) {
        if (storage_ == Storage::Half) {
            halves_[first + i] = toHalf(values[i] / halfUnit_);
        } else {
            const Range& range = ranges_[block];
            const float steps = range.step > 0.0f ? std::round((values[i] - range.offset) / range.step) : 0.0f;
            bytes_[first + i] = static_cast<std::uint8_t>(std::clamp(steps, 0.0f, kLargestByte));
        }
        error = std::max(error, std::abs(at(block, int(i)) - values[i]));
    }
    return error;
}

float BlockValues::at(std::size_t block, int offset) const
{
    const std::size_t place = block * kSize + std::size_t(offset);
    if (storage_ == Storage::Float) return floats_[place];
    if (storage_ == Storage::Half) return fromHalf(halves_[place]) * halfUnit_;
    return fromByte(ranges_[block], bytes_[place]);
}

void BlockValues::decode(std::size_t block, float* values) const
{
    if (storage_ == Storage::Float) {
        std::copy_n(floats_.begin() + std::ptrdiff_t(block * kSize), kSize, values);
        return;
    }
    for (std::size_t i = 0; i < kSize; ++i) values[i] = at(block, int(i));
}

void BlockValues::decodeNeighbourhood(std::size_t block, int offset, float (&values)[64]) const
{
    float* value = values;
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 4; ++y) {
            const int row = offset + x * BlockLayout::kStrideX + y * BlockLayout::kStrideY;
            for (int z = 0; z < 4; ++z) *value++ = at(block, row + z);
        }
    }
}

std::size_t BlockValues::bytesPerBlock(Storage storage)
{
    switch (storage) {
    case Storage::Half: return kSize * sizeof(std::uint16_t);
    case Storage::Fixed8: return kSize + sizeof(Range);
    case Storage::Float: break;
    }
    return kSize * sizeof(float);
}

std::size_t BlockValues::memoryBytes() const { return blockCount_ * bytesPerBlock(storage_); }

} // namespace vdbounce
