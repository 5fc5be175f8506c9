// SPDX-License-Identifier: Apache-2.0
#include "mesh2ls_arguments.h"

#include "vdbounce/field/grid_transform.h"
#include "vdbounce/io/frame_files.h"
#include "vdbounce/io/grid_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace vdbounce::tool {
namespace {

constexpr const char* kVerb = "vdbounce mesh2ls";

// Distances are a few float ulps off, 1e-6 of the band; a thousandth of a voxel is what no use of them notices.
constexpr double kToleranceVx = 1e-3;

// Rounding to 16-bit floats takes no more than this part of a value, and no more than this of those next to zero.
constexpr double kHalfRounding = 1.0 / 2048.0;
constexpr double kHalfSmallest = 1.0 / 33554432.0;

const std::map<std::string, SignMethod> kSignMethods = {{"auto", SignMethod::Auto},
                                                        {"winding", SignMethod::Winding},
                                                        {"parity", SignMethod::Parity},
                                                        {"flood", SignMethod::Flood},
                                                        {"unsigned", SignMethod::Unsigned}};

double longestSide(const MeshToLevelSetOptions& options) { return options.transform->voxelSize().maxCoeff(); }

void addVoxelOptions(CLI::App& verb, Mesh2lsArguments& a)
{
    addSides(verb, "--voxel", a.voxel, "Voxel size, world units; three for voxels that are no cubes");
    verb.add_option("--dim", a.dim, "Voxels on the longest side of the mesh's box (a sequence's first)")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    verb.add_option("--like", a.like, "Voxels where those of the level set in this file are")->type_name("GRID.vdb");
    addBandOptions(verb, a.band, "default 3vx; vx are multiples of a voxel's longest side");
}

void addOutputOptions(CLI::App& verb, Mesh2lsArguments& a)
{
    verb.add_option("--name", a.name, "Name of the grid")->capture_default_str();
    verb.add_flag("--half", a.half, "Store values as 16-bit floats");
    verb.add_flag("--closest", a.closest, "Add a grid NAME_closest: each voxel's closest triangle, counted from 0");
    verb.add_flag("--confidence", a.confidence, "Add a grid NAME_confidence: how certain each voxel's sign is, 0 to 1");
    verb.add_flag("--velocity", a.velocity, "Of a sequence: add a grid v, the velocity of each voxel's closest point");
    verb.add_option("--fps", a.fps, "With --velocity: frames a second")->check(CLI::PositiveNumber)->type_name("F");
    verb.add_option("--dt", a.dt, "With --velocity: seconds a frame, instead of --fps")
        ->check(CLI::PositiveNumber)
        ->type_name("S");
}

} // namespace

bool Mesh2lsArguments::isSequence() const { return isFramePattern(input) && !std::filesystem::exists(input); }

void addMesh2lsOptions(CLI::App& verb, Mesh2lsArguments& a)
{
    verb.add_option("IN", a.input, "Mesh: .obj, .stl, .ply or .off; with #### for the frame: all frames there are")
        ->required();
    verb.add_option("-o,--output", a.output, "Level set to write, .vdb; with #### for a sequence's frame")->required();
    addVoxelOptions(verb, a);
    addChoice(verb, "--sign", a.sign, kSignMethods,
              "How inside is told from outside: auto, winding, parity, flood, unsigned");
    addLength(verb, "--thickness", a.thickness, "Thickness of the sheet that --sign unsigned makes (default 2vx)");
    addOutputOptions(verb, a);
    addBytes(verb, "--max-memory", a.maxMemory,
             "Refuse what is expected to take more, 500M or 2G (default three quarters of the machine's)");
    verb.add_flag("--verify", a.verify, "Compare the result with exact distances and signs; see --tolerance");
    addLength(verb, "--tolerance", a.tolerance,
              "With --verify, which it implies: exit 4 when off by more or on the wrong side, and write nothing "
              "(default 1e-3vx, with --half and what rounding takes of the band)");
    verb.footer("Example:\n  vdbounce mesh2ls bunny.obj -o bunny.vdb --dim 128\n"
                "  vdbounce mesh2ls body.####.obj -o body.####.vdb --dim 128 --velocity --fps 24");
}

void requireSound(const Mesh2lsArguments& a)
{
    const auto require = [](bool good, const char* what, const char* remedy) {
        if (!good) throw UsageError(kVerb, what, remedy);
    };
    const int given = int(a.voxel.has_value()) + int(a.dim.has_value()) + int(!a.like.empty());
    require(given == 1, "exactly one of --voxel and --dim is needed, or --like", "give for example --dim 128");
    requireNoClash(a.band, kVerb);
    const bool sequence = a.isSequence();
    require(sequence == isFramePattern(a.output),
            sequence ? "a sequence needs #### in its output's name, too" : "only a sequence has #### in its output",
            "write for example mesh2ls body.####.obj -o body.####.vdb");
    require(!a.velocity || sequence, "--velocity needs a sequence", "write for example body.####.obj");
    require(!a.velocity || a.fps.has_value() != a.dt.has_value(), "--velocity needs either --fps or --dt",
            "give for example --fps 24");
    require(a.velocity || (!a.fps && !a.dt), "--fps and --dt say nothing without --velocity", "add --velocity");
    requireOutput(a.output, {"vdb"}, {a.input, a.like});
}

LinearTransform transformFor(const Mesh2lsArguments& a, const TriangleMesh& first, const std::string& path)
{
    if (!a.like.empty()) return transformOf(readLevelSet(a.like));
    if (a.voxel) return LinearTransform(a.voxel->asDiagonal(), Vec3d::Zero());
    const double longest = boundingBox(first).size().maxCoeff();
    if (!(longest > 0.0))
        throw InputError(path, "all its points are in one place, so --dim says nothing", "give --voxel");
    return LinearTransform(longest / *a.dim * Mat3d::Identity(), Vec3d::Zero());
}

MeshToLevelSetOptions optionsFor(const Mesh2lsArguments& a, const LinearTransform& transform)
{
    MeshToLevelSetOptions options;
    options.transform = transform;
    options.sign = a.sign;
    options.gridName = a.name;
    options.closest = a.closest || a.velocity;
    options.confidence = a.confidence;
    options.maxMemory = a.maxMemory;
    const double voxel = longestSide(options);
    if (const auto outside = a.band.outside()) options.exteriorVx = outside->voxels(voxel);
    if (const auto inside = a.band.inside()) options.interiorVx = inside->voxels(voxel);
    if (a.thickness) options.thicknessVx = a.thickness->voxels(voxel);
    return options;
}

double toleranceVx(const Mesh2lsArguments& a, const MeshToLevelSetOptions& options)
{
    const double voxel = longestSide(options);
    if (a.tolerance) return a.tolerance->voxels(voxel);
    if (!a.half) return kToleranceVx;
    const double band = std::max(options.exteriorVx, options.interiorVx);
    return kToleranceVx + std::max(band * kHalfRounding, kHalfSmallest / voxel);
}

} // namespace vdbounce::tool
