// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vdbounce {

/// How inside is told from outside.
enum class SignMethod {
    Auto,     ///< winding, or parity for a closed mesh whose faces disagree; a warning where neither is certain
    Winding,  ///< inside where the mesh winds around a point more than half; right for overlapping parts
    Parity,   ///< inside where rays cross the mesh an odd number of times; does not need consistent faces
    Flood,    ///< outside is what can be reached from far away, so cavities are filled
    Unsigned, ///< no inside: the mesh becomes a sheet of the stated thickness
};

struct MeshToLevelSetOptions {
    double voxelSize = 0.0;  ///< world units, > 0
    double exteriorVx = 3.0; ///< half width of the band outside, voxels, >= 1; becomes the background
    double interiorVx = 3.0; ///< half width of the band inside, voxels, >= 1
    SignMethod sign = SignMethod::Auto;
    double thicknessVx =
        2.0; ///< of a sheet (SignMethod::Unsigned), voxels, > 0; two can be told from nothing by trilinear lookup
    std::string gridName = "surface";
};

struct MeshToLevelSetResult {
    LevelSetGrid grid;
    SignMethod sign = SignMethod::Winding; ///< what Auto chose
    std::vector<std::string> warnings;     ///< about the mesh, one sentence each
};

/// Makes a narrow-band level set from a triangle mesh.
///
/// Guarantee: every active voxel holds the distance to the mesh that a double-precision closest point gives, rounded to
/// float; nothing is renormalised afterwards. Signs are the chosen method's, asked once for each connected region of
/// space between the triangles; voxel by voxel where a region leaks through a hole of the mesh. The grid's transform is
/// a uniform scale, voxel centres lie at multiples of the voxel size. The same bits for any number of threads.
///
/// Throws UsageError for options out of range, InputError for a mesh too large for the voxel size, Interrupted.
/// Cost: about (triangles that reach a leaf) x 512 distances for each leaf of the band.
MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options,
                                    Progress& progress = Progress::none());

/// The method's name on the command line and in JSON: "auto", "winding", "parity", "flood", "unsigned".
const char* signMethodName(SignMethod method);

} // namespace vdbounce
