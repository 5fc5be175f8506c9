// SPDX-License-Identifier: Apache-2.0
#include "description.h"

#include "vdbounce/io/mesh_file.h"

namespace vdbounce::tool {

Description describeMesh(const std::string& path)
{
    const TriangleMesh mesh = readMesh(path);
    const EdgeReport edges = inspectEdges(mesh);
    const Box box = boundingBox(mesh);
    const bool sound = edges.closedAndOriented();
    const Json json = {{"kind", "mesh"},
                       {"points", mesh.points.size()},
                       {"triangles", mesh.triangles.size()},
                       {"open_edges", edges.open},
                       {"non_manifold_edges", edges.nonManifold},
                       {"inconsistent_edges", edges.inconsistent},
                       {"closed", sound},
                       {"box_min", toJson(box.min)},
                       {"box_max", toJson(box.max)}};
    std::string text = "mesh: " + grouped(mesh.points.size()) + " points, " + grouped(mesh.triangles.size()) +
                       " triangles, box " + vectorText(box.min) + " to " + vectorText(box.max);
    text += sound ? "; closed and oriented, fit for mesh2ls"
                  : "; " + grouped(edges.open) + " open, " + grouped(edges.nonManifold) + " non-manifold and " +
                        grouped(edges.inconsistent) + " inconsistent edges: mesh2ls will warn";
    return {json, text};
}

} // namespace vdbounce::tool
