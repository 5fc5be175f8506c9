// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/particle_contact.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/contact/cell_list.h"
#include "vdbounce/contact/response.h"

#include <algorithm>

namespace vdbounce {
namespace {

constexpr std::size_t kParticlesPerBlock = 4096;
constexpr std::size_t kCellsPerBlock = 256;

// Rounds of collisions a step: a chain of contacts passes an impulse on against the order of its pairs by one particle
// a round.
constexpr int kCollisionRounds = 3;

// How far apart, as a share of the way between their centres, particles still count as touching: once moved apart they
// would else go on approaching each other.
constexpr double kTouchMargin = 1e-3;

// The share of their overlap that particles are moved apart in a step.
constexpr double kSeparation = 0.2;

struct Largest {
    double radius = 0.0;
    double speed = 0.0;
    Largest& operator+=(const Largest& other)
    {
        radius = std::max(radius, other.radius);
        speed = std::max(speed, other.speed);
        return *this;
    }
};

} // namespace

ParticleContact::ParticleContact(const Spheres& spheres, const std::vector<Vec3d>& positions,
                                 const std::vector<Vec3d>& velocities, double dt, const InteractOptions& options)
    : spheres_(spheres), options_(options)
{
    const Largest largest = reduceBlocks(positions.size(), kParticlesPerBlock, Largest{}, [&](IndexRange range) {
        Largest part;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            if (spheres.skipped[i] == 0) part += {spheres.radius[i], velocities[i].norm()};
        }
        return part;
    });
    if (!(largest.radius > 0.0)) return;
    // Both of a pair may come nearer by what they move, which is looked after up to a radius.
    const double nearing = 2.0 * (std::min(largest.radius, largest.speed * dt) + kTouchMargin * largest.radius);
    const CellList cells(positions, spheres.skipped, 2.0 * largest.radius + nearing);
    const auto forEachPartner = [&](std::size_t place, const auto& visit) {
        const std::uint32_t i = cells.index(place);
        cells.forEachNearAfter(place, [&](std::uint32_t j) {
            const double limit = spheres.radius[i] + spheres.radius[j] + nearing;
            if ((positions[i] - positions[j]).squaredNorm() < limit * limit) visit(Pair{i, j});
        });
    };
    std::vector<std::size_t> begins(cells.size() + 1, 0);
    forEachIndex(cells.size(), kParticlesPerBlock,
                 [&](std::size_t place) { forEachPartner(place, [&](const Pair&) { ++begins[place + 1]; }); });
    for (std::size_t i = 0; i < cells.size(); ++i) begins[i + 1] += begins[i];
    pairs_.resize(begins.back());
    forEachIndex(cells.size(), kParticlesPerBlock, [&](std::size_t place) {
        std::size_t next = begins[place];
        forEachPartner(place, [&](const Pair& pair) { pairs_[next++] = pair; });
    });
    const std::vector<std::uint32_t>& firsts = cells.cellBegins();
    for (std::size_t c = 0; c + 1 < firsts.size(); ++c) {
        const Cell cell{begins[firsts[c]], begins[firsts[c + 1]]};
        if (cell.end > cell.begin) colours_[std::size_t(cells.colourOf(firsts[c]))].push_back(cell);
    }
}

template <class Answer> void ParticleContact::forEachPair(const Answer& answer) const
{
    for (const std::vector<Cell>& cells : colours_) {
        forEachIndex(cells.size(), kCellsPerBlock, [&](std::size_t c) {
            for (std::size_t k = cells[c].begin; k < cells[c].end; ++k) answer(pairs_[k]);
        });
    }
}

// Whether two overlap at the ends of their ways, with the direction from b to a: that from where they were, since at
// the end they may have passed each other.
bool ParticleContact::meets(const Pair& pair, const std::vector<Vec3d>& starts, const Vec3d& endA, const Vec3d& endB,
                            double margin, Vec3d& normal) const
{
    if (spheres_.skipped[pair.a] != 0 || spheres_.skipped[pair.b] != 0) return false;
    const double touch = (1.0 + margin) * (spheres_.radius[pair.a] + spheres_.radius[pair.b]);
    if (!((endA - endB).squaredNorm() < touch * touch)) return false;
    normal = starts[pair.a] - starts[pair.b];
    const double distance = normal.norm();
    if (distance > 0.0) {
        normal /= distance;
    } else {
        normal = Vec3d::UnitY(); // in the same place: any direction
    }
    return spheres_.inverseMass[pair.a] + spheres_.inverseMass[pair.b] > 0.0;
}

void ParticleContact::collide(const std::vector<Vec3d>& positions, std::vector<Vec3d>& velocities, double dt) const
{
    for (int round = 0; round < kCollisionRounds; ++round) {
        forEachPair([&](const Pair& pair) {
            const auto [a, b] = pair;
            Vec3d normal;
            if (!meets(pair, positions, positions[a] + dt * velocities[a], positions[b] + dt * velocities[b], 0.0,
                       normal))
                return;
            const Vec3d w = velocities[a] - velocities[b];
            const Vec3d impulse = (respond(w, normal, options_.restitution, options_.friction) - w) /
                                  (spheres_.inverseMass[a] + spheres_.inverseMass[b]);
            velocities[a] += spheres_.inverseMass[a] * impulse;
            velocities[b] -= spheres_.inverseMass[b] * impulse;
        });
    }
}

bool ParticleContact::rest(const std::vector<Vec3d>& starts, std::vector<Vec3d>& ends,
                           std::vector<Vec3d>& endVelocities, std::vector<std::uint8_t>& changed) const
{
    changed.assign(starts.size(), 0);
    forEachPair([&](const Pair& pair) {
        const auto [a, b] = pair;
        Vec3d normal;
        if (!meets(pair, starts, ends[a], ends[b], kTouchMargin, normal)) return;
        const double total = spheres_.inverseMass[a] + spheres_.inverseMass[b];
        const double touch = spheres_.radius[a] + spheres_.radius[b];
        const double room = (ends[a] - ends[b]).norm() - touch;
        const double overlap = touch - (starts[a] - starts[b]).norm();
        // What only comes near is left to the next step's collisions.
        if (room >= 0.0 && overlap < -kTouchMargin * touch) return;
        // As if the surfaces came towards each other by a share of what they overlapped before.
        const Vec3d apart = std::max(0.0, kSeparation * overlap) * normal;
        const Vec3d way = (ends[a] - starts[a]) - (ends[b] - starts[b]);
        if (room < 0.0) {
            const Vec3d move = (respond(way - apart, normal, 0.0, options_.friction) + apart - way) / total;
            ends[a] += spheres_.inverseMass[a] * move;
            ends[b] -= spheres_.inverseMass[b] * move;
            if (!move.isZero(0.0)) changed[a] = changed[b] = 1;
        }
        const Vec3d w = endVelocities[a] - endVelocities[b];
        const Vec3d impulse = (respond(w, normal, 0.0, options_.friction) - w) / total;
        endVelocities[a] += spheres_.inverseMass[a] * impulse;
        endVelocities[b] -= spheres_.inverseMass[b] * impulse;
        if (!impulse.isZero(0.0)) changed[a] = changed[b] = 1;
    });
    return std::any_of(changed.begin(), changed.end(), [](std::uint8_t c) { return c != 0; });
}

} // namespace vdbounce
