// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/motion.h"
#include "vdbounce/contact/shape.h"
#include "vdbounce/implicit/implicit_field.h"

#include <memory>

namespace vdbounce {

/// Any collider's shape, with a motion of its own, as an operand of CSG: level sets, sequences of them and planes
/// beside shapes by formula.
std::shared_ptr<const ImplicitField> asField(const Shape& shape, const Motion& motion = {});

} // namespace vdbounce
