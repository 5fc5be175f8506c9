// SPDX-License-Identifier: Apache-2.0
#include "support/meshes.h"
#include "support/random.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/triangle_distance.h"
#include "vdbounce/implicit/heightfield.h"
#include "vdbounce/implicit/heightfield_mesh.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace vdbounce;

namespace {

HeightMap filled(int columns, int rows, double value = 0.0)
{
    return {columns, rows, std::vector<double>(std::size_t(columns * rows), value)};
}

HeightMap randomMap(test::Random& random, int columns, int rows)
{
    HeightMap map = filled(columns, rows);
    for (double& value : map.values) value = random.uniform(0, 1);
    return map;
}

// A rough terrain: waves with a spike here and there.
HeightMap terrain(test::Random& random, int columns, int rows)
{
    HeightMap map = filled(columns, rows);
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            double& value = map.values[std::size_t(j * columns + i)];
            value = 0.4 + 0.2 * std::sin(0.2 * i) * std::cos(0.13 * j) + random.uniform(0, 0.02);
            if (random.uniform(0, 1) < 0.01) value += 0.3;
        }
    }
    return map;
}

using Long = Eigen::Matrix<long double, 3, 1>;

long double segmentDistance(const Long& p, const Long& a, const Long& b)
{
    const long double share = (p - a).dot(b - a) / (b - a).squaredNorm();
    return (p - a - std::min(1.0L, std::max(0.0L, share)) * (b - a)).norm();
}

// In long double, so that what is compared with it is the only one to lose digits.
long double triangleDistance(const Long& p, const Long& a, const Long& b, const Long& c)
{
    const Long normal = (b - a).cross(c - a);
    const Long foot = p - (p - a).dot(normal) / normal.squaredNorm() * normal;
    const bool within = (b - a).cross(foot - a).dot(normal) >= 0 && (c - b).cross(foot - b).dot(normal) >= 0 &&
                        (a - c).cross(foot - c).dot(normal) >= 0;
    if (within) return (p - foot).norm();
    return std::min(segmentDistance(p, a, b), std::min(segmentDistance(p, b, c), segmentDistance(p, c, a)));
}

// Distance to the solid's mesh by all of its triangles: the least, signed by their solid angles.
double bruteForcePhi(const TriangleMesh& mesh, const Vec3d& p)
{
    const auto corner = [&](std::size_t t, int which) { return Long(mesh.corner(t, which).cast<long double>()); };
    long double distance = std::numeric_limits<long double>::infinity();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        distance =
            std::min(distance, triangleDistance(Long(p.cast<long double>()), corner(t, 0), corner(t, 1), corner(t, 2)));
    }
    return double(test::bruteForceInside(mesh, p) ? -distance : distance);
}

Box grown(Box box, double by)
{
    box.min.array() -= by;
    box.max.array() += by;
    return box;
}

// phi of a box, exact.
double boxPhi(const Box& box, const Vec3d& p)
{
    const Vec3d q = (p - box.centre()).cwiseAbs() - 0.5 * box.size();
    return q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
}

// One of the triangles at a point has this normal.
bool isNormalAt(const TriangleMesh& mesh, const Vec3d& p, const Vec3d& normal)
{
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d a = mesh.corner(t, 0);
        const Vec3d b = mesh.corner(t, 1);
        const Vec3d c = mesh.corner(t, 2);
        if ((closestPointOnTriangle(p, a, b, c) - p).norm() > 1e-9) continue;
        if (((b - a).cross(c - a).normalized() - normal).norm() < 1e-9) return true;
    }
    return false;
}

struct Setting {
    const char* name;
    int columns;
    int rows;
    HeightfieldOptions options;
};

const Setting kSettings[] = {
    {"square", 9, 9, {Vec3d::Zero(), Vec3d(1, 0.2, 1), {}}},
    {"one cell", 2, 2, {Vec3d::Zero(), Vec3d(1, 1, 2), {}}},
    {"steep", 7, 12, {Vec3d(-1, -5, -1), Vec3d(1, 30, 1), -6.0}},
    {"cliffs", 6, 5, {Vec3d(0, 0, 0), Vec3d(1, 3000, 1), {}}},
    {"narrow", 2, 40, {Vec3d(0, 0, 0), Vec3d(0.1, 0.3, 7), {}}},
    {"wide", 30, 3, {Vec3d(5, 1, -7), Vec3d(9, 1.5, -6.5), 0.9}},
    {"flat cells", 10, 11, {Vec3d(0, 0, 0), Vec3d(100, 0.001, 50), -1e-4}},
};

} // namespace

