// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace vdbounce {

/// Another OpenVDB grid that goes into a level set's file beside it: closest triangles, confidence, velocities. A
/// handle, as LevelSetGrid is; `vdbounce/io/openvdb_grid.h` converts from and to openvdb's grids. Empty where nothing
/// was made.
class SidecarGrid {
public:
    struct Holder; ///< defined in openvdb_grid.h

    SidecarGrid() = default;
    explicit SidecarGrid(std::shared_ptr<const Holder> holder) : holder_(std::move(holder)) {}

    explicit operator bool() const { return holder_ != nullptr; }
    const Holder& holder() const { return *holder_; }

private:
    std::shared_ptr<const Holder> holder_;
};

} // namespace vdbounce
