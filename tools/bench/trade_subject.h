// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/base/progress.h"
#include "vdbounce/io/level_set_grid.h"

#include <functional>
#include <string>
#include <vector>

namespace vdbounce::bench {

/// A body that is known better than by any of the grids made of it.
struct TradeSubject {
    std::string name;
    std::string truth;                         ///< what errors are measured against, in words
    std::function<double(const Vec3d&)> phi;   ///< the true distance, world units; safe from many threads
    std::function<Vec3d(const Vec3d&)> normal; ///< its gradient; zero where it has none
    std::vector<LevelSetGrid> grids;           ///< the finest first, each with voxels twice as large as the one before
};

/// A sphere, a torus and a box by formula, 128 voxels and less across, off the voxels' axes.
std::vector<TradeSubject> analyticSubjects(Progress& progress);

/// A mesh at `dim`, half and a quarter of that many voxels along its longest side, against its own triangles.
TradeSubject meshSubject(const std::string& file, int dim, Progress& progress);

/// A level set as it is in its file, against its own finest setting: float values, looked up by cubic splines with
/// their slope. How far the grid itself is from what it was made of is not in that.
TradeSubject fieldSubject(const std::string& file);

} // namespace vdbounce::bench
