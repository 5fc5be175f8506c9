// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/build/hole_caps.h"

#include "vdbounce/base/triangle_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr std::uint32_t kPiecesPerNode = 4;
constexpr std::size_t kStackDepth = 128; // halving 2^32 pieces takes 32 levels, two entries each

// What MeshTree::windingNumber() may be off by.
constexpr double kWindingError = 0.05;

// Change below which it is not worth knowing more exactly what a part of the rim does.
constexpr double kNegligibleChange = 0.001;

// Cones that are looked at to tell whether they fit, and how far from a half the winding number may be there.
constexpr std::size_t kProbes = 2048;
constexpr double kFits = 0.25;
constexpr double kFittingShare = 0.9;

// How far to either side of a cone that is looked at, in square roots of its area.
constexpr double kBeside = 1e-3;

} // namespace

HoleCaps::HoleCaps(TriangleMesh cones) : cones_(std::move(cones)), tree_(cones_)
{
    for (std::size_t t = 0; t < cones_.triangles.size(); ++t)
        pieces_.push_back({cones_.corner(t, 1), cones_.corner(t, 2)});
    Node root;
    root.end = static_cast<std::uint32_t>(pieces_.size());
    nodes_.push_back(root);
    split(0);
}

void HoleCaps::split(std::uint32_t number)
{
    Node node = nodes_[number];
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        node.box.add(pieces_[i].from);
        node.box.add(pieces_[i].to);
        node.length += (pieces_[i].to - pieces_[i].from).norm();
    }
    if (node.end - node.begin > kPiecesPerNode) {
        int axis = 0;
        node.box.size().maxCoeff(&axis);
        const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
        std::nth_element(
            pieces_.begin() + node.begin, pieces_.begin() + middle, pieces_.begin() + node.end,
            [axis](const Piece& a, const Piece& b) { return a.from[axis] + a.to[axis] < b.from[axis] + b.to[axis]; });
        node.child = static_cast<std::uint32_t>(nodes_.size());
        nodes_.resize(nodes_.size() + 2);
        nodes_[node.child].begin = node.begin;
        nodes_[node.child].end = nodes_[node.child + 1].begin = middle;
        nodes_[node.child + 1].end = node.end;
    }
    nodes_[number] = node;
    if (node.child == 0) return;
    split(node.child);
    split(node.child + 1);
}

double HoleCaps::changeAround(const Vec3d& centre, double radius) const
{
    const auto changeOf = [radius](double length, double distance) {
        const double least = distance - radius;
        // Beside a wire a winding number turns by one at most.
        return least > 0.0 ? std::min(1.0, radius * length / (4.0 * M_PI * least * least)) : 1.0;
    };
    std::uint32_t stack[kStackDepth];
    std::size_t top = 0;
    stack[top++] = 0;
    double change = 0.0;
    while (top > 0 && change < 1.0) {
        const Node& node = nodes_[stack[--top]];
        const double ofNode = changeOf(node.length, std::sqrt(distanceSquared(node.box, centre)));
        if (ofNode < kNegligibleChange) {
            change += ofNode;
        } else if (node.child != 0) {
            stack[top++] = node.child;
            stack[top++] = node.child + 1;
        } else {
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                const Piece& piece = pieces_[i];
                const Vec3d nearest = closestPointOnTriangle(centre, piece.from, piece.to, piece.to);
                change += changeOf((piece.to - piece.from).norm(), (nearest - centre).norm());
            }
        }
    }
    return change;
}

bool HoleCaps::fitAsWalls() const
{
    const std::size_t stride = std::max<std::size_t>(1, cones_.triangles.size() / kProbes);
    std::size_t asked = 0;
    std::size_t fitting = 0;
    for (std::size_t t = 0; t < cones_.triangles.size(); t += stride) {
        const Vec3d& a = cones_.corner(t, 0);
        const Vec3d across = (cones_.corner(t, 1) - a).cross(cones_.corner(t, 2) - a);
        const double size = std::sqrt(across.norm());
        if (!(size > 0.0)) continue;
        const Vec3d middle = (a + cones_.corner(t, 1) + cones_.corner(t, 2)) / 3.0;
        const Vec3d step = kBeside * size * across.normalized();
        // A wall by itself winds a half on one side and minus a half on the other; what is left is what all the rest
        // adds to the mesh's own half.
        const double rest = 0.5 * (tree_.windingNumber(middle + step) + tree_.windingNumber(middle - step));
        ++asked;
        fitting += std::abs(rest) < kFits ? 1 : 0;
    }
    return double(fitting) >= kFittingShare * double(asked);
}

HoleCaps::Range HoleCaps::around(const Vec3d& centre, double radius) const
{
    Range range{tree_.windingNumber(centre), kWindingError};
    if (!(radius > 0.0)) return range;
    range.uncertainty += changeAround(centre, radius);
    if (range.uncertainty < 1.0 && tree_.closest(centre).distance <= radius) range.uncertainty += 1.0;
    return range;
}

} // namespace vdbounce
