// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/io/byte_order.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/mesh_assembly.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/text_cursor.h"

namespace vdbounce {
namespace {

// Binary STL: 80 bytes of anything, a count, then 50 bytes a triangle: normal, three corners, 2 bytes of attributes.
constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kCountOffset = 80;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kCornerBytes = 12;

TriangleMesh readBinary(const std::string& path, std::string_view bytes)
{
    if (bytes.size() < kHeaderBytes) {
        throw InputError(path, "ends after " + std::to_string(bytes.size()) + " bytes, before an STL header does",
                         "export the mesh again");
    }
    const auto count = loadNumber<std::uint32_t>(bytes.data() + kCountOffset, ByteOrder::Little);
    const std::size_t held = (bytes.size() - kHeaderBytes) / kTriangleBytes;
    if (held < count) {
        throw InputError(path, "announces " + std::to_string(count) + " triangles but holds " + std::to_string(held),
                         "the file is cut short or is no STL; export the mesh again");
    }
    MeshAssembly assembly(path);
    std::vector<std::int64_t> corners(3);
    for (std::size_t t = 0; t < count; ++t) {
        const char* triangle = bytes.data() + kHeaderBytes + t * kTriangleBytes + kNormalBytes;
        const auto place = [&] { return path + ": triangle " + std::to_string(t); };
        for (std::size_t c = 0; c < 3; ++c) {
            const char* corner = triangle + c * kCornerBytes;
            Vec3d point;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                point[static_cast<int>(axis)] = loadNumber<float>(corner + axis * sizeof(float), ByteOrder::Little);
            }
            corners[c] = static_cast<std::int64_t>(assembly.pointCount());
            if (!point.allFinite()) assembly.addPoint(point, place());
            assembly.addPoint(point);
        }
        assembly.addFace(corners, place);
    }
    return assembly.finish();
}

TriangleMesh readText(const std::string& path, std::string_view bytes)
{
    TextCursor text(path, bytes, TextCursor::Comments::None);
    MeshAssembly assembly(path);
    std::vector<std::int64_t> corners;
    bool inLoop = false;
    bool ended = false;
    const auto place = [&] { return path + ":" + std::to_string(text.line()); };
    while (text.skipToToken()) {
        const std::string_view keyword = text.tokenOnLine();
        if (keyword == "outer") {
            if (inLoop) text.fail("a loop starts inside a loop", "an 'endloop' is missing before it");
            inLoop = true;
            corners.clear();
        } else if (keyword == "vertex") {
            if (!inLoop) text.fail("a vertex outside of 'outer loop'", "export the mesh again");
            Vec3d point;
            for (int axis = 0; axis < 3; ++axis) point[axis] = text.requireNumber("a vertex coordinate");
            corners.push_back(static_cast<std::int64_t>(assembly.pointCount()));
            assembly.addPoint(point, place());
        } else if (keyword == "endloop") {
            if (!inLoop) text.fail("'endloop' without 'outer loop'", "export the mesh again");
            assembly.addFace(corners, place);
            inLoop = false;
        }
        ended = keyword == "endsolid";
        text.nextLine();
    }
    if (inLoop || !ended) text.fail("the file ends before 'endsolid'", "the file is cut short; export the mesh again");
    return assembly.finish();
}

// Binary headers may start with "solid" too, so the size decides first.
bool isBinary(std::string_view bytes)
{
    if (bytes.size() >= kHeaderBytes) {
        const auto count = loadNumber<std::uint32_t>(bytes.data() + kCountOffset, ByteOrder::Little);
        if (bytes.size() == kHeaderBytes + std::size_t(count) * kTriangleBytes) return true;
    }
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    return start == std::string_view::npos || bytes.substr(start, 5) != "solid" ||
           bytes.find('\0') != std::string_view::npos;
}

} // namespace

TriangleMesh readStl(const std::string& path)
{
    const FileBytes bytes(path);
    if (bytes.view().empty()) throw InputError(path, "is empty", "export the mesh again");
    TriangleMesh mesh = isBinary(bytes.view()) ? readBinary(path, bytes.view()) : readText(path, bytes.view());
    weldEqualPoints(mesh);
    return mesh;
}

} // namespace vdbounce
