// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/number_text.h"
#include "vdbounce/scene/run.h"
#include "vdbounce/scene/scene_load.h"

namespace vdbounce {
namespace {

std::string describeShape(const PlaneField& plane)
{
    const Vec3d& n = plane.normal();
    return "plane, normal (" + numberText(n.x()) + ", " + numberText(n.y()) + ", " + numberText(n.z()) + ")";
}

std::string describeShape(const std::shared_ptr<const DistanceField>& field)
{
    return "level set, " + std::to_string(field->blocks().blockCount()) + " leaves, voxel " +
           numberText(field->voxelSize()) + ", band " + numberText(field->background()) + ", " +
           std::to_string(field->memoryBytes() >> 20) + " MiB for lookup" +
           (field->clipped() ? ", cut off by its box" : "");
}

std::string describeSweep(const Scene& scene, const ColliderSet& colliders)
{
    switch (scene.sweep) {
    case Sweep::Always: return "sweep: along every path that may touch something";
    case Sweep::Never: return "sweep: left out (never); fast particles may pass through thin walls";
    case Sweep::Auto: break;
    }
    return "sweep: only for steps longer than " + numberText(colliders.smallestVoxel()) +
           " that may touch something on the way";
}

} // namespace

std::vector<std::string> explainScene(const Scene& scene)
{
    validate(scene);
    const ColliderSet colliders = loadColliders(scene);
    const ParticleDefaults defaults = particleDefaults(scene, colliders);
    std::vector<std::string> lines;
    lines.push_back("time: " + std::to_string(scene.frames) + " frames of " + std::to_string(scene.stepsPerFrame) +
                    " steps of " + numberText(scene.dt) + " s");
    lines.push_back("particles: " + scene.particleFile + ", radius " + numberText(defaults.radius) + " and mass " +
                    numberText(defaults.mass) + " where it carries none");
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        lines.push_back("collider '" + collider.name +
                        "': " + std::visit([](const auto& shape) { return describeShape(shape); }, collider.shape) +
                        ", restitution " + numberText(collider.restitution) + ", friction " +
                        numberText(collider.friction));
    }
    lines.push_back("scheme: collide-contact, up to " + std::to_string(scene.maxBounces) + " bounces a step");
    lines.push_back(describeSweep(scene, colliders));
    lines.emplace_back(
        "lookups: none for a particle whose clearance exceeds its step; gradients only for those that touch");
    lines.emplace_back(
        "left out: collider velocities (none moves), particle against particle (not asked for), reordering");
    return lines;
}

} // namespace vdbounce
