// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/particle_columns.h"

#include "vdbounce/base/error.h"

namespace vdbounce {

ParticleTable::ParticleTable(const std::vector<std::string>& names, const std::string& place)
{
    for (const std::string& name : names) {
        int column = -1;
        for (std::size_t c = 0; c < kParticleColumnNames.size(); ++c) {
            if (name == kParticleColumnNames[c]) column = static_cast<int>(c);
        }
        if (column >= 0) {
            if (present_[static_cast<std::size_t>(column)])
                throw InputError(place, "column '" + name + "' comes twice", "remove one of them");
            present_[static_cast<std::size_t>(column)] = true;
        }
        columns_.push_back(column);
    }
    if (!has(ParticleColumn::X) || !has(ParticleColumn::Y) || !has(ParticleColumn::Z)) {
        throw InputError(place, "there are no columns x, y and z", "name the columns of the positions x, y and z");
    }
    const int velocityParts =
        int(has(ParticleColumn::Vx)) + int(has(ParticleColumn::Vy)) + int(has(ParticleColumn::Vz));
    if (velocityParts != 0 && velocityParts != 3) {
        throw InputError(place, "only part of vx, vy and vz is there", "give all three or none");
    }
}

void ParticleTable::resize(Particles& particles, std::size_t count) const
{
    particles.position.resize(count, Vec3d::Zero());
    if (has(ParticleColumn::Vx)) particles.velocity.resize(count, Vec3d::Zero());
    if (has(ParticleColumn::Radius)) particles.radius.resize(count);
    if (has(ParticleColumn::Mass)) particles.mass.resize(count);
    if (has(ParticleColumn::Id)) {
        particles.id.resize(count);
    } else {
        numberInOrder(particles);
    }
}

void ParticleTable::set(Particles& particles, std::size_t row, ParticleColumn column, double value)
{
    switch (column) {
    case ParticleColumn::X: particles.position[row].x() = value; break;
    case ParticleColumn::Y: particles.position[row].y() = value; break;
    case ParticleColumn::Z: particles.position[row].z() = value; break;
    case ParticleColumn::Vx: particles.velocity[row].x() = value; break;
    case ParticleColumn::Vy: particles.velocity[row].y() = value; break;
    case ParticleColumn::Vz: particles.velocity[row].z() = value; break;
    case ParticleColumn::Radius: particles.radius[row] = value; break;
    case ParticleColumn::Mass: particles.mass[row] = value; break;
    case ParticleColumn::Id: particles.id[row] = static_cast<std::int64_t>(value); break;
    }
}

std::vector<ParticleColumn> presentColumns(const Particles& particles)
{
    std::vector<ParticleColumn> columns = {ParticleColumn::X, ParticleColumn::Y, ParticleColumn::Z};
    if (!particles.velocity.empty()) {
        columns.insert(columns.end(), {ParticleColumn::Vx, ParticleColumn::Vy, ParticleColumn::Vz});
    }
    if (!particles.radius.empty()) columns.push_back(ParticleColumn::Radius);
    if (!particles.mass.empty()) columns.push_back(ParticleColumn::Mass);
    columns.push_back(ParticleColumn::Id);
    return columns;
}

double columnValue(const Particles& particles, std::size_t row, ParticleColumn column)
{
    switch (column) {
    case ParticleColumn::X: return particles.position[row].x();
    case ParticleColumn::Y: return particles.position[row].y();
    case ParticleColumn::Z: return particles.position[row].z();
    case ParticleColumn::Vx: return particles.velocity[row].x();
    case ParticleColumn::Vy: return particles.velocity[row].y();
    case ParticleColumn::Vz: return particles.velocity[row].z();
    case ParticleColumn::Radius: return particles.radius[row];
    case ParticleColumn::Mass: return particles.mass[row];
    case ParticleColumn::Id: break;
    }
    return static_cast<double>(particles.id[row]);
}

} // namespace vdbounce
