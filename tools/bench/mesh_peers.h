// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/level_set_grid.h"
#include "vdbounce/io/triangle_mesh.h"

namespace vdbounce::bench {

/// The peer's name in cases.
constexpr const char* kMeshToVolume = "OpenVDB, meshToVolume";

/// OpenVDB's own conversion, tools::meshToVolume with its default flags: distances in the band, then signs by flooding
/// from outside, then what it does to smooth them. At its best: it reads the mesh in place and in double precision,
/// through an adapter that carries points to index space, so it pays for no copy. Of `options` the voxel size, the half
/// widths and the name; its transform is the one that meshToLevelSet() makes. Throws Interrupted.
LevelSetGrid meshToVolume(const TriangleMesh& mesh, const MeshToLevelSetOptions& options,
                          Progress& progress = Progress::none());

} // namespace vdbounce::bench
