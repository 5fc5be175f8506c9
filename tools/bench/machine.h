// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce::bench {

/// The processor, the number of threads that this run may use and the vector instructions that it uses, in words.
std::string machineText();

} // namespace vdbounce::bench
