// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/render/picture.h"
#include "vdbounce/render/slice.h"

#include <catch2/catch.hpp>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

std::shared_ptr<const DistanceField> ball()
{
    return std::make_shared<const DistanceField>(levelSet(bandGrid(sphere(1.0), uniformTransform(0.1), 16)));
}

bool isDark(const RgbImage& image, int x, int y)
{
    const std::uint8_t* pixel = &image.bytes[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 3];
    return pixel[0] + pixel[1] + pixel[2] < 150;
}

} // namespace

TEST_CASE("a picture shows the surface in the middle and is the same for any number of threads")
{
    PictureOptions options;
    options.width = 120;
    options.height = 80;
    options.ground = -1.0;
    Particles particles;
    particles.resize(50);
    for (std::size_t i = 0; i < 50; ++i) particles.position[i] = Vec3d(0.02 * double(i), 1.2, 0);
    const RgbImage image = renderPicture({ball()}, particles, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(image.bytes == renderPicture({ball()}, particles, options).bytes);
    const auto red = [&](int x, int y) { return int(image.bytes[(std::size_t(y) * 120 + std::size_t(x)) * 3]); };
    CHECK(std::abs(red(60, 45) - red(2, 2)) > 20);
    options.width = 3;
    CHECK_THROWS(renderPicture({ball()}, particles, options));
    CHECK_THROWS(renderPicture({}, Particles{}, PictureOptions{}));
}

TEST_CASE("a slice draws its zero line where phi is zero")
{
    SliceOptions options;
    options.size = 400;
    const RgbImage image = renderSlice(*ball(), Particles{}, options);
    // The box reaches 1.2 or so and a margin; the line of a unit circle crosses the middle row twice.
    int dark = 0;
    int first = -1;
    int last = -1;
    for (int x = 0; x < image.width; ++x) {
        if (!isDark(image, x, image.height / 2)) continue;
        ++dark;
        if (first < 0) first = x;
        last = x;
    }
    CHECK(dark >= 2);
    CHECK(dark <= 12);
    const Box box = ball()->worldBox();
    const double worldPerPixel = box.size().maxCoeff() * 1.3 / 400;
    CHECK((last - first) * worldPerPixel == Approx(2.0).margin(4 * worldPerPixel));
}

TEST_CASE("pictures are written as PNG files")
{
    const TemporaryFolder folder;
    REQUIRE(runTool("mesh2ls " + sourcePath("data/bunny.obj") + " -o " + (folder / "b.vdb") + " --dim 48").exitCode ==
            0);
    REQUIRE(runTool("emit box --min -4,9,-3 --max 4,12,3 -n 2000 -o " + (folder / "c.vdb")).exitCode == 0);
    REQUIRE(runTool("render " + (folder / "b.vdb") + " " + (folder / "c.vdb") + " --ground 0 --size 200x150 -o " +
                    (folder / "r.png"))
                .exitCode == 0);
    REQUIRE(runTool("slice " + (folder / "b.vdb") + " --axis y --at 3 --particles " + (folder / "c.vdb") +
                    " --size 200 -o " + (folder / "s.png"))
                .exitCode == 0);
    for (const char* name : {"r.png", "s.png"}) {
        CHECK(readFile(folder / name).substr(1, 3) == "PNG");
        CHECK(readFile(folder / name).size() > 2000);
    }
    CHECK(runTool("render " + (folder / "b.vdb") + " --size 9000000x3 -o " + (folder / "x.png")).exitCode == 2);
    CHECK(runTool("render " + (folder / "b.vdb") + " --size 1x1 -o " + (folder / "x.png")).exitCode == 2);
}
