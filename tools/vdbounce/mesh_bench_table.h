// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/bench_mesh.h"

#include <string>
#include <vector>

namespace vdbounce::tool {

/// The results for reading, a line a mesh and dim, in columns that line up.
std::string meshBenchTable(const std::vector<bench::MeshBenchResult>& results);

} // namespace vdbounce::tool
