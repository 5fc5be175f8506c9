// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/field/tetrahedra_cut.h"

#include "vdbounce/base/disjoint_sets.h"
#include "vdbounce/base/vector.h"

#include <Eigen/Geometry>

namespace vdbounce {
namespace {

using Cut = TetrahedraCut;
using Triangle = std::array<std::uint8_t, 3>;

Vec3d cornerPlace(int corner) { return Vec3d(corner & 1, corner >> 1 & 1, corner >> 2 & 1); }

// Corners of the six tetrahedra: from the low corner along the axes in every order.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

void listEdges(Cut& table)
{
    std::size_t count = 0;
    for (int from = 0; from < 8; ++from) {
        for (int to = from + 1; to < 8; ++to) {
            if ((from & to) == from) table.edges[count++] = {std::uint8_t(from), std::uint8_t(to)};
        }
    }
}

std::uint8_t edgeBetween(const Cut& table, int a, int b)
{
    for (std::size_t e = 0; e < Cut::kEdges; ++e) {
        if (table.edges[e].from == std::min(a, b) && table.edges[e].to == std::max(a, b)) return std::uint8_t(e);
    }
    return Cut::kNone;
}

void listFaces(Cut& table)
{
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int bit = 1 << axis;
        std::size_t count = 0;
        for (std::size_t e = 0; e < Cut::kEdges; ++e) {
            const Cut::Edge edge = table.edges[e];
            if (((edge.from | edge.to) & bit) != 0) continue;
            table.lowFace[axis][count] = std::uint8_t(e);
            table.highFace[axis][count++] = edgeBetween(table, edge.from | bit, edge.to | bit);
        }
    }
}

Vec3d edgeMiddle(const Cut& table, std::uint8_t edge)
{
    return 0.5 * (cornerPlace(table.edges[edge].from) + cornerPlace(table.edges[edge].to));
}

// Turned so that its normal points along `outwards`.
void addTriangle(const Cut& table, Triangle triangle, const Vec3d& outwards, Cut::Case& cut)
{
    const Vec3d a = edgeMiddle(table, triangle[0]);
    const Vec3d normal = (edgeMiddle(table, triangle[1]) - a).cross(edgeMiddle(table, triangle[2]) - a);
    if (normal.dot(outwards) < 0.0) std::swap(triangle[1], triangle[2]);
    cut.corners[cut.triangles++] = triangle;
}

void cutTetrahedron(const Cut& table, const int (&corners)[4], int insideBits, Cut::Case& cut)
{
    int inside[4];
    int outside[4];
    int insideCount = 0;
    int outsideCount = 0;
    Vec3d insideSum = Vec3d::Zero();
    Vec3d outsideSum = Vec3d::Zero();
    for (int corner : corners) {
        const bool isInside = (insideBits >> corner & 1) != 0;
        (isInside ? inside[insideCount++] : outside[outsideCount++]) = corner;
        (isInside ? insideSum : outsideSum) += cornerPlace(corner);
    }
    if (insideCount == 0 || outsideCount == 0) return;
    const Vec3d outwards = outsideSum / outsideCount - insideSum / insideCount;
    const auto edge = [&](int a, int b) { return edgeBetween(table, a, b); };
    if (insideCount == 2) {
        const Triangle first{edge(inside[0], outside[0]), edge(inside[0], outside[1]), edge(inside[1], outside[1])};
        const Triangle second{first[0], first[2], edge(inside[1], outside[0])};
        addTriangle(table, first, outwards, cut);
        addTriangle(table, second, outwards, cut);
        return;
    }
    const int alone = insideCount == 1 ? inside[0] : outside[0];
    const int* others = insideCount == 1 ? outside : inside;
    addTriangle(table, {edge(alone, others[0]), edge(alone, others[1]), edge(alone, others[2])}, outwards, cut);
}

// Triangles that share an edge of a tetrahedron hang together.
void findParts(Cut::Case& cut)
{
    DisjointSets sets(Cut::kEdges);
    for (std::size_t t = 0; t < cut.triangles; ++t) {
        sets.join(cut.corners[t][0], cut.corners[t][1]);
        sets.join(cut.corners[t][0], cut.corners[t][2]);
    }
    cut.partOfEdge.fill(Cut::kNone);
    std::array<std::uint8_t, Cut::kEdges> partOfSet;
    partOfSet.fill(Cut::kNone);
    for (std::size_t t = 0; t < cut.triangles; ++t) {
        std::uint8_t& part = partOfSet[sets.find(cut.corners[t][0])];
        if (part == Cut::kNone) part = cut.parts++;
        cut.partOfTriangle[t] = part;
        for (std::uint8_t edge : cut.corners[t]) cut.partOfEdge[edge] = part;
    }
}

Cut makeTable()
{
    Cut table;
    listEdges(table);
    listFaces(table);
    for (int insideBits = 0; insideBits < 256; ++insideBits) {
        Cut::Case& cut = table.cases[std::size_t(insideBits)];
        for (const auto& corners : kTetrahedra) cutTetrahedron(table, corners, insideBits, cut);
        findParts(cut);
    }
    return table;
}

} // namespace

const TetrahedraCut& TetrahedraCut::table()
{
    static const TetrahedraCut made = makeTable();
    return made;
}

} // namespace vdbounce
