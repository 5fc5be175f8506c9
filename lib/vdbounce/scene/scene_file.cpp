// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/scene/scene_overrides.h"
#include "vdbounce/scene/scene_table.h"

#include <filesystem>
#include <set>

namespace vdbounce {
namespace {

std::string resolved(const std::string& sceneFile, const std::string& path)
{
    if (path.empty() || std::filesystem::path(path).is_absolute()) return path;
    return (std::filesystem::path(sceneFile).parent_path() / path).string();
}

void readTime(SceneTable table, Scene& scene)
{
    scene.dt = table.number("dt", scene.dt);
    scene.stepsPerFrame = table.integer("steps_per_frame", scene.stepsPerFrame);
    scene.frames = table.integer("frames", scene.frames);
    table.finish();
}

void readWorld(SceneTable table, Scene& scene)
{
    scene.gravity = table.vector("gravity", scene.gravity);
    table.finish();
}

void readParticles(SceneTable table, const std::string& sceneFile, Scene& scene)
{
    scene.particleFile = resolved(sceneFile, table.text("file", ""));
    if (scene.particleFile.empty()) table.fail("file", "is missing", "name the particle file, file = \"cloud.vdb\"");
    scene.radius = table.length("radius", scene.radius);
    scene.mass = table.number("mass", scene.mass);
    if (table.boolean("interact", false)) {
        table.fail("interact", "= true is not supported by this version",
                   "remove it; particles then pass through each other");
    }
    table.finish();
}

void readContact(SceneTable table, Scene& scene)
{
    const std::vector<std::string> schemes = {"collide-contact", "once", "iterate"};
    if (table.choice("scheme", schemes, 0) != 0) {
        table.fail("scheme", "is not supported by this version", "use \"collide-contact\"");
    }
    scene.maxBounces = table.integer("max_bounces", scene.maxBounces);
    const Sweep sweeps[] = {Sweep::Auto, Sweep::Always, Sweep::Never};
    scene.sweep = sweeps[table.choice("sweep", {"auto", "always", "never"}, 0)];
    SceneTable repulsion = table.table("repulsion");
    if (repulsion.number("range", 0.0) != 0.0) {
        repulsion.fail("range", "is not supported by this version", "set it to 0");
    }
    repulsion.number("strength", 0.0);
    repulsion.finish();
    table.finish();
}

void readAccuracy(SceneTable table)
{
    const auto onlyFirst = [&](const char* key, const std::vector<std::string>& choices) {
        if (table.choice(key, choices, 0) != 0) {
            table.fail(key, "is not supported by this version", "use \"" + choices[0] + "\"");
        }
    };
    onlyFirst("lookup", {"trilinear", "nearest", "cubic"});
    onlyFirst("normal", {"central", "analytic"});
    onlyFirst("storage", {"float", "half", "fixed8"});
    table.refuseForNow("max_error", "remove it");
    table.finish();
}

ColliderSpec::Plane readPlane(SceneTable table)
{
    ColliderSpec::Plane plane;
    plane.point = table.vector("point", plane.point);
    plane.normal = table.vector("normal", plane.normal);
    table.finish();
    return plane;
}

ColliderSpec readCollider(SceneTable table, const std::string& sceneFile, const std::string& name)
{
    ColliderSpec collider;
    collider.name = name;
    table.text("name", name);
    collider.file = resolved(sceneFile, table.text("file", ""));
    if (table.has("plane")) collider.plane = readPlane(table.table("plane"));
    for (const char* key :
         {"sequence", "sphere", "box", "capsule", "cylinder", "torus", "heightfield", "csg", "motion"}) {
        table.refuseForNow(key, "use a level-set file or a plane that does not move");
    }
    collider.restitution = table.number("restitution", collider.restitution);
    collider.friction = table.number("friction", collider.friction);
    if (table.choice("on_hit", {"bounce", "stick", "delete"}, 0) != 0) {
        table.fail("on_hit", "is not supported by this version", "use \"bounce\"");
    }
    if (collider.file.empty() == !collider.plane.has_value()) {
        table.fail("file", "and plane: exactly one is needed",
                   "give file = \"shape.vdb\" or plane = { point, normal }");
    }
    table.finish();
    return collider;
}

void readColliders(const toml::table& root, const std::string& sceneFile, Scene& scene)
{
    const toml::node* node = root.get("collider");
    if (node == nullptr) return;
    const toml::array* array = node->as_array();
    if (array == nullptr || !array->is_array_of_tables()) {
        throw InputError(sceneFile + ":" + std::to_string(node->source().begin.line),
                         "collider is not a list of tables", "write [[collider]] in double brackets");
    }
    std::set<std::string> names;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::table& table = *(*array)[i].as_table();
        const std::string name = table["name"].value_or(std::string("collider") + std::to_string(i));
        if (!names.insert(name).second) {
            throw InputError(sceneFile + ":" + std::to_string(table.source().begin.line),
                             "two colliders are called '" + name + "'", "give each a name of its own");
        }
        scene.colliders.push_back(
            readCollider(SceneTable(sceneFile, "collider '" + name + "'", table), sceneFile, name));
    }
}

void readOutput(SceneTable table, const std::string& sceneFile, Scene& scene)
{
    scene.outputFile = resolved(sceneFile, table.text("file", ""));
    scene.every = table.integer("every", scene.every);
    table.finish();
}

[[noreturn]] void refuseFault(const toml::table& root, const std::string& path, const SceneFault& fault)
{
    const auto node = toml::at_path(root, fault.path);
    const auto line = node ? node.node()->source().begin.line : 0;
    throw InputError(line > 0 ? path + ":" + std::to_string(line) : path,
                     fault.path + " = " + numberText(fault.value) + " is out of range", fault.remedy);
}

toml::table parse(const std::string& path)
{
    const FileBytes bytes(path);
    try {
        return toml::parse(bytes.view(), path);
    } catch (const toml::parse_error& error) {
        throw InputError(path + ":" + std::to_string(error.source().begin.line),
                         "is no TOML (" + std::string(error.description()) + ")", "correct the line");
    }
}

} // namespace

Scene readScene(const std::string& path, const std::vector<std::string>& overrides)
{
    toml::table root = parse(path);
    for (const std::string& override : overrides) applyOverride(root, override);

    Scene scene;
    SceneTable table(path, "", root);
    readTime(table.table("time"), scene);
    readWorld(table.table("world"), scene);
    readParticles(table.table("particles"), path, scene);
    readContact(table.table("contact"), scene);
    readAccuracy(table.table("accuracy"));
    readColliders(root, path, scene);
    table.markKnown("collider");
    readOutput(table.table("output"), path, scene);
    table.finish();
    if (const auto fault = findFault(scene)) refuseFault(root, path, *fault);
    return scene;
}

} // namespace vdbounce
