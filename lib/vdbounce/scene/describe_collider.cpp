// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/describe_collider.h"

#include "vdbounce/io/number_text.h"

namespace vdbounce {
namespace {

std::string describeBand(const DistanceField& field, const ContactReach& reach)
{
    const double needed = neededBand(field, reach);
    return "band " + numberText(field.background()) +
           (needed > 0.0 ? " of which " + numberText(needed) + " is needed" : ", any would do for points");
}

std::string describeShape(const PlaneField& plane, const ContactReach&)
{
    const Vec3d& n = plane.normal();
    return "plane, normal (" + numberText(n.x()) + ", " + numberText(n.y()) + ", " + numberText(n.z()) + ")";
}

std::string describeShape(const std::shared_ptr<const DistanceField>& field, const ContactReach& reach)
{
    return "level set, " + std::to_string(field->blocks().blockCount()) + " leaves, voxel " +
           numberText(field->voxelSize()) + ", " + describeBand(*field, reach) + ", " +
           std::to_string(field->memoryBytes() >> 20) + " MiB for lookup" +
           (field->clipped() ? ", cut off by its box" : "");
}

std::string describeShape(const DeformingShape& shape, const ContactReach& reach)
{
    const DistanceField& first = shape.field->from();
    return "deforming level sets, the first of " + std::to_string(first.blocks().blockCount()) + " leaves, voxel " +
           numberText(first.voxelSize()) + ", " + describeBand(first, reach);
}

std::string describeShape(const std::shared_ptr<const ImplicitField>& field, const ContactReach&)
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

} // namespace

std::string describeCollider(const ColliderSpec& spec, const Collider& collider, const ContactReach& reach)
{
    return "collider '" + collider.name + "': " + describeForm(spec) +
           std::visit([&](const auto& shape) { return describeShape(shape, reach); }, collider.shape) +
           ", restitution " + numberText(collider.restitution) + ", friction " + numberText(collider.friction);
}

} // namespace vdbounce
