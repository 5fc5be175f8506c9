// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/mesh_assembly.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/text_cursor.h"

namespace vdbounce {
namespace {

// Each corner takes at least a digit and a blank, so a face cannot have more corners than the file has bytes.
void requirePlausibleCount(const TextCursor& text, std::int64_t count, const char* what)
{
    if (count < 0 || static_cast<std::uint64_t>(count) > text.rest().size() + 1) {
        text.fail("a count of " + std::to_string(count) + " " + what + " does not fit the file's size",
                  "correct the counts or export the mesh again");
    }
}

void skipHeader(TextCursor& text)
{
    if (!text.skipToToken()) text.fail("the file is empty", "export the mesh again");
    const std::string_view magic = text.tokenOnLine();
    // Prefixes such as C, N and ST announce more numbers behind each vertex's position, which are passed over.
    if (magic.size() < 3 || magic.substr(magic.size() - 3) != "OFF" || magic.find('4') != std::string_view::npos) {
        text.fail("does not start with OFF", "name a text OFF file of three-dimensional points");
    }
    if (text.tokenOnLine() == "BINARY") text.fail("is a binary OFF file", "convert it to text OFF or to ply");
}

} // namespace

TriangleMesh readOff(const std::string& path)
{
    const FileBytes bytes(path);
    TextCursor text(path, bytes.view(), TextCursor::Comments::Hash);
    // "OFF" may stand alone on its line or before the counts; looking at a copy decides without losing any.
    skipHeader(text);
    text = TextCursor(path, bytes.view(), TextCursor::Comments::Hash);
    text.skipToToken();
    text.tokenOnLine();

    const std::int64_t pointCount = text.requireInteger("the number of vertices");
    const std::int64_t faceCount = text.requireInteger("the number of faces");
    requirePlausibleCount(text, pointCount, "vertices");
    requirePlausibleCount(text, faceCount, "faces");
    text.nextLine(); // the number of edges, which may be missing

    MeshAssembly assembly(path);
    for (std::int64_t i = 0; i < pointCount; ++i) {
        Vec3d point;
        for (int axis = 0; axis < 3; ++axis) point[axis] = text.requireNumber("a vertex coordinate");
        assembly.addPoint(point);
        text.nextLine();
    }
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < faceCount; ++i) {
        const std::int64_t cornerCount = text.requireInteger("the number of a face's corners");
        requirePlausibleCount(text, cornerCount, "corners");
        corners.clear();
        for (std::int64_t c = 0; c < cornerCount; ++c) corners.push_back(text.requireInteger("a face's corner"));
        assembly.addFace(corners, [&] { return path + ":" + std::to_string(text.line()); });
        text.nextLine(); // colours
    }
    return assembly.finish();
}

} // namespace vdbounce
