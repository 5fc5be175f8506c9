// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/build/column_sign.h"
#include "vdbounce/build/mesh_topology.h"
#include "vdbounce/build/sign_choice.h"

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// What somebody should know of a mesh that was converted, one sentence each.

namespace vdbounce {

/// Of a mesh whose components were treated each by itself.
void warnAboutMesh(const MeshTopology& topology, const ComponentSigns& signs, double thicknessVx,
                   std::vector<std::string>& warnings);

/// Of a mesh that was taken as it is, by one method.
void warnAboutMesh(const MeshTopology& topology, SignMethod method, std::vector<std::string>& warnings);

/// Of bodies within others that face the same way, which were taken for the walls of cavities.
void warnAboutCavities(std::size_t sameWay, std::vector<std::string>& warnings);

/// Of voxels on whose sign the methods disagree; of overlaps only where `overlaps` says that they are news.
void warnAboutDoubt(const ColumnSigns& signs, bool overlaps, std::vector<std::string>& warnings);

} // namespace vdbounce
