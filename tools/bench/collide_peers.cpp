// SPDX-License-Identifier: Apache-2.0
#include "bench/collide_peers.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/io/openvdb_grid.h"

#include <memory>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <vector>

namespace vdbounce::bench {
namespace {

constexpr std::size_t kExampleBlock = 512; // particles a task, as in NanoVDB's example

// Particles that are moved in one block: with their velocities half of a first-level cache.
constexpr std::size_t kMovedBlock = 512;

using NanoVector = nanovdb::Vec3<float>;

NanoVector toNano(const Vec3d& v) { return NanoVector(float(v.x()), float(v.y()), float(v.z())); }

class NanoColumn {
public:
    NanoColumn(const LevelSetGrid& grid, const StepOptions& options, double top)
        : handle_(nanovdb::openToNanoVDB(toOpenVdb(grid))), dt_(float(options.dt)), gravity_(toNano(options.gravity)),
          top_(float(top))
    {
        const nanovdb::Map& map = handle_.grid<float>()->map();
        voxelsPerUnit_ = map.mInvMatF[0];
        origin_ = NanoVector(map.mVecF[0], map.mVecF[1], map.mVecF[2]);
    }

    void place(const Particles& start)
    {
        position_.resize(start.size());
        velocity_.resize(start.size());
        forEachIndex(start.size(), kExampleBlock, [&](std::size_t i) {
            position_[i] = toNano(start.position[i]);
            velocity_[i] = toNano(start.velocity[i]);
        });
    }

    void step()
    {
        forEachBlock(position_.size(), kExampleBlock, [&](std::size_t, IndexRange range) {
            const auto accessor = handle_.grid<float>()->getAccessor();
            for (std::size_t i = range.begin; i < range.end; ++i) stepOne(accessor, position_[i], velocity_[i]);
        });
    }

private:
    template <class Accessor> void stepOne(const Accessor& accessor, NanoVector& position, NanoVector& velocity) const
    {
        NanoVector nextPosition = position + velocity * dt_ + gravity_ * (dt_ * dt_);
        NanoVector nextVelocity = velocity + gravity_ * dt_;
        if (nextPosition[1] < 0.0f) {
            nextPosition[1] = top_;
            nextVelocity = NanoVector(0.0f);
        } else {
            const nanovdb::Coord voxel = ((nextPosition - origin_) * voxelsPerUnit_).floor();
            float value = 0.0f;
            // Both questions of the example in one way down the tree.
            if (accessor.probeValue(voxel, value) && value <= 0.0f) {
                const NanoVector normal = forwardDifferences(accessor, voxel, value).normalize();
                nextPosition += (nextPosition - position).normalize() * value;
                nextVelocity -= normal * (2.0f * nextVelocity.dot(normal));
            }
        }
        position = nextPosition;
        velocity = nextVelocity;
    }

    template <class Accessor>
    static NanoVector forwardDifferences(const Accessor& accessor, const nanovdb::Coord& voxel, float value)
    {
        return NanoVector(accessor.getValue(voxel.offsetBy(1, 0, 0)) - value,
                          accessor.getValue(voxel.offsetBy(0, 1, 0)) - value,
                          accessor.getValue(voxel.offsetBy(0, 0, 1)) - value);
    }

    nanovdb::GridHandle<> handle_;
    float dt_;
    NanoVector gravity_;
    float top_;
    // The map of a uniform grid, which spares the example more than a third of its time: worldToIndexF() calls fmaf()
    // six times out of line in code for any processor.
    float voxelsPerUnit_;
    NanoVector origin_;
    std::vector<NanoVector> position_;
    std::vector<NanoVector> velocity_;
};

// The same arrays that Particles has.
class MovedParticles {
public:
    explicit MovedParticles(const StepOptions& options) : halfDt_(0.5 * options.dt)
    {
        change_ << options.dt * options.gravity.array(), options.dt * options.gravity.array();
    }

    void place(const Particles& start)
    {
        position_ = start.position;
        velocity_ = start.velocity;
    }

    void sweep()
    {
        forEachBlock(position_.size(), kMovedBlock, [&](std::size_t, IndexRange range) { move(range); });
    }

    void sweepBlocks(int steps)
    {
        forEachBlock(position_.size(), kMovedBlock, [&](std::size_t, IndexRange range) {
            for (int s = 0; s < steps; ++s) move(range);
        });
    }

private:
    // Two particles at a time, whose six numbers fill whole vectors: twice as fast as one by one.
    void move(IndexRange range)
    {
        std::size_t i = range.begin;
        for (; i + 2 <= range.end; i += 2) moveNumbers<6>(i);
        if (i < range.end) moveNumbers<3>(i);
    }

    template <int Count> void moveNumbers(std::size_t particle)
    {
        using Numbers = Eigen::Array<double, Count, 1>;
        Eigen::Map<Numbers> position(position_[particle].data());
        Eigen::Map<Numbers> velocity(velocity_[particle].data());
        const Numbers before = velocity;
        const Numbers after = before + change_.head<Count>();
        velocity = after;
        position += halfDt_ * (before + after);
    }

    double halfDt_;
    Eigen::Array<double, 6, 1> change_; // of two particles
    std::vector<Vec3d> position_;
    std::vector<Vec3d> velocity_;
};

} // namespace

CollidePeer nanoCollision(const LevelSetGrid& grid, const StepOptions& options, double top)
{
    const auto column = std::make_shared<NanoColumn>(grid, options, top);
    return {"NanoVDB's collision example", [column](const Particles& start) { column->place(start); },
            [column](int steps) {
                for (int s = 0; s < steps; ++s) column->step();
            }};
}

CollidePeer gravityAndMove(const StepOptions& options)
{
    const auto moved = std::make_shared<MovedParticles>(options);
    return {"gravity and move, a sweep a step", [moved](const Particles& start) { moved->place(start); },
            [moved](int steps) {
                for (int s = 0; s < steps; ++s) moved->sweep();
            }};
}

CollidePeer gravityAndMoveInBlocks(const StepOptions& options)
{
    const auto moved = std::make_shared<MovedParticles>(options);
    return {"gravity and move, each block through all steps", [moved](const Particles& start) { moved->place(start); },
            [moved](int steps) { moved->sweepBlocks(steps); }};
}

} // namespace vdbounce::bench