TEST_CASE("a heightfield's distance is that of the nearest of all its triangles")
{
    VDBOUNCE_RANDOM(random);
    for (const Setting& setting : kSettings) {
        INFO(setting.name);
        const HeightMap map = randomMap(random, setting.columns, setting.rows);
        const HeightfieldField field(map, setting.options);
        const TriangleMesh mesh = heightfieldMesh(map, setting.options);
        const double size = field.box().size().norm();
        double worst = 0.0;
        int inside = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3d p = random.in(grown(field.box(), (i % 3) * (i % 3) * 0.1 * size));
            const double phi = field.phi(p, 0.0);
            const double error = std::abs(phi - bruteForcePhi(mesh, p));
            worst = std::max(worst, error);
            inside += phi < 0.0 ? 1 : 0;
        }
        CHECK(worst < 1e-14 * size);
        CHECK(inside > 100);
    }
}

TEST_CASE("a large map's pyramid finds the triangle that brute force finds, near and far")
{
    VDBOUNCE_RANDOM(random);
    const HeightMap map = terrain(random, 150, 97);
    const HeightfieldOptions options{Vec3d(0, 0, 0), Vec3d(15, 10, 9), {}};
    const HeightfieldField field(map, options);
    const TriangleMesh mesh = heightfieldMesh(map, options);
    for (double distance : {0.01, 0.3, 4.0, 100.0}) {
        INFO(distance);
        double worst = 0.0;
        for (int i = 0; i < 150; ++i) {
            const Vec3d p = random.in(field.box());
            const double above = field.phi(p, 0.0);
            const Vec3d moved = p + (distance - above) * field.sample(p, 0.0).gradient;
            worst = std::max(worst, std::abs(std::abs(field.phi(moved, 0.0)) - test::bruteForceDistance(mesh, moved)));
        }
        CHECK(worst < 1e-12 * (20 + distance));
    }
}

TEST_CASE("a flat heightfield is a box")
{
    VDBOUNCE_RANDOM(random);
    const HeightfieldField field(filled(33, 20, 0.5), {Vec3d(1, 0, -2), Vec3d(4, 2, 2), -0.5});
    const Box box = field.box();
    CHECK((box.min - Vec3d(1, -0.5, -2)).norm() == 0.0);
    CHECK((box.max - Vec3d(4, 1, 2)).norm() == 0.0);
    CHECK(field.thinnestWall() == 1.5);
    CHECK(field.exact());
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.in(grown(box, 2.0));
        worst = std::max(worst, std::abs(field.phi(p, 0.0) - boxPhi(box, p)));
    }
    CHECK(worst < 1e-14);
    // Without a spread of heights, too.
    const HeightfieldField level(filled(2, 2, 0.7), {Vec3d(0, 3, 0), Vec3d(1, 3, 2), {}});
    CHECK(level.phi(Vec3d(0.5, 4, 1), 0.0) == 1.0);
    CHECK(level.phi(Vec3d(0.5, 2.8, 1), 0.0) == Approx(0.0).margin(1e-15));
    CHECK(level.thinnestWall() == Approx(0.2));
}

TEST_CASE("a tilted heightfield gives a plane's distance and normal over and under its middle")
{
    VDBOUNCE_RANDOM(random);
    HeightMap map = filled(65, 33);
    for (int j = 0; j < 33; ++j) {
        for (int i = 0; i < 65; ++i) map.values[std::size_t(j * 65 + i)] = i / 64.0 - 0.5 * j / 32.0;
    }
    const HeightfieldField field(map, {Vec3d(0, 0, 0), Vec3d(4, 1, 2), -5.0});
    const Vec3d normal = Vec3d(-0.25, 1.0, 0.25).normalized();
    double worst = 0.0;
    double turned = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const double distance = random.uniform(-0.5, 0.5);
        const Vec3d on(random.uniform(1, 3), 0, random.uniform(0.7, 1.3));
        const Vec3d p = Vec3d(on.x(), 0.25 * on.x() - 0.25 * on.z(), on.z()) + distance * normal;
        const FieldSample sample = field.sample(p, 0.0);
        worst = std::max(worst, std::abs(sample.phi - distance));
        // Nearest to an edge between two coplanar triangles, by rounding, the direction from it is good to rounding
        // over the distance.
        turned = std::max(turned, (sample.gradient - normal).norm() * std::min(1.0, std::abs(distance)));
    }
    CHECK(worst < 1e-14);
    CHECK(turned < 1e-13);
}

