// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr double kHalfAngle = 0.24; // radians, of the shorter side: a portrait lens, little distortion
constexpr double kMargin = 1.06;    // room around the box

Vec3d corner(const Box& box, int i)
{
    return Vec3d((i & 1) != 0 ? box.max.x() : box.min.x(), (i & 2) != 0 ? box.max.y() : box.min.y(),
                 (i & 4) != 0 ? box.max.z() : box.min.z());
}

} // namespace

Camera frameBox(const Box& box, const Vec3d& view, const Vec3d& up, int width, int height)
{
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.forward = -view.normalized();
    const Vec3d side = camera.forward.cross(up);
    camera.right = (side.norm() > 1e-9 ? side : Vec3d(camera.forward.unitOrthogonal())).normalized();
    camera.up = camera.right.cross(camera.forward);
    camera.pixelsPerSlope = 0.5 * std::min(width, height) / std::tan(kHalfAngle);

    // Far enough back that every corner's slope fits, horizontally and vertically.
    const double slopeX = 0.5 * width / camera.pixelsPerSlope;
    const double slopeY = 0.5 * height / camera.pixelsPerSlope;
    double distance = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Vec3d offset = kMargin * (corner(box, i) - box.centre());
        const double need =
            std::max(std::abs(offset.dot(camera.right)) / slopeX, std::abs(offset.dot(camera.up)) / slopeY);
        distance = std::max(distance, need - offset.dot(camera.forward));
    }
    camera.eye = box.centre() - std::max(distance, 1e-9) * camera.forward;
    return camera;
}

} // namespace vdbounce
