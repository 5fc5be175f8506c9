// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/particle_columns.h"

#include "vdbounce/base/error.h"

#include <cmath>
#include <limits>

namespace vdbounce {
namespace {

// One column of the table: its name, and how it is found, made room for, read and written.
struct Column {
    const char* name;
    bool (*present)(const Particles&);
    void (*resize)(Particles&, std::size_t);
    double (*get)(const Particles&, std::size_t);
    void (*set)(Particles&, std::size_t, double);
};

// What is no whole number, or too large, is -1: no collider, and nothing counted.
template <class Whole> Whole whole(double value)
{
    // The largest of 64 bits is no double; the next above it is.
    const double end = std::ldexp(1.0, std::numeric_limits<Whole>::digits);
    const double least = std::numeric_limits<Whole>::is_signed ? -end : 0.0;
    if (!(value >= least && value < end && value == std::trunc(value))) return static_cast<Whole>(-1);
    return static_cast<Whole>(value);
}

bool always(const Particles&) { return true; }

template <int Axis> Column position(const char* name)
{
    return {name, always, [](Particles& p, std::size_t n) { p.position.resize(n, Vec3d::Zero()); },
            [](const Particles& p, std::size_t i) { return p.position[i][Axis]; },
            [](Particles& p, std::size_t i, double value) { p.position[i][Axis] = value; }};
}

template <int Axis> Column velocity(const char* name)
{
    return {name, [](const Particles& p) { return !p.velocity.empty(); },
            [](Particles& p, std::size_t n) { p.velocity.resize(n, Vec3d::Zero()); },
            [](const Particles& p, std::size_t i) { return p.velocity[i][Axis]; },
            [](Particles& p, std::size_t i, double value) { p.velocity[i][Axis] = value; }};
}

template <auto Values> Column scalar(const char* name)
{
    return {name, [](const Particles& p) { return !(p.*Values).empty(); },
            [](Particles& p, std::size_t n) { (p.*Values).resize(n); },
            [](const Particles& p, std::size_t i) { return double((p.*Values)[i]); },
            [](Particles& p, std::size_t i, double value) {
                using Value = std::decay_t<decltype((p.*Values)[i])>;
                if constexpr (std::is_floating_point_v<Value>) {
                    (p.*Values)[i] = value;
                } else {
                    (p.*Values)[i] = whole<Value>(value);
                }
            }};
}

bool hasHits(const Particles& p) { return !p.hits.empty(); }
void resizeHits(Particles& p, std::size_t n) { p.hits.resize(n); }

template <auto Member, int Axis> Column hitVector(const char* name)
{
    return {name, hasHits, resizeHits, [](const Particles& p, std::size_t i) { return (p.hits[i].*Member)[Axis]; },
            [](Particles& p, std::size_t i, double value) { (p.hits[i].*Member)[Axis] = value; }};
}

template <auto Member> Column hitNumber(const char* name)
{
    return {name, hasHits, resizeHits, [](const Particles& p, std::size_t i) { return double(p.hits[i].*Member); },
            [](Particles& p, std::size_t i, double value) {
                using Value = std::decay_t<decltype(p.hits[i].*Member)>;
                if constexpr (std::is_floating_point_v<Value>) {
                    p.hits[i].*Member = value;
                } else {
                    p.hits[i].*Member = whole<Value>(value);
                }
            }};
}

// In the order of ParticleColumn.
const std::array<Column, kParticleColumns>& columnTable()
{
    static const std::array<Column, kParticleColumns> table = {
        position<0>("x"),
        position<1>("y"),
        position<2>("z"),
        velocity<0>("vx"),
        velocity<1>("vy"),
        velocity<2>("vz"),
        scalar<&Particles::radius>("radius"),
        scalar<&Particles::mass>("mass"),
        scalar<&Particles::id>("id"),
        scalar<&Particles::stuckTo>("stuck"),
        scalar<&Particles::rejected>("rejected"),
        hitNumber<&HitRecord::time>("hit_time"),
        hitVector<&HitRecord::position, 0>("hit_x"),
        hitVector<&HitRecord::position, 1>("hit_y"),
        hitVector<&HitRecord::position, 2>("hit_z"),
        hitVector<&HitRecord::normal, 0>("hit_nx"),
        hitVector<&HitRecord::normal, 1>("hit_ny"),
        hitVector<&HitRecord::normal, 2>("hit_nz"),
        hitVector<&HitRecord::velocity, 0>("hit_vx"),
        hitVector<&HitRecord::velocity, 1>("hit_vy"),
        hitVector<&HitRecord::velocity, 2>("hit_vz"),
        hitNumber<&HitRecord::collider>("hit_collider"),
        hitNumber<&HitRecord::count>("hit_count"),
    };
    return table;
}

const Column& rowOf(ParticleColumn column) { return columnTable()[static_cast<std::size_t>(column)]; }

} // namespace

const char* columnName(ParticleColumn column) { return rowOf(column).name; }

ParticleTable::ParticleTable(const std::vector<std::string>& names, const std::string& place)
{
    for (const std::string& name : names) {
        int column = -1;
        for (std::size_t c = 0; c < kParticleColumns; ++c) {
            if (name == columnTable()[c].name) column = static_cast<int>(c);
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
    for (std::size_t c = 0; c < kParticleColumns; ++c) {
        if (present_[c]) columnTable()[c].resize(particles, count);
    }
    if (!has(ParticleColumn::Id)) numberInOrder(particles);
}

void ParticleTable::set(Particles& particles, std::size_t row, ParticleColumn column, double value)
{
    rowOf(column).set(particles, row, value);
}

std::vector<ParticleColumn> presentColumns(const Particles& particles)
{
    std::vector<ParticleColumn> columns;
    for (std::size_t c = 0; c < kParticleColumns; ++c) {
        if (columnTable()[c].present(particles)) columns.push_back(static_cast<ParticleColumn>(c));
    }
    return columns;
}

double columnValue(const Particles& particles, std::size_t row, ParticleColumn column)
{
    return rowOf(column).get(particles, row);
}

} // namespace vdbounce
