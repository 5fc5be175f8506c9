// SPDX-License-Identifier: Apache-2.0
#include "transform_words.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace vdbounce::tool {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

// Turns and differences of sides below this are rounding: of a matrix in double that was read from a file of floats.
constexpr double kRounding = 1e-6;

struct Parts {
    bool cubes;
    bool mirrored;
    double turned; // degrees
    Vec3d about;
    Vec3d angles; // degrees between axes y and z, z and x, x and y
};

double angleBetween(const Vec3d& a, const Vec3d& b) { return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b)); }

// The rotation that is left when the voxel's stretch and shear are taken off, and a mirror along one axis or all,
// whichever leaves the smallest turn.
Eigen::AngleAxisd turnOf(const Mat3d& matrix)
{
    const Eigen::JacobiSVD<Mat3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3d turn = svd.matrixU() * svd.matrixV().transpose();
    if (turn.determinant() > 0.0) return Eigen::AngleAxisd(turn);
    Eigen::AngleAxisd least(Mat3d(-turn));
    for (int axis = 0; axis < 3; ++axis) {
        Mat3d flipped = turn;
        flipped.col(axis) *= -1.0;
        const Eigen::AngleAxisd candidate(flipped);
        if (candidate.angle() < least.angle() - kRounding) least = candidate;
    }
    return least;
}

Parts partsOf(const LinearTransform& transform)
{
    Parts parts;
    const Mat3d& m = transform.indexToWorld();
    const Vec3d& sides = transform.voxelSize();
    parts.cubes = transform.orthogonal() && sides.maxCoeff() - sides.minCoeff() < kRounding * sides.maxCoeff();
    parts.mirrored = m.determinant() < 0.0;
    const Eigen::AngleAxisd turn = turnOf(m * sides.cwiseInverse().asDiagonal());
    parts.turned = turn.angle() < kRounding ? 0.0 : kDegrees * turn.angle();
    // Without what rounding adds to an axis of the world.
    parts.about = parts.turned == 0.0
                      ? Vec3d(Vec3d::Zero())
                      : Vec3d(turn.axis().unaryExpr([](double v) { return std::abs(v) < kRounding ? 0.0 : v; }));
    for (int axis = 0; axis < 3; ++axis)
        parts.angles[axis] = angleBetween(m.col((axis + 1) % 3), m.col((axis + 2) % 3));
    return parts;
}

} // namespace

std::string transformWords(const LinearTransform& transform)
{
    const Parts parts = partsOf(transform);
    const Vec3d& sides = transform.voxelSize();
    std::string words = parts.cubes
                            ? "cubes of side " + rounded(sides.x())
                            : "sides " + rounded(sides.x()) + ", " + rounded(sides.y()) + ", " + rounded(sides.z());
    if (parts.turned == 0.0) {
        words += transform.orthogonal() ? " along the world's axes" : "";
    } else {
        words += ", turned by " + rounded(parts.turned) + " degrees about " + vectorText(parts.about);
    }
    if (!transform.orthogonal())
        words += ", sheared: axes meet at " + rounded(parts.angles.x()) + ", " + rounded(parts.angles.y()) + " and " +
                 rounded(parts.angles.z()) + " degrees";
    if (parts.mirrored) words += ", mirrored";
    return words;
}

Json transformJson(const LinearTransform& transform)
{
    const Parts parts = partsOf(transform);
    Json matrix = Json::array();
    for (int row = 0; row < 3; ++row) matrix.push_back(toJson(transform.indexToWorld().row(row).transpose()));
    return {
        {"words", transformWords(transform)},  {"sides", toJson(transform.voxelSize())}, {"cubes", parts.cubes},
        {"turned_deg", parts.turned},          {"turned_about", toJson(parts.about)},    {"mirrored", parts.mirrored},
        {"sheared", !transform.orthogonal()},  {"angles_deg", toJson(parts.angles)},     {"matrix", matrix},
        {"origin", toJson(transform.origin())}};
}

} // namespace vdbounce::tool
