// SPDX-License-Identifier: Apache-2.0
#include "support/grids.h"
#include "support/random.h"
#include "support/run_tool.h"

#include "vdbounce/base/quantile.h"
#include "vdbounce/build/mesh_oracle.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/lookup_error.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/field/sample_points.h"
#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"
#include "vdbounce/io/mesh_file.h"

#include <cmath>
#include <functional>

#include <tbb/global_control.h>

using namespace vdbounce;
using namespace vdbounce::test;

namespace {

using Phi = std::function<double(const Vec3d&)>;

// What 99 of 100 lookups within a voxel of the surface are off by, at points of our own.
double trueError(const LevelSetGrid& grid, const FieldOptions& choice, const Phi& truth, Random& random)
{
    const DistanceField field(grid, choice);
    std::vector<double> errors;
    while (errors.size() < 20000) {
        const Vec3d p = field.transform().toWorld(random.in(field.indexBox()));
        const double phi = field.phi(p);
        if (std::abs(phi) < field.voxelSize()) errors.push_back(std::abs(phi - truth(p)));
    }
    return quantile(errors, kErrorShare);
}

// Never much less than the truth, and not twice as much. What is left of splines on smooth surfaces, thousandths of a
// voxel, is told less well.
void checkEstimates(const char* name, const LevelSetGrid& grid, const Phi& truth, Random& random)
{
    const LookupErrors errors = measureLookupErrors(grid, 1);
    for (const FieldOptions& choice : choicesByCost()) {
        if (choice.normal == Normal::Central) continue; // phi is the same
        const double measured = trueError(grid, choice, truth, random) / errors.voxel;
        for (const ChoiceError& error : errors.choices) {
            if (!(error.choice == choice)) continue;
            const double told = (error.phi + errors.resolution.error) / errors.voxel;
            INFO(name << ", voxel " << errors.voxel << ", " << nameOf(choice.lookup) << " " << nameOf(choice.storage)
                      << ": told " << told << ", measured " << measured << " voxels");
            CHECK(told > 0.9 * measured - 5e-4);
            CHECK(told < 2.0 * measured + 5e-3);
        }
    }
}

LevelSetGrid sampled(const ShapeFormula& shape, double voxel)
{
    SampleFieldOptions options;
    options.voxelSize = voxel;
    return sampleField(*makeField(shape), options);
}

} // namespace

TEST_CASE("errors of lookups are told from the voxels as they are against formulas")
{
    VDBOUNCE_RANDOM(random);
    const Vec3d centre(0.013, 0.007, 0.003);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(1.0, 0.2, 0.1, 0.3).normalized();
    const std::pair<const char*, ShapeFormula> shapes[] = {
        {"sphere", SphereShape{centre, 1.0}},
        {"torus", TorusShape{centre, Vec3d(0.2, 1.0, 0.3), 0.75, 0.25}},
        {"box", BoxShape{centre, Vec3d(0.9, 0.5, 0.7), turned}},
    };
    for (const auto& [name, shape] : shapes) {
        const auto field = makeField(shape);
        const Phi truth = [&](const Vec3d& p) { return field->phi(p, 0.0); };
        for (const double voxel : {1.0 / 64.0, 1.0 / 24.0}) checkEstimates(name, sampled(shape, voxel), truth, random);
    }
}

TEST_CASE("errors of lookups are told from the voxels as they are against a mesh")
{
    VDBOUNCE_RANDOM(random);
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    MeshToLevelSetOptions options;
    options.voxelSize = boundingBox(mesh).size().maxCoeff() / 100.0;
    const LevelSetGrid grid = meshToLevelSet(mesh, options).grid;
    const MeshOracle oracle(mesh, SignMethod::Auto, toLinearTransform(toOpenVdb(grid).transform()), 0.0);
    checkEstimates(
        "bunny", grid,
        [&](const Vec3d& p) {
            const double distance = oracle.bodyDistance(p);
            return oracle.inBody(p) ? -distance : distance;
        },
        random);
}

TEST_CASE("the order of what voxels cannot tell is two on smooth surfaces and less along edges")
{
    CHECK(measureLookupErrors(sampled(SphereShape{Vec3d::Zero(), 1.0}, 0.03), 1).resolution.order > 1.9);
    const double box =
        measureLookupErrors(sampled(BoxShape{Vec3d::Zero(), Vec3d::Constant(0.51)}, 0.07), 1).resolution.order;
    CHECK(box < 1.6);
    CHECK(box >= 1.0);
}

