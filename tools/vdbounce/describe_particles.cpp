// SPDX-License-Identifier: Apache-2.0
#include "description.h"

#include "vdbounce/io/particle_file.h"

#include <cmath>

namespace vdbounce::tool {
namespace {

std::string attributeNames(const Particles& particles)
{
    std::string names = "position";
    if (!particles.velocity.empty()) names += ", velocity";
    if (!particles.radius.empty()) names += ", radius";
    if (!particles.mass.empty()) names += ", mass";
    return names + ", id";
}

} // namespace

Description describeParticles(const std::string& path)
{
    const Particles particles = readParticles(path);
    const Box box = boundingBox(particles);
    std::uint64_t bad = 0;
    double fastest = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double speed = particles.velocity.empty() ? 0.0 : particles.velocity[i].norm();
        if (particles.position[i].allFinite() && std::isfinite(speed)) {
            fastest = std::max(fastest, speed);
        } else {
            ++bad;
        }
    }
    const Json json = {
        {"kind", "particles"},        {"particles", particles.size()}, {"attributes", attributeNames(particles)},
        {"box_min", toJson(box.min)}, {"box_max", toJson(box.max)},    {"fastest", fastest},
        {"not_finite", bad}};
    std::string text = grouped(particles.size()) + " particles with " + attributeNames(particles);
    if (!box.empty())
        text += ", box " + vectorText(box.min) + " to " + vectorText(box.max) + ", fastest " + rounded(fastest);
    if (bad > 0) text += ", " + grouped(bad) + " not finite";
    return {json, text};
}

} // namespace vdbounce::tool
