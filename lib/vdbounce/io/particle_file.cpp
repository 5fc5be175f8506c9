// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/particle_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/file_bytes.h"

namespace vdbounce {
namespace {

struct ParticleFormat {
    const char* ending;
    Particles (*read)(const std::string&);
    void (*write)(const Particles&, const std::string&);
};
constexpr ParticleFormat kFormats[] = {{"vdb", readVdbParticles, writeVdbParticles},
                                       {"csv", readCsvParticles, writeCsvParticles},
                                       {"ply", readPlyParticles, writePlyParticles}};
constexpr const char* kRemedy = "use .vdb, .csv or .ply";

const ParticleFormat* findFormat(const std::string& path)
{
    const std::string ending = fileEnding(path);
    for (const ParticleFormat& format : kFormats) {
        if (ending == format.ending) return &format;
    }
    return nullptr;
}

} // namespace

bool isParticleFile(const std::string& path) { return findFormat(path) != nullptr; }

void requireParticleFile(const std::string& path)
{
    if (!isParticleFile(path)) throw UsageError(path, "'." + fileEnding(path) + "' is no particle format", kRemedy);
}

Particles readParticles(const std::string& path)
{
    requireReadableFile(path);
    const ParticleFormat* format = findFormat(path);
    if (format == nullptr) throw InputError(path, "'." + fileEnding(path) + "' is no particle format", kRemedy);
    return format->read(path);
}

void writeParticles(const Particles& particles, const std::string& path)
{
    requireParticleFile(path);
    findFormat(path)->write(particles, path);
}

} // namespace vdbounce
