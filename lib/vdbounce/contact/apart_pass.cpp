// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/parallel.h"
#include "vdbounce/contact/clearance_batch.h"
#include "vdbounce/contact/free_flight.h"
#include "vdbounce/contact/particle_pass.h"
#include "vdbounce/contact/step_needs.h"

#include <algorithm>
#include <array>
#include <cmath>

/// @file
/// Steps of particles that do not see each other: a block of them goes through all steps before the next, while its
/// voxels are in the cache.

namespace vdbounce {
namespace {

// How many steps of its present length a particle should be spared the next lookup for.
constexpr double kStepsAhead = 8.0;

} // namespace

struct ParticlePass::Apart {
    std::vector<PlacedColliders> placed; // of each step; one where it makes no difference
    std::vector<double> reach;
    FlightPlan plan;
    bool batches; // lookups can be made many at once
    StepFunction takeStep;

    const PlacedColliders& placedIn(int step) const { return placed[placed.size() == 1 ? 0 : std::size_t(step)]; }
};

// One block on its way. In each round every particle that is not through takes a step that needs a lookup, all of them
// together, and flies on from there.
class ParticlePass::ApartBlock {
public:
    ApartBlock(ParticlePass& pass, const Apart& apart, IndexRange range, Progress& progress)
        : pass_(pass), apart_(apart), range_(range), progress_(progress), tally_(pass.colliders_->size()),
          batch_(*pass.colliders_)
    {
    }

    StepTally run()
    {
        flyAll();
        while (!active_.empty()) {
            throwIfStopped(progress_); // a call may have millions of steps
            if (apart_.batches) lookAhead();
            std::size_t kept = 0;
            for (std::size_t k = 0; k < active_.size(); ++k) {
                const std::size_t i = active_[k];
                int& step = done_[i - range_.begin];
                if (!apart_.batches || !takeFree(i, candidates_[k])) stepOne(i, step);
                ++step;
                flyOn(i, step);
                if (step < apart_.plan.steps && pass_.skipped_[i] == 0) active_[kept++] = active_[k];
            }
            active_.resize(kept);
        }
        return std::move(tally_);
    }

private:
    void flyAll()
    {
        const std::size_t begin = range_.begin;
        flyFreely(apart_.plan, &pass_.particles_.position[begin], &pass_.particles_.velocity[begin],
                  &pass_.clearance_[begin], range_.end - begin, done_.data());
        for (std::size_t i = begin; i < range_.end; ++i) {
            if (pass_.skipped_[i] != 0) continue;
            const int flown = done_[i - begin];
            tally_.free += static_cast<std::uint64_t>(flown);
            if (flown > 0) pass_.touching_[i] = 0;
            if (flown < apart_.plan.steps) active_.push_back(i);
        }
    }

    void flyOn(std::size_t i, int& step)
    {
        if (pass_.clearance_[i] <= 0.0) return;
        const int before = step;
        while (step < apart_.plan.steps &&
               flyFreely(apart_.plan, apart_.reach[std::size_t(step)], pass_.particles_.position[i],
                         pass_.particles_.velocity[i], pass_.clearance_[i]))
            ++step;
        tally_.free += static_cast<std::uint64_t>(step - before);
        if (step > before) pass_.touching_[i] = 0;
    }

    // Clearances where the next step would bring them.
    void lookAhead()
    {
        candidates_.resize(active_.size());
        for (std::size_t k = 0; k < active_.size(); ++k) {
            const std::size_t i = active_[k];
            Candidate& candidate = candidates_[k];
            const Vec3d& v = pass_.particles_.velocity[i];
            const Vec3d& x = pass_.particles_.position[i];
            candidate.position = x + apart_.plan.halfStep * (v + (v + apart_.plan.speedUp));
            // What touched something in the last step mostly does so in this one, and is looked up then.
            const bool stuck =
                !pass_.particles_.stuckTo.empty() && pass_.particles_.stuckTo[i] != MovingParticle::kNotStuck;
            candidate.asked = !stuck && pass_.inside_[i] == 0 && pass_.touching_[i] == 0;
            candidate.radius =
                pass_.particles_.radius.empty() ? pass_.options_.defaults.radius : pass_.particles_.radius[i];
            candidate.colliders = &apart_.placedIn(done_[i - range_.begin]);
            candidate.way = (candidate.position - x).norm() + candidate.colliders->reach();
            candidate.enough = kStepsAhead * candidate.way;
        }
        batch_.compute(candidates_);
    }

    // The step of a particle that touches nothing, as step() would take it.
    bool takeFree(std::size_t i, const Candidate& candidate)
    {
        const StepOptions& options = pass_.options_.step;
        if (!(candidate.clearance > 0.0) || !std::isfinite(candidate.way)) return false;
        if (sweepIsDue(options.sweep, candidate.way, pass_.clearance_[i] + candidate.clearance,
                       pass_.colliders_->wallLength()))
            return false;
        ++tally_.near;
        pass_.particles_.position[i] = candidate.position;
        pass_.particles_.velocity[i] += apart_.plan.speedUp;
        pass_.clearance_[i] = candidate.clearance;
        pass_.touching_[i] = 0;
        return true;
    }

    void stepOne(std::size_t i, int s)
    {
        MovingParticle particle = pass_.load(i);
        apart_.takeStep(particle, apart_.placedIn(s), pass_.options_.step, tally_);
        pass_.store(i, particle);
    }

    ParticlePass& pass_;
    const Apart& apart_;
    const IndexRange range_;
    Progress& progress_;
    StepTally tally_;
    std::array<int, kParticlesPerBlock> done_; // steps taken
    std::vector<std::size_t> active_;
    std::vector<Candidate> candidates_;
    ClearanceBatch batch_;
};

StepTally ParticlePass::advanceApart(int steps, Progress& progress)
{
    Apart apart;
    // What never moves is placed once, unless hits are to know which step they happened in.
    const bool once = colliders_->still() && !options_.hits;
    for (int s = 0; s < (once ? 1 : steps); ++s)
        apart.placed.push_back(placedAt(step_ + static_cast<std::uint64_t>(s), options_.step.dt));
    apart.reach.assign(static_cast<std::size_t>(steps), 0.0);
    for (int s = 0; s < steps; ++s) apart.reach[std::size_t(s)] = apart.placedIn(s).reach();
    apart.plan = flightPlan(options_.step);
    apart.plan.reach = apart.reach.data();
    apart.plan.steps = steps;
    // Repulsion acts before anything touches.
    apart.batches = ClearanceBatch::answers(*colliders_) && !(options_.step.repulsion.range > 0.0);

    const StepNeeds needs = needsOf(*colliders_, options_.step, options_.hits);
    apart.takeStep = stepOfVariant(options_.wholeStep ? kWholeStep : stepVariantFor(needs));

    ProgressCounter counter(progress, particles_.size());
    return reduceBlocks(particles_.size(), kParticlesPerBlock, StepTally(colliders_->size()), [&](IndexRange range) {
        throwIfStopped(progress);
        StepTally tally = ApartBlock(*this, apart, range, progress).run();
        counter.add(range.end - range.begin);
        return tally;
    });
}

} // namespace vdbounce
