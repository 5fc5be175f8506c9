// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"
#include "vdbounce/io/mesh_assembly.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/text_cursor.h"

namespace vdbounce {
namespace {

Vec3d readVertex(TextCursor& text)
{
    Vec3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view token = text.tokenOnLine();
        const auto value = parseDouble(token);
        if (!value)
            text.fail("a vertex with a coordinate that is no number: '" + std::string(token.substr(0, 40)) + "'",
                      "write 'v x y z'");
        point[axis] = *value;
    }
    return point;
}

// A corner is "v", "v/t", "v/t/n" or "v//n"; v counts from 1, or backwards from the latest vertex when negative.
std::int64_t readCorner(TextCursor& text, std::string_view token, std::size_t pointCount)
{
    const auto index = parseInteger(token.substr(0, token.find('/')));
    if (!index || *index == 0) {
        text.fail("face corner '" + std::string(token.substr(0, 40)) + "' is no index",
                  "indices count from 1, or backwards from -1");
    }
    return *index > 0 ? *index - 1 : static_cast<std::int64_t>(pointCount) + *index;
}

} // namespace

TriangleMesh readObj(const std::string& path)
{
    const FileBytes bytes(path);
    TextCursor text(path, bytes.view(), TextCursor::Comments::Hash);
    MeshAssembly assembly(path);
    std::vector<std::int64_t> corners;

    // Faces may come before their vertices in theory; no exporter does that, so they are checked as they come.
    while (text.skipToToken()) {
        const auto place = [&] { return path + ":" + std::to_string(text.line()); };
        const std::string_view keyword = text.tokenOnLine();
        if (keyword == "v") {
            const Vec3d point = readVertex(text);
            if (point.allFinite()) {
                assembly.addPoint(point);
            } else {
                assembly.addPoint(point, place());
            }
        } else if (keyword == "f") {
            corners.clear();
            for (auto token = text.tokenOnLine(); !token.empty(); token = text.tokenOnLine()) {
                corners.push_back(readCorner(text, token, assembly.pointCount()));
            }
            assembly.addFace(corners, place);
        }
        text.nextLine();
    }
    return assembly.finish();
}

} // namespace vdbounce