TEST_CASE("a heightfield's sign tells column by column what is inside")
{
    VDBOUNCE_RANDOM(random);
    // A plane's height is known without triangles.
    const HeightMap map{2, 2, {0.0, 1.0, 1.0, 2.0}};
    const HeightfieldField field(map, {Vec3d(0, 0, 0), Vec3d(1, 1, 1), -0.5});
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3d p = random.in(grown(field.box(), 0.5));
        const bool within = p.x() > 0 && p.x() < 1 && p.z() > 0 && p.z() < 1 && p.y() > -0.5 && p.y() < p.x() + p.z();
        if ((field.phi(p, 0.0) < 0.0) != within) FAIL(p.transpose());
        inside += within ? 1 : 0;
    }
    CHECK(inside > 1000);
}

TEST_CASE("each cell of a heightfield is cut from its first to its last sample")
{
    const HeightfieldField ridge({2, 2, {1.0, 0.0, 0.0, 1.0}}, {Vec3d::Zero(), Vec3d::Ones(), -1.0});
    CHECK(ridge.phi(Vec3d(0.5, 1, 0.5), 0.0) == Approx(0.0).margin(1e-15));
    const HeightfieldField valley({2, 2, {0.0, 1.0, 1.0, 0.0}}, {Vec3d::Zero(), Vec3d::Ones(), -1.0});
    CHECK(valley.phi(Vec3d(0.5, 0, 0.5), 0.0) == Approx(0.0).margin(1e-15));
    CHECK(valley.phi(Vec3d(0.5, 0.5, 0.5), 0.0) > 0.2);
}

TEST_CASE("a heightfield's gradient has length 1 and is the slope of phi, inside too")
{
    VDBOUNCE_RANDOM(random);
    for (const Setting& setting : kSettings) {
        if (std::string(setting.name) == "cliffs") continue; // nearest places change within any difference's step
        INFO(setting.name);
        const HeightfieldField field(randomMap(random, setting.columns, setting.rows), setting.options);
        const double h = 1e-6 * field.box().size().minCoeff();
        int bends = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3d p = random.in(grown(field.box(), 0.3 * field.box().size().minCoeff()));
            const FieldSample sample = field.sample(p, 0.0);
            CHECK(sample.phi == field.phi(p, 0.0));
            CHECK(sample.gradient.norm() == Approx(1.0).epsilon(1e-12));
            Vec3d slope;
            for (int axis = 0; axis < 3; ++axis) {
                const Vec3d step = h * Vec3d::Unit(axis);
                slope[axis] = (field.phi(p + step, 0.0) - field.phi(p - step, 0.0)) / (2 * h);
            }
            // Where the nearest place changes within the step, the difference is of two directions.
            if ((slope - sample.gradient).norm() > 1e-3) ++bends;
        }
        CHECK(bends < 5);
    }
}

TEST_CASE("a heightfield's gradient on the surface is a face's normal")
{
    VDBOUNCE_RANDOM(random);
    const HeightMap map = randomMap(random, 12, 9);
    const HeightfieldOptions options{Vec3d(1, 2, 3), Vec3d(4, 3, 5), {}};
    const HeightfieldField field(map, options);
    const TriangleMesh mesh = heightfieldMesh(map, options);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d a = mesh.corner(t, 0);
        const Vec3d b = mesh.corner(t, 1);
        const Vec3d c = mesh.corner(t, 2);
        const Vec3d normal = (b - a).cross(c - a).normalized();
        const double u = random.uniform(0.1, 0.4);
        const double v = random.uniform(0.1, 0.4);
        const FieldSample inner = field.sample(a + u * (b - a) + v * (c - a), 0.0);
        CHECK(std::abs(inner.phi) < 1e-14);
        CHECK((inner.gradient - normal).norm() < 1e-9);
        for (const Vec3d& p : {a, b, c, Vec3d(0.5 * (a + b))}) {
            const FieldSample edge = field.sample(p, 0.0);
            CHECK(std::abs(edge.phi) < 1e-14);
            CHECK(isNormalAt(mesh, p, edge.gradient));
        }
    }
}

TEST_CASE("no two points differ in a heightfield's phi by more than their distance")
{
    VDBOUNCE_RANDOM(random);
    for (const Setting& setting : kSettings) {
        INFO(setting.name);
        const HeightfieldField field(randomMap(random, setting.columns, setting.rows), setting.options);
        const double size = field.box().size().norm();
        double worst = 0.0;
        for (int i = 0; i < 4000; ++i) {
            const Vec3d p = random.in(grown(field.box(), 0.2 * size));
            const Vec3d q = p + std::pow(10.0, random.uniform(-9, 0)) * size * random.direction();
            worst = std::max(worst, std::abs(field.phi(p, 0.0) - field.phi(q, 0.0)) - (p - q).norm());
        }
        CHECK(worst < 1e-13 * size);
    }
}

