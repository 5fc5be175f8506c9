// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/scene_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/scene/collider_table.h"
#include "vdbounce/scene/scene_overrides.h"
#include "vdbounce/scene/scene_table.h"
#include "vdbounce/scene/shape_table.h"

#include <filesystem>
#include <set>

namespace vdbounce {
namespace {

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
    scene.particleFile = resolvedPath(sceneFile, table.text("file", ""));
    if (scene.particleFile.empty()) table.fail("file", "is missing", "name the particle file, file = \"cloud.vdb\"");
    scene.radius = table.length("radius", scene.radius);
    scene.mass = table.number("mass", scene.mass);
    scene.interact = table.boolean("interact", scene.interact);
    scene.particles.restitution = table.number("restitution", scene.particles.restitution);
    scene.particles.friction = table.number("friction", scene.particles.friction);
    table.finish();
}

template <class Enum, std::size_t N>
Enum namedChoice(SceneTable& table, const char* key, const char* const (&names)[N], Enum otherwise)
{
    return Enum(table.choice(key, {names, names + N}, std::size_t(otherwise)));
}

void readContact(SceneTable table, Scene& scene)
{
    scene.scheme = namedChoice(table, "scheme", kSchemeNames, scene.scheme);
    scene.maxBounces = table.integer("max_bounces", scene.maxBounces);
    scene.sweep = namedChoice(table, "sweep", kSweepNames, scene.sweep);
    SceneTable repulsion = table.table("repulsion");
    scene.repulsionRange = repulsion.length("range", scene.repulsionRange);
    scene.repulsionStrength = repulsion.number("strength", scene.repulsionStrength);
    repulsion.finish();
    table.finish();
}

void readAccuracy(SceneTable table, Scene& scene)
{
    FieldOptions& accuracy = scene.accuracy;
    accuracy.lookup = namedChoice(table, "lookup", kLookupNames, accuracy.lookup);
    accuracy.normal = namedChoice(table, "normal", kNormalNames, accuracy.normal);
    accuracy.storage = namedChoice(table, "storage", kStorageNames, accuracy.storage);
    if (table.has("max_error")) {
        for (const char* key : {"lookup", "normal", "storage"}) {
            if (table.has(key)) table.fail(key, "is chosen by max_error", "remove one of the two");
        }
        scene.maxError = table.length("max_error", Length());
    }
    table.finish();
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
    std::vector<SceneTable> tables;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const toml::table& table = *(*array)[i].as_table();
        const std::string name = table["name"].value_or(std::string("collider") + std::to_string(i));
        if (!names.insert(name).second) {
            throw InputError(sceneFile + ":" + std::to_string(table.source().begin.line),
                             "two colliders are called '" + name + "'", "give each a name of its own");
        }
        tables.emplace_back(sceneFile, "collider '" + name + "'", table);
        scene.colliders.push_back(readCollider(tables.back(), sceneFile, name));
    }
    requireOperands(scene.colliders, tables);
}

void readOutput(SceneTable table, const std::string& sceneFile, Scene& scene)
{
    scene.outputFile = resolvedPath(sceneFile, table.text("file", ""));
    scene.every = table.integer("every", scene.every);
    scene.hits = table.boolean("hits", scene.hits);
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
    readAccuracy(table.table("accuracy"), scene);
    readColliders(root, path, scene);
    table.markKnown("collider");
    readOutput(table.table("output"), path, scene);
    table.finish();
    if (const auto fault = findFault(scene)) refuseFault(root, path, *fault);
    return scene;
}

} // namespace vdbounce
