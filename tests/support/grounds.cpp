// SPDX-License-Identifier: Apache-2.0
#include "support/grounds.h"

#include "support/grids.h"

namespace vdbounce::test {

std::vector<Ground> grounds(const Vec3d& normal)
{
    auto turned = uniformTransform(kGroundVoxel);
    turned->postRotate(0.4, openvdb::math::X_AXIS);
    turned->postRotate(0.3, openvdb::math::Z_AXIS);
    const Phi phi = halfSpace(normal, kGroundOffset);
    const auto field = [&](const openvdb::math::Transform::Ptr& transform) {
        return std::make_shared<const DistanceField>(levelSet(bandGrid(phi, transform, 40, 6.0)));
    };
    return {{"plane", PlaneField(kGroundOffset * normal.normalized(), normal)},
            {"aligned level set", field(uniformTransform(kGroundVoxel))},
            {"turned level set", field(turned)}};
}

StillColliders single(const Ground& ground, double restitution, double friction)
{
    return StillColliders({{"ground", ground.shape, restitution, friction}});
}

} // namespace vdbounce::test
