// SPDX-License-Identifier: BSD-3-Clause
// Whitted's picture of a scene with mirrors (Roger 2008, section 1.2.2) in double precision on the CPU,
// primary rays included. It shares no shader with the techniques: it sees the coordinates that the GPU holds,
// rounded to float, and nothing else of it.
#include <atomic>
#include <optional>

#include "renderer/frame/mirror_path.h"
#include "renderer/references/exact_shading.h"
#include "renderer/references/parallel.h"
#include "renderer/techniques/technique.h"

namespace limen::references {
namespace {

constexpr const char* kReflectionsPass = "reflections/reference";

struct ReflectionsReferenceSettings {
  frame::MirrorPathSettings path;
  bool refraction = false;
  frame::ShadedSetting shading;
  static const SettingsTable<ReflectionsReferenceSettings>& table() {
    using S = ReflectionsReferenceSettings;
    static const SettingsTable<S> kTable = {
        included(&S::path),
        {&S::refraction, "refraction", frame::kRefractionText, frame::kRefractionSource},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
};

class ReflectionsReference : public techniques::Technique {
 public:
  using Settings = ReflectionsReferenceSettings;
  explicit ReflectionsReference(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    if (frame.scene().motions.empty()) build(frame, frame.scene());
    product_.emplace(gl::Format::RGBA32F, frame.sizePx());
    picture_ = Image(frame.sizePx().x, frame.sizePx().y, 4, 1.0F);
    frame.passes().setBytesHeld(kReflectionsPass, product_->bytes());
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open(kReflectionsPass);
    if (!frame.scene().motions.empty()) {
      shading_.reset();
      build(frame, moved_.emplace(scene::movedTo(frame.scene(), frame.timeS())));
    }
    const glm::dmat4 toAnchor = glm::inverse(frame.anchorToCamera());
    const glm::dvec3 eye(toAnchor[3]);
    const glm::dvec2 size(frame.sizePx());
    const glm::dvec2 half(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov());
    std::atomic<int64_t> rays = 0;
    parallelFor(picture_.pixels(), [&](size_t, size_t first, size_t last) {
      int64_t count = 0;
      for (size_t pixel = first; pixel < last; ++pixel) {
        const glm::dvec2 place(double(pixel % size_t(picture_.width)) + 0.5,
                               double(pixel / size_t(picture_.width)) + 0.5);
        const glm::dvec2 onImage = (2.0 * place / size - 1.0) * glm::dvec2(1.0, -1.0) * half;
        const glm::dvec3 colour = followed(
            {eye, glm::dvec3(toAnchor * glm::dvec4(onImage, -1.0, 0.0)), ExactRay::kNoTriangle}, count);
        for (int c = 0; c < 3; ++c) picture_.data[4 * pixel + size_t(c)] = static_cast<float>(colour[c]);
      }
      rays += count;
    });
    rays_ = rays;
    product_->write(picture_);
  }

  const gl::Texture& product() const override { return *product_; }
  std::vector<techniques::Counter> count(frame::Frame&) override {
    return {{"mirrored_rays", double(rays_)}};
  }

 private:
  void build(const frame::Frame& frame, const scene::Scene& scene) {
    const glm::dvec3 anchor = frame.gpuScene().anchor();
    triangles_.emplace(scene, anchor);
    tree_.emplace(*triangles_);
    shading_.emplace(scene, *triangles_, *tree_, anchor, settings_.shading);
  }

  /// Light that comes along a ray from the eye; `rays` grows by those that leave mirrors.
  glm::dvec3 followed(ExactRay ray, int64_t& rays) const {
    glm::dvec3 sum(0.0), share(1.0);
    for (int bounce = 0;; ++bounce) {
      const ExactHit hit = tree_->nearest(ray);
      if (hit.triangle == ExactRay::kNoTriangle) return sum + share * shading_->background();
      const ExactPoint point = shading_->point(ray, hit);
      const bool shadow = bounce == 0 ? settings_.shading.shadow : bounce <= settings_.path.shadows;
      sum += share * shading_->colour(point, shadow);
      const scene::Material& material = shading_->material(point.triangle);
      const bool refracts = settings_.refraction && material.refracts();
      if (!(material.reflects() || refracts) || bounce == settings_.path.bounces) return sum;
      glm::dvec3 onwards;
      if (refracts) {
        const ExactRefraction refraction = exactRefracted(material, point);
        onwards = refraction.direction;
        if (refraction.passes) share *= glm::dvec3(material.transmittance);
      } else {
        onwards = exactMirrored(point);
        share *= exactMirrorShare(material, point);
      }
      if (std::max({share.r, share.g, share.b}) <= settings_.path.leastShare) return sum;
      ray = {point.position, onwards, point.triangle};
      ++rays;
    }
  }

  ReflectionsReferenceSettings settings_;
  std::optional<scene::Scene> moved_;  ///< of the last frame, if parts move
  std::optional<Triangles> triangles_;
  std::optional<TriangleTree> tree_;
  std::optional<ExactShading> shading_;
  std::optional<gl::Texture> product_;
  Image picture_;
  int64_t rays_ = 0;
};

const techniques::RegisteredTechnique<ReflectionsReference> kReflectionsReferenceRegistered{
    {.name = "reflections/reference",
     .version = 1,
     .summary = "Mirrors by rays in double precision on the CPU, primary rays included",
     .source = "Roger 2008, sections 1.2.2 and 3.1 (R-59)",
     .product = techniques::ProductKind::Colour,
     .needs = {"mirrors"},
     .reference = true,
     .followsMotion = true,
     .onCpu = true,
     .counters = {{"mirrored_rays", "Rays that leave mirrors", "", Direction::Neither}}}};

}  // namespace
}  // namespace limen::references
