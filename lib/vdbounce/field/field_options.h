// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/field/block_values.h"

namespace vdbounce {

/// How phi is taken from the voxels.
enum class Lookup {
    Nearest,   ///< of the nearest voxel: 1 value, off by half a voxel's diagonal, jumps from voxel to voxel
    Trilinear, ///< of the 8 voxels around the point: continuous
    Cubic, ///< Catmull-Rom splines through the 4^3 voxels around the point: C1, meets every voxel's value, overshoots
           ///< where values kink (for one point at a time several times the cost)
};

/// Where the gradient comes from.
enum class Normal {
    Central,  ///< central differences at the 8 voxels around the point, interpolated trilinearly (32 values):
              ///< continuous; with Lookup::Nearest those at the nearest voxel
    Analytic, ///< the derivative of the trilinear cell (8 values), which jumps from cell to cell; with Lookup::Cubic
              ///< the derivative of the spline, which is continuous
};

/// What scenes, options and reports call them, in the enumerations' order.
constexpr const char* kLookupNames[] = {"nearest", "trilinear", "cubic"};
constexpr const char* kNormalNames[] = {"central", "analytic"};
constexpr const char* kStorageNames[] = {"float", "half", "fixed8"};

inline const char* nameOf(Lookup lookup) { return kLookupNames[int(lookup)]; }
inline const char* nameOf(Normal normal) { return kNormalNames[int(normal)]; }
inline const char* nameOf(Storage storage) { return kStorageNames[int(storage)]; }

struct FieldOptions {
    Lookup lookup = Lookup::Trilinear;
    Normal normal = Normal::Central;
    Storage storage = Storage::Float;

    bool operator==(const FieldOptions& other) const
    {
        return lookup == other.lookup && normal == other.normal && storage == other.storage;
    }
};

} // namespace vdbounce
