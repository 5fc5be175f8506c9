// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_load.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

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

double largestRadius(const Particles& particles, const ParticleDefaults& defaults)
{
    double largest = particles.radius.empty() ? defaults.radius : 0.0;
    for (double radius : particles.radius) {
        if (std::isfinite(radius)) largest = std::max(largest, radius);
    }
    return largest;
}

} // namespace

ColliderSet loadColliders(const Scene& scene)
{
    std::map<std::string, FieldPtr> fields;
    std::vector<Collider> colliders;
    for (const ColliderSpec& spec : scene.colliders) {
        if (spec.plane) {
            colliders.push_back(
                {spec.name, PlaneField(spec.plane->point, spec.plane->normal), spec.restitution, spec.friction});
            continue;
        }
        FieldPtr& field = fields[spec.file];
        if (!field) field = loadField(spec.file);
        colliders.push_back({spec.name, field, spec.restitution, spec.friction});
    }
    return ColliderSet(std::move(colliders));
}

ParticleDefaults particleDefaults(const Scene& scene, const ColliderSet& colliders)
{
    if (scene.radius.inVoxels && scene.radius.value > 0.0 && !std::isfinite(colliders.smallestVoxel())) {
        throw UsageError("particles.radius",
                         numberText(scene.radius.value) + "vx is in voxels, and no collider has any",
                         "give the radius in world units");
    }
    return {scene.radius.value > 0.0 ? scene.radius.world(colliders.smallestVoxel()) : 0.0, scene.mass};
}

void requireBandsForRadius(const Scene& scene, const ColliderSet& colliders, const Particles& particles,
                           const ParticleDefaults& defaults)
{
    const double radius = largestRadius(particles, defaults);
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const auto* field = std::get_if<FieldPtr>(&colliders[i].shape);
        if (field == nullptr || (*field)->empty()) continue;
        const double needed = radius + kLookupReachVx * (*field)->voxelSize();
        if (radius == 0.0 || (*field)->background() >= needed * (1.0 - 1e-6)) continue;
        throw InputError(scene.colliders[i].file,
                         "its narrow band of " + numberText((*field)->background()) +
                             " is too thin for a particle radius of " + numberText(radius),
                         "make it with --exterior " + numberText(std::ceil(needed / (*field)->voxelSize())) +
                             "vx or more");
    }
}

} // namespace vdbounce
