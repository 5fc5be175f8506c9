// SPDX-License-Identifier: Apache-2.0
#include "support/broken_files.h"
#include "support/random.h"
#include "support/temporary_folder.h"

#include "vdbounce/io/particle_file.h"
#include "vdbounce/particles/points_voxel.h"

#include <cmath>
#include <limits>
#include <numeric>

using namespace vdbounce;
using test::TemporaryFolder;

namespace {

Particles randomParticles(test::Random& random, std::size_t count)
{
    Particles particles;
    particles.resize(count);
    particles.velocity.resize(count);
    particles.radius.resize(count);
    particles.mass.resize(count);
    const Box box{Vec3d(-3, 10, 2), Vec3d(5, 11, 2.5)};
    for (std::size_t i = 0; i < count; ++i) {
        particles.position[i] = random.in(box);
        particles.velocity[i] = random.uniform(0, 9) * random.direction();
        particles.radius[i] = random.uniform(0, 0.1);
        particles.mass[i] = random.uniform(0.1, 2);
        particles.id[i] = std::int64_t(7 * ((i * 7919) % count) + 3);
    }
    return particles;
}

// The same particles in order of id.
Particles sorted(const Particles& particles) { return reordered(particles, orderById(particles)); }

} // namespace

TEST_CASE("csv and ply read back to the same bits")
{
    VDBOUNCE_RANDOM(random);
    const Particles before = randomParticles(random, 5000);
    const TemporaryFolder folder;
    for (const char* name : {"a.csv", "a.ply"}) {
        INFO(name);
        writeParticles(before, folder / name);
        const Particles a = sorted(before);
        const Particles b = sorted(readParticles(folder / name));
        CHECK(a.position == b.position);
        CHECK(a.velocity == b.velocity);
        CHECK(a.radius == b.radius);
        CHECK(a.mass == b.mass);
        CHECK(a.id == b.id);
    }
}

TEST_CASE("csv is ordered by id and names its columns")
{
    const TemporaryFolder folder;
    Particles particles;
    particles.resize(3);
    particles.id = {30, 10, 20};
    particles.position[0].x() = 0.1;
    writeParticles(particles, folder / "a.csv");
    CHECK(test::readFile(folder / "a.csv") == "x,y,z,id\n0,0,0,10\n0,0,0,20\n0.1,0,0,30\n");
}

TEST_CASE("csv takes columns in any order, passes unknown ones over and numbers particles without id")
{
    const TemporaryFolder folder;
    const Particles particles =
        readParticles(folder.write("a.csv", "\xEF\xBB\xBF"
                                            "colour, z ,y,x\r\nred,3,2,1\r\n\r\nblue,6,5,4\r\n"));
    REQUIRE(particles.size() == 2);
    CHECK(particles.position[1] == Vec3d(4, 5, 6));
    CHECK(particles.id == std::vector<std::int64_t>{0, 1});
    CHECK(particles.velocity.empty());
    CHECK(particles.radius.empty());
}

TEST_CASE("OpenVDB points keep every attribute to single precision, and positions relative to their voxel")
{
    VDBOUNCE_RANDOM(random);
    const Particles before = randomParticles(random, 20000);
    const TemporaryFolder folder;
    writeParticles(before, folder / "a.vdb");
    const Particles a = sorted(before);
    const Particles b = sorted(readParticles(folder / "a.vdb"));
    REQUIRE(a.id == b.id);
    const double tolerance = pointsVoxelSize(before) * std::ldexp(1.0, -25);
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE((a.position[i] - b.position[i]).norm() <= 2 * tolerance);
        REQUIRE(b.velocity[i] == a.velocity[i].cast<float>().cast<double>());
        REQUIRE(b.radius[i] == double(float(a.radius[i])));
        REQUIRE(b.mass[i] == double(float(a.mass[i])));
    }
}

TEST_CASE("what was read from OpenVDB points is written back without any change")
{
    VDBOUNCE_RANDOM(random);
    const TemporaryFolder folder;
    writeParticles(randomParticles(random, 3000), folder / "a.vdb");
    const Particles once = sorted(readParticles(folder / "a.vdb"));
    writeParticles(once, folder / "b.vdb");
    const Particles twice = sorted(readParticles(folder / "b.vdb"));
    CHECK(once.position == twice.position);
    CHECK(once.velocity == twice.velocity);
    CHECK(once.mass == twice.mass);
}

