// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/shape_table.h"

#include "vdbounce/scene/scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

namespace vdbounce {
namespace {

ShapeFormula readPlane(SceneTable& table)
{
    PlaneShape shape;
    shape.point = table.vector("point", shape.point);
    shape.normal = table.vector("normal", shape.normal);
    return shape;
}
ShapeFormula readSphere(SceneTable& table)
{
    table.require("radius");
    SphereShape shape;
    shape.centre = table.vector("center", shape.centre);
    shape.radius = table.number("radius", shape.radius);
    return shape;
}
ShapeFormula readBox(SceneTable& table)
{
    table.require("half");
    BoxShape shape;
    shape.centre = table.vector("center", shape.centre);
    shape.half = table.vector("half", shape.half);
    shape.rotate = table.quaternion("rotate", shape.rotate);
    return shape;
}

// What capsule, cylinder and cone have.
template <class Shape> Shape readEnds(SceneTable& table)
{
    for (const char* key : {"from", "to", "radius"}) table.require(key);
    Shape shape;
    shape.from = table.vector("from", shape.from);
    shape.to = table.vector("to", shape.to);
    shape.radius = table.number("radius", shape.radius);
    return shape;
}
ShapeFormula readCapsule(SceneTable& table) { return readEnds<CapsuleShape>(table); }
ShapeFormula readCylinder(SceneTable& table) { return readEnds<CylinderShape>(table); }
ShapeFormula readCone(SceneTable& table)
{
    auto shape = readEnds<ConeShape>(table);
    shape.topRadius = table.number("top_radius", shape.topRadius);
    return shape;
}
ShapeFormula readTorus(SceneTable& table)
{
    for (const char* key : {"major", "minor"}) table.require(key);
    TorusShape shape;
    shape.centre = table.vector("center", shape.centre);
    shape.axis = table.vector("axis", shape.axis);
    shape.major = table.number("major", shape.major);
    shape.minor = table.number("minor", shape.minor);
    return shape;
}
ShapeFormula readEllipsoid(SceneTable& table)
{
    table.require("radii");
    EllipsoidShape shape;
    shape.centre = table.vector("center", shape.centre);
    shape.radii = table.vector("radii", shape.radii);
    return shape;
}

struct FormulaReader {
    const char* key;
    ShapeFormula (*read)(SceneTable&);
};
constexpr std::array<FormulaReader, 8> kFormulas = {{{"plane", readPlane},
                                                     {"sphere", readSphere},
                                                     {"box", readBox},
                                                     {"capsule", readCapsule},
                                                     {"cylinder", readCylinder},
                                                     {"cone", readCone},
                                                     {"torus", readTorus},
                                                     {"ellipsoid", readEllipsoid}}};

void readFormula(SceneTable& table, ColliderSpec& collider)
{
    for (const FormulaReader& formula : kFormulas) {
        if (!table.has(formula.key)) continue;
        SceneTable inner = table.table(formula.key);
        collider.formula = formula.read(inner);
        inner.finish();
        if (const auto fault = findFault(*collider.formula))
            inner.fail(fault->name.c_str(), fault->what, fault->remedy);
    }
}

ColliderSpec::Heightfield readHeightfield(SceneTable table, const std::string& sceneFile)
{
    for (const char* key : {"file", "min", "max"}) table.require(key);
    ColliderSpec::Heightfield heightfield;
    heightfield.file = resolvedPath(sceneFile, table.text("file", ""));
    heightfield.place.min = table.vector("min", heightfield.place.min);
    heightfield.place.max = table.vector("max", heightfield.place.max);
    if (table.has("base")) heightfield.place.base = table.number("base", 0.0);
    table.finish();
    return heightfield;
}

ColliderSpec::Blobs readBlobs(SceneTable table, const std::string& sceneFile)
{
    for (const char* key : {"file", "voxel"}) table.require(key);
    const BlobKernel kernels[] = {BlobKernel::Gaussian, BlobKernel::Compact, BlobKernel::Sphere};
    ColliderSpec::Blobs blobs;
    blobs.file = resolvedPath(sceneFile, table.text("file", ""));
    BlobOptions& options = blobs.options;
    options.voxelSize = table.number("voxel", 0.0);
    if (!(options.voxelSize > 0.0)) table.fail("voxel", "is out of range", "give a positive length");
    options.kernel = kernels[table.choice("kernel", {"gaussian", "compact", "sphere"}, 0)];
    if (table.has("threshold")) options.threshold = table.number("threshold", 0.0);
    if (table.has("radius")) options.radius = table.length("radius", {});
    options.strength = table.number("strength", options.strength);
    options.halfWidthVx = table.length("band", {options.halfWidthVx, true}).voxels(options.voxelSize);
    table.finish();
    return blobs;
}

ColliderSpec::Csg readCsg(SceneTable table)
{
    const CsgOperation operations[] = {CsgOperation::Union, CsgOperation::Intersection, CsgOperation::Subtraction,
                                       CsgOperation::Complement};
    for (const char* key : {"op", "of"}) table.require(key);
    ColliderSpec::Csg csg;
    csg.operation = operations[table.choice("op", {"union", "intersect", "subtract", "complement"}, 0)];
    csg.of = table.texts("of");
    csg.blend = table.length("blend", csg.blend);
    const bool one = csg.operation == CsgOperation::Complement;
    if (one && csg.of.size() != 1) table.fail("of", "names not one collider", "complement takes one");
    if (!one && csg.of.size() < 2) table.fail("of", "names fewer than two colliders", "give two or more");
    if (one && csg.blend.value != 0.0) table.fail("blend", "rounds no edge of a complement", "remove it");
    table.finish();
    return csg;
}

// The keys that say which form a collider has.
std::vector<const char*> formKeys()
{
    std::vector<const char*> keys = {"file", "sequence", "heightfield", "blobs", "csg"};
    for (const FormulaReader& formula : kFormulas) keys.push_back(formula.key);
    return keys;
}

// Follows operands down, and complains of whatever leads back to where it is on the way.
class OperandCheck {
public:
    OperandCheck(const std::vector<ColliderSpec>& colliders, const std::vector<SceneTable>& tables)
        : colliders_(colliders), tables_(tables), states_(colliders.size(), State::New)
    {
        for (std::size_t i = 0; i < colliders.size(); ++i) places_[colliders[i].name] = i;
    }

