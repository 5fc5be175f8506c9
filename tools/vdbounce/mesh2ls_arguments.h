// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "band_arguments.h"

#include "vdbounce/build/mesh_to_level_set.h"

#include <optional>
#include <string>

namespace vdbounce::tool {

/// What mesh2ls was asked for.
struct Mesh2lsArguments {
    std::string input;  ///< with #### for several frames
    std::string output; ///< likewise
    std::optional<Vec3d> voxel;
    std::optional<int> dim;
    std::string like;
    BandArguments band;
    std::optional<Length> thickness;
    SignMethod sign = SignMethod::Auto;
    std::string name = "surface";
    bool half = false;
    bool closest = false;
    bool confidence = false;
    bool velocity = false;
    std::optional<double> fps;
    std::optional<double> dt;
    std::uint64_t maxMemory = 0;
    bool verify = false;
    std::optional<Length> tolerance;

    bool verified() const { return verify || tolerance.has_value(); }

    /// True where the input names the frames of a sequence, and no file is called just so.
    bool isSequence() const;

    /// Between frames; of a sequence with velocities.
    double secondsPerFrame() const { return dt ? *dt : 1.0 / *fps; }
};

void addMesh2lsOptions(CLI::App& verb, Mesh2lsArguments& arguments);

/// Throws UsageError for what cannot be asked for together.
void requireSound(const Mesh2lsArguments& arguments);

/// Where the voxels are to lie. `first` is the mesh, or that of the first frame, read from `path`.
LinearTransform transformFor(const Mesh2lsArguments& arguments, const TriangleMesh& first, const std::string& path);

MeshToLevelSetOptions optionsFor(const Mesh2lsArguments& arguments, const LinearTransform& transform);

/// The largest error that is met, multiples of the longest side: --tolerance or its default.
double toleranceVx(const Mesh2lsArguments& arguments, const MeshToLevelSetOptions& options);

} // namespace vdbounce::tool
