// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesh2ls_arguments.h"
#include "report.h"

#include "vdbounce/build/topology_memory.h"

#include <string>
#include <vector>

namespace vdbounce::tool {

/// A mesh to convert.
struct MeshFrame {
    std::string input;
    std::string output;
    const TriangleMesh& mesh;
    double readSeconds = 0.0;
    std::vector<Vec3d> velocities; ///< of its points; empty where none are wanted
};

/// What the conversion of one mesh has to say; `json` has the seconds.
struct ConversionReport {
    Json json;
    std::string text;
};

/// Converts one mesh after the other with the same options: says what to expect, converts, looks for what is too thin,
/// verifies, writes.
class MeshConversion {
public:
    MeshConversion(const Mesh2lsArguments& arguments, const CommonOptions& common, const LinearTransform& transform);

    ConversionReport convert(const MeshFrame& frame);

private:
    ConversionEstimate expect(const MeshFrame& frame) const;
    void verify(const MeshFrame& frame, const MeshToLevelSetResult& result, ConversionReport& report) const;
    void write(const MeshFrame& frame, const MeshToLevelSetResult& result) const;

    const Mesh2lsArguments& arguments_;
    const CommonOptions& common_;
    const MeshToLevelSetOptions options_;
    TopologyMemory memory_;
};

} // namespace vdbounce::tool
