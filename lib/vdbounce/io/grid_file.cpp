// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/grid_file.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/number_text.h"
#include "vdbounce/io/openvdb_grid.h"
#include "vdbounce/io/vdb_archive.h"

#include <openvdb/points/PointDataGrid.h>

#include <cmath>

namespace vdbounce {
namespace {

std::string storedType(const openvdb::GridBase& grid) { return grid.saveFloatAsHalf() ? "half" : grid.valueType(); }

// A float grid that shares name, transform and topology with a double one.
openvdb::FloatGrid::Ptr toFloat(const openvdb::DoubleGrid& grid)
{
    auto result = std::make_shared<openvdb::FloatGrid>(grid);
    result->setName(grid.getName());
    result->setGridClass(grid.getGridClass());
    return result;
}

openvdb::FloatGrid::ConstPtr asFloatGrid(const openvdb::GridBase::Ptr& grid)
{
    if (auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) return floats;
    if (auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid)) return toFloat(*doubles);
    return nullptr;
}

bool holdsDistances(const openvdb::GridBase& grid)
{
    return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>();
}

std::string classText(const openvdb::GridBase& grid)
{
    return openvdb::GridBase::gridClassToString(grid.getGridClass());
}

GridEntry describe(const VdbGridHeader& header)
{
    const openvdb::GridBase& grid = *header.grid;
    GridEntry entry;
    entry.name = header.uniqueName;
    entry.valueType = storedType(grid);
    entry.gridClass = classText(grid);
    entry.isPoints = grid.isType<openvdb::points::PointDataGrid>();
    entry.linear = grid.transform().isLinear();
    return entry;
}

std::string listing(const std::vector<VdbGridHeader>& headers)
{
    std::string text;
    for (const auto& [uniqueName, grid] : headers) {
        text +=
            (text.empty() ? "'" : ", '") + grid->getName() + "' (" + storedType(*grid) + ", " + classText(*grid) + ")";
    }
    return text.empty() ? "nothing" : text;
}

// The grid of that name, or without one the first level set, or else the first grid of numbers (which is then
// refused or accepted by what it is).
const VdbGridHeader* choose(const std::vector<VdbGridHeader>& headers, const std::string& name)
{
    const VdbGridHeader* candidate = nullptr;
    for (const VdbGridHeader& header : headers) {
        if (!name.empty()) {
            if (header.uniqueName == name || header.grid->getName() == name) return &header;
        } else if (holdsDistances(*header.grid)) {
            if (header.grid->getGridClass() == openvdb::GRID_LEVEL_SET) return &header;
            if (candidate == nullptr) candidate = &header;
        }
    }
    return candidate;
}

void requireLinear(const openvdb::FloatGrid& grid, const std::string& place)
{
    if (grid.transform().isLinear()) return;
    throw InputError(place, "has a transform that is not linear (" + grid.transform().mapType() + ")", "resample it");
}

void requireLevelSet(const openvdb::FloatGrid& grid, const std::string& place)
{
    const std::string remedy = "convert it to a level set first";
    if (grid.getGridClass() == openvdb::GRID_FOG_VOLUME)
        throw InputError(place, "is a fog volume, not a level set", remedy);
    if (grid.getGridClass() == openvdb::GRID_STAGGERED)
        throw InputError(place, "is staggered, not a level set", remedy);
    requireLinear(grid, place);
    if (!(grid.background() > 0.0f) || !std::isfinite(grid.background())) {
        throw InputError(place,
                         "has background " + numberText(grid.background()) + ", a level set's is positive and finite",
                         "write it with its exterior band width as background");
    }
}

// An unsigned field is >= 0 everywhere and has no inside, yet reaches close to zero: everything would leak through.
void refuseUnsigned(const openvdb::FloatGrid& grid, const std::string& place)
{
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) return;
    for (auto it = grid.cbeginValueAll(); it; ++it) {
        if (*it < 0.0f) return;
    }
    throw InputError(place, "is no level set and holds no negative value: an unsigned field has no inside",
                     "make a signed one, or set its grid class to 'level set'");
}

// Calls use(grid, place) with the file's grid of that name, or without one the most likely; `what` is what the caller
// looks for.
template <class Use>
void withFloatGrid(const std::string& path, const std::string& gridName, const std::string& what, const Use& use)
{
    withVdbFile(path, [&](openvdb::io::File& file) {
        const std::vector<VdbGridHeader> headers = readVdbHeaders(file);
        const VdbGridHeader* chosen = choose(headers, gridName);
        if (chosen == nullptr) {
            throw InputError(path,
                             gridName.empty() ? "holds no " + what + " but " + listing(headers)
                                              : "holds no grid '" + gridName + "' but " + listing(headers),
                             "name a file, or a grid in it, with signed distances");
        }
        const std::string place = path + ": grid '" + chosen->uniqueName + "'";
        if (!holdsDistances(*chosen->grid)) {
            throw InputError(place, "holds " + chosen->grid->valueType() + ", not distances",
                             "name a grid of float or double");
        }
        use(asFloatGrid(file.readGrid(chosen->uniqueName)), place);
    });
}

} // namespace

LevelSetGrid toLevelSetGrid(openvdb::FloatGrid::ConstPtr grid, const std::string& place)
{
    requireLevelSet(*grid, place);
    refuseUnsigned(*grid, place);
    return LevelSetGrid(std::make_shared<LevelSetGrid::Holder>(LevelSetGrid::Holder{std::move(grid)}));
}

LevelSetGrid readLevelSet(const std::string& path, const std::string& gridName)
{
    LevelSetGrid result;
    withFloatGrid(path, gridName, "level set",
                  [&](auto grid, const std::string& place) { result = toLevelSetGrid(std::move(grid), place); });
    return result;
}

ScalarGrid readScalarGrid(const std::string& path, const std::string& gridName)
{
    ScalarGrid result;
    withFloatGrid(path, gridName, "grid of numbers", [&](auto grid, const std::string& place) {
        requireLinear(*grid, place);
        result = toScalarGrid(std::move(grid));
    });
    return result;
}

ScalarGrid toScalarGrid(const LevelSetGrid& grid) { return toScalarGrid(grid.holder().grid); }

LevelSetGrid toLevelSetGrid(const ScalarGrid& grid, const std::string& place)
{
    return toLevelSetGrid(grid.holder().grid, place);
}

bool isFogVolume(const ScalarGrid& grid) { return toOpenVdb(grid).getGridClass() == openvdb::GRID_FOG_VOLUME; }

void writeLevelSet(const LevelSetGrid& grid, const std::string& path, const GridWriteOptions& options)
{
    // The copy shares the tree and has its own metadata.
    const openvdb::FloatGrid& source = toOpenVdb(grid);
    openvdb::MetaMap metadata(source);
    metadata.removeMeta(openvdb::GridBase::META_SAVE_HALF_FLOAT);
    if (options.half) metadata.insertMeta(openvdb::GridBase::META_SAVE_HALF_FLOAT, openvdb::BoolMetadata(true));
    openvdb::GridCPtrVec grids{source.copyReplacingMetadata(metadata)};
    for (const SidecarGrid& other : options.beside) {
        if (other) grids.push_back(other.holder().grid);
    }
    writeVdbFile(grids, path);
}

std::vector<GridEntry> listGrids(const std::string& path)
{
    std::vector<GridEntry> entries;
    withVdbFile(path, [&](openvdb::io::File& file) {
        for (const VdbGridHeader& header : readVdbHeaders(file)) entries.push_back(describe(header));
    });
    return entries;
}

} // namespace vdbounce
