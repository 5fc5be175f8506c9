// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/shapes.h"

#include "vdbounce/base/error.h"
#include "vdbounce/implicit/ellipsoid_form.h"
#include "vdbounce/implicit/flat_forms.h"
#include "vdbounce/implicit/round_forms.h"
#include "vdbounce/io/number_text.h"

namespace vdbounce {
namespace {

using FieldPtr = std::shared_ptr<const ImplicitField>;

// Refuses what is no shape, at the door.
class Door {
public:
    explicit Door(const std::string& place) : place_(place) {}

    void finite(const char* name, const Vec3d& value) const
    {
        if (!value.allFinite()) fail(name, "is not finite", "give finite numbers");
    }
    void positive(const char* name, double value) const
    {
        if (!(value > 0.0) || !std::isfinite(value))
            fail(name, numberText(value) + " is out of range", "give a positive number");
    }
    void direction(const char* name, double length) const
    {
        if (!(length > 0.0) || !std::isfinite(length))
            fail(name, "has no direction", "give finite numbers that are not all 0");
    }
    [[noreturn]] void fail(const char* name, const std::string& what, const char* remedy) const
    {
        throw UsageError(place_ + ": " + name, what, remedy);
    }

private:
    const std::string& place_;
};

template <class Form> FieldPtr fieldOf(const Form& form) { return std::make_shared<const FormField<Form>>(form); }

FieldPtr make(const PlaneShape& shape, const Door& door)
{
    door.finite("point", shape.point);
    door.direction("normal", shape.normal.norm());
    return fieldOf(PlaneForm(shape.point, shape.normal));
}

FieldPtr make(const SphereShape& shape, const Door& door)
{
    door.finite("center", shape.centre);
    door.positive("radius", shape.radius);
    return fieldOf(SphereForm(shape.centre, shape.radius));
}

FieldPtr make(const BoxShape& shape, const Door& door)
{
    door.finite("center", shape.centre);
    for (int axis = 0; axis < 3; ++axis) door.positive("half", shape.half[axis]);
    door.direction("rotate", shape.rotate.norm());
    return fieldOf(BoxForm(shape.centre, shape.half, shape.rotate.normalized().toRotationMatrix()));
}

FieldPtr make(const CapsuleShape& shape, const Door& door)
{
    door.finite("from", shape.from);
    door.finite("to", shape.to);
    door.positive("radius", shape.radius);
    return fieldOf(CapsuleForm(shape.from, shape.to, shape.radius));
}

void requireEnds(const Vec3d& from, const Vec3d& to, const Door& door)
{
    door.finite("from", from);
    door.finite("to", to);
    if (!((to - from).norm() > 0.0)) door.fail("from, to", "are one point", "give two");
}

FieldPtr make(const CylinderShape& shape, const Door& door)
{
    requireEnds(shape.from, shape.to, door);
    door.positive("radius", shape.radius);
    return fieldOf(FrustumForm(shape.from, shape.to, shape.radius, shape.radius));
}

FieldPtr make(const ConeShape& shape, const Door& door)
{
    requireEnds(shape.from, shape.to, door);
    door.positive("radius", shape.radius);
    if (!(shape.topRadius >= 0.0) || !std::isfinite(shape.topRadius))
        door.fail("top radius", numberText(shape.topRadius) + " is out of range", "give 0 or more");
    return fieldOf(FrustumForm(shape.from, shape.to, shape.radius, shape.topRadius));
}

FieldPtr make(const TorusShape& shape, const Door& door)
{
    door.finite("center", shape.centre);
    door.direction("axis", shape.axis.norm());
    door.positive("minor", shape.minor);
    door.positive("major", shape.major);
    if (!(shape.minor < shape.major)) {
        door.fail("minor", numberText(shape.minor) + " is not less than major " + numberText(shape.major),
                  "give a thinner tube");
    }
    return fieldOf(TorusForm(shape.centre, shape.axis, shape.major, shape.minor));
}

FieldPtr make(const EllipsoidShape& shape, const Door& door)
{
    door.finite("center", shape.centre);
    for (int axis = 0; axis < 3; ++axis) door.positive("radii", shape.radii[axis]);
    return fieldOf(EllipsoidForm(shape.centre, shape.radii));
}

} // namespace

FieldPtr makeField(const ShapeFormula& shape, const std::string& place)
{
    const Door door(place);
    return std::visit([&](const auto& formula) { return make(formula, door); }, shape);
}

FieldPtr makeField(const ShapeFormula& shape) { return makeField(shape, nameOf(shape)); }

const char* nameOf(const ShapeFormula& shape)
{
    constexpr const char* kNames[] = {"plane", "sphere", "box", "capsule", "cylinder", "cone", "torus", "ellipsoid"};
    return kNames[shape.index()];
}

} // namespace vdbounce