TEST_CASE("a row of a heightfield's phi has the same bits as its points")
{
    VDBOUNCE_RANDOM(random);
    const HeightfieldField field(terrain(random, 200, 130), {Vec3d(0, 0, 0), Vec3d(20, 10, 13), {}});
    for (int row = 0; row < 400; ++row) {
        const Vec3d from = random.in(grown(field.box(), 3.0));
        const Vec3d step = std::pow(10.0, random.uniform(-3, 0.5)) * random.direction();
        double phis[64];
        field.phiInRow(from, step, 64, 0.0, phis);
        int differing = 0;
        for (int i = 0; i < 64; ++i) differing += phis[i] == field.phi(from + double(i) * step, 0.0) ? 0 : 1;
        CHECK(differing == 0);
    }
}

TEST_CASE("a heightfield far from the origin is as exact as the points there")
{
    VDBOUNCE_RANDOM(random);
    const HeightMap map = randomMap(random, 20, 20);
    const Vec3d away(1 << 20, -(1 << 22), 1 << 21);
    const HeightfieldField here(map, {Vec3d::Zero(), Vec3d(1, 0.5, 2), -0.25});
    const HeightfieldField there(map, {away, away + Vec3d(1, 0.5, 2), away.y() - 0.25});
    double worst = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3d p = away + random.in(grown(here.box(), 0.5));
        worst = std::max(worst, std::abs(there.phi(p, 0.0) - here.phi(p - away, 0.0)));
    }
    CHECK(worst == 0.0);
}

TEST_CASE("a heightfield's thinnest wall is its bulk, or a cell where it is steep")
{
    HeightMap map = filled(11, 11);
    map.values[60] = 0.5;
    CHECK(HeightfieldField(map, {Vec3d::Zero(), Vec3d(10, 1, 20), -3.0}).thinnestWall() == 3.0);
    CHECK(HeightfieldField(map, {Vec3d::Zero(), Vec3d(10, 10, 20), -3.0}).thinnestWall() == 1.0);
    CHECK(HeightfieldField(map, {Vec3d::Zero(), Vec3d(10, 10, 20), -0.5}).thinnestWall() == 0.5);
    CHECK(HeightfieldField(map, {Vec3d::Zero(), Vec3d(10, 1, 2), -30.0}).thinnestWall() == Approx(0.2));
}

TEST_CASE("points that are no numbers have no distance to a heightfield")
{
    VDBOUNCE_RANDOM(random);
    const HeightfieldField field(terrain(random, 100, 100), {Vec3d::Zero(), Vec3d(10, 10, 10), {}});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d p(5, 20, 5);
        p[axis] = nan;
        CHECK_FALSE(std::isfinite(field.sample(p, 0.0).phi));
    }
}

TEST_CASE("heightfields that cannot be are refused by name")
{
    const HeightMap map{2, 2, {0.0, 1.0, 1.0, 2.0}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [](const HeightMap& m, const HeightfieldOptions& options) {
        try {
            const HeightfieldField field(m, options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Contains;
    CHECK_THAT(refusal(map, {Vec3d(1, 0, 0), Vec3d(-1, 1, 1), {}}),
               Contains("heightfield max.x: is -1 where min.x is 1"));
    CHECK_THAT(refusal(map, {Vec3d(0, 0, 0), Vec3d(0, 1, 1), {}}), Contains("heightfield max.x"));
    CHECK_THAT(refusal(map, {Vec3d(0, 3, 0), Vec3d(1, 2, 1), {}}),
               Contains("heightfield max.y: is 2 where min.y is 3"));
    CHECK_THAT(refusal(map, {Vec3d(0, 0, nan), Vec3d(1, 1, 1), {}}), Contains("heightfield max.z"));
    CHECK_THAT(refusal(map, {Vec3d(0, 0, 0), Vec3d(1, 1, 1), 0.0}),
               Contains("heightfield base: is 0 where the lowest height is 0"));
    CHECK_THAT(refusal(map, {Vec3d(0, 0, 0), Vec3d(1, 1, 1), nan}), Contains("heightfield base: is nan"));
    CHECK_THAT(refusal({2, 2, {0.0, 1.0, nan, 2.0}}, {}), Contains("column 1 of row 2 is nan"));
    CHECK_THAT(refusal({1, 4, {0.0, 1.0, 1.0, 2.0}}, {}), Contains("1 columns"));
    CHECK_THAT(refusal({2, 3, {0.0, 1.0, 1.0, 2.0}}, {}), Contains("4 values"));
    CHECK_THROWS_AS(HeightfieldField(map, {Vec3d(1, 0, 0), Vec3d(-1, 1, 1), {}}), UsageError);
    CHECK_THROWS_AS(HeightfieldField({2, 2, {0.0, 1.0, nan, 2.0}}, {}), InputError);
    CHECK(refusal(map, {}).empty());
}
