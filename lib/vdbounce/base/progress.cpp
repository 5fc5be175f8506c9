// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/progress.h"

#include "vdbounce/base/error.h"

namespace vdbounce {

Progress& Progress::none()
{
    static Progress instance;
    return instance;
}

void throwIfStopped(const Progress& progress)
{
    if (progress.stopRequested()) throw Interrupted();
}

} // namespace vdbounce
