// SPDX-License-Identifier: Apache-2.0
#include "support/random.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace vdbounce::test;

namespace {

// A rough terrain, 61 samples wide, and a cloud of 2000 particles.
void writeInputs(const TemporaryFolder& folder, Random& random)
{
    std::string heights;
    for (int row = 0; row < 61; ++row) {
        for (int column = 0; column < 61; ++column)
            heights += (column > 0 ? "," : "") + std::to_string(random.uniform(0.0, 1.0));
        heights += '\n';
    }
    folder.write("terrain.csv", heights);
    std::string particles = "x,y,z,radius\n";
    for (int i = 0; i < 2000; ++i) {
        for (int axis = 0; axis < 3; ++axis) particles += std::to_string(random.uniform(-1.0, 1.0)) + ",";
        particles += std::to_string(random.uniform(0.04, 0.12)) + "\n";
    }
    folder.write("cloud.csv", particles);
}

// What `words`, in which files begin with @, write with so many threads.
std::string written(const TemporaryFolder& folder, std::string words, const std::string& output, int threads)
{
    const std::string path = folder / "";
    for (std::size_t at = 0; (at = words.find('@', at)) != std::string::npos; at += path.size())
        words.replace(at, 1, path);
    const ToolRun run = runTool(words + " --quiet --threads " + std::to_string(threads) + " -o " + (folder / output));
    REQUIRE(run.err == "");
    return readFile(folder / output);
}

} // namespace

TEST_CASE("one and two threads write identical level sets")
{
    VDBOUNCE_RANDOM(random);
    const TemporaryFolder folder;
    writeInputs(folder, random);
    // Each may take what those before it wrote. All have leaves for many tasks.
    const std::pair<const char*, const char*> verbs[] = {
        {"torus.vdb", "make torus --center 0.3,0.1,0 --axis 1,2,3 --major 0.8 --minor 0.3 --voxel 0.02"},
        {"terrain.vdb", "make heightfield @terrain.csv --min=-1,0,-1 --max 1,0.3,1 --voxel 0.02"},
        {"blend.vdb", "blobs @cloud.csv --voxel 0.03"},
        {"compact.vdb", "blobs @cloud.csv --voxel 0.03 --kernel compact"},
        {"spheres.vdb", "blobs @cloud.csv --voxel 0.02 --kernel sphere"},
        {"union.vdb", "csg union @torus.vdb @terrain.vdb @spheres.vdb"},
        {"bitten.vdb", "csg subtract @terrain.vdb @torus.vdb --redistance"},
        {"resampled.vdb", "csg intersect @torus.vdb @blend.vdb --blend 2vx"},
        {"not.vdb", "csg complement @torus.vdb"},
        {"wide.vdb", "redistance @union.vdb --exterior 4vx --interior 3vx"},
        {"raised.vdb", "redistance @terrain.vdb --iso 0.024"}};
    for (const auto& [file, words] : verbs) {
        INFO(words);
        const std::string two = written(folder, words, file, 2);
        CHECK(two.size() > 10'000);
        CHECK((two == written(folder, words, file, 1))); // megabytes, not to be printed
    }
}
