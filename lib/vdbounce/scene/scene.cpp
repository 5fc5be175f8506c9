// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"

#include <cmath>
#include <set>

namespace vdbounce {
namespace {

// Notes the first rule that does not hold.
class Checker {
public:
    void require(bool good, const std::string& path, double value, const char* remedy)
    {
        if (!good && !fault) fault = SceneFault{path, value, remedy};
    }
    std::optional<SceneFault> fault;
};

void checkCollider(const ColliderSpec& collider, const std::string& path, Checker& checker)
{
    checker.require(collider.restitution >= 0.0 && collider.restitution <= 1.0, path + ".restitution",
                    collider.restitution, "give 0 to 1");
    checker.require(collider.friction >= 0.0 && std::isfinite(collider.friction), path + ".friction", collider.friction,
                    "give 0 or more");
    if (collider.csg) {
        checker.require(collider.csg->blend.value >= 0.0 && std::isfinite(collider.csg->blend.value),
                        path + ".csg.blend", collider.csg->blend.value, "give 0 or more");
    }
    if (collider.body) {
        checker.require(collider.body->mass > 0.0 && std::isfinite(collider.body->mass), path + ".mass",
                        collider.body->mass, "give a positive mass");
        checker.require(collider.body->centre.value_or(Vec3d::Zero()).allFinite(), path + ".center_of_mass",
                        collider.body->centre.value_or(Vec3d::Zero()).sum(), "give finite numbers");
        const Vec3d inertia = collider.body->inertia.value_or(Vec3d::Ones());
        checker.require((inertia.array() > 0.0).all() && inertia.allFinite(), path + ".inertia", inertia.minCoeff(),
                        "give three positive moments");
    }
}

// Where the last # of the file's name is; a # in a folder's name is none.
std::size_t patternEnd(const std::string& pattern)
{
    const std::size_t last = pattern.rfind('#');
    const std::size_t slash = pattern.rfind('/');
    return last != std::string::npos && (slash == std::string::npos || last > slash) ? last : std::string::npos;
}

} // namespace

std::optional<SceneFault> findFault(const Scene& scene)
{
    Checker checker;
    checker.require(scene.dt > 0.0 && std::isfinite(scene.dt), "time.dt", scene.dt,
                    "give a positive number of seconds");
    checker.require(scene.stepsPerFrame >= 1, "time.steps_per_frame", scene.stepsPerFrame, "give 1 or more");
    checker.require(scene.frames >= 0, "time.frames", scene.frames, "give 0 or more");
    checker.require(scene.gravity.allFinite(), "world.gravity", scene.gravity.norm(), "give finite numbers");
    const double radius = scene.radius.value;
    checker.require(radius >= 0.0 && std::isfinite(radius), "particles.radius", radius, "give 0 or more");
    checker.require(scene.mass > 0.0 && std::isfinite(scene.mass), "particles.mass", scene.mass,
                    "give a positive mass");
    checker.require(scene.particles.restitution >= 0.0 && scene.particles.restitution <= 1.0, "particles.restitution",
                    scene.particles.restitution, "give 0 to 1");
    checker.require(scene.particles.friction >= 0.0 && std::isfinite(scene.particles.friction), "particles.friction",
                    scene.particles.friction, "give 0 or more");
    checker.require(scene.maxBounces >= 0, "contact.max_bounces", scene.maxBounces, "give 0 or more");
    checker.require(scene.repulsionRange.value >= 0.0 && std::isfinite(scene.repulsionRange.value),
                    "contact.repulsion.range", scene.repulsionRange.value, "give 0 or more");
    checker.require(scene.repulsionStrength >= 0.0 && std::isfinite(scene.repulsionStrength),
                    "contact.repulsion.strength", scene.repulsionStrength, "give 0 or more");
    const double maxError = scene.maxError.value_or(Length{1.0}).value;
    checker.require(maxError > 0.0 && std::isfinite(maxError), "accuracy.max_error", maxError,
                    "give a positive length, 0.05vx is a twentieth of a voxel");
    checker.require(scene.every >= 1, "output.every", scene.every, "give 1 or more");
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
        checkCollider(scene.colliders[i], "collider[" + std::to_string(i) + "]", checker);
    }
    return checker.fault;
}

std::vector<const ColliderSpec*> collidersMet(const Scene& scene)
{
    std::set<std::string> operands;
    for (const ColliderSpec& collider : scene.colliders) {
        if (collider.csg) operands.insert(collider.csg->of.begin(), collider.csg->of.end());
    }
    std::vector<const ColliderSpec*> met;
    for (const ColliderSpec& collider : scene.colliders) {
        if (operands.count(collider.name) == 0) met.push_back(&collider);
    }
    return met;
}

void validate(const Scene& scene)
{
    if (const auto fault = findFault(scene)) {
        throw UsageError(fault->path, numberText(fault->value) + " is out of range", fault->remedy);
    }
}

bool hasFramePattern(const std::string& pattern) { return patternEnd(pattern) != std::string::npos; }

std::string framePath(const std::string& pattern, int frame)
{
    const std::size_t begin = patternEnd(pattern);
    if (begin == std::string::npos) return pattern;
    std::size_t first = begin;
    while (first > 0 && pattern[first - 1] == '#') --first;
    const std::size_t width = begin - first + 1;
    std::string number = std::to_string(frame);
    if (number.size() < width) number.insert(0, width - number.size(), '0');
    return pattern.substr(0, first) + number + pattern.substr(begin + 1);
}

} // namespace vdbounce
