// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/slice.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/render/palette.h"

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

constexpr float kZeroLinePixels = 1.3f; // half width
constexpr float kContourPixels = 0.6f;
constexpr int kParticlePixels = 2; // radius of a dot

const std::array<Colour, 3> kOutside = {Colour(0.62f, 0.78f, 0.92f), Colour(0.84f, 0.91f, 0.97f),
                                        Colour(0.97f, 0.98f, 0.99f)};
const std::array<Colour, 3> kInside = {Colour(0.98f, 0.72f, 0.45f), Colour(0.99f, 0.86f, 0.70f),
                                       Colour(0.99f, 0.95f, 0.90f)};
const Colour kZeroLine(0.05f, 0.05f, 0.08f);
const Colour kParticle(0.75f, 0.05f, 0.25f);

// Pixels and the world plane that they show.
struct Window {
    int width, height;
    int horizontal, vertical, axis; // world axes
    Vec3d corner;                   // world, of the picture's lower left corner
    double worldPerPixel;

    Vec3d worldAt(double x, double y) const
    {
        Vec3d world = corner;
        world[horizontal] += (x + 0.5) * worldPerPixel;
        world[vertical] += (height - y - 0.5) * worldPerPixel;
        return world;
    }
};

Window windowFor(const DistanceField& field, const SliceOptions& options)
{
    const Box box = field.worldBox();
    if (box.empty()) throw InputError("slice", "the field is empty", "name a level set with a surface");
    Window window{};
    window.axis = options.axis;
    window.horizontal = options.axis == 0 ? 2 : 0;
    window.vertical = options.axis == 1 ? 2 : 1;
    const double margin = options.margin * box.size().maxCoeff();
    const double wide = box.size()[window.horizontal] + 2.0 * margin;
    const double high = box.size()[window.vertical] + 2.0 * margin;
    window.worldPerPixel = std::max(wide, high) / options.size;
    window.width = std::max(1, int(std::lround(wide / window.worldPerPixel)));
    window.height = std::max(1, int(std::lround(high / window.worldPerPixel)));
    window.corner = box.min - Vec3d::Constant(margin);
    window.corner[options.axis] = options.at.value_or(box.centre()[options.axis]);
    return window;
}

Colour colourOf(const DistanceField& field, double phi, double worldPerPixel)
{
    const auto share = float(std::min(1.0, std::abs(phi) / field.background()));
    Colour colour = phi < 0.0 ? onScale(kInside, share) : onScale(kOutside, share);
    const double inVoxels = std::abs(phi) / field.voxelSize();
    const double toContour = std::abs(inVoxels - std::round(inVoxels)) * field.voxelSize() / worldPerPixel;
    if (std::abs(phi) < 0.95 * field.background() && toContour < double(kContourPixels)) colour *= 0.86f;
    const float toZero = float(std::abs(phi) / worldPerPixel);
    const float line = std::clamp(kZeroLinePixels + 0.5f - toZero, 0.0f, 1.0f);
    return colour + line * (kZeroLine - colour);
}

void put(RgbImage& image, int x, int y, const Colour& colour)
{
    for (int channel = 0; channel < 3; ++channel) {
        image.bytes[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 3 + std::size_t(channel)] =
            toByte(colour[channel]);
    }
}

void drawParticles(const Particles& particles, const Window& window, double slab, RgbImage& image)
{
    for (const Vec3d& p : particles.position) {
        if (!p.allFinite() || std::abs(p[window.axis] - window.corner[window.axis]) > slab) continue;
        const double px = (p[window.horizontal] - window.corner[window.horizontal]) / window.worldPerPixel;
        const double py = window.height - (p[window.vertical] - window.corner[window.vertical]) / window.worldPerPixel;
        if (px < -8.0 || py < -8.0 || px > window.width + 8.0 || py > window.height + 8.0) continue;
        for (int y = int(py) - kParticlePixels; y <= int(py) + kParticlePixels; ++y) {
            for (int x = int(px) - kParticlePixels; x <= int(px) + kParticlePixels; ++x) {
                const double distance = std::hypot(x + 0.5 - px, y + 0.5 - py);
                if (x < 0 || y < 0 || x >= image.width || y >= image.height || distance > kParticlePixels) continue;
                put(image, x, y, kParticle);
            }
        }
    }
}

} // namespace

RgbImage renderSlice(const DistanceField& field, const Particles& particles, const SliceOptions& options)
{
    if (options.size < 16 || options.size > 16384)
        throw UsageError("--size", std::to_string(options.size) + " is out of range", "give 16 to 16384 pixels");
    const Window window = windowFor(field, options);
    RgbImage image(window.width, window.height);
    forEachIndex(std::size_t(window.height), 8, [&](std::size_t y) {
        for (int x = 0; x < window.width; ++x) {
            put(image, x, int(y), colourOf(field, field.phi(window.worldAt(x, double(y))), window.worldPerPixel));
        }
    });
    drawParticles(particles, window, options.slab > 0.0 ? options.slab : 2.0 * field.voxelSize(), image);
    return image;
}

} // namespace vdbounce
