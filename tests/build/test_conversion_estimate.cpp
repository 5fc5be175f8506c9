// SPDX-License-Identifier: Apache-2.0
#include "bench/memory_peak.h"
#include "support/meshes.h"
#include "support/run_tool.h"

#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/io/mesh_file.h"

using namespace vdbounce;
using namespace vdbounce::test;

TEST_CASE("what a conversion will take is told within a factor, memory never much too low")
{
    const std::pair<TriangleMesh, double> cases[] = {
        // and a voxel's size
        {readMesh(sourcePath("data/bunny.obj")), 0.05},
        {sphereMesh(1.0, 7), 0.01},
        {boxMesh(Vec3d(1.0, 0.7, 0.5)), 0.008},
    };
    for (const auto& [mesh, voxel] : cases) {
        MeshToLevelSetOptions options;
        options.voxelSize = voxel;
        const ConversionEstimate expected = expectConversion(mesh, options);
        const bench::MemoryPeak peak;
        const MeshToLevelSetResult result = meshToLevelSet(mesh, options);
        const auto bytes = peak.bytes();
        const auto active = double(summarize(result.grid).activeVoxels);
        INFO(mesh.triangles.size() << " triangles");
        CHECK(expected.activeVoxels > active / 1.5);
        CHECK(expected.activeVoxels < active * 1.5);
        if (!bytes) continue; // the system does not tell
        CHECK(expected.bytes > *bytes / 2.0);
        CHECK(expected.bytes < *bytes * 3.0);
    }
}
