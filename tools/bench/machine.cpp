// SPDX-License-Identifier: Apache-2.0
#include "bench/machine.h"

#include "vdbounce/field/vector_lookup.h"

#include <fstream>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

std::string processorName()
{
    std::ifstream file("/proc/cpuinfo");
    std::string name = "unknown processor";
    std::string family;
    for (std::string line; std::getline(file, line);) {
        const auto value = [&] { return line.substr(line.find(':') + 2); };
        if (line.rfind("model name", 0) == 0) name = value();
        if (line.rfind("cpu family", 0) == 0) family = value();
        if (line.rfind("model\t", 0) == 0) return name + " (family " + family + ", model " + value() + ")";
    }
    return name;
}

} // namespace

std::string machineText()
{
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return processorName() + ", " + std::to_string(threads) + " threads, " + vectorTargets().front();
}

} // namespace vdbounce::bench
