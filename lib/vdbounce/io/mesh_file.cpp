// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/mesh_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"

namespace vdbounce {
namespace {

struct MeshFormat {
    const char* ending;
    TriangleMesh (*read)(const std::string&);
};
constexpr MeshFormat kFormats[] = {{"obj", readObj}, {"stl", readStl}, {"ply", readPlyMesh}, {"off", readOff}};

const MeshFormat* findFormat(const std::string& path)
{
    const std::string ending = fileEnding(path);
    for (const MeshFormat& format : kFormats) {
        if (ending == format.ending) return &format;
    }
    return nullptr;
}

} // namespace

bool isMeshFile(const std::string& path) { return findFormat(path) != nullptr; }

TriangleMesh readMesh(const std::string& path)
{
    requireReadableFile(path);
    const MeshFormat* format = findFormat(path);
    if (format == nullptr) {
        throw InputError(path, "'." + fileEnding(path) + "' is no mesh format that can be read",
                         "use .obj, .stl, .ply or .off");
    }
    return format->read(path);
}

} // namespace vdbounce
