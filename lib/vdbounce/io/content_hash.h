// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vdbounce {

/// What tells a file's content from others': 128 bits in hexadecimal (XXH3), no protection against forgery. Throws
/// InputError where the file cannot be read. Cost: reading it, some GB/s from memory.
std::string contentHash(const std::string& path);

} // namespace vdbounce
