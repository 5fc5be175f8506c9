// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/base/error.h"
#include "vdbounce/io/particle_columns.h"
#include "vdbounce/io/particle_file.h"
#include "vdbounce/io/ply_reader.h"
#include "vdbounce/io/safe_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace vdbounce {
namespace {

// PLY has no 64-bit integers. Ids that fit are int; larger ones are double, which holds them up to 2^53.
constexpr double kLargestExactId = 9007199254740992.0;

ParticleTable tableFor(const PlyElement& element, const std::string& path)
{
    std::vector<std::string> names;
    for (const PlyProperty& property : element.properties) {
        names.push_back(property.listCount ? "list " + property.name : property.name);
    }
    return ParticleTable(names, path);
}

void readVertices(PlyReader& ply, const PlyElement& element, const ParticleTable& table, Particles& particles)
{
    const std::vector<int>& columns = table.columns();
    table.resize(particles, 0);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        ply.readRow();
        // Grown as rows come, so that a wrong count in the header cannot claim memory for rows that are not there.
        if (row == particles.size()) table.resize(particles, std::min<std::uint64_t>(element.count, 2 * row + 1024));
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (columns[c] < 0) continue;
            const auto column = static_cast<ParticleColumn>(columns[c]);
            const double value = ply.value(static_cast<int>(c));
            if (column == ParticleColumn::Id && (std::abs(value) > kLargestExactId || value != std::floor(value))) {
                throw InputError(ply.place(), "an id that is no whole number", "correct the id");
            }
            ParticleTable::set(particles, row, column, value);
        }
    }
}

template <class T> void appendBytes(std::string& out, T value)
{
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

bool idsFitInt(const Particles& particles)
{
    return std::all_of(particles.id.begin(), particles.id.end(), [](std::int64_t id) {
        return id >= std::numeric_limits<std::int32_t>::min() && id <= std::numeric_limits<std::int32_t>::max();
    });
}

void requireExactIds(const Particles& particles, const std::string& path)
{
    for (std::int64_t id : particles.id) {
        if (std::abs(static_cast<double>(id)) > kLargestExactId) {
            throw InputError(path, "id " + std::to_string(id) + " is too large for PLY", "write .csv or .vdb");
        }
    }
}

} // namespace

Particles readPlyParticles(const std::string& path)
{
    PlyReader ply(path);
    Particles particles;
    bool found = false;
    while (const PlyElement* element = ply.nextElement()) {
        if (element->name != "vertex") continue;
        readVertices(ply, *element, tableFor(*element, path), particles);
        found = true;
        break;
    }
    if (!found) throw InputError(path, "holds no element 'vertex'", "name a PLY file of points");
    return particles;
}

void writePlyParticles(const Particles& particles, const std::string& path)
{
    const std::vector<ParticleColumn> columns = presentColumns(particles);
    const bool intIds = idsFitInt(particles);
    requireExactIds(particles, path);

    std::string out = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(particles.size()) + "\n";
    for (ParticleColumn column : columns) {
        out += (column == ParticleColumn::Id && intIds) ? "property int " : "property double ";
        out += std::string(columnName(column)) + "\n";
    }
    out += "end_header\n";
    out.reserve(out.size() + particles.size() * columns.size() * sizeof(double));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (ParticleColumn column : columns) {
            if (column == ParticleColumn::Id && intIds) {
                appendBytes(out, static_cast<std::int32_t>(particles.id[i]));
            } else {
                appendBytes(out, columnValue(particles, i, column));
            }
        }
    }
    writeTextFile(path, out);
}

} // namespace vdbounce
