// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/particles/particles.h"

#include <algorithm>
#include <numeric>

namespace vdbounce {
namespace {

template <class T> void gather(const std::vector<T>& from, const std::vector<std::size_t>& order, std::vector<T>& to)
{
    if (from.empty()) return;
    to.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) to[i] = from[order[i]];
}

} // namespace

void Particles::resize(std::size_t count)
{
    const std::size_t before = id.size();
    position.resize(count, Vec3d::Zero());
    if (!velocity.empty()) velocity.resize(count, Vec3d::Zero());
    if (!radius.empty()) radius.resize(count, 0.0);
    if (!mass.empty()) mass.resize(count, 1.0);
    if (!hits.empty()) hits.resize(count);
    if (!stuckTo.empty()) stuckTo.resize(count, -1);
    if (!rejected.empty()) rejected.resize(count, 0);
    id.resize(count);
    for (std::size_t i = before; i < count; ++i) id[i] = static_cast<std::int64_t>(i);
}

void Particles::ensureVelocity()
{
    if (velocity.empty()) velocity.assign(size(), Vec3d::Zero());
}

void numberInOrder(Particles& particles)
{
    particles.id.resize(particles.size());
    std::iota(particles.id.begin(), particles.id.end(), std::int64_t(0));
}

Box boundingBox(const Particles& particles)
{
    Box box;
    for (const Vec3d& p : particles.position) {
        if (p.allFinite()) box.add(p);
    }
    return box;
}

std::vector<std::size_t> orderById(const Particles& particles)
{
    std::vector<std::size_t> order(particles.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return particles.id[a] < particles.id[b]; });
    return order;
}

Particles reordered(const Particles& particles, const std::vector<std::size_t>& order)
{
    Particles result;
    gather(particles.position, order, result.position);
    gather(particles.velocity, order, result.velocity);
    gather(particles.radius, order, result.radius);
    gather(particles.mass, order, result.mass);
    gather(particles.id, order, result.id);
    gather(particles.hits, order, result.hits);
    gather(particles.stuckTo, order, result.stuckTo);
    gather(particles.rejected, order, result.rejected);
    return result;
}

} // namespace vdbounce
