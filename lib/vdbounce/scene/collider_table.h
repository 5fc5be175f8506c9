// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/scene.h"
#include "vdbounce/scene/scene_table.h"

#include <string>

namespace vdbounce {

/// Reads one [[collider]]. Throws InputError as SceneTable does.
ColliderSpec readCollider(SceneTable& table, const std::string& sceneFile, const std::string& name);

} // namespace vdbounce
