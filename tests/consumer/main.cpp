// SPDX-License-Identifier: Apache-2.0
// The README's example for developers, as a program of its own: a mesh becomes a field, particles bounce off it.
#include <iostream>
#include <vdbounce/build/mesh_to_level_set.h>
#include <vdbounce/contact/particle_pass.h>
#include <vdbounce/field/sample_points.h>
#include <vdbounce/io/mesh_file.h>
#include <vector>

int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    vdbounce::MeshToLevelSetOptions options;
    options.voxelSize = 0.1;
    const auto levelSet = vdbounce::meshToLevelSet(vdbounce::readMesh(argv[1]), options);
    const auto field = std::make_shared<const vdbounce::DistanceField>(levelSet.grid);
    const vdbounce::ColliderSet colliders({{"bunny", field, /*restitution=*/0.3, /*friction=*/0.5}});

    vdbounce::Particles particles;
    particles.resize(1000);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.position[i] = {0.005 * double(i) - 2.5, 10.0, 0.0};
    particles.ensureVelocity();
    const auto report =
        vdbounce::advanceParticles(particles, colliders, vdbounce::StepOptions{}, {/*radius=*/0.05}, 400);

    for (const vdbounce::Vec3d& p : particles.position) {
        if (!(field->phi(p) >= 0.05)) return 1;
    }
    std::vector<vdbounce::PointSample> samples(particles.size());
    vdbounce::samplePoints(*field, particles.position.data(), samples.size(), samples.data());
    for (const vdbounce::PointSample& sample : samples) {
        if (!(sample.phi >= 0.0499f)) return 1;
    }
    std::cout << report.tally.contacts << " contacts\n";
    return report.tally.contacts > 0 ? 0 : 1;
}
