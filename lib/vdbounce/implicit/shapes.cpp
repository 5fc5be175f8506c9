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

// Notes the first value that makes no shape.
class Door {
public:
    void finite(const char* name, const Vec3d& value) { require(value.allFinite(), name, "is not finite", kFinite); }
    void positive(const char* name, double value)
    {
        require(value > 0.0 && std::isfinite(value), name, numberText(value) + " is out of range",
                "give a positive number");
    }
    void direction(const char* name, double length)
    {
        require(length > 0.0 && std::isfinite(length), name, "has no direction", "give numbers that are not all 0");
    }
    void require(bool good, const char* name, const std::string& what, const char* remedy)
    {
        if (!good && !fault) fault = ShapeFault{name, what, remedy};
    }
    void ends(const Vec3d& from, const Vec3d& to)
    {
        finite("from", from);
        finite("to", to);
        require((to - from).norm() > 0.0, "to", "is where from is", "give two points");
    }

    std::optional<ShapeFault> fault;

private:
    static constexpr const char* kFinite = "give finite numbers";
};

void check(const PlaneShape& shape, Door& door)
{
    door.finite("point", shape.point);
    door.direction("normal", shape.normal.norm());
}
void check(const SphereShape& shape, Door& door)
{
    door.finite("center", shape.centre);
    door.positive("radius", shape.radius);
}
void check(const BoxShape& shape, Door& door)
{
    door.finite("center", shape.centre);
    for (int axis = 0; axis < 3; ++axis) door.positive("half", shape.half[axis]);
    door.direction("rotate", shape.rotate.norm());
}
void check(const CapsuleShape& shape, Door& door)
{
    door.finite("from", shape.from);
    door.finite("to", shape.to);
    door.positive("radius", shape.radius);
}
void check(const CylinderShape& shape, Door& door)
{
    door.ends(shape.from, shape.to);
    door.positive("radius", shape.radius);
}
void check(const ConeShape& shape, Door& door)
{
    door.ends(shape.from, shape.to);
    door.positive("radius", shape.radius);
    door.require(shape.topRadius >= 0.0 && std::isfinite(shape.topRadius), "top_radius",
                 numberText(shape.topRadius) + " is out of range", "give 0 or more");
}
void check(const TorusShape& shape, Door& door)
{
    door.finite("center", shape.centre);
    door.direction("axis", shape.axis.norm());
    door.positive("major", shape.major);
    door.positive("minor", shape.minor);
    door.require(shape.minor < shape.major, "minor",
                 numberText(shape.minor) + " is not less than major " + numberText(shape.major), "give a thinner tube");
}
void check(const EllipsoidShape& shape, Door& door)
{
    door.finite("center", shape.centre);
    for (int axis = 0; axis < 3; ++axis) door.positive("radii", shape.radii[axis]);
}

template <class Form> FieldPtr fieldOf(const Form& form) { return std::make_shared<const FormField<Form>>(form); }

FieldPtr make(const PlaneShape& shape) { return fieldOf(PlaneForm(shape.point, shape.normal)); }
FieldPtr make(const SphereShape& shape) { return fieldOf(SphereForm(shape.centre, shape.radius)); }
FieldPtr make(const BoxShape& shape)
{
    return fieldOf(BoxForm(shape.centre, shape.half, shape.rotate.normalized().toRotationMatrix()));
}
FieldPtr make(const CapsuleShape& shape) { return fieldOf(CapsuleForm(shape.from, shape.to, shape.radius)); }
FieldPtr make(const CylinderShape& shape)
{
    return fieldOf(FrustumForm(shape.from, shape.to, shape.radius, shape.radius));
}
FieldPtr make(const ConeShape& shape)
{
    return fieldOf(FrustumForm(shape.from, shape.to, shape.radius, shape.topRadius));
}
FieldPtr make(const TorusShape& shape)
{
    return fieldOf(TorusForm(shape.centre, shape.axis, shape.major, shape.minor));
}
FieldPtr make(const EllipsoidShape& shape) { return fieldOf(EllipsoidForm(shape.centre, shape.radii)); }

} // namespace

std::optional<ShapeFault> findFault(const ShapeFormula& shape)
{
    Door door;
    std::visit([&](const auto& formula) { check(formula, door); }, shape);
    return door.fault;
}

FieldPtr makeField(const ShapeFormula& shape)
{
    if (const auto fault = findFault(shape))
        throw UsageError(std::string(nameOf(shape)) + " " + fault->name, fault->what, fault->remedy);
    return std::visit([](const auto& formula) { return make(formula); }, shape);
}

const char* nameOf(const ShapeFormula& shape)
{
    constexpr const char* kNames[] = {"plane", "sphere", "box", "capsule", "cylinder", "cone", "torus", "ellipsoid"};
    return kNames[shape.index()];
}

} // namespace vdbounce
