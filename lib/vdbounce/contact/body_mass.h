// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/rigid_body.h"
#include "vdbounce/contact/shape.h"

#include <optional>

namespace vdbounce {

/// Centre and inertia of a shape that is of even density inside and weighs `mass`. Summed over a lattice of 96 points
/// along the longest side of its box, each for the part of its cell that is inside: within 0.1 % for smooth shapes.
/// Nothing for a shape that is endless or has no inside.
std::optional<BodyMass> evenDensity(const Shape& shape, double mass);

} // namespace vdbounce