TEST_CASE("voxels of the size that is asked for reach the error")
{
    const TriangleMesh mesh = readMesh(sourcePath("data/bunny.obj"));
    MeshToLevelSetOptions options;
    options.voxelSize = boundingBox(mesh).size().maxCoeff() / 60.0;
    const LookupErrors coarse = measureLookupErrors(meshToLevelSet(mesh, options).grid, 1);
    for (const double share : {0.7, 0.3}) {
        const double wanted = share * coarse.reachable();
        options.voxelSize = coarse.voxelFor(wanted);
        const LookupErrors fine = measureLookupErrors(meshToLevelSet(mesh, options).grid, 1);
        INFO("voxel " << coarse.voxel << " to " << options.voxelSize << " for " << wanted);
        CHECK(fine.reachable() <= wanted);
        CHECK(fine.reachable() > 0.5 * wanted);
    }
}

TEST_CASE("errors of lookups have the same bits for any number of threads")
{
    const LevelSetGrid grid = sampled(TorusShape{Vec3d(0.1, 0, 0), Vec3d::UnitY(), 0.7, 0.2}, 0.02);
    const LookupErrors all = measureLookupErrors(grid, 3);
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    const LookupErrors one = measureLookupErrors(grid, 3);
    CHECK(all.resolution.error == one.resolution.error);
    CHECK(all.resolution.order == one.resolution.order);
    REQUIRE(all.choices.size() == one.choices.size());
    for (std::size_t i = 0; i < all.choices.size(); ++i) {
        CHECK(all.choices[i].phi == one.choices[i].phi);
        CHECK(all.choices[i].normal == one.choices[i].normal);
    }
}

TEST_CASE("a level set without a surface is never looked up wrongly")
{
    const auto empty = openvdb::createLevelSet<openvdb::FloatGrid>(0.1, 3.0);
    const LookupErrors errors = measureLookupErrors(levelSet(empty), 1);
    CHECK(errors.reachable() == 0.0);
    CHECK(errors.voxel == Approx(0.1));
}

TEST_CASE("a sample of a level set's leaves is found by lookups as in the whole")
{
    VDBOUNCE_RANDOM(random);
    Mat3d rows;
    rows << 0.1, 0.02, 0, -0.03, 0.12, 0.04, 0.01, 0, 0.11;
    const auto whole = bandGrid(sphere(4.0, Vec3d(3, -2, 1)), affineTransform(rows, Vec3d(3, -2, 1)), 60);
    const LookupErrors errors = measureLookupErrors(levelSet(whole), 1);
    const Phi truth = [&](const Vec3d& p) { return (p - Vec3d(3, -2, 1)).norm() - 4.0; };
    const FieldOptions trilinear{Lookup::Trilinear, Normal::Analytic, Storage::Float};
    const double measured = trueError(levelSet(whole), trilinear, truth, random);
    INFO(errors.of(trilinear) << " " << measured);
    CHECK(errors.choices.front().phi + errors.resolution.error == Approx(measured).epsilon(0.1));
}

TEST_CASE("a surface that runs between leaves is looked at too")
{
    // All faces lie between the voxels 7 and 8 and so on of their leaves.
    const LevelSetGrid grid = sampled(BoxShape{Vec3d::Constant(-0.5), Vec3d::Constant(8.0)}, 1.0);
    CHECK(measureLookupErrors(grid, 1).reachable() > 0.1);
}

TEST_CASE("where the voxels do not tell what lookups are off by, no error is reachable")
{
    SampleFieldOptions thin;
    thin.voxelSize = 1.0 / 16.0;
    thin.exteriorVx = 1.0;
    thin.interiorVx = 1.0;
    const auto torus = makeField(TorusShape{Vec3d::Zero(), Vec3d::UnitY(), 0.75, 0.25});
    CHECK(std::isinf(measureLookupErrors(sampleField(*torus, thin), 1).reachable()));
    CHECK(std::isinf(measureLookupErrors(sampled(SphereShape{Vec3d::Zero(), 1.0}, 1.0), 1).reachable()));
}
