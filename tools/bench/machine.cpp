// SPDX-License-Identifier: Apache-2.0
#include "bench/machine.h"

#include "vdbounce/field/vector_lookup.h"

#include <algorithm>
#include <fstream>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

std::string processorName()
{
    std::ifstream file("/proc/cpuinfo");
    std::string name = "unknown processor";
    std::string family;
    std::string model;
    for (std::string line; std::getline(file, line) && !line.empty();) { // the first processor
        const std::string value = line.substr(std::min(line.size(), line.find(':') + 2));
        if (line.rfind("model name", 0) == 0) name = value;
        if (line.rfind("cpu family", 0) == 0) family = value;
        if (line.rfind("model\t", 0) == 0) model = value;
    }
    return family.empty() ? name : name + " (family " + family + ", model " + model + ")";
}

} // namespace

std::string machineText()
{
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return processorName() + ", " + std::to_string(threads) + " threads, " + vectorTargets().front();
}

} // namespace vdbounce::bench
