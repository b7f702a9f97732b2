// SPDX-License-Identifier: BSD-3-Clause
#include <epoxy/gl.h>

#include <limits>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/sparse/sampling.h"
#include "renderer/techniques/soft_shadows/sparse/sparse_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char *kPlace = "sparse/choose", *kUpsample = "sparse/upsample";
constexpr const char* kUpsampleShader = "renderer/techniques/soft_shadows/sparse/upsample.comp.glsl";

class UniformSampling : public SparseSampling {
 public:
  UniformSampling(frame::Frame& frame, const UniformSamplingSettings& settings, double depthTolerance)
      : reconstruction_(depthTolerance, settings.normalPower),
        factor_(settings.factor),
        fromPicture_(settings.points == GridPoints::Subset),
        points_(frame, "sparse/inner", pointCount(frame.sizePx())),
        upsample_(frame.context().programs().compute(kUpsampleShader)) {
    if (!fromPicture_) return;
    place_ =
        &frame.context().programs().compute("renderer/techniques/soft_shadows/sparse/place_grid.comp.glsl");
    ids_.emplace(gl::Format::R32UI, points_.sizePx());
    places_.emplace(gl::Format::RG32F, points_.sizePx());
    frame.passes().setBytesHeld(kPlace, ids_->bytes() + places_->bytes());
    points_.setSeen({&*ids_, &*places_, frame.sizePx()});
  }

  frame::Frame& points() override { return points_; }

  void choose(frame::Frame& frame) override {
    if (!fromPicture_) return;
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    const auto scope = frame.passes().open(kPlace);
    place_->set("pictureSizePx", frame.sizePx());
    place_->set("gridSizePx", points_.sizePx());
    place_->set("factor", factor_);
    ids.bindTexture(kSparseGridIdsUnit);
    ids_->bindImage(kSparseGridIdsImage, gl::Access::Write);
    places_->bindImage(kSparseGridPlacesImage, gl::Access::Write);
    place_->dispatch(points_.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void reconstruct(frame::Frame& frame, const gl::Texture& sampled, const gl::Texture& visibility,
                   const gl::Texture* classes) override {
    const gl::Program& program =
        classes ? frame.context().programs().compute(kUpsampleShader, {{"COUNT", "1"}}) : upsample_;
    const SurfaceChannels grid = SurfaceChannels::of(points_), picture = SurfaceChannels::of(frame);
    const auto scope = frame.passes().open(kUpsample);
    reconstruction_.configure(frame, program);
    const glm::vec2 size(frame.sizePx()), gridSize(points_.sizePx());
    if (fromPicture_) {
      program.set("firstPlace", glm::vec2(0.5F));
      program.set("placeStep", glm::vec2(static_cast<float>(factor_)));
      program.set("lastPlace", size - 0.5F);
    } else {
      // Both pictures have the same vertical field of view and square pixels around the same centre.
      const float step = size.y / gridSize.y;
      program.set("firstPlace", 0.5F * size + (0.5F - 0.5F * gridSize) * step);
      program.set("placeStep", glm::vec2(step));
      program.set("lastPlace", glm::vec2(std::numeric_limits<float>::max()));
    }
    program.set("gridSizePx", points_.sizePx());
    picture.bind(kSparseReceiversUnit);
    grid.bind(kSparseUpsampleGridReceiversUnit);
    sampled.bindTexture(kSparseUpsampleGridVisibilityUnit);
    visibility.bindImage(kSparseReconstructVisibilityImage, gl::Access::Write);
    if (classes) classes->bindImage(kSparseReconstructClassImage, gl::Access::Write);
    program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

 private:
  /// A subset ends with the picture's last pixels, so that no pixel lies outside of the grid.
  glm::ivec2 pointCount(glm::ivec2 sizePx) const {
    return fromPicture_ ? (sizePx - 1 + factor_ - 1) / factor_ + 1 : (sizePx + factor_ - 1) / factor_;
  }

  Reconstruction reconstruction_;
  int factor_;
  bool fromPicture_;
  frame::Frame points_;
  const gl::Program& upsample_;
  const gl::Program* place_ = nullptr;
  std::optional<gl::Texture> ids_, places_;
};

}  // namespace

const SettingsTable<UniformSamplingSettings>& UniformSamplingSettings::table() {
  using S = UniformSamplingSettings;
  static const std::string kSection = "Schwarz 2009, section 5.1.3";
  static const SettingsTable<S> kTable = {
      Binding(&S::factor, "factor", oneOf({1, 2, 4, 8}), "px",
              "Pixels between samples, along rows and columns", kSection + " (value not given there)")
          .formerly({"factor"}),
      Binding(&S::points, "points",
              "Samples are pixels of the picture, or of one rendered at lower resolution", kSection)
          .formerly({"points"}),
      Binding(&S::normalPower, "normal_power", Range{0, 64}, "",
              "Power of the cosine between a point's normal and a sample's that weights the sample; 0: "
              "normals do not matter",
              kSection + " (value not given there)")
          .formerly({"normal_power"})};
  return kTable;
}

std::unique_ptr<SparseSampling> makeSampling(frame::Frame& frame, const UniformSamplingSettings& settings,
                                             double depthTolerance, const ChosenEntry&) {
  return std::make_unique<UniformSampling>(frame, settings, depthTolerance);
}

}  // namespace limen::techniques
