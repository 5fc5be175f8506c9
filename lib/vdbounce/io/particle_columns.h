// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/particles/particles.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace vdbounce {

/// The columns of a table of particles, as csv and ply name them.
enum class ParticleColumn {
    X,
    Y,
    Z,
    Vx,
    Vy,
    Vz,
    Radius,
    Mass,
    Id,
    Stuck,
    Rejected,
    HitTime,
    HitX,
    HitY,
    HitZ,
    HitNx,
    HitNy,
    HitNz,
    HitVx,
    HitVy,
    HitVz,
    HitCollider,
    HitCount,
};
constexpr std::size_t kParticleColumns = 23;

const char* columnName(ParticleColumn column);

/// Assigns table cells to a particle set column by column. Made from the names of a file's columns in the file's order.
class ParticleTable {
public:
    /// Refuses names without x, y and z, names that come twice, and part of a velocity; `place` is the header's.
    ParticleTable(const std::vector<std::string>& names, const std::string& place);

    /// The known column at each position of the file, or -1 for one to pass over.
    const std::vector<int>& columns() const { return columns_; }

    /// Room for `count` rows with the attributes that the table has; ids are numbered where it has none.
    void resize(Particles& particles, std::size_t count) const;

    static void set(Particles& particles, std::size_t row, ParticleColumn column, double value);

private:
    bool has(ParticleColumn column) const { return present_[static_cast<std::size_t>(column)]; }

    std::vector<int> columns_;
    std::array<bool, kParticleColumns> present_{};
};

/// The columns that hold something in `particles`, in the order of the enumeration.
std::vector<ParticleColumn> presentColumns(const Particles& particles);

/// The value in a column other than Id.
double columnValue(const Particles& particles, std::size_t row, ParticleColumn column);

} // namespace vdbounce
