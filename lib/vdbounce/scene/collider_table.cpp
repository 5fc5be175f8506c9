// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/collider_table.h"

#include "vdbounce/base/error.h"

#include <cmath>
#include <filesystem>

namespace vdbounce {
namespace {

ColliderSpec::Plane readPlane(SceneTable table)
{
    ColliderSpec::Plane plane;
    plane.point = table.vector("point", plane.point);
    plane.normal = table.vector("normal", plane.normal);
    table.finish();
    return plane;
}

Motion::Key readKey(SceneTable table)
{
    if (!table.has("time")) table.fail("time", "is missing", "give each key a time");
    Motion::Key key;
    key.time = table.number("time", 0.0);
    key.translate = table.vector("translate", key.translate);
    key.rotate = table.quaternion("rotate", key.rotate);
    if (!std::isfinite(key.time)) table.fail("time", "is not finite", "give a finite number of seconds");
    if (!key.translate.allFinite()) table.fail("translate", "is not finite", "give finite numbers");
    if (!(key.rotate.norm() > 0.0) || !std::isfinite(key.rotate.norm()))
        table.fail("rotate", "is no rotation", "give w, x, y, z that are finite and not all 0");
    table.finish();
    return key;
}

Motion readMotion(SceneTable table)
{
    if (!table.has("keys")) {
        Motion::Constant motion;
        motion.velocity = table.vector("velocity", motion.velocity);
        motion.angularVelocity = table.vector("angular_velocity", motion.angularVelocity);
        motion.centre = table.vector("center", motion.centre);
        if (!(motion.velocity + motion.angularVelocity + motion.centre).allFinite())
            table.fail("velocity", "or angular_velocity or center is not finite", "give finite numbers");
        table.finish();
        return Motion(motion);
    }
    std::vector<Motion::Key> keys;
    for (const SceneTable& key : table.tables("keys")) {
        keys.push_back(readKey(key));
        if (keys.size() > 1 && !(keys.back().time > keys[keys.size() - 2].time))
            key.fail("time", "is not after the key before", "order keys by time");
    }
    if (keys.empty()) table.fail("keys", "is empty", "give at least one key");
    table.finish();
    return Motion(std::move(keys));
}

ColliderSpec::Body readBody(SceneTable& table)
{
    ColliderSpec::Body body;
    body.mass = table.number("mass", body.mass);
    if (table.has("inertia")) body.inertia = table.vector("inertia", Vec3d::Ones());
    if (table.has("center_of_mass")) body.centre = table.vector("center_of_mass", Vec3d::Zero());
    return body;
}

void requireOneForm(const ColliderSpec& collider, const SceneTable& table)
{
    const int forms = int(!collider.file.empty()) + int(!collider.sequence.empty()) + int(collider.plane.has_value());
    if (forms != 1) {
        table.fail("file", "and sequence and plane: exactly one is needed",
                   "give file = \"shape.vdb\", sequence = \"shape.####.vdb\" or plane = { point, normal }");
    }
    if (!collider.sequence.empty() && !hasFramePattern(collider.sequence))
        table.fail("sequence", "has no #### for the frame", "write for example \"shape.####.vdb\", or use file");
}

void requireFreeToMove(const ColliderSpec& collider, const SceneTable& table)
{
    if (!collider.body) return;
    if (collider.plane) table.fail("mass", "is set, and a plane is endless", "remove it, or use a level set");
    if (!collider.sequence.empty()) table.fail("mass", "is set, and the collider deforms", "remove it, or use file");
    if (collider.motion.keyed())
        table.fail("mass", "is set, and motion has keys", "remove either: keys leave nothing for particles to move");
    if (collider.onHit == OnHit::Stick)
        table.fail("on_hit", "= \"stick\" is not possible with mass", "use \"bounce\" or remove mass");
}

} // namespace

std::string resolvedPath(const std::string& sceneFile, const std::string& path)
{
    if (path.empty() || std::filesystem::path(path).is_absolute()) return path;
    return (std::filesystem::path(sceneFile).parent_path() / path).string();
}

ColliderSpec readCollider(SceneTable table, const std::string& sceneFile, const std::string& name)
{
    ColliderSpec collider;
    collider.name = name;
    table.text("name", name);
    collider.file = resolvedPath(sceneFile, table.text("file", ""));
    collider.sequence = resolvedPath(sceneFile, table.text("sequence", ""));
    if (table.has("plane")) collider.plane = readPlane(table.table("plane"));
    for (const char* key : {"sphere", "box", "capsule", "cylinder", "torus", "heightfield", "csg"})
        table.refuseForNow(key, "use a level-set file or a plane");
    collider.restitution = table.number("restitution", collider.restitution);
    collider.friction = table.number("friction", collider.friction);
    const OnHit choices[] = {OnHit::Bounce, OnHit::Stick, OnHit::Delete};
    collider.onHit = choices[table.choice("on_hit", {"bounce", "stick", "delete"}, 0)];
    if (table.has("motion")) collider.motion = readMotion(table.table("motion"));
    if (table.has("mass")) collider.body = readBody(table);
    requireOneForm(collider, table);
    requireFreeToMove(collider, table);
    table.finish();
    return collider;
}

} // namespace vdbounce
