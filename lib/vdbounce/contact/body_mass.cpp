// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/contact/body_mass.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr int kLatticePoints = 96;

// Mass and its first and second moments about the origin of the sum.
struct Moments {
    double mass = 0.0;
    Vec3d first = Vec3d::Zero();
    Mat3d second = Mat3d::Zero();

    Moments& operator+=(const Moments& other)
    {
        mass += other.mass;
        first += other.first;
        second += other.second;
        return *this;
    }
    void add(const Vec3d& at, double share)
    {
        mass += share;
        first += share * at;
        second += share * at * at.transpose();
    }
};

// A box around a shape that has an inside and an end; empty where it has none.
Box closedBox(const Shape& shape)
{
    if (deforms(shape)) return {};
    if (const auto* implicit = std::get_if<std::shared_ptr<const ImplicitField>>(&shape)) {
        const Box box = (*implicit)->box();
        return box.size().allFinite() ? box : Box{};
    }
    const auto* field = std::get_if<std::shared_ptr<const DistanceField>>(&shape);
    if (field == nullptr || (*field)->empty() || (*field)->clipped()) return {};
    return (*field)->worldBox();
}

} // namespace

std::optional<BodyMass> evenDensity(const Shape& shape, double mass)
{
    const Box box = closedBox(shape);
    if (box.empty()) return std::nullopt;
    const double cell = box.size().maxCoeff() / kLatticePoints;
    const Vec3i counts = (box.size() / cell).array().ceil().max(1.0).cast<int>();
    // Moments about the box's centre, so that a place far from the origin costs no precision.
    const Vec3d origin = box.centre();
    const Moments sum = reduceBlocks(std::size_t(counts.x()), 1, Moments{}, [&](IndexRange range) {
        Moments part;
        for (int x = int(range.begin); x < int(range.end); ++x) {
            for (int y = 0; y < counts.y(); ++y) {
                for (int z = 0; z < counts.z(); ++z) {
                    const Vec3d at = box.min + cell * Vec3d(x + 0.5, y + 0.5, z + 0.5);
                    const double share = std::clamp(0.5 - phiOf(shape, at, 0.0) / cell, 0.0, 1.0);
                    if (share > 0.0) part.add(at - origin, share);
                }
            }
        }
        return part;
    });
    if (!(sum.mass > 0.0)) return std::nullopt;
    BodyMass body;
    body.mass = mass;
    const Vec3d centre = sum.first / sum.mass;
    body.centre = origin + centre;
    // Each cell is a cube with moments of its own, cell^2 / 12 an axis.
    const Mat3d spread = sum.second / sum.mass - centre * centre.transpose() + cell * cell / 12.0 * Mat3d::Identity();
    body.inertia = mass * (spread.trace() * Mat3d::Identity() - spread);
    return body;
}

} // namespace vdbounce
