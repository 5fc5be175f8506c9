// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/number_text.h"
#include "vdbounce/scene/run.h"
#include "vdbounce/scene/scene_colliders.h"

#include <cmath>

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

std::string describeShape(const DeformingShape& shape)
{
    const DistanceField& first = shape.field->from();
    return "deforming level sets, the first of " + std::to_string(first.blocks().blockCount()) + " leaves, voxel " +
           numberText(first.voxelSize()) + ", band " + numberText(first.background());
}

std::string describeShape(const std::shared_ptr<const ImplicitField>& field)
{
    return std::string(field->exact() ? "exact distance by formula" : "combined by formula") +
           (field->still() ? "" : ", its parts move");
}

// What the scene calls it, and what it is made of.
std::string describeForm(const ColliderSpec& spec)
{
    if (spec.csg) {
        const char* const kNames[] = {"union", "intersection", "subtraction", "complement"};
        std::string text = std::string("csg ") + kNames[int(spec.csg->operation)] + " of ";
        for (const std::string& name : spec.csg->of) text += (name == spec.csg->of.front() ? "'" : ", '") + name + "'";
        return text + ", ";
    }
    if (spec.blobs) return "blobs, ";
    if (spec.heightfield) return "heightfield, ";
    const bool named = spec.formula && !std::holds_alternative<PlaneShape>(*spec.formula);
    return named ? std::string(nameOf(*spec.formula)) + ", " : "";
}

// Nothing where no collider is a level set.
std::string describeAccuracy(const Scene& scene, const ColliderSet& colliders)
{
    if (!std::isfinite(colliders.smallestVoxel())) return "";
    const FieldOptions& accuracy = scene.accuracy;
    return std::string("accuracy: ") + nameOf(accuracy.lookup) + " lookup, " + nameOf(accuracy.normal) +
           " normals, values kept as " + nameOf(accuracy.storage);
}

std::string describeSweep(const Scene& scene, const ColliderSet& colliders)
{
    switch (scene.sweep) {
    case Sweep::Always: return "sweep: along every path that may touch something";
    case Sweep::Never: return "sweep: left out (never); fast particles may pass through thin walls";
    case Sweep::Auto: break;
    }
    if (!(colliders.wallLength() > 0.0))
        return "sweep: along every path that may touch something (what is cut can be as thin as one likes)";
    return "sweep: only for steps longer than " + numberText(0.5 * colliders.wallLength()) +
           " that may touch something on the way";
}

std::string describeScheme(const Scene& scene)
{
    switch (scene.scheme) {
    case Scheme::Once: return "scheme: once, a response to what penetrates at the end of a step";
    case Scheme::Iterate: return "scheme: iterate, responses until nothing penetrates";
    case Scheme::CollideContact: break;
    }
    return "scheme: collide-contact, up to " + std::to_string(scene.maxBounces) + " bounces a step";
}

std::string describeLookups(const Scene& scene, const ColliderSet& colliders)
{
    std::string text = "lookups: none for a particle whose clearance exceeds its step";
    if (!colliders.still()) text += " and what the colliders move";
    if (scene.repulsionRange.value > 0.0) text += " and the range of repulsion";
    return text + "; gradients only for those that touch" +
           (scene.repulsionRange.value > 0.0 ? " or are in range" : "");
}

std::string describeOmissions(const Scene& scene, const ColliderSet& colliders)
{
    std::string text;
    const auto leaveOut = [&](bool out, const char* what) {
        if (out) text += (text.empty() ? "left out: " : ", ") + std::string(what);
    };
    leaveOut(colliders.still(), "collider velocities (none moves)");
    leaveOut(!colliders.anyFree(), "moving colliders by particles (none has a mass)");
    leaveOut(!scene.interact, "particle against particle (not asked for)");
    leaveOut(!(scene.repulsionRange.value > 0.0), "repulsion (no range)");
    leaveOut(!scene.hits, "records of hits (not asked for)");
    leaveOut(true, "reordering");
    return text;
}

} // namespace

std::vector<std::string> explainScene(const Scene& scene)
{
    validate(scene);
    const ColliderSet colliders = SceneColliders(scene).onTheWayTo(0);
    const ParticleDefaults defaults = particleDefaults(scene, colliders);
    std::vector<std::string> lines;
    lines.push_back("time: " + std::to_string(scene.frames) + " frames of " + std::to_string(scene.stepsPerFrame) +
                    " steps of " + numberText(scene.dt) + " s");
    lines.push_back("particles: " + scene.particleFile + ", radius " + numberText(defaults.radius) + " and mass " +
                    numberText(defaults.mass) + " where it carries none");
    const std::vector<const ColliderSpec*> specs = collidersMet(scene);
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const Collider& collider = colliders[i];
        lines.push_back("collider '" + collider.name + "': " + describeForm(*specs[i]) +
                        std::visit([](const auto& shape) { return describeShape(shape); }, collider.shape) +
                        ", restitution " + numberText(collider.restitution) + ", friction " +
                        numberText(collider.friction));
    }
    const std::string accuracy = describeAccuracy(scene, colliders);
    if (!accuracy.empty()) lines.push_back(accuracy);
    lines.push_back(describeScheme(scene));
    lines.push_back(describeSweep(scene, colliders));
    lines.push_back(describeLookups(scene, colliders));
    lines.push_back(describeOmissions(scene, colliders));
    return lines;
}

} // namespace vdbounce