    void follow(std::size_t i)
    {
        if (states_[i] == State::Done || !colliders_[i].csg) return;
        states_[i] = State::OnTheWay;
        for (const std::string& name : colliders_[i].csg->of) {
            const auto found = places_.find(name);
            if (found == places_.end())
                tables_[i].fail("csg", "is of '" + name + "', which is no collider", "name one of the scene's");
            if (states_[found->second] == State::OnTheWay)
                tables_[i].fail("csg", "is of '" + name + "', which is made of it", "break the circle");
            follow(found->second);
        }
        states_[i] = State::Done;
    }

private:
    enum class State { New, OnTheWay, Done };

    const std::vector<ColliderSpec>& colliders_;
    const std::vector<SceneTable>& tables_;
    std::map<std::string, std::size_t> places_;
    std::vector<State> states_;
};

} // namespace

std::string resolvedPath(const std::string& sceneFile, const std::string& path)
{
    if (path.empty() || std::filesystem::path(path).is_absolute()) return path;
    return (std::filesystem::path(sceneFile).parent_path() / path).string();
}

void readForm(SceneTable& table, const std::string& sceneFile, ColliderSpec& collider)
{
    const std::vector<const char*> keys = formKeys();
    const auto given = std::count_if(keys.begin(), keys.end(), [&](const char* key) { return table.has(key); });
    if (given != 1) {
        table.fail(
            given > 1 ? *std::find_if(keys.begin(), keys.end(), [&](auto key) { return table.has(key); }) : "file",
            "is one of " + std::to_string(given) + " forms: exactly one is needed",
            "give file, sequence, csg or a shape: plane, sphere, box, capsule, cylinder, cone, torus, ellipsoid, "
            "heightfield, blobs");
    }
    collider.file = resolvedPath(sceneFile, table.text("file", ""));
    collider.sequence = resolvedPath(sceneFile, table.text("sequence", ""));
    if (!collider.sequence.empty() && !hasFramePattern(collider.sequence))
        table.fail("sequence", "has no #### for the frame", "write for example \"shape.####.vdb\", or use file");
    readFormula(table, collider);
    if (table.has("heightfield")) collider.heightfield = readHeightfield(table.table("heightfield"), sceneFile);
    if (table.has("blobs")) collider.blobs = readBlobs(table.table("blobs"), sceneFile);
    if (table.has("csg")) collider.csg = readCsg(table.table("csg"));
    for (const char* key : keys) table.markKnown(key);
}

void requireOperands(const std::vector<ColliderSpec>& colliders, const std::vector<SceneTable>& tables)
{
    OperandCheck check(colliders, tables);
    for (std::size_t i = 0; i < colliders.size(); ++i) check.follow(i);
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        if (!colliders[i].csg) continue;
        for (const std::string& name : colliders[i].csg->of) {
            for (std::size_t k = 0; k < colliders.size(); ++k) {
                if (colliders[k].name != name) continue;
                for (const char* key : {"restitution", "friction", "on_hit", "mass"}) {
                    if (tables[k].has(key))
                        tables[k].fail(key, "is set, and collider '" + colliders[i].name + "' is made of it",
                                       "set it there");
                }
            }
        }
    }
}

} // namespace vdbounce
