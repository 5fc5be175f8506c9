// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>

namespace vdbounce {

/// Sets one "key=value" in a parsed scene. A part of the key behind "collider" is a collider's name or its number from
/// 0. Throws UsageError where there is no '=' or no such collider.
void applyOverride(toml::table& scene, const std::string& override);

} // namespace vdbounce