TEST_CASE("a stray particle does not coarsen the rest")
{
    VDBOUNCE_RANDOM(random);
    Particles particles = randomParticles(random, 4000);
    const double before = pointsVoxelSize(particles);
    particles.position[17] = Vec3d(1e6, -1e6, 0);
    CHECK(pointsVoxelSize(particles) == before);
    const TemporaryFolder folder;
    writeParticles(particles, folder / "a.vdb");
    CHECK(readParticles(folder / "a.vdb").size() == 4000);
}

TEST_CASE("few, equal, far and absent particles can be written as OpenVDB points")
{
    const TemporaryFolder folder;
    for (std::size_t count : {0u, 1u, 2u, 100u}) {
        for (double at : {0.0, 1e-30, 3.0, 1e12, 1e30}) {
            INFO(count << " particles at " << at);
            Particles particles;
            particles.resize(count);
            for (Vec3d& p : particles.position) p = Vec3d(at, -at, at);
            writeParticles(particles, folder / "a.vdb");
            const Particles back = readParticles(folder / "a.vdb");
            REQUIRE(back.size() == count);
            for (const Vec3d& p : back.position) REQUIRE((p - Vec3d(at, -at, at)).norm() <= 1e-6 * at);
        }
    }
}

TEST_CASE("particles that are not finite survive every format")
{
    const double infinity = std::numeric_limits<double>::infinity();
    Particles particles;
    particles.resize(3);
    particles.position[1] = Vec3d(std::nan(""), 1, 2);
    particles.position[2] = Vec3d(0, infinity, 0);
    const TemporaryFolder folder;
    for (const char* name : {"a.csv", "a.ply", "a.vdb"}) {
        INFO(name);
        writeParticles(particles, folder / name);
        const Particles back = sorted(readParticles(folder / name));
        REQUIRE(back.size() == 3);
        CHECK(back.position[0] == Vec3d::Zero());
        CHECK(std::isnan(back.position[1].x()));
        CHECK(back.position[2].y() == infinity);
    }
}

TEST_CASE("equal particles give equal files")
{
    VDBOUNCE_RANDOM(random);
    const Particles particles = randomParticles(random, 2000);
    const TemporaryFolder folder;
    for (const char* ending : {".csv", ".ply", ".vdb"}) {
        writeParticles(particles, folder / (std::string("a") + ending));
        writeParticles(particles, folder / (std::string("b") + ending));
        CHECK(test::readFile(folder / (std::string("a") + ending)) ==
              test::readFile(folder / (std::string("b") + ending)));
    }
}

TEST_CASE("a broken particle file is refused with its place")
{
    const std::vector<test::BrokenFile> files = {
        {"empty.csv", "", "empty.csv", "is empty"},
        {"header.csv", "a,b,c\n1,2,3\n", "header.csv:1", "no columns x, y and z"},
        {"twice.csv", "x,y,z,x\n1,2,3,4\n", "twice.csv:1", "'x' comes twice"},
        {"part.csv", "x,y,z,vx\n1,2,3,4\n", "part.csv:1", "only part of vx"},
        {"word.csv", "x,y,z\n1,2,3\n1,two,3\n", "word.csv:3", "'two' in column y"},
        {"short.csv", "x,y,z\n1,2\n", "short.csv:2", "3 columns"},
        {"long.csv", "x,y,z\n1,2,3,4\n", "long.csv:2", "3 columns"},
        {"id.csv", "x,y,z,id\n1,2,3,4.5\n", "id.csv:2", "'4.5' is no id"},
        {"short.ply",
         "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 "
         "2 3\n",
         "short.ply:9", "the file ends"},
        {"none.ply", "ply\nformat ascii 1.0\nelement thing 0\nproperty float x\nend_header\n", "none.ply",
         "no element 'vertex'"},
        {"junk.vdb", "this is no OpenVDB file at all", "junk.vdb", "cannot be read as OpenVDB"},
        {"what.xyz", "1 2 3", "what.xyz", "no particle format"},
    };
    test::checkRefused(files, readParticles);
}

TEST_CASE("a cloud smaller than OpenVDB's smallest voxel can be written")
{
    VDBOUNCE_RANDOM(random);
    Particles particles;
    particles.resize(100000);
    for (Vec3d& p : particles.position) p = random.in(Box{Vec3d::Zero(), Vec3d::Constant(1e-4)});
    const TemporaryFolder folder;
    writeParticles(particles, folder / "a.vdb");
    CHECK(readParticles(folder / "a.vdb").size() == 100000);
}
