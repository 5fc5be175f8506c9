// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/mesh_edges.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace vdbounce {

/// The triangles that are second copies of others and add nothing, in order: those with the same three points that face
/// the same way. Of two that are back to back one counts as a copy only where each triangle of the mesh has such a twin
/// (every face drawn on both sides); elsewhere they are the wall between two bodies.
std::vector<std::uint32_t> findCopies(const std::vector<TriangleMesh::Triangle>& triangles, const MeshEdges& edges,
                                      const std::vector<char>& use);

} // namespace vdbounce
