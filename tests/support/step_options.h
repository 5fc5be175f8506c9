// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/contact/step.h"

namespace vdbounce::test {

/// Steps of a millisecond.
inline StepOptions millisecond(Scheme scheme = Scheme::CollideContact)
{
    StepOptions options;
    options.dt = 1e-3;
    options.scheme = scheme;
    return options;
}

/// Steps of `dt` seconds without gravity.
inline StepOptions weightless(double dt)
{
    StepOptions options;
    options.dt = dt;
    options.gravity = Vec3d::Zero();
    return options;
}

} // namespace vdbounce::test
