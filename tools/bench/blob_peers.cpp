// SPDX-License-Identifier: Apache-2.0
#include "bench/blob_peers.h"

#include "vdbounce/io/openvdb_grid.h"

#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/ParticlesToLevelSet.h>

#include <algorithm>
#include <cmath>

#include <tbb/global_control.h>

namespace vdbounce::bench {
namespace {

// Particles as ParticlesToLevelSet asks for them, whose function names these are.
class ParticleList {
public:
    using PosType = openvdb::Vec3R;

    explicit ParticleList(const Particles& particles) : particles_(particles) {}

    std::size_t size() const { return particles_.size(); }
    void getPos(std::size_t n, openvdb::Vec3R& position) const
    {
        const Vec3d& p = particles_.position[n];
        position = openvdb::Vec3R(p.x(), p.y(), p.z());
    }
    void getPosRad(std::size_t n, openvdb::Vec3R& position, openvdb::Real& radius) const
    {
        getPos(n, position);
        radius = particles_.radius[n];
    }

private:
    const Particles& particles_;
};

bool haveOneRadius(const Particles& particles)
{
    return std::all_of(particles.radius.begin(), particles.radius.end(),
                       [&](double radius) { return radius == particles.radius.front(); });
}

} // namespace

LevelSetGrid particlesToLevelSet(const Particles& particles, double voxelSize, double halfWidthVx)
{
    const auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxelSize, halfWidthVx);
    openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> rasterizer(*grid);
    rasterizer.setRmin(0.0);
    rasterizer.setRmax(1e9);
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    rasterizer.setGrainSize(threads > 1 ? 1 : 0);
    if (haveOneRadius(particles)) {
        rasterizer.rasterizeSpheres(ParticleList(particles), particles.radius.front());
    } else {
        rasterizer.rasterizeSpheres(ParticleList(particles));
    }
    rasterizer.finalize(/*prune=*/true);
    return toLevelSetGrid(grid, "peer");
}

double largestSphereErrorVx(const LevelSetGrid& grid, const Particles& particles, std::size_t count)
{
    const openvdb::FloatGrid& voxels = toOpenVdb(grid);
    const std::size_t step = std::max<std::size_t>(1, std::size_t(voxels.activeVoxelCount()) / count);
    double largest = 0.0;
    std::size_t i = 0;
    for (auto it = voxels.cbeginValueOn(); it; ++it, ++i) {
        if (i % step != 0) continue;
        const openvdb::Vec3d at = voxels.indexToWorld(it.getCoord());
        const Vec3d p(at.x(), at.y(), at.z());
        double exact = HUGE_VAL;
        for (std::size_t n = 0; n < particles.size(); ++n)
            exact = std::min(exact, (particles.position[n] - p).norm() - particles.radius[n]);
        largest = std::max(largest, std::abs(exact - double(*it)));
    }
    return largest / voxels.voxelSize().x();
}

} // namespace vdbounce::bench
