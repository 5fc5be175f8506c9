// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/implicit/grid_csg_resample.h"

#include "vdbounce/base/parallel.h"
#include "vdbounce/field/distance_field.h"
#include "vdbounce/field/openvdb_transform.h"
#include "vdbounce/field/sample_points.h"
#include "vdbounce/implicit/grid_csg_complement.h"
#include "vdbounce/implicit/grid_csg_near_leaves.h"

#include <openvdb/tools/Prune.h>

#include <cmath>

namespace vdbounce {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Index;
using Upper = openvdb::FloatTree::RootNodeType::ChildNodeType; // 4096 voxels a side
using Lower = Upper::ChildNodeType;                            // 128
using Leaf = Lower::ChildNodeType;

// Leaves that are looked up at once: enough points for the lookup to put in order, few enough for the cache.
constexpr std::size_t kLeavesPerTask = 4;
constexpr std::size_t kVoxels = Leaf::SIZE;

// Interpolated between values at the end of the band, which all are the same, phi may be off by a few units in the last
// place; what is so near the end counts as beyond. A part of the band's width.
constexpr float kRounding = 1e-5f;

class Resampling {
public:
    Resampling(const DistanceField& field, const LinearTransform& onto, const CsgBand& band, Progress& progress)
        : field_(field), onto_(onto), band_(band), progress_(progress)
    {
    }

    openvdb::FloatTree::Ptr tree(const openvdb::CoordBBox& box)
    {
        const NearLeaves near = leavesNearBlocks(field_, onto_);
        std::vector<const NearLeaves::value_type*> nodes;
        std::uint64_t leaves = 0;
        for (const auto& node : near) {
            nodes.push_back(&node);
            leaves += node.second.count();
        }
        ProgressCounter counter(progress_, leaves);
        std::vector<std::unique_ptr<Lower>> made(nodes.size());
        forEachIndex(nodes.size(), 1, [&](std::size_t i) {
            made[i] = lowerNode(Coord(nodes[i]->first.x, nodes[i]->first.y, nodes[i]->first.z), nodes[i]->second);
            counter.add(nodes[i]->second.count());
        });
        auto tree = std::make_shared<openvdb::FloatTree>(band_.exterior);
        addTiles(box, made, *tree);
        for (auto& node : made) {
            Upper* upper = tree->root().probeNode<Upper>(node->origin());
            upper->addChild(node.release());
        }
        openvdb::tools::prune(*tree);
        return tree;
    }

private:
    // Beyond the band: its width there, with the sign of the source's nearest voxel.
    float farValueAt(const Vec3d& index) const
    {
        const Vec3d nearest = index.array().round();
        return field_.blocks().valueAt(nearest.cast<int>()) < 0.0f ? -band_.interior : band_.exterior;
    }

    // The same for the cube of `side` voxels at `origin`, none of which is near the band.
    float farValue(const Coord& origin, int side) const
    {
        const Vec3d first(origin.x(), origin.y(), origin.z());
        return farValueAt(field_.transform().toIndex(onto_.toWorld(first.array() + 0.5 * (side - 1))));
    }

    std::unique_ptr<Lower> lowerNode(const Coord& origin, const LeafBits& near) const
    {
        auto node = std::make_unique<Lower>(origin, band_.exterior);
        std::vector<Coord> places;
        for (Index n = 0; n < Lower::NUM_VALUES; ++n) {
            const Coord place = node->offsetToGlobalCoord(n);
            if (near.test(n)) {
                places.push_back(place);
            } else if (const float value = farValue(place, int(Leaf::DIM)); value < 0.0f) {
                node->addTile(n, value, false);
            }
        }
        std::vector<std::unique_ptr<Leaf>> leaves(places.size());
        forEachBlock(places.size(), kLeavesPerTask, [&](std::size_t, IndexRange range) {
            fillLeaves(places.data() + range.begin, range.end - range.begin, leaves.data() + range.begin);
        });
        for (auto& leaf : leaves) node->addChild(leaf.release());
        return node;
    }

    void fillLeaves(const Coord* places, std::size_t count, std::unique_ptr<Leaf>* leaves) const
    {
        std::vector<Vec3d> points(count * kVoxels);
        std::vector<PointSample> samples(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Coord voxel = places[i / kVoxels] + Leaf::offsetToLocalCoord(Index(i % kVoxels));
            points[i] = onto_.toWorld(Vec3d(voxel.x(), voxel.y(), voxel.z()));
        }
        // The gradient is not looked at; this one is had for less.
        samplePoints(field_, points.data(), points.size(), samples.data(), Normal::Analytic);
        for (std::size_t i = 0; i < count; ++i) {
            leaves[i] = std::make_unique<Leaf>(places[i], band_.exterior);
            for (Index v = 0; v < kVoxels; ++v) {
                const std::size_t point = i * kVoxels + v;
                const Vec3d index = field_.transform().toIndex(points[point]);
                setVoxel(*leaves[i], v, field_.indexBox().contains(index) ? samples[point].phi : phiBeyondBox(index));
            }
        }
    }

