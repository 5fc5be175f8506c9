// SPDX-License-Identifier: Apache-2.0
#include "support/broken_files.h"
#include "support/meshes.h"
#include "support/run_tool.h"
#include "support/temporary_folder.h"

#include "vdbounce/base/error.h"
#include "vdbounce/io/mesh_file.h"
#include "vdbounce/io/polygon.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cstring>

using namespace vdbounce;
using test::TemporaryFolder;

namespace {

template <class T> std::string bytesOf(T value, bool big = false)
{
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

const TriangleMesh& tetrahedron()
{
    static const TriangleMesh mesh{{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)},
                                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    return mesh;
}

std::string asObj(const TriangleMesh& mesh)
{
    std::ostringstream out;
    for (const Vec3d& p : mesh.points) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    return out.str();
}

std::string asOff(const TriangleMesh& mesh)
{
    std::ostringstream out;
    out << "OFF\n# a comment\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (const Vec3d& p : mesh.points) out << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << " 255 0 0\n";
    return out.str();
}

std::string asTextStl(const TriangleMesh& mesh)
{
    std::ostringstream out;
    out << "solid thing\n";
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out << "facet normal 0 0 0\n outer loop\n";
        for (int c = 0; c < 3; ++c) out << "  vertex " << mesh.corner(t, c).transpose() << '\n';
        out << " endloop\nendfacet\n";
    }
    out << "endsolid thing\n";
    return out.str();
}

std::string asBinaryStl(const TriangleMesh& mesh)
{
    // Starts with "solid", as some exporters write, to show that size decides.
    std::string out = "solid binary";
    out.resize(80, ' ');
    out += bytesOf(std::uint32_t(mesh.triangles.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out += std::string(12, '\0');
        for (int c = 0; c < 3; ++c) {
            for (double x : mesh.corner(t, c)) out += bytesOf(float(x));
        }
        out += std::string(2, '\0');
    }
    return out;
}

std::string plyHeader(const TriangleMesh& mesh, const std::string& format)
{
    std::ostringstream out;
    out << "ply\nformat " << format << " 1.0\ncomment made by hand\nelement vertex " << mesh.points.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nelement face "
        << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    return out.str();
}

std::string asTextPly(const TriangleMesh& mesh)
{
    std::ostringstream out;
    out << plyHeader(mesh, "ascii");
    for (const Vec3d& p : mesh.points) out << p.transpose() << " 7\n";
    for (const auto& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return out.str();
}

std::string asBinaryPly(const TriangleMesh& mesh, bool big)
{
    std::string out = plyHeader(mesh, big ? "binary_big_endian" : "binary_little_endian");
    for (const Vec3d& p : mesh.points) {
        for (double x : p) out += bytesOf(float(x), big);
        out += '\7';
    }
    for (const auto& t : mesh.triangles) {
        out += '\3';
        for (std::uint32_t i : t) out += bytesOf(std::int32_t(i), big);
    }
    return out;
}

void requireTetrahedron(const TriangleMesh& mesh)
{
    REQUIRE(mesh.triangles.size() == 4);
    REQUIRE(mesh.points.size() == 4);
    CHECK(inspectEdges(mesh).closedAndOriented());
    double volume = 0.0;
    for (std::size_t t = 0; t < 4; ++t)
        volume += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6.0;
    CHECK(volume == Approx(1.0 / 6.0));
}

} // namespace

TEST_CASE("every mesh format gives the same mesh")
{
    const TemporaryFolder folder;
    const TriangleMesh& mesh = tetrahedron();
    requireTetrahedron(readMesh(folder.write("a.obj", asObj(mesh))));
    requireTetrahedron(readMesh(folder.write("b.OFF", asOff(mesh))));
    requireTetrahedron(readMesh(folder.write("c.stl", asTextStl(mesh))));
    requireTetrahedron(readMesh(folder.write("d.stl", asBinaryStl(mesh))));
    requireTetrahedron(readMesh(folder.write("e.ply", asTextPly(mesh))));
    requireTetrahedron(readMesh(folder.write("f.ply", asBinaryPly(mesh, false))));
    requireTetrahedron(readMesh(folder.write("g.ply", asBinaryPly(mesh, true))));
}

TEST_CASE("obj understands what exporters write")
{
    const TemporaryFolder folder;
    const std::string text = "# comment\r\nmtllib x.mtl\r\no thing\r\nv 0 0 0 1.0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 "
                             "0\r\nvn 0 0 1\r\nvt 0 0\r\ns off\r\nf 1/1/1 2//1 \\\r\n 3/1 -1\r\n";
    const TriangleMesh mesh = readMesh(folder.write("a.obj", text));
    CHECK(mesh.points.size() == 4);
    CHECK(mesh.triangles.size() == 2);
}

TEST_CASE("polygons are cut into triangles of the same area, concave ones too")
{
    TriangleMesh mesh;
    // An L, a quad with a reflex corner, and a star, in a slanted plane.
    const auto slanted = [](double x, double y) { return Vec3d(x, y, 0.3 * x - 0.7 * y); };
    const std::vector<std::vector<Vec3d>> polygons = {
        {slanted(0, 0), slanted(2, 0), slanted(2, 1), slanted(1, 1), slanted(1, 2), slanted(0, 2)},
        {slanted(0, 0), slanted(1, 0.2), slanted(2, 0), slanted(1, 2)},
        {slanted(0, 3), slanted(-0.5, 1), slanted(-3, 0), slanted(-0.5, -1), slanted(0, -3), slanted(0.5, -1),
         slanted(3, 0), slanted(0.5, 1)}};
    for (const auto& polygon : polygons) {
        mesh.points = polygon;
        mesh.triangles.clear();
        std::vector<std::uint32_t> corners;
        Vec3d area = Vec3d::Zero();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            corners.push_back(std::uint32_t(i));
            area += 0.5 * polygon[i].cross(polygon[(i + 1) % polygon.size()]);
        }
        appendPolygon(mesh, corners);
        REQUIRE(mesh.triangles.size() == polygon.size() - 2);
        double sum = 0.0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            sum += 0.5 * (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).norm();
        CHECK(sum == Approx(area.norm()));
    }
}

TEST_CASE("a broken mesh is refused with its place")
{
    std::string shortStl = asBinaryStl(tetrahedron());
    shortStl.resize(shortStl.size() - 20);
    std::string shortPly = asBinaryPly(tetrahedron(), false);
    shortPly.resize(shortPly.size() - 5);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::string nanStl = asBinaryStl(tetrahedron());
    std::memcpy(nanStl.data() + 84 + 50 + 12, &nan, 4);

    const std::vector<test::BrokenFile> files = {
        {"empty.obj", "", "empty.obj", "no faces"},
        {"points.obj", "v 0 0 0\nv 1 0 0\n", "points.obj", "no faces (2 points)"},
        {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 9\n", "index.obj:5", "out of range"},
        {"zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "zero.obj:4", "is no index"},
        {"negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -9\n", "negative.obj:4", "out of range"},
        {"two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "two.obj:3", "2 corners"},
        {"word.obj", "v 0 zero 0\n", "word.obj:1", "zero"},
        {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:2", "not finite"},
        {"inf.off", "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "inf.off: point 1", "not finite"},
        {"magic.off", "OOF\n3 1 0\n", "magic.off:1", "does not start with OFF"},
        {"counts.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "counts.off:7", "the file ends"},
        {"huge.off", "OFF\n4000000000000 1 0\n0 0 0\n", "huge.off:2", "does not fit"},
        {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "index.off:6", "out of range"},
        {"blank.stl", "", "blank.stl", "is empty"},
        {"short.stl", shortStl, "short.stl", "announces 4 triangles but holds 3"},
        {"nan.stl", nanStl, "nan.stl: triangle 1", "not finite"},
        {"cut.stl", asTextStl(tetrahedron()).substr(0, 150), "cut.stl", "the file ends"},
        {"short.ply", shortPly, "short.ply: face 3", "the file ends"},
        {"magic.ply", "play\n", "magic.ply:1", "'ply'"},
        {"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "header.ply", "within its header"},
        {"type.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\nend_header\n", "type.ply:4",
         "no PLY type"},
        {"xyz.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "xyz.ply",
         "x, y or z"},
        {"nofaces.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 "
         "0 0\n",
         "nofaces.ply", "no faces"},
        {"ending.fbx", "x", "ending.fbx", "no mesh format"},
    };
    test::checkRefused(files, readMesh);
    const TemporaryFolder folder;
    CHECK_THROWS_AS(readMesh(folder / "missing.obj"), InputError);
    CHECK_THROWS_AS(readMesh(folder / ""), InputError);
}

TEST_CASE("the bunny is closed and oriented")
{
    const TriangleMesh mesh = readMesh(test::sourcePath("data/bunny.obj"));
    CHECK(mesh.triangles.size() == 3674);
    CHECK(inspectEdges(mesh).closedAndOriented());
}

TEST_CASE("edges tell holes, flipped faces and fins apart")
{
    TriangleMesh open = tetrahedron();
    open.triangles.pop_back();
    CHECK(inspectEdges(open).open == 3);
    TriangleMesh turned = tetrahedron();
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    CHECK(inspectEdges(turned).inconsistent == 3);
    TriangleMesh fin = tetrahedron();
    fin.points.emplace_back(2, 2, 2);
    fin.triangles.push_back({0, 1, 4});
    CHECK(inspectEdges(fin).nonManifold == 1);
    CHECK(inspectEdges(fin).open == 2);
}
