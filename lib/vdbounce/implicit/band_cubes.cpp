// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/band_cubes.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/implicit/leaf_limit.h"

#include <cstdint>

namespace vdbounce {
namespace {

constexpr int kLeafSide = 8;

// The cubes to begin with are an eighth of the longest side or more: some hundred at most.
constexpr int kCubesAlongBox = 8;

constexpr std::size_t kCubesPerTask = 256;

// Rounding of phi at the middle of a cube, as a share of the cube.
constexpr double kRounding = 1e-9;

enum class Place : std::uint8_t { Outside, Band, Inside };

int firstSide(const VoxelBox& box)
{
    const int longest = (box.max - box.min).maxCoeff() + 1;
    int side = kLeafSide;
    while (std::int64_t(side) * kCubesAlongBox < longest) side *= 2;
    return side;
}

// The cubes of that side, at multiples of it, which meet the box.
std::vector<VoxelCube> coverBox(const VoxelBox& box, int side)
{
    const auto down = [&](int x) { return x >= 0 ? x / side * side : -((-x + side - 1) / side) * side; };
    std::vector<VoxelCube> cubes;
    for (int x = down(box.min.x()); x <= box.max.x(); x += side) {
        for (int y = down(box.min.y()); y <= box.max.y(); y += side) {
            for (int z = down(box.min.z()); z <= box.max.z(); z += side) cubes.push_back({Vec3i(x, y, z), side});
        }
    }
    return cubes;
}

std::vector<VoxelCube> eighthsOf(const std::vector<VoxelCube>& cubes, const VoxelBox& within)
{
    std::vector<VoxelCube> eighths;
    eighths.reserve(cubes.size() * 8);
    for (const VoxelCube& cube : cubes) {
        const int side = cube.side / 2;
        for (int i = 0; i < 8; ++i) {
            const VoxelCube eighth{cube.origin + side * Vec3i(i >> 2 & 1, i >> 1 & 1, i & 1), side};
            if (within.meets(eighth)) eighths.push_back(eighth);
        }
    }
    return eighths;
}

} // namespace

BandCubes findBandCubes(const ImplicitField& field, const LinearTransform& transform, const BandCubesOptions& options)
{
    const double half = 0.5 * transform.voxelDiagonal(); // of one voxel, world
    BandCubes found;
    if (options.within.empty()) return found;
    std::vector<VoxelCube> cubes = coverBox(options.within, firstSide(options.within));
    std::vector<Place> places;
    while (true) {
        places.resize(cubes.size());
        forEachIndex(cubes.size(), kCubesPerTask, [&](std::size_t i) {
            const VoxelCube& cube = cubes[i];
            const Vec3d middle = cube.origin.cast<double>() + Vec3d::Constant(0.5 * (cube.side - 1));
            const double reach = (1.0 + kRounding) * half * (cube.side - 1) * field.lipschitz();
            const double phi = field.phi(transform.toWorld(middle), options.time);
            places[i] = phi >= options.exterior + reach    ? Place::Outside
                        : phi <= -options.interior - reach ? Place::Inside
                                                           : Place::Band;
        });
        std::vector<VoxelCube> band;
        for (std::size_t i = 0; i < cubes.size(); ++i) {
            if (places[i] == Place::Inside) found.inside.push_back(cubes[i]);
            if (places[i] == Place::Band) band.push_back(cubes[i]);
        }
        requireLeaves(band.size(), options.maxLeaves);
        if (band.empty() || band.front().side == kLeafSide) {
            found.leaves = std::move(band);
            return found;
        }
        cubes = eighthsOf(band, options.within);
    }
}

} // namespace vdbounce
