// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/particles/particles.h"

#include <string>

/// @file
/// Particle files by ending, with all attributes (position, velocity, radius, mass, id), in and out.
///
/// | ending | names | precision |
/// |---|---|---|
/// | .csv | a header, then columns by name: x,y,z and vx,vy,vz,radius,mass,id where present; rows ordered by id | reads
/// back to the same bits | | .ply | vertex properties of the same names; written binary little-endian, read in all
/// three forms | reads back to the same bits | | .vdb | an OpenVDB points grid with P, v, pscale, mass, id | single;
/// positions relative to their voxel, so to 2^-26 of a points voxel anywhere in space |
///
/// Attributes that a file lacks stay empty (velocity, radius, mass) or become the position in the file (id).
/// Other columns and attributes are passed over. Errors are InputErrors naming file and line or element, a value that
/// is not a number included; NaN and infinity are numbers and are read as they stand.

namespace vdbounce {

/// True for the endings that can be read and written.
bool isParticleFile(const std::string& path);

/// Throws UsageError unless `path` has one of those endings.
void requireParticleFile(const std::string& path);

Particles readParticles(const std::string& path);

/// Writes the file whole or not at all.
void writeParticles(const Particles& particles, const std::string& path);

Particles readCsvParticles(const std::string& path);
void writeCsvParticles(const Particles& particles, const std::string& path);
Particles readPlyParticles(const std::string& path);
void writePlyParticles(const Particles& particles, const std::string& path);
Particles readVdbParticles(const std::string& path);
void writeVdbParticles(const Particles& particles, const std::string& path);

} // namespace vdbounce
