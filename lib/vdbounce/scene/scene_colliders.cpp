// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_colliders.h"

#include "vdbounce/base/error.h"
#include "vdbounce/contact/body_mass.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

// Trilinear lookup and central differences at phi = radius use voxels up to two cells further out.
constexpr double kLookupReachVx = 2.0;

using FieldPtr = std::shared_ptr<const DistanceField>;

FieldPtr loadField(const std::string& path)
{
    const LevelSetGrid grid = readLevelSet(path);
    try {
        return std::make_shared<const DistanceField>(grid);
    } catch (const InputError& error) {
        throw InputError(path, error.what(), "write the file again");
    }
}

std::optional<BodyMass> bodyOf(const ColliderSpec& spec, const Shape& shape)
{
    if (!spec.body) return std::nullopt;
    const auto even = evenDensity(shape, spec.body->mass);
    if (!even) {
        throw InputError(spec.file, "has no closed inside, so nothing tells how its mass is spread",
                         "remove the collider's mass, or write a closed level set");
    }
    BodyMass body = *even;
    body.centre = spec.body->centre.value_or(body.centre);
    if (spec.body->inertia) body.inertia = spec.body->inertia->asDiagonal();
    const RigidVelocity start = spec.motion.velocityAt(0.0);
    body.velocity = start.at(body.centre);
    body.angularVelocity = start.angular;
    return body;
}

double largestRadius(const Particles& particles, const ParticleDefaults& defaults)
{
    double largest = particles.radius.empty() ? defaults.radius : 0.0;
    for (double radius : particles.radius) {
        if (std::isfinite(radius)) largest = std::max(largest, radius);
    }
    return largest;
}

double inWorld(const Length& length, const char* key, const ColliderSet& colliders)
{
    if (!(length.value > 0.0)) return 0.0;
    if (length.inVoxels && !std::isfinite(colliders.smallestVoxel())) {
        throw UsageError(key, numberText(length.value) + "vx is in voxels, and no collider has any",
                         "give it in world units");
    }
    return length.world(colliders.smallestVoxel());
}

void requireBand(const DistanceField& field, const std::string& file, double reach, double radius)
{
    const double needed = reach + kLookupReachVx * field.voxelSize();
    if (field.empty() || reach == 0.0 || field.background() >= needed * (1.0 - 1e-6)) return;
    throw InputError(file,
                     "its narrow band of " + numberText(field.background()) + " is too thin for a particle radius of " +
                         numberText(radius) +
                         (reach > radius ? " and repulsion from " + numberText(reach - radius) + " on" : ""),
                     "make it with --exterior " + numberText(std::ceil(needed / field.voxelSize())) + "vx or more");
}

} // namespace

SceneColliders::SceneColliders(const Scene& scene) : scene_(scene)
{
    for (const ColliderSpec& spec : scene.colliders) {
        deforming_ = deforming_ || !spec.sequence.empty();
        if (spec.file.empty()) continue;
        FieldPtr& field = fields_[spec.file];
        if (!field) field = loadField(spec.file);
    }
}

SceneColliders::Moment SceneColliders::momentOf(const std::string& sequence, int frame)
{
    std::map<int, Moment>& moments = moments_[sequence];
    // Frames go up, so what lies more than one before is not asked for again.
    moments.erase(moments.begin(), moments.lower_bound(frame - 1));
    Moment& moment = moments[frame];
    if (!moment.field) {
        const std::string path = framePath(sequence, frame);
        moment = {loadField(path), readVelocityField(path)};
    }
    return moment;
}

Shape SceneColliders::shapeOf(const ColliderSpec& spec, int frame)
{
    if (spec.plane) return PlaneField(spec.plane->point, spec.plane->normal);
    if (spec.sequence.empty()) return fields_.at(spec.file);
    const double seconds = scene_.stepsPerFrame * scene_.dt;
    const Moment from = momentOf(spec.sequence, std::max(0, frame - 1));
    const Moment to = momentOf(spec.sequence, frame);
    DeformingShape shape;
    shape.field = std::make_shared<const DeformingField>(from.field, to.field, seconds, from.velocity, to.velocity);
    shape.begin = (frame - 1) * seconds;
    shape.end = frame * seconds;
    return shape;
}

ColliderSet SceneColliders::onTheWayTo(int frame)
{
    std::vector<Collider> colliders;
    for (const ColliderSpec& spec : scene_.colliders) {
        Collider collider{spec.name, shapeOf(spec, frame), spec.restitution, spec.friction, spec.onHit, {}, {}};
        collider.body = bodyOf(spec, collider.shape);
        if (!collider.body) collider.motion = spec.motion;
        colliders.push_back(std::move(collider));
    }
    return ColliderSet(std::move(colliders));
}

ParticleDefaults particleDefaults(const Scene& scene, const ColliderSet& colliders)
{
    return {inWorld(scene.radius, "particles.radius", colliders), scene.mass};
}

StepOptions stepOptions(const Scene& scene, const ColliderSet& colliders)
{
    StepOptions options;
    options.dt = scene.dt;
    options.gravity = scene.gravity;
    options.scheme = scene.scheme;
    options.maxBounces = scene.maxBounces;
    options.sweep = scene.sweep;
    options.repulsion = {inWorld(scene.repulsionRange, "contact.repulsion.range", colliders), scene.repulsionStrength};
    return options;
}

void requireBandsForRadius(const Scene& scene, const ColliderSet& colliders, const Particles& particles,
                           const ParticleDefaults& defaults, int frame)
{
    const double radius = largestRadius(particles, defaults);
    const double reach = radius + stepOptions(scene, colliders).repulsion.range;
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (const auto* field = std::get_if<FieldPtr>(&colliders[i].shape))
            requireBand(**field, scene.colliders[i].file, reach, radius);
        if (const auto* shape = std::get_if<DeformingShape>(&colliders[i].shape))
            for (const int end : {std::max(0, frame - 1), frame})
                requireBand(end == frame ? shape->field->to() : shape->field->from(),
                            framePath(scene.colliders[i].sequence, end), reach, radius);
    }
}

} // namespace vdbounce
