// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/lookup_error.h"

#include <string>

namespace vdbounce {

/// What lookups in a level set's file are off by. Measured once: it is kept in `path`.accuracy beside the file, and
/// measured again when the file's content, or the list of choices, is another. Where nothing can be written there, it
/// is measured each time.
LookupErrors lookupErrorsOf(const std::string& path);

} // namespace vdbounce
