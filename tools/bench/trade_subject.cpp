// SPDX-License-Identifier: Apache-2.0
#include "bench/trade_subject.h"

#include "vdbounce/build/mesh_oracle.h"
#include "vdbounce/build/mesh_to_level_set.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/implicit/sample_field.h"
#include "vdbounce/implicit/shapes.h"
#include "vdbounce/io/grid_file.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/openvdb_grid.h"

#include <cmath>
#include <filesystem>
#include <memory>

namespace vdbounce::bench {
namespace {

constexpr int kLevels = 3;
constexpr double kFinestVoxel = 1.0 / 64.0; // of bodies about two units across

TradeSubject analyticSubject(const std::string& name, const ShapeFormula& formula, Progress& progress)
{
    const std::shared_ptr<const ImplicitField> field = makeField(formula);
    TradeSubject subject;
    subject.name = name;
    subject.truth = "its formula";
    subject.phi = [field](const Vec3d& p) { return field->phi(p, 0.0); };
    subject.normal = [field](const Vec3d& p) { return field->sample(p, 0.0).gradient; };
    for (int level = 0; level < kLevels; ++level) {
        SampleFieldOptions options;
        options.voxelSize = kFinestVoxel * double(1 << level);
        subject.grids.push_back(sampleField(*field, options, progress));
    }
    return subject;
}

// Central differences of an exact distance.
std::function<Vec3d(const Vec3d&)> normalOf(const std::function<double(const Vec3d&)>& phi, double step)
{
    return [phi, step](const Vec3d& p) {
        Vec3d gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3d side = step * Vec3d::Unit(axis);
            gradient[axis] = (phi(p + side) - phi(p - side)) / (2.0 * step);
        }
        // Much shorter than 1 next to edges only, where there is no one direction.
        constexpr double kShortest = 0.999;
        return gradient.norm() > kShortest ? gradient : Vec3d(Vec3d::Zero());
    };
}

} // namespace

std::vector<TradeSubject> analyticSubjects(Progress& progress)
{
    const Vec3d centre(0.013, 0.007, 0.003);
    const Eigen::Quaterniond turned = Eigen::Quaterniond(1.0, 0.2, 0.1, 0.3).normalized();
    return {analyticSubject("sphere", SphereShape{centre, 1.0}, progress),
            analyticSubject("torus", TorusShape{centre, Vec3d(0.2, 1.0, 0.3), 0.75, 0.25}, progress),
            analyticSubject("box", BoxShape{centre, Vec3d(0.9, 0.5, 0.7), turned}, progress)};
}

TradeSubject meshSubject(const std::string& file, int dim, Progress& progress)
{
    const TriangleMesh mesh = readMesh(file);
    TradeSubject subject;
    subject.name = std::filesystem::path(file).filename().string();
    subject.truth = "its triangles";
    for (int level = 0; level < kLevels; ++level) {
        MeshToLevelSetOptions options;
        options.voxelSize = boundingBox(mesh).size().maxCoeff() / double(dim) * double(1 << level);
        subject.grids.push_back(meshToLevelSet(mesh, options, progress).grid);
    }
    const LinearTransform finest = toLinearTransform(toOpenVdb(subject.grids.front()).transform());
    const auto oracle = std::make_shared<const MeshOracle>(mesh, SignMethod::Auto, finest, 0.0);
    subject.phi = [oracle](const Vec3d& p) {
        const double distance = oracle->bodyDistance(p);
        return oracle->inBody(p) ? -distance : distance;
    };
    subject.normal = normalOf(subject.phi, 1e-4 * finest.voxelSize().maxCoeff());
    return subject;
}

TradeSubject fieldSubject(const std::string& file)
{
    TradeSubject subject;
    subject.name = std::filesystem::path(file).filename().string();
    subject.truth = "its own values, looked up by cubic splines";
    subject.grids = {readLevelSet(file)};
    const auto finest = std::make_shared<const DistanceField>(
        subject.grids.front(), FieldOptions{Lookup::Cubic, Normal::Analytic, Storage::Float});
    subject.phi = [finest](const Vec3d& p) { return finest->phi(p); };
    subject.normal = [finest](const Vec3d& p) { return finest->sample(p).gradient; };
    return subject;
}

} // namespace vdbounce::bench
