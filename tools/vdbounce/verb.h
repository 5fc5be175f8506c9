// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

/// @file
/// The verbs of the tool. Each add...() describes one verb on the command line and, when that verb is given, runs it:
/// parse, call the library once, report. Failures leave by exception; main() turns them into one line and an exit code.

namespace vdbounce::tool {

/// What every verb takes.
struct CommonOptions {
    int threads = 0; ///< 0: all cores
    bool json = false;
    bool quiet = false;
};

void addMesh2ls(CLI::App& app, const CommonOptions& common);
void addMake(CLI::App& app, const CommonOptions& common);
void addMakeHeightfield(CLI::App& make, const CommonOptions& common); // a shape of make
void addCsg(CLI::App& app, const CommonOptions& common);
void addBlobs(CLI::App& app, const CommonOptions& common);
void addInfo(CLI::App& app, const CommonOptions& common);
void addSample(CLI::App& app, const CommonOptions& common);
void addEmit(CLI::App& app, const CommonOptions& common);
void addConvert(CLI::App& app, const CommonOptions& common);
void addCollide(CLI::App& app, const CommonOptions& common);
void addRedistance(CLI::App& app, const CommonOptions& common);
void addRender(CLI::App& app, const CommonOptions& common);
void addSlice(CLI::App& app, const CommonOptions& common);
void addBench(CLI::App& app, const CommonOptions& common);
void addBenchMesh(CLI::App& bench, const CommonOptions& common); // a kind of bench
void addBenchMake(CLI::App& bench, const CommonOptions& common);
void addBenchTrade(CLI::App& bench, const CommonOptions& common);
void addBenchAll(CLI::App& bench, const CommonOptions& common); // another

/// The number of threads that the user asked for; of all cores where they asked for none.
int threadsUsed(const CommonOptions& common);

/// Runs `body` with that number of threads.
void runWith(const CommonOptions& common, const std::function<void()>& body);

} // namespace vdbounce::tool
