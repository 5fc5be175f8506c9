// SPDX-License-Identifier: Apache-2.0

// See field/vector_lookup.cpp: the tests compare all targets.
#define HWY_BROKEN_EMU128 0

// The rest of this file is compiled once for each target, which needs this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vdbounce/contact/free_flight.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "vdbounce/contact/free_flight.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace vdbounce {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using V = hn::Vec<Doubles>;
using M = hn::Mask<Doubles>;

// A vector of particles.
struct Flock {
    V x[3];
    V v[3];
    V clearance;
};

HWY_INLINE M stepOf(const FlightPlan& plan, double reach, const Flock& now, Flock& next)
{
    const Doubles d;
    const auto half = hn::Set(d, plan.halfStep);
    V move[3];
    for (int axis = 0; axis < 3; ++axis) {
        next.v[axis] = hn::Add(now.v[axis], hn::Set(d, plan.speedUp[axis]));
        next.x[axis] = hn::Add(now.x[axis], hn::Mul(half, hn::Add(now.v[axis], next.v[axis])));
        move[axis] = hn::Sub(next.x[axis], now.x[axis]);
    }
    const V square = hn::Add(hn::Add(hn::Mul(move[0], move[0]), hn::Mul(move[1], move[1])), hn::Mul(move[2], move[2]));
    const V size = hn::Max(hn::Max(hn::Abs(next.x[0]), hn::Abs(next.x[1])), hn::Abs(next.x[2]));
    const V spent =
        hn::Add(hn::Add(hn::Sqrt(square), hn::Set(d, reach)), hn::Mul(hn::Set(d, kClearanceRounding), size));
    next.clearance = hn::Sub(now.clearance, spent);
    return hn::Lt(hn::Add(spent, hn::Set(d, plan.range)), now.clearance);
}

HWY_INLINE void blend(M mask, const Flock& yes, Flock& flock)
{
    for (int axis = 0; axis < 3; ++axis) {
        flock.x[axis] = hn::IfThenElse(mask, yes.x[axis], flock.x[axis]);
        flock.v[axis] = hn::IfThenElse(mask, yes.v[axis], flock.v[axis]);
    }
    flock.clearance = hn::IfThenElse(mask, yes.clearance, flock.clearance);
}

// One that may touch something is put aside as it is; its lane flies on with all the clearance there is, to no
// purpose, but without a mask that the next step would have to wait for.
void flyWhole(const FlightPlan& plan, double* x, double* v, double* clearance, int* done)
{
    const Doubles d;
    const V endless = hn::Inf(d);
    Flock flock;
    hn::LoadInterleaved3(d, x, flock.x[0], flock.x[1], flock.x[2]);
    hn::LoadInterleaved3(d, v, flock.v[0], flock.v[1], flock.v[2]);
    flock.clearance = hn::LoadU(d, clearance);
    Flock aside = flock;
    M landed = hn::Lt(flock.clearance, hn::Zero(d));
    flock.clearance = hn::IfThenElse(landed, endless, flock.clearance);
    V count = hn::Zero(d);
    for (int step = 0; step < plan.steps; ++step) {
        Flock next;
        const M flies = stepOf(plan, plan.reach[step], flock, next);
        if (HWY_UNLIKELY(!hn::AllTrue(d, hn::Or(flies, landed)))) {
            const M lands = hn::AndNot(flies, hn::Not(landed));
            blend(lands, flock, aside);
            count = hn::IfThenElse(lands, hn::Set(d, double(step)), count);
            landed = hn::Or(landed, lands);
            if (hn::AllTrue(d, landed)) break;
            next.clearance = hn::IfThenElse(landed, endless, next.clearance);
        }
        flock = next;
    }
    count = hn::IfThenElse(landed, count, hn::Set(d, double(plan.steps)));
    blend(landed, aside, flock);
    hn::StoreInterleaved3(flock.x[0], flock.x[1], flock.x[2], d, x);
    hn::StoreInterleaved3(flock.v[0], flock.v[1], flock.v[2], d, v);
    hn::StoreU(flock.clearance, d, clearance);
    HWY_ALIGN double counts[8];
    hn::Store(count, d, counts);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) done[i] = int(counts[i]);
}

void flyAll(const FlightPlan& plan, double* x, double* v, double* clearance, std::size_t count, int* done)
{
    const std::size_t lanes = hn::Lanes(Doubles());
    const std::size_t whole = count - count % lanes;
    for (std::size_t i = 0; i < whole; i += lanes) flyWhole(plan, x + 3 * i, v + 3 * i, clearance + i, done + i);
}

std::size_t flockSize() { return hn::Lanes(Doubles()); }

} // namespace HWY_NAMESPACE
} // namespace vdbounce
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vdbounce {

HWY_EXPORT(flyAll);
HWY_EXPORT(flockSize);

void flyFreely(const FlightPlan& plan, Vec3d* positions, Vec3d* velocities, double* clearances, std::size_t count,
               int* done)
{
    static_assert(sizeof(Vec3d) == 3 * sizeof(double));
    if (count == 0) return;
    HWY_DYNAMIC_DISPATCH(flyAll)(plan, positions->data(), velocities->data(), clearances, count, done);
    // Those that do not fill a vector.
    for (std::size_t i = count - count % HWY_DYNAMIC_DISPATCH(flockSize)(); i < count; ++i) {
        done[i] = 0;
        while (done[i] < plan.steps && flyFreely(plan, plan.reach[done[i]], positions[i], velocities[i], clearances[i]))
            ++done[i];
    }
}

} // namespace vdbounce
#endif
