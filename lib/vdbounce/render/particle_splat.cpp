// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/particle_splat.h"

#include "vdbounce/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr int kBandRows = 16;           // rows of the picture that one task draws
constexpr float kSmallestPixels = 0.7f; // a particle never becomes invisible
constexpr float kLargestPixels = 400.0f;
constexpr double kFastQuantile = 0.9;
constexpr double kCoveredShare = 0.35; // of the frame's largest face, when the radius is ours to choose

// Slow is deep blue, fast is warm: sRGB.
const std::array<Colour, 5> kSpeedScale = {Colour(0.05f, 0.22f, 0.55f), Colour(0.06f, 0.45f, 0.75f),
                                           Colour(0.20f, 0.70f, 0.80f), Colour(0.98f, 0.80f, 0.42f),
                                           Colour(0.95f, 0.42f, 0.18f)};

struct Disc {
    float x, y, depth, radius; // pixels, but depth in world units
    std::uint32_t particle;
};

std::vector<Disc> project(const Particles& particles, const ParticleLook& look, const Camera& camera)
{
    std::vector<Disc> discs(particles.size());
    forEachIndex(particles.size(), 8192, [&](std::size_t i) {
        const Vec3d offset = particles.position[i] - camera.eye;
        const double depth = offset.dot(camera.forward);
        Disc disc{0.0f, 0.0f, -1.0f, 0.0f, static_cast<std::uint32_t>(i)};
        if (depth > 0.0 && offset.allFinite()) {
            const double scale = camera.pixelsPerSlope / depth;
            disc.x = float(offset.dot(camera.right) * scale + 0.5 * camera.width);
            disc.y = float(0.5 * camera.height - offset.dot(camera.up) * scale);
            disc.depth = float(depth);
            disc.radius = std::clamp(float(look.radius[i] * scale), kSmallestPixels, kLargestPixels);
        }
        discs[i] = disc;
    });
    return discs;
}

// Draws the part of a sphere that lies in rows [rowBegin, rowEnd).
void drawSphere(const Disc& disc, const Colour& albedo, const Camera& camera, int rowBegin, int rowEnd,
                SurfaceBuffer& buffer)
{
    const float worldPerPixel = disc.depth / float(camera.pixelsPerSlope);
    const int y0 = std::max(rowBegin, int(std::floor(disc.y - disc.radius)));
    const int y1 = std::min(rowEnd - 1, int(std::ceil(disc.y + disc.radius)));
    const int x0 = std::max(0, int(std::floor(disc.x - disc.radius)));
    const int x1 = std::min(buffer.width - 1, int(std::ceil(disc.x + disc.radius)));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const float dx = (float(x) + 0.5f - disc.x) / disc.radius;
            const float dy = (float(y) + 0.5f - disc.y) / disc.radius;
            const float r2 = dx * dx + dy * dy;
            if (r2 > 1.0f) continue;
            const float dz = std::sqrt(1.0f - r2);
            SurfaceBuffer::Pixel& pixel = buffer.at(x, y);
            const float depth = disc.depth - dz * disc.radius * worldPerPixel;
            if (depth >= pixel.depth) continue;
            pixel.depth = depth;
            pixel.normal = (camera.right * dx - camera.up * dy - camera.forward * dz).cast<float>();
            pixel.albedo = albedo;
            pixel.gloss = 0.35f;
        }
    }
}

float fastSpeed(const Particles& particles)
{
    std::vector<float> speeds;
    const std::size_t stride = std::max<std::size_t>(1, particles.size() / 65536);
    for (std::size_t i = 0; i < particles.velocity.size(); i += stride) {
        const double speed = particles.velocity[i].norm();
        if (std::isfinite(speed)) speeds.push_back(float(speed));
    }
    if (speeds.empty()) return 1.0f;
    const auto at = speeds.begin() + std::ptrdiff_t(kFastQuantile * double(speeds.size() - 1));
    std::nth_element(speeds.begin(), at, speeds.end());
    return std::max(*at, 1e-12f);
}

} // namespace

ParticleLook lookOf(const Particles& particles, double askedRadius, const Box& frame)
{
    ParticleLook look;
    look.radius.resize(particles.size());
    look.albedo.resize(particles.size());
    const float fast = fastSpeed(particles);
    const double face = std::pow(frame.size().maxCoeff(), 2.0);
    const double suitable =
        std::sqrt(kCoveredShare * face / (M_PI * double(std::max<std::size_t>(1, particles.size()))));
    forEachIndex(particles.size(), 8192, [&](std::size_t i) {
        double radius = askedRadius > 0.0 ? askedRadius : suitable;
        if (askedRadius <= 0.0 && !particles.radius.empty() && particles.radius[i] > 0.0) radius = particles.radius[i];
        look.radius[i] = float(radius);
        const float speed = particles.velocity.empty() ? 0.0f : float(particles.velocity[i].norm());
        look.albedo[i] = toLinear(onScale(kSpeedScale, std::isfinite(speed) ? speed / fast : 1.0f));
    });
    return look;
}

void splatParticles(const Particles& particles, const ParticleLook& look, const Camera& camera, SurfaceBuffer& buffer)
{
    const std::vector<Disc> discs = project(particles, look, camera);
    // Each task draws its own rows, in the order of the particles, so that no two write to a pixel.
    const int bands = (buffer.height + kBandRows - 1) / kBandRows;
    std::vector<std::vector<std::uint32_t>> inBand(static_cast<std::size_t>(bands));
    for (std::size_t i = 0; i < discs.size(); ++i) {
        const Disc& disc = discs[i];
        if (disc.depth <= 0.0f || disc.x + disc.radius < 0.0f || disc.x - disc.radius > float(buffer.width)) continue;
        if (disc.y + disc.radius < 0.0f || disc.y - disc.radius > float(buffer.height)) continue;
        const int first = std::max(0, int(disc.y - disc.radius - 1.0f) / kBandRows);
        const int last = std::min(bands - 1, int(disc.y + disc.radius + 1.0f) / kBandRows);
        for (int band = first; band <= last; ++band) inBand[std::size_t(band)].push_back(static_cast<std::uint32_t>(i));
    }
    forEachIndex(inBand.size(), 1, [&](std::size_t band) {
        const int begin = int(band) * kBandRows;
        for (std::uint32_t i : inBand[band]) {
            drawSphere(discs[i], look.albedo[i], camera, begin, std::min(buffer.height, begin + kBandRows), buffer);
        }
    });
}

} // namespace vdbounce
