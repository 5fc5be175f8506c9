// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/scene/scene.h"

#include <string>
#include <vector>

namespace vdbounce {

/// Reads a scene file (TOML; the keys and their defaults are in docs/scene.md). Relative paths in it start at its
/// folder.
///
/// `overrides` are "key=value" with the key as in the file, "time.dt=0.002" or "collider.bunny.friction=0", and the
/// value in TOML; a value that is no TOML is taken as text.
///
/// Throws InputError, naming file, line and key, for what is no TOML, for unknown keys, wrong types and values out of
/// range.
Scene readScene(const std::string& path, const std::vector<std::string>& overrides = {});

} // namespace vdbounce
