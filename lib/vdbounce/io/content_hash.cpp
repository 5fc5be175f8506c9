// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/content_hash.h"

#include "vdbounce/io/file_bytes.h"

#include <cstdint>

#define XXH_INLINE_ALL // no library to link
#include <xxhash.h>

namespace vdbounce {

std::string contentHash(const std::string& path)
{
    const FileBytes bytes(path);
    XXH128_canonical_t hash;
    XXH128_canonicalFromHash(&hash, XXH3_128bits(bytes.view().data(), bytes.view().size()));
    std::string text;
    for (const std::uint8_t byte : hash.digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

} // namespace vdbounce
