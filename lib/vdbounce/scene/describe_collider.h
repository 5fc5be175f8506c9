// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/collider.h"
#include "vdbounce/scene/band_needs.h"
#include "vdbounce/scene/collider_spec.h"

#include <string>

namespace vdbounce {

/// A collider in a line: what it is made of, how large that is, and of level sets the band that the particles need.
std::string describeCollider(const ColliderSpec& spec, const Collider& collider, const ContactReach& reach);

} // namespace vdbounce
