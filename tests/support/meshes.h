// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vdbounce/io/triangle_mesh.h"

namespace vdbounce::test {

/// A box from -half to half, 12 triangles, facing outwards.
TriangleMesh boxMesh(const Vec3d& half, const Vec3d& centre = Vec3d::Zero());

/// A sphere of 8 * 4^level triangles, points on the sphere, facing outwards.
TriangleMesh sphereMesh(double radius, int level, const Vec3d& centre = Vec3d::Zero());

/// Both meshes as one.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);

/// The same mesh inside out.
TriangleMesh flipped(TriangleMesh mesh);

/// Distance to the mesh by asking every triangle, double precision.
double bruteForceDistance(const TriangleMesh& mesh, const Vec3d& p);

/// True where the solid angles of all triangles add up to more than half a sphere.
bool bruteForceInside(const TriangleMesh& mesh, const Vec3d& p);

} // namespace vdbounce::test
