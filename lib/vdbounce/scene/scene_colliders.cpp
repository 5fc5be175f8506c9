// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_colliders.h"

#include "vdbounce/base/error.h"
#include "vdbounce/contact/body_mass.h"
#include "vdbounce/contact/shape_field.h"
#include "vdbounce/implicit/csg_field.h"
#include "vdbounce/implicit/heightfield.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/scene/band_needs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

using FieldPtr = std::shared_ptr<const DistanceField>;

FieldPtr loadField(const std::string& path, const FieldOptions& accuracy)
{
    const LevelSetGrid grid = readLevelSet(path);
    try {
        return std::make_shared<const DistanceField>(grid, accuracy);
    } catch (const InputError& error) {
        throw InputError(path, error.what(), "write the file again");
    }
}

FieldPtr loadBlobs(const ColliderSpec::Blobs& blobs, const FieldOptions& accuracy)
{
    return std::make_shared<const DistanceField>(makeBlobs(readParticles(blobs.file), blobs.options).grid, accuracy);
}

// What a collider's level set goes by; of blobs no file has it.
std::string fieldKey(const ColliderSpec& spec)
{
    return spec.blobs ? "the blobs of collider '" + spec.name + "'" : spec.file;
}

std::optional<BodyMass> bodyOf(const ColliderSpec& spec, const Shape& shape)
{
    if (!spec.body) return std::nullopt;
    const auto even = evenDensity(shape, spec.body->mass);
    if (!even) {
        throw InputError(spec.file.empty() ? "collider '" + spec.name + "'" : spec.file,
                         "has no closed inside that keeps its form, so nothing tells how its mass is spread",
                         "remove the collider's mass, or close it");
    }
    BodyMass body = *even;
    body.centre = spec.body->centre.value_or(body.centre);
    if (spec.body->inertia) body.inertia = spec.body->inertia->asDiagonal();
    const RigidVelocity start = spec.motion.velocityAt(0.0);
    body.velocity = start.at(body.centre);
    body.angularVelocity = start.angular;
    return body;
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

} // namespace

SceneColliders::SceneColliders(const Scene& scene) : scene_(scene)
{
    for (const ColliderSpec& spec : scene.colliders) {
        deforming_ = deforming_ || !spec.sequence.empty();
        if (spec.heightfield) {
            heightfields_[spec.name] = std::make_shared<const HeightfieldField>(readHeightMap(spec.heightfield->file),
                                                                                spec.heightfield->place);
        }
        if (spec.blobs) fields_[fieldKey(spec)] = loadBlobs(*spec.blobs, scene.accuracy);
        if (spec.file.empty()) continue;
        FieldPtr& field = fields_[spec.file];
        if (!field) field = loadField(spec.file, scene.accuracy);
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
        moment = {loadField(path, scene_.accuracy), readVelocityField(path)};
    }
    return moment;
}

Shape SceneColliders::shapeOf(const ColliderSpec& spec, int frame)
{
    if (spec.csg) return csgOf(spec, frame);
    if (!spec.sequence.empty()) return deformingShape(spec, frame);
    if (spec.heightfield) return heightfields_.at(spec.name);
    if (!spec.formula) return fields_.at(fieldKey(spec));
    if (const auto* plane = std::get_if<PlaneShape>(&*spec.formula)) return PlaneField(plane->point, plane->normal);
    return makeField(*spec.formula);
}

Shape SceneColliders::deformingShape(const ColliderSpec& spec, int frame)
{
    const double seconds = scene_.stepsPerFrame * scene_.dt;
    const Moment from = momentOf(spec.sequence, std::max(0, frame - 1));
    const Moment to = momentOf(spec.sequence, frame);
    DeformingShape shape;
    shape.field = std::make_shared<const DeformingField>(from.field, to.field, seconds, from.velocity, to.velocity);
    shape.begin = (frame - 1) * seconds;
    shape.end = frame * seconds;
    return shape;
}

Shape SceneColliders::csgOf(const ColliderSpec& spec, int frame)
{
    std::vector<std::shared_ptr<const ImplicitField>> operands;
    double voxel = std::numeric_limits<double>::infinity();
    for (const std::string& name : spec.csg->of) {
        const ColliderSpec& operand = specOf(name);
        operands.push_back(asField(shapeOf(operand, frame), operand.motion));
        voxel = std::min(voxel, operands.back()->voxelSize());
    }
    if (spec.csg->blend.inVoxels && !std::isfinite(voxel)) {
        throw UsageError("collider '" + spec.name + "' csg.blend",
                         numberText(spec.csg->blend.value) + "vx is in voxels, and no operand has any",
                         "give it in world units");
    }
    return std::make_shared<const CsgField>(spec.csg->operation, std::move(operands), spec.csg->blend.world(voxel));
}

const ColliderSpec& SceneColliders::specOf(const std::string& name) const
{
    for (const ColliderSpec& spec : scene_.colliders) {
        if (spec.name == name) return spec;
    }
    throw UsageError("csg of '" + name + "'", "the scene has no collider of that name", "name another");
}

ColliderSet SceneColliders::onTheWayTo(int frame)
{
    std::vector<Collider> colliders;
    for (const ColliderSpec* met : collidersMet(scene_)) {
        const ColliderSpec& spec = *met;
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

PassOptions passOptions(const Scene& scene, const ColliderSet& colliders, const ParticleDefaults& defaults)
{
    PassOptions options;
    options.step = stepOptions(scene, colliders);
    options.defaults = defaults;
    options.hits = scene.hits;
    options.interact = scene.interact;
    options.particles = scene.particles;
    return options;
}

void SceneColliders::requireBandsForRadius(const ColliderSet& colliders, const Particles& particles,
                                           const ParticleDefaults& defaults) const
{
    const ContactReach reach = contactReach(particles, defaults, stepOptions(scene_, colliders));
    for (const auto& [file, field] : fields_) requireBand(*field, field->background(), file, "exterior", reach);
    for (const auto& [sequence, moments] : moments_) {
        for (const auto& [frame, moment] : moments)
            requireBand(*moment.field, moment.field->background(), framePath(sequence, frame), "exterior", reach);
    }
    for (const ColliderSpec& spec : scene_.colliders) {
        if (!spec.csg) continue;
        // What is taken away is touched from its inside.
        const bool complement = spec.csg->operation == CsgOperation::Complement;
        if (!complement && spec.csg->operation != CsgOperation::Subtraction) continue;
        for (std::size_t i = complement ? 0 : 1; i < spec.csg->of.size(); ++i) {
            const std::string file = fieldKey(specOf(spec.csg->of[i]));
            if (fields_.count(file) == 0) continue;
            const DistanceField& field = *fields_.at(file);
            requireBand(field, field.interior(), file, "interior", reach);
        }
    }
}

std::size_t SceneColliders::memoryBytes() const
{
    std::size_t bytes = 0;
    for (const auto& [file, field] : fields_) bytes += field->memoryBytes();
    for (const auto& [sequence, moments] : moments_) {
        for (const auto& [frame, moment] : moments) bytes += moment.field->memoryBytes();
    }
    return bytes;
}

} // namespace vdbounce
