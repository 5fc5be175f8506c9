// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/vdb_archive.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/safe_file.h"

#include <cstdio>
#include <cstring>
#include <functional>
#include <new>

#include <fcntl.h>
#include <unistd.h>

namespace vdbounce {
namespace {

// Where a .vdb header keeps its file id, a UUID in text form: behind the magic number (8 bytes), the
// format version (4), the library version (8) and the flag for grid offsets (1). Same since file version 222.
constexpr std::size_t kIdOffset = 21;
constexpr std::size_t kIdLength = 36;

// FNV-1a over 8 bytes at a time with a shift that lets high bits reach low ones; two seeds give the id's 128 bits.
std::uint64_t contentHash(std::string_view bytes, std::uint64_t seed)
{
    constexpr std::uint64_t kPrime = 0x100000001b3ULL;
    std::uint64_t hash = seed;
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
        hash = (hash ^ word) * kPrime;
        hash ^= hash >> 29;
    }
    return hash;
}

std::string contentId(std::string_view content)
{
    const std::uint64_t a = contentHash(content, 0xcbf29ce484222325ULL);
    const std::uint64_t b = contentHash(content, 0x9e3779b97f4a7c15ULL);
    char text[kIdLength + 1];
    std::snprintf(text, sizeof(text), "%08x-%04x-%04x-%04x-%012llx", static_cast<unsigned>(a >> 32),
                  static_cast<unsigned>((a >> 16) & 0xffff), static_cast<unsigned>(a & 0xffff),
                  static_cast<unsigned>(b >> 48), static_cast<unsigned long long>(b & 0xffffffffffffULL));
    return text;
}

void replaceFileId(const std::string& path)
{
    std::string id;
    {
        const FileBytes bytes(path);
        const std::string_view view = bytes.view();
        if (view.size() < kIdOffset + kIdLength || view[kIdOffset + 8] != '-') {
            throw RunError(path, "OpenVDB wrote a header of unknown layout", "build with OpenVDB 10");
        }
        id = contentId(view.substr(kIdOffset + kIdLength));
    }
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const bool written = descriptor >= 0 && ::pwrite(descriptor, id.data(), kIdLength, kIdOffset) == ssize_t(kIdLength);
    if (descriptor >= 0) ::close(descriptor);
    if (!written) throw RunError(path, "cannot write its header", "check that the disk has room");
}

} // namespace

void initializeOpenVdb()
{
    static const bool done = (openvdb::initialize(), true);
    (void)done;
}

void withVdbFile(const std::string& path, const std::function<void(openvdb::io::File&)>& body)
{
    initializeOpenVdb();
    requireReadableFile(path);
    try {
        openvdb::io::File file(path);
        // Without delayed loading: values are needed at once, and the file may change under us.
        file.open(/*delayLoad=*/false);
        body(file);
    } catch (const openvdb::Exception& error) {
        throw InputError(path, std::string("cannot be read as OpenVDB (") + error.what() + ")",
                         "it is damaged or no .vdb file; write it again");
    } catch (const std::bad_alloc&) {
        // What OpenVDB makes of a file that is cut short may be a count of anything.
        throw InputError(path, "asks for more memory than there is",
                         "it is damaged, or too large for this machine; write it again, with larger voxels");
    }
}

std::vector<VdbGridHeader> readVdbHeaders(openvdb::io::File& file)
{
    std::vector<VdbGridHeader> headers;
    for (auto name = file.beginName(); name != file.endName(); ++name) {
        headers.push_back({name.gridName(), file.readGridMetadata(name.gridName())});
    }
    return headers;
}

void writeVdbFile(const openvdb::GridCPtrVec& grids, const std::string& path)
{
    initializeOpenVdb();
    SafeFile safe(path);
    try {
        openvdb::io::File file(safe.temporaryPath());
        file.write(grids);
        file.close();
    } catch (const std::exception& error) {
        throw RunError(path, std::string("cannot be written (") + error.what() + ")", "check that the disk has room");
    }
    replaceFileId(safe.temporaryPath());
    safe.commit();
}

} // namespace vdbounce