    void setVoxel(Leaf& leaf, Index v, float phi) const
    {
        constexpr float kPart = 1.0f - kRounding;
        if (phi > -band_.interior * kPart && phi < band_.exterior * kPart) {
            leaf.setValueOn(v, phi);
        } else if (phi < 0.0f) {
            leaf.setValueOff(v, -band_.interior);
        }
    }

    // Within a voxel of the box there is something left of the band, unless the box cuts the surface off: then phi
    // jumps there.
    float phiBeyondBox(const Vec3d& index) const
    {
        if (field_.clipped()) return farValueAt(index);
        const Vec3d below = index.array().floor();
        const Vec3d at = index - below;
        const std::array<double, 8> corners = field_.cellCorners(below.cast<int>());
        double phi = 0.0;
        for (int i = 0; i < 8; ++i) {
            const auto share = [&](int axis) { return (i >> axis & 1) != 0 ? at[axis] : 1.0 - at[axis]; };
            phi += share(0) * share(1) * share(2) * corners[std::size_t(i)];
        }
        return float(phi);
    }

    // All that is not near the band, in the cubes of the root that hold nodes or meet `box`; the nodes' own cubes are
    // left to them.
    void addTiles(const openvdb::CoordBBox& box, const std::vector<std::unique_ptr<Lower>>& nodes,
                  openvdb::FloatTree& tree) const
    {
        for (const auto& node : nodes) {
            if (tree.root().probeNode<Upper>(node->origin()) != nullptr) continue;
            tree.root().addChild(upperNode(node->origin()).release());
        }
        const Coord first = box.min() & ~int(Upper::DIM - 1);
        for (int x = first.x(); x <= box.max().x(); x += int(Upper::DIM)) {
            for (int y = first.y(); y <= box.max().y(); y += int(Upper::DIM)) {
                for (int z = first.z(); z <= box.max().z(); z += int(Upper::DIM)) {
                    const Coord cube(x, y, z);
                    if (tree.root().probeNode<Upper>(cube) != nullptr) continue;
                    const float value = farValue(cube, int(Upper::DIM));
                    if (value < 0.0f) tree.root().addTile(cube, value, false);
                }
            }
        }
    }

    std::unique_ptr<Upper> upperNode(const Coord& voxel) const
    {
        auto node = std::make_unique<Upper>(voxel, band_.exterior);
        for (Index n = 0; n < Upper::NUM_VALUES; ++n) {
            const float value = farValue(node->offsetToGlobalCoord(n), int(Lower::DIM));
            if (value < 0.0f) node->addTile(n, value, false);
        }
        return node;
    }

    const DistanceField& field_;
    const LinearTransform& onto_;
    const CsgBand band_;
    Progress& progress_;
};

// The box of `box`, of the source's voxels, in the index space of `onto`.
openvdb::CoordBBox mapped(const openvdb::CoordBBox& box, const LinearTransform& from, const LinearTransform& onto)
{
    openvdb::CoordBBox result;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d index((corner & 1) != 0 ? box.max().x() : box.min().x(),
                          (corner & 2) != 0 ? box.max().y() : box.min().y(),
                          (corner & 4) != 0 ? box.max().z() : box.min().z());
        const Vec3i at = onto.toIndex(from.toWorld(index)).array().round().cast<int>();
        result.expand(Coord(at.x(), at.y(), at.z()));
    }
    return result;
}

} // namespace

FloatGrid::Ptr resampled(const LevelSetGrid& handle, const LinearTransform& onto, const CsgBand& band,
                         Progress& progress)
{
    const FloatGrid& source = toOpenVdb(handle);
    const DistanceField field(handle);
    Resampling resampling(field, onto, band, progress);
    const openvdb::CoordBBox box = paddedBox(source);
    auto tree = box.empty() ? std::make_shared<openvdb::FloatTree>(band.exterior)
                            : resampling.tree(mapped(box, field.transform(), onto));
    auto result = levelSetLike(source, std::move(tree));
    result->setTransform(toOpenVdb(onto));
    return result;
}

} // namespace vdbounce
