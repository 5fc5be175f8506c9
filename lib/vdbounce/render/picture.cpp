// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/render/picture.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/render/camera.h"
#include "vdbounce/render/particle_splat.h"
#include "vdbounce/render/ray_march.h"
#include "vdbounce/render/shadow_map.h"
#include "vdbounce/render/surface_buffer.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vdbounce {
namespace {

using Fields = std::vector<std::shared_ptr<const DistanceField>>;

constexpr int kSamples = 2; // a side, of each pixel
constexpr int kSmallestSize = 16;
constexpr int kLargestSize = 16384;
constexpr float kExposure = 1.05f;
constexpr double kOpennessReachVx = 3.0;
constexpr double kFloorFade = 1.1; // the floor fades into the background within this many frame sizes

const Colour kSolidAlbedo = toLinear(Colour(0.86f, 0.83f, 0.78f));
const Colour kFloorAlbedo = toLinear(Colour(0.66f, 0.68f, 0.71f));
const Colour kKeyLight(2.30f, 2.15f, 1.95f);
const Colour kSkyLight(0.62f, 0.70f, 0.82f);
const Colour kFloorLight(0.30f, 0.28f, 0.26f);
const Colour kBackgroundTop = toLinear(Colour(0.56f, 0.63f, 0.71f));
const Colour kBackgroundBottom = toLinear(Colour(0.78f, 0.81f, 0.84f));

void validate(const PictureOptions& options)
{
    for (const int side : {options.width, options.height}) {
        if (side < kSmallestSize || side > kLargestSize)
            throw UsageError("--size", std::to_string(side) + " is out of range", "give 16 to 16384 pixels a side");
    }
    if (!(options.view.norm() > 0.0) || !(options.up.norm() > 0.0))
        throw UsageError("--view, --up", "are zero", "give a direction");
}

Box frameOf(const Fields& fields, const Particles& particles, const PictureOptions& options)
{
    if (options.frame) return *options.frame;
    Box box;
    for (const auto& field : fields) {
        if (!field->empty()) box.add(field->worldBox());
    }
    if (box.empty()) box.add(boundingBox(particles));
    if (box.empty()) throw InputError("render", "there is nothing to show", "name files with a surface or particles");
    return box;
}

// Everything that lighting needs to know.
class Stage {
public:
    Stage(const Fields& fields, const Particles& particles, const PictureOptions& options)
        : fields_(fields), up_(options.up.normalized()), ground_(options.ground),
          frame_(frameOf(fields, particles, options)),
          camera_(frameBox(frame_, options.view, options.up, options.width * kSamples, options.height * kSamples)),
          look_(lookOf(particles, options.particleRadius, frame_)),
          towardsLight_((0.9 * up_ - 0.45 * camera_.right - 0.35 * camera_.forward).normalized()),
          shadows_(particles, look_, towardsLight_, frame_), buffer_(camera_.width, camera_.height)
    {
        forEachIndex(std::size_t(camera_.height), 4, [&](std::size_t y) {
            for (int x = 0; x < camera_.width; ++x) showSurfaces(x, int(y));
        });
        splatParticles(particles, look_, camera_, buffer_);
    }

    RgbImage develop(Progress& progress) const
    {
        RgbImage image(camera_.width / kSamples, camera_.height / kSamples);
        ProgressCounter counter(progress, std::uint64_t(image.height));
        forEachIndex(std::size_t(image.height), 4, [&](std::size_t y) {
            for (int x = 0; x < image.width; ++x) developPixel(image, x, int(y));
            counter.add(1);
        });
        return image;
    }

private:
    void showSurfaces(int x, int y)
    {
        const Vec3d ray = camera_.rayThrough(x, y);
        SurfaceBuffer::Pixel& pixel = buffer_.at(x, y);
        for (const auto& field : fields_) {
            if (field->empty()) continue;
            const auto t = marchToSurface(*field, camera_.eye, ray, 0.0, double(std::min(pixel.depth, 1e30f)));
            if (!t) continue;
            pixel.depth = float(*t);
            pixel.normal = field->sample(camera_.eye + *t * ray).gradient.normalized().cast<float>();
            pixel.albedo = kSolidAlbedo;
            pixel.gloss = 0.15f;
        }
        if (!ground_) return;
        const double t = (*ground_ - camera_.eye.dot(up_)) / ray.dot(up_);
        if (t > 0.0 && t < double(pixel.depth)) {
            pixel.depth = float(t);
            pixel.normal = up_.cast<float>();
            pixel.albedo = kFloorAlbedo;
            pixel.gloss = 0.0f;
        }
    }

