// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/collider_spec.h"
#include "vdbounce/scene/scene_table.h"

#include <string>

namespace vdbounce {

/// Reads which form a [[collider]] has: `file`, `sequence`, a shape by formula or `csg`; exactly one. Throws InputError
/// as SceneTable does. `sceneFile` is where relative paths start.
void readForm(SceneTable& table, const std::string& sceneFile, ColliderSpec& collider);

/// Throws InputError for CSG of colliders that the scene does not have, or of itself by whatever detour.
/// `tables` are those of the colliders, in their order.
void requireOperands(const std::vector<ColliderSpec>& colliders, const std::vector<SceneTable>& tables);

/// A path as a scene file has it, which starts at the file's folder.
std::string resolvedPath(const std::string& sceneFile, const std::string& path);

} // namespace vdbounce
