// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/scene/collider_table.h"

#include "vdbounce/scene/shape_table.h"

#include <cmath>

namespace vdbounce {
namespace {

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

void requireFreeToMove(const ColliderSpec& collider, const SceneTable& table)
{
    if (!collider.body) return;
    if (collider.formula && std::holds_alternative<PlaneShape>(*collider.formula))
        table.fail("mass", "is set, and a plane is endless", "remove it, or use a level set");
    if (!collider.sequence.empty()) table.fail("mass", "is set, and the collider deforms", "remove it, or use file");
    if (collider.motion.keyed())
        table.fail("mass", "is set, and motion has keys", "remove either: keys leave nothing for particles to move");
    if (collider.onHit == OnHit::Stick)
        table.fail("on_hit", "= \"stick\" is not possible with mass", "use \"bounce\" or remove mass");
}

} // namespace

ColliderSpec readCollider(SceneTable& table, const std::string& sceneFile, const std::string& name)
{
    ColliderSpec collider;
    collider.name = name;
    table.text("name", name);
    readForm(table, sceneFile, collider);
    collider.restitution = table.number("restitution", collider.restitution);
    collider.friction = table.number("friction", collider.friction);
    const OnHit choices[] = {OnHit::Bounce, OnHit::Stick, OnHit::Delete};
    collider.onHit = choices[table.choice("on_hit", {"bounce", "stick", "delete"}, 0)];
    if (table.has("motion")) collider.motion = readMotion(table.table("motion"));
    if (table.has("mass")) collider.body = readBody(table);
    requireFreeToMove(collider, table);
    table.finish();
    return collider;
}

} // namespace vdbounce
