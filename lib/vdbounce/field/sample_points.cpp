// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/sample_points.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/block_order.h"
#include "vdbounce/field/vector_lookup.h"

#include <algorithm>

namespace vdbounce {
namespace {

// Points a task: a tenth of a millisecond of work.
constexpr std::size_t kPointsPerTask = 4096;

PointSample sampleOne(const DistanceField& field, const Vec3d& point)
{
    const FieldSample sample = field.sample(point);
    const Eigen::Vector3f gradient = sample.gradient.cast<float>();
    return {float(sample.phi), {gradient.x(), gradient.y(), gradient.z()}};
}

bool vectorCodeAnswers(const DistanceField& field)
{
    const FieldOptions& options = field.options();
    const bool written = options.lookup == Lookup::Trilinear ||
                         (options.lookup == Lookup::Nearest && options.normal == Normal::Central) ||
                         (options.lookup == Lookup::Cubic && options.normal == Normal::Analytic);
    const LeafBlocks::Directory directory = field.blocks().directory();
    return written && !field.empty() && directory.nodes != nullptr && directory.entries != nullptr;
}

// Answers those points of a chunk that are not in blocks, and moves the others to its front. Returns how many those
// are; `which` tells their numbers.
int sortOut(const DistanceField& field, const VectorField& vectorField, const Vec3d* points, int count,
            PointChunk& chunk, std::uint8_t (&which)[kPointsPerChunk], PointSample* samples)
{
    int inBlocks = 0;
    for (int i = 0; i < count; ++i) {
        if ((chunk.outside >> i & 1) != 0) {
            samples[i] = sampleOne(field, points[i]);
        } else if (chunk.entry[i] < 0) {
            samples[i] = {vectorField.directory.tileValues[~chunk.entry[i]], {0.0f, 0.0f, 0.0f}};
        } else {
            const int to = inBlocks++;
            which[to] = std::uint8_t(i);
            for (auto& axis : chunk.at) axis[to] = axis[i];
            chunk.entry[to] = chunk.entry[i];
            chunk.offset[to] = chunk.offset[i];
        }
    }
    return inBlocks;
}

void sampleChunk(const DistanceField& field, const VectorField& vectorField, const Vec3d* points, int count,
                 PointSample* samples)
{
    PointChunk chunk;
    const bool allInBlocks = locatePoints(vectorField, points, count, chunk);
    if (allInBlocks && count == kPointsPerChunk) {
        interpolatePoints(vectorField, chunk, count, samples);
        return;
    }
    std::uint8_t which[kPointsPerChunk];
    PointSample results[kPointsPerChunk];
    const int inBlocks = sortOut(field, vectorField, points, count, chunk, which, samples);
    interpolatePoints(vectorField, chunk, inBlocks, results);
    for (int i = 0; i < inBlocks; ++i) samples[which[i]] = results[i];
}

void sampleInGivenOrder(const DistanceField& field, const VectorField& vectorField, const Vec3d* points,
                        std::size_t count, PointSample* samples)
{
    forEachBlock(count, kPointsPerTask, [&](std::size_t, IndexRange range) {
        for (std::size_t begin = range.begin; begin < range.end; begin += kPointsPerChunk) {
            const int size = int(std::min(range.end - begin, std::size_t(kPointsPerChunk)));
            sampleChunk(field, vectorField, points + begin, size, samples + begin);
        }
    });
}

void sampleInBlockOrder(const DistanceField& field, const VectorField& vectorField, const Vec3d* points,
                        std::size_t count, PointSample* samples)
{
    BlockOrder blockOrder;
    for (std::size_t first = 0; first < count; first += BlockOrder::kMostPoints) {
        const std::size_t together = std::min(count - first, BlockOrder::kMostPoints);
        const Vec3d* from = points + first;
        PointSample* to = samples + first;
        const auto& order = blockOrder.order(vectorField, field.blocks().blockCount(), from, together);
        forEachBlock(together, kPointsPerTask, [&](std::size_t, IndexRange range) {
            for (std::size_t begin = range.begin; begin < range.end; begin += kPointsPerChunk) {
                const int size = int(std::min(range.end - begin, std::size_t(kPointsPerChunk)));
                const std::uint32_t* numbers = order.data() + begin;
                Vec3d chunk[kPointsPerChunk];
                PointSample results[kPointsPerChunk];
                for (int i = 0; i < size; ++i) chunk[i] = from[numbers[i]];
                // The next chunk's points, and the places of its results, come while this one is computed.
                const std::size_t next = std::min(begin + 2 * kPointsPerChunk, range.end);
                for (std::size_t i = begin + std::size_t(size); i < next; ++i) {
                    __builtin_prefetch(from + order[i]);
                    __builtin_prefetch(to + order[i], 1);
                }
                sampleChunk(field, vectorField, chunk, size, results);
                for (int i = 0; i < size; ++i) to[numbers[i]] = results[i];
            }
        });
    }
}

} // namespace

void samplePoints(const DistanceField& field, const Vec3d* points, std::size_t count, PointSample* samples)
{
    samplePoints(field, points, count, samples, field.options().normal);
}

void samplePoints(const DistanceField& field, const Vec3d* points, std::size_t count, PointSample* samples,
                  Normal normal)
{
    if (!vectorCodeAnswers(field)) {
        forEachIndex(count, kPointsPerTask, [&](std::size_t i) { samples[i] = sampleOne(field, points[i]); });
        return;
    }
    VectorField vectorField(field);
    if (vectorField.lookup == Lookup::Trilinear) vectorField.normal = normal;
    if (BlockOrder::pays(vectorField, field.blocks().blockCount(), points, count)) {
        sampleInBlockOrder(field, vectorField, points, count, samples);
    } else {
        sampleInGivenOrder(field, vectorField, points, count, samples);
    }
}

} // namespace vdbounce
