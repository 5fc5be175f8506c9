// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

#include <string>

/// @file
/// Reading triangle meshes: obj, stl (text and binary), ply (text and binary of either byte order) and off.
///
/// Positions and faces are taken, everything else is passed over; polygons are cut into triangles. Every reader throws
/// InputError, naming file and line or element, for: counts that do not fit, indices out of range, NaN or infinite
/// positions, a file that ends early, and a file without any face. A mesh that is returned has at least one
/// triangle, and all its indices and positions are sound.

namespace vdbounce {

/// Reads a mesh; the file's ending names its format, in upper or lower case.
TriangleMesh readMesh(const std::string& path);

/// True for the endings that readMesh knows.
bool isMeshFile(const std::string& path);

TriangleMesh readObj(const std::string& path);
TriangleMesh readStl(const std::string& path); ///< corners at bitwise equal positions become one point
TriangleMesh readPlyMesh(const std::string& path);
TriangleMesh readOff(const std::string& path);

} // namespace vdbounce
