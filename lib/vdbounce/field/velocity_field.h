// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/vector.h"

#include <memory>
#include <string>

namespace vdbounce {

/// Velocities at the voxels of an OpenVDB grid of three floats (world units a second), interpolated trilinearly; zero
/// where the grid holds none. Safe to use from any number of threads.
class VelocityField {
public:
    struct Holder; ///< defined in velocity_field.cpp, so that OpenVDB's headers stay out of this one

    explicit VelocityField(std::shared_ptr<const Holder> holder) : holder_(std::move(holder)) {}

    Vec3d at(const Vec3d& world) const;

private:
    std::shared_ptr<const Holder> holder_;
};

/// The first grid of three floats in a .vdb file. Null where there is none. Throws InputError as readLevelSet() does.
std::shared_ptr<const VelocityField> readVelocityField(const std::string& path);

} // namespace vdbounce
