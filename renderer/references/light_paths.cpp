// SPDX-License-Identifier: BSD-3-Clause
// Light between diffuse surfaces by paths in double precision on the CPU, primary rays included: the integral
// of global_illumination/path_traced, sampled in another way. It shares no shader, no tree and no random
// number with the techniques; it sees the coordinates that the GPU holds, rounded to float. Source: Kajiya
// 1986.
#include "renderer/frame/light_paths.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/references/counter_random.h"
#include "renderer/references/exact_shading.h"
#include "renderer/references/parallel.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

constexpr const char* kPathReferencePass = "global_illumination/path_reference";

/// The normal plus a point that is uniform on the unit sphere has the direction's density cosine / pi.
glm::dvec3 cosineDirection(glm::dvec3 normal, glm::dvec2 u) {
  const double z = 1.0 - 2.0 * u.x, r = std::sqrt(std::max(1.0 - z * z, 0.0));
  const double angle = 2.0 * std::numbers::pi * u.y;
  const glm::dvec3 sum = normal + glm::dvec3(r * std::cos(angle), r * std::sin(angle), z);
  return glm::dot(sum, sum) > 1e-20 ? glm::normalize(sum) : normal;
}

class PathReference : public techniques::Technique {
 public:
  using Settings = frame::LightPathSettings;
  explicit PathReference(const Settings& settings) : settings_(settings), lamp_(settings.surfaces.lamp()) {}

  void prepare(frame::Frame& frame) override {
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    triangles_.emplace(frame.scene(), anchor);
    tree_.emplace(*triangles_);
    shading_.emplace(frame.scene(), *triangles_, *tree_, anchor, lamp_);
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    picture_ = Image(frame.sizePx().x, frame.sizePx().y, 4, 1.0F);
    found_.assign(picture_.pixels(), {});
    frame.passes().setBytesHeld(kPathReferencePass, product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open(kPathReferencePass);
    const glm::dmat4 toAnchor = glm::inverse(frame.anchorToCamera());
    const glm::dvec3 eye(toAnchor[3]);
    const glm::dvec2 size(frame.sizePx());
    const glm::dvec2 half(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov());
    const bool lit = !frame.scene().lights.empty();
    parallelFor(picture_.pixels(), [&](size_t, size_t first, size_t last) {
      for (size_t pixel = first; pixel < last; ++pixel) {
        const glm::dvec2 place(double(pixel % size_t(picture_.width)) + 0.5,
                               double(pixel / size_t(picture_.width)) + 0.5);
        const glm::dvec2 onImage = (2.0 * place / size - 1.0) * glm::dvec2(1.0, -1.0) * half;
        const glm::dvec3 forward(toAnchor * glm::dvec4(onImage, -1.0, 0.0));
        found_[pixel] = seen({eye, forward, ExactRay::kNoTriangle}, pixel, lit);
        for (int c = 0; c < 3; ++c)
          picture_.data[4 * pixel + size_t(c)] = static_cast<float>(found_[pixel].radiance[c]);
      }
    });
    product_->write(picture_);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<techniques::Counter> count(frame::Frame&) override {
    double variance = 0.0, radiance = 0.0, rays = 0.0;
    for (const Found& found : found_) {
      variance += found.variance;
      radiance += (found.radiance.r + found.radiance.g + found.radiance.b) / 3.0;
      rays += double(found.rays);
    }
    const auto pixels = double(found_.size());
    return {{"standard_error", std::sqrt(variance / pixels)},
            {"mean_radiance", radiance / pixels},
            {"rays_per_px", rays / pixels}};
  }

 private:
  struct Found {
    glm::dvec3 radiance{0.0};
    double variance = 0.0;  ///< of the mean over channels
    int64_t rays = 0;
  };

  glm::dvec3 leaving(const ExactPoint& point, bool lit, int64_t& rays) const {
    rays += lit ? 1 : 0;
    const glm::dvec3 reflected = shading_->colour(point, true);
    return point.isFront ? reflected + glm::dvec3(shading_->material(point.triangle).emission) : reflected;
  }

  Found seen(const ExactRay& ray, size_t pixel, bool lit) const {
    Found out;
    const ExactHit hit = tree_->nearest(ray);
    if (hit.triangle == ExactRay::kNoTriangle) return out;
    const ExactPoint start = shading_->point(ray, hit);
    if (settings_.surfaces.light != frame::LightPart::Indirect) out.radiance = leaving(start, lit, out.rays);
    if (settings_.surfaces.light == frame::LightPart::Direct || settings_.bounces == 0) return out;
    glm::dvec3 mean(0.0);
    double meanOfChannels = 0.0, squares = 0.0;  // by Welford's recurrence
    for (int64_t path = 0; path < settings_.paths; ++path) {
      const glm::dvec3 brought = along(start, pixel, path, lit, out.rays);
      mean += (brought - mean) / double(path + 1);
      const double channels = (brought.r + brought.g + brought.b) / 3.0, before = channels - meanOfChannels;
      meanOfChannels += before / double(path + 1);
      squares += before * (channels - meanOfChannels);
    }
    out.radiance += mean;
    out.variance = squares / (double(settings_.paths) * double(settings_.paths - 1));
    return out;
  }

  /// What one path brings to a point, as reflected there.
  glm::dvec3 along(ExactPoint point, size_t pixel, int64_t path, bool lit, int64_t& rays) const {
    glm::dvec3 sum(0.0), share(1.0);
    for (int bounce = 0; bounce < settings_.bounces; ++bounce) {
      share *= shading_->albedo(point);
      if (share == glm::dvec3(0.0)) return sum;
      const auto sample = static_cast<uint64_t>(path) * 16U + static_cast<uint64_t>(bounce);
      const glm::dvec2 u = uniform2(static_cast<uint64_t>(settings_.seed), pixel, sample);
      const ExactRay ray{point.position, cosineDirection(point.flatNormal, u), point.triangle};
      ++rays;
      const ExactHit hit = tree_->nearest(ray);
      if (hit.triangle == ExactRay::kNoTriangle) return sum;
      point = shading_->point(ray, hit);
      sum += share * leaving(point, lit, rays);
    }
    return sum;
  }

  Settings settings_;
  frame::ShadedSetting lamp_;
  std::optional<Triangles> triangles_;
  std::optional<TriangleTree> tree_;
  std::optional<ExactShading> shading_;
  std::optional<gl::Texture> product_;
  Image picture_;
  std::vector<Found> found_;
};

const techniques::RegisteredTechnique<PathReference> kPathReferenceRegistered{
    {.name = "global_illumination/path_reference",
     .version = 1,
     .summary = "Diffuse light by paths of a few reflections, in double precision on the CPU",
     .source = "Kajiya 1986; Gaitatzes 2012, section 5.6 (BL-03)",
     .product = techniques::ProductKind::Colour,
     .reference = true,
     .onCpu = true,
     .counters = frame::lightPathQuantities(),
     .effort = "paths"}};

}  // namespace
}  // namespace limen::references
