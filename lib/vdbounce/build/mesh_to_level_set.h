// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/conversion_estimate.h"
#include "vdbounce/build/sign_method.h"
#include "vdbounce/build/topology_memory.h"
#include "vdbounce/field/linear_transform.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/sidecar_grid.h"
#include "vdbounce/io/triangle_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vdbounce {

struct MeshToLevelSetOptions {
    double voxelSize = 0.0; ///< world units, > 0; voxel centres then lie at its multiples

    /// Instead of voxelSize: any invertible map from voxels to the world, with rotation, shear and sides of different
    /// length. Lengths in voxels are then multiples of the longest side.
    std::optional<LinearTransform> transform;

    double exteriorVx = 3.0; ///< half width of the band outside, voxels, >= 1; becomes the background
    double interiorVx = 3.0; ///< half width of the band inside, voxels, >= 1
    SignMethod sign = SignMethod::Auto;
    double thicknessVx =
        2.0; ///< of a sheet (SignMethod::Unsigned), voxels, > 0; two can be told from nothing by trilinear lookup
    std::string gridName = "surface";
    bool closest = false;    ///< also make a grid of the closest triangle's number
    bool confidence = false; ///< also make a grid of how certain the sign is
    std::uint64_t maxMemory =
        0; ///< bytes; what is expected to take more is refused; 0: three quarters of the machine's
};

struct MeshToLevelSetResult {
    LevelSetGrid grid;
    SidecarGrid closest;    ///< "NAME_closest", int32, active as the level set; of equally near triangles any one
    SidecarGrid confidence; ///< "NAME_confidence", float, 0 to 1: 1 where all methods agree on the sign
    SignMethod sign = SignMethod::Winding; ///< what most of the surface was signed by
    std::vector<SignChoice> choices;       ///< what Auto chose for which part, and why
    std::uint64_t doubtfulVoxels = 0;      ///< of the band, on whose sign the methods disagree
    std::vector<std::string> warnings;     ///< about the mesh, one sentence each
};

/// Makes a narrow-band level set from a triangle mesh.
///
/// Distance: every active voxel holds the world distance to the mesh that a double-precision closest point gives,
/// rounded to float; nothing is renormalised. Inside bodies that overlap it is the distance to the nearest triangle all
/// the same.
///
/// Sign: Auto treats each connected component by what it is (see chooseSigns()), and a point is inside where it is
/// inside of any, but for cavities: a component that lies wholly within another one, or that faces inwards and cuts
/// into one, takes away (see findCavities()). Cracks narrower than a twentieth of a voxel are closed. Closed components
/// are exact whatever their shape, since whole windings are counted; beside holes it is the winding number that
/// decides. Components that enclose nothing become sheets of the stated thickness. The other methods take the mesh as
/// it is and as a whole.
///
/// The same bits for any number of threads.
///
/// Throws UsageError for options out of range and for what needs more than maxMemory, Interrupted.
/// Cost: about 1 microsecond a triangle where triangles are as large as voxels, 0.07 microseconds a voxel where they
/// are larger; memory of the finished grid, and some 110 bytes a triangle.
MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options,
                                    Progress& progress = Progress::none());

/// The same result, bit by bit, for one mesh of several with the same triangles: see TopologyMemory.
MeshToLevelSetResult meshToLevelSet(const TriangleMesh& mesh, const MeshToLevelSetOptions& options,
                                    TopologyMemory& memory, Progress& progress = Progress::none());

/// What meshToLevelSet() will take. Throws what it would throw before it starts.
ConversionEstimate expectConversion(const TriangleMesh& mesh, const MeshToLevelSetOptions& options);

} // namespace vdbounce
