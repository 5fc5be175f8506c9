// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/io/mesh_assembly.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/ply_reader.h"

namespace vdbounce {
namespace {

void readPoints(PlyReader& ply, const PlyElement& element, MeshAssembly& assembly, const std::string& path)
{
    const int columns[3] = {element.find("x"), element.find("y"), element.find("z")};
    for (int column : columns) {
        if (column < 0 || element.properties[static_cast<std::size_t>(column)].listCount) {
            throw InputError(path, "its vertices lack a property x, y or z", "export the mesh with positions");
        }
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
        ply.readRow();
        const Vec3d point(ply.value(columns[0]), ply.value(columns[1]), ply.value(columns[2]));
        if (!point.allFinite()) assembly.addPoint(point, ply.place());
        assembly.addPoint(point);
    }
}

void readFaces(PlyReader& ply, const PlyElement& element, MeshAssembly& assembly, const std::string& path)
{
    int column = element.find("vertex_indices");
    if (column < 0) column = element.find("vertex_index");
    if (column < 0 || !element.properties[static_cast<std::size_t>(column)].listCount) {
        throw InputError(path, "its faces lack the list vertex_indices", "export the mesh with faces");
    }
    std::vector<std::int64_t> corners;
    for (std::uint64_t row = 0; row < element.count; ++row) {
        ply.readRow();
        corners.clear();
        for (double entry : ply.list(column)) {
            const auto corner = static_cast<std::int64_t>(entry);
            if (static_cast<double>(corner) != entry) {
                throw InputError(ply.place(), "face corner " + numberText(entry) + " is no whole number",
                                 "export the mesh again");
            }
            corners.push_back(corner);
        }
        assembly.addFace(corners, [&] { return ply.place(); });
    }
}

} // namespace

TriangleMesh readPlyMesh(const std::string& path)
{
    PlyReader ply(path);
    MeshAssembly assembly(path);
    while (const PlyElement* element = ply.nextElement()) {
        if (element->name == "vertex") readPoints(ply, *element, assembly, path);
        if (element->name == "face") readFaces(ply, *element, assembly, path);
    }
    return assembly.finish();
}

} // namespace vdbounce
