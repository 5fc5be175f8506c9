// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

/// @file
/// Reading and writing .vdb files as wholes; for the files of io/ that know OpenVDB.

namespace vdbounce {

/// Registers OpenVDB's types once; to be called before any of them is used.
void initializeOpenVdb();

/// Opens `path`, passes the file to `body`, and turns OpenVDB's exceptions into InputErrors that name it.
void withVdbFile(const std::string& path, const std::function<void(openvdb::io::File&)>& body);

/// The grids of an open file without their trees, each with the name by which the file tells it from others of the same
/// name.
struct VdbGridHeader {
    std::string uniqueName;
    openvdb::GridBase::Ptr grid;
};
std::vector<VdbGridHeader> readVdbHeaders(openvdb::io::File& file);

/// Writes grids whole or not at all. Equal grids give equal bytes: OpenVDB's random file id is replaced by one that is
/// computed from the content.
void writeVdbFile(const openvdb::GridCPtrVec& grids, const std::string& path);

} // namespace vdbounce
