// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/velocity_field.h"

#include "vdbounce/io/vdb_archive.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

namespace vdbounce {

struct VelocityField::Holder {
    openvdb::Vec3SGrid::ConstPtr grid;
};

Vec3d VelocityField::at(const Vec3d& world) const
{
    const openvdb::Vec3SGrid& grid = *holder_->grid;
    const openvdb::Vec3d index = grid.worldToIndex(openvdb::Vec3d(world.x(), world.y(), world.z()));
    const openvdb::Vec3f velocity = openvdb::tools::BoxSampler::sample(grid.constTree(), index);
    return Vec3d(velocity.x(), velocity.y(), velocity.z());
}

std::shared_ptr<const VelocityField> readVelocityField(const std::string& path)
{
    openvdb::Vec3SGrid::ConstPtr grid;
    withVdbFile(path, [&](openvdb::io::File& file) {
        for (auto name = file.beginName(); name != file.endName() && !grid; ++name) {
            if (!file.readGridMetadata(name.gridName())->isType<openvdb::Vec3SGrid>()) continue;
            grid = openvdb::gridConstPtrCast<openvdb::Vec3SGrid>(file.readGrid(name.gridName()));
        }
    });
    if (!grid) return nullptr;
    return std::make_shared<const VelocityField>(
        std::make_shared<const VelocityField::Holder>(VelocityField::Holder{grid}));
}

} // namespace vdbounce