    Colour background(int y) const
    {
        const float t = float(y) / float(camera_.height);
        return kBackgroundTop + t * (kBackgroundBottom - kBackgroundTop);
    }

    Colour light(int x, int y) const
    {
        const SurfaceBuffer::Pixel& pixel = buffer_.at(x, y);
        if (!(pixel.depth < std::numeric_limits<float>::infinity())) return background(y);
        const Vec3d ray = camera_.rayThrough(x, y);
        const Vec3d point = camera_.eye + double(pixel.depth) * ray;
        const Vec3d normal = pixel.normal.cast<double>();
        double reaching = shadows_.lightReaching(point);
        double open = 1.0;
        for (const auto& field : fields_) {
            if (field->empty()) continue;
            if (reaching > 0.0)
                reaching *= lightReaching(*field, point + 1.5 * field->voxelSize() * normal, towardsLight_);
            open *= openness(*field, point, normal, kOpennessReachVx * field->voxelSize());
        }
        // Light that gets in between particles scatters on: their shade is never black.
        const float diffuse = float(std::max(0.0, normal.dot(towardsLight_)) * reaching);
        const float skywards = 0.5f + 0.5f * float(normal.dot(up_));
        const Colour ambient =
            float(open) * (kFloorLight + skywards * (kSkyLight - kFloorLight)) * float(0.55 + 0.45 * reaching);
        const Vec3d halfway = (towardsLight_ - ray.normalized()).normalized();
        const float highlight = pixel.gloss * float(reaching * std::pow(std::max(0.0, normal.dot(halfway)), 40.0));
        const Colour lit = pixel.albedo.cwiseProduct(diffuse * kKeyLight / float(M_PI) * 2.2f + ambient * 0.62f) +
                           Colour::Constant(highlight);
        return fadeFloor(pixel, point, lit, y);
    }

    // A floor has no end; it dissolves before it would show one.
    Colour fadeFloor(const SurfaceBuffer::Pixel& pixel, const Vec3d& point, const Colour& lit, int y) const
    {
        if (!ground_ || pixel.gloss > 0.0f) return lit;
        const double away = (point - frame_.centre()).norm() / (kFloorFade * frame_.size().norm());
        const auto fade = float(std::clamp(away * away, 0.0, 1.0));
        return lit + fade * (background(y) - lit);
    }

    void developPixel(RgbImage& image, int x, int y) const
    {
        Colour sum = Colour::Zero();
        for (int i = 0; i < kSamples * kSamples; ++i) {
            // Compressed before averaging, so that edges against bright parts stay smooth.
            const Colour linear = kExposure * light(x * kSamples + i % kSamples, y * kSamples + i / kSamples);
            sum += linear.cwiseQuotient(linear + Colour::Constant(0.55f)) * 1.35f;
        }
        const Colour srgb = (sum / float(kSamples * kSamples)).array().max(0.0f).pow(1.0f / 2.2f);
        for (int channel = 0; channel < 3; ++channel) {
            image.bytes[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 3 + std::size_t(channel)] =
                toByte(srgb[channel]);
        }
    }

    const Fields& fields_;
    const Vec3d up_;
    const std::optional<double> ground_;
    const Box frame_;
    const Camera camera_;
    const ParticleLook look_;
    const Vec3d towardsLight_;
    const ShadowMap shadows_;
    SurfaceBuffer buffer_;
};

} // namespace

RgbImage renderPicture(const Fields& fields, const Particles& particles, const PictureOptions& options,
                       Progress& progress)
{
    validate(options);
    return Stage(fields, particles, options).develop(progress);
}

} // namespace vdbounce
