// SPDX-License-Identifier: BSD-3-Clause
// Diffuse path tracer with a limit on bounces (BL-03) in double precision on the CPU, primary rays included.
// It shares no shader with the techniques. Directions by the cosine, a ray to the lamp at each surface; where
// light may pass a surface, both ways are weighed by chance, as no path may grow into a tree.
// Source: Kajiya 1986; Gaitatzes 2012, section 5.6.
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/frame/light_paths.h"
#include "renderer/references/counter_random.h"
#include "renderer/references/exact_shading.h"
#include "renderer/references/parallel.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

constexpr const char* kPathReferencePass = "global_illumination/path_reference";

/// By the cosine about a unit vector: a point of the unit sphere above its top (Shirley).
glm::dvec3 aboveSurface(glm::dvec3 normal, glm::dvec2 u) {
  const double height = 2.0 * u.x - 1.0, radius = std::sqrt(std::max(1.0 - height * height, 0.0));
  const double angle = 2.0 * std::numbers::pi * u.y;
  const glm::dvec3 sum = normal + glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), height);
  const double length = glm::length(sum);
  return length > 1e-9 ? sum / length : normal;
}

class PathReference : public techniques::Technique {
 public:
  using Settings = frame::LightPathSettings;
  explicit PathReference(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    anchor_ = frame.gpuScene().anchor();
    triangles_.emplace(frame.scene(), anchor_);
    tree_.emplace(*triangles_);
    shading_.emplace(frame.scene(), *triangles_, *tree_, anchor_, settings_.surfaces.lamp());
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld(kPathReferencePass, product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open(kPathReferencePass);
    const glm::dmat4 toAnchor = glm::inverse(frame.anchorToCamera());
    const glm::dvec3 eye(toAnchor[3]);
    const glm::ivec2 sizePx = frame.sizePx();
    const glm::dvec2 half(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov());
    lamp_.reset();
    if (!frame.scene().lights.empty()) lamp_ = frame.scene().lights[0].centre - anchor_;
    Image picture(sizePx.x, sizePx.y, 4, 1.0F);
    std::vector<double> variances(picture.pixels(), 0.0);
    const double n = double(settings_.paths);
    parallelFor(picture.pixels(), [&](size_t, size_t first, size_t last) {
      for (size_t pixel = first; pixel < last; ++pixel) {
        const glm::dvec2 place(double(pixel % size_t(sizePx.x)) + 0.5,
                               double(pixel / size_t(sizePx.x)) + 0.5);
        const glm::dvec2 at = (2.0 * place / glm::dvec2(sizePx) - 1.0) * glm::dvec2(1.0, -1.0) * half;
        const ExactRay ray{eye, glm::dvec3(toAnchor * glm::dvec4(at, -1.0, 0.0)), ExactRay::kNoTriangle};
        glm::dvec3 sum(0.0);
        double squares = 0.0;
        for (int64_t path = 0; path < settings_.paths; ++path) {
          const glm::dvec3 light = alongPath(ray, pixel, static_cast<uint64_t>(path));
          sum += light;
          squares += std::pow((light.r + light.g + light.b) / 3.0, 2.0);
        }
        sum /= n;
        const double mean = (sum.r + sum.g + sum.b) / 3.0;
        variances[pixel] = std::max(squares / n - mean * mean, 0.0) / (n - 1.0);
        for (int c = 0; c < 3; ++c) picture.data[4 * pixel + size_t(c)] = static_cast<float>(sum[c]);
      }
    });
    double total = 0.0;
    for (const double variance : variances) total += variance;
    standardError_ = std::sqrt(total / double(variances.size()));
    product_->write(picture);
  }

  const gl::Texture& product() const override { return *product_; }

  std::vector<techniques::Counter> count(frame::Frame&) override {
    return {{"paths_per_px", double(settings_.paths)}, {"standard_error", standardError_}};
  }

 private:
  /// Radiance of a white surface that the lamp alone lights, through what lets its light pass.
  glm::dvec3 lampRadiance(const ExactPoint& point) const {
    if (!lamp_) return glm::dvec3(0.0);
    const double cosine = glm::dot(glm::normalize(*lamp_ - point.position), point.flatNormal);
    if (!(cosine > 0.0)) return glm::dvec3(0.0);
    glm::dvec3 share(settings_.surfaces.strength * cosine);
    ExactRay ray{point.position, *lamp_ - point.position, point.triangle, 1.0};
    for (int passage = 0; passage <= frame::kMostPassages; ++passage) {
      const ExactHit hit = tree_->nearest(ray);
      if (hit.triangle == ExactRay::kNoTriangle) return share;
      share *= glm::dvec3(shading_->material(hit.triangle).transmittance);
      if (share == glm::dvec3(0.0)) return share;
      const glm::dvec3 at = shading_->point(ray, hit).position;
      ray = {at, *lamp_ - at, hit.triangle, 1.0};
    }
    return glm::dvec3(0.0);
  }

  glm::dvec3 alongPath(ExactRay ray, uint64_t pixel, uint64_t path) const {
    glm::dvec3 sum(0.0), share(1.0);
    const frame::LightPart part = settings_.surfaces.light;
    int reflections = 0;
    for (int leg = 0; leg <= settings_.bounces + frame::kMostPassages; ++leg) {
      const ExactHit hit = tree_->nearest(ray);
      if (hit.triangle == ExactRay::kNoTriangle) return sum;
      const ExactPoint point = shading_->point(ray, hit);
      const scene::Material& material = shading_->material(hit.triangle);
      const glm::dvec3 albedo = shading_->albedo(point);
      if (part == frame::LightPart::All || (part == frame::LightPart::Indirect) == (reflections > 0)) {
        if (point.isFront) sum += share * glm::dvec3(material.emission);
        sum += share * albedo * lampRadiance(point);
      }
      const glm::dvec3 through(material.transmittance);
      const double passes = (through.r + through.g + through.b) / 3.0;
      const uint64_t number = path * 64 + static_cast<uint64_t>(2 * leg);
      const auto seed = static_cast<uint64_t>(settings_.seed);
      if (passes > 0.0 && uniform2(seed, pixel, number + 1).x < passes) {
        share *= through / passes;
        ray = {point.position, -point.view, point.triangle};
        continue;
      }
      if (reflections == settings_.bounces || albedo == glm::dvec3(0.0)) return sum;
      ++reflections;
      share *= albedo / (1.0 - passes);
      ray = {point.position, aboveSurface(point.flatNormal, uniform2(seed, pixel, number)), point.triangle};
    }
    return sum;
  }

  Settings settings_;
  glm::dvec3 anchor_{0.0};
  std::optional<glm::dvec3> lamp_;  ///< relative to the anchor
  std::optional<Triangles> triangles_;
  std::optional<TriangleTree> tree_;
  std::optional<ExactShading> shading_;
  std::optional<gl::Texture> product_;
  double standardError_ = 0.0;
};

const techniques::RegisteredTechnique<PathReference> kPathReferenceRegistered{
    {.name = "global_illumination/path_reference",
     .version = 1,
     .summary = "Paths over diffuse surfaces with a limit on bounces, in double precision on the CPU",
     .source = "Kajiya 1986; Gaitatzes 2012, section 5.6 (BL-03)",
     .product = techniques::ProductKind::Colour,
     .reference = true,
     .onCpu = true,
     .counters = {{"paths_per_px", "Paths from each pixel's point", "", Direction::LowerIsBetter},
                  {"standard_error",
                   "Standard error of pixels' channel means, root mean square over the picture", "",
                   Direction::LowerIsBetter}},
     .effort = "paths"}};

}  // namespace
}  // namespace limen::references
