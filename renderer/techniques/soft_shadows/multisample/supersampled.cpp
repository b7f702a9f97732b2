// SPDX-License-Identifier: BSD-3-Clause
// Reference for pictures with several samples per pixel: a technique's visibility on a grid of samples over
// each pixel's square, averaged. Samples that are not receivers count as lit, as in every visibility image.
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kSupersampledPass = "supersampled/mean";

template <bool kColoured>
struct SupersampledSettings {
  ChosenEntry inner{kColoured ? "soft_shadows/bitmask_coloured" : "soft_shadows/backprojection", {}};
  int samples = 4;
  static const SettingsTable<SupersampledSettings>& table() {
    using S = SupersampledSettings;
    static const SettingsTable<S> kTable = {
        innerBinding(&S::inner, kColoured ? InnerKind::Coloured : InnerKind::OrRayTraced),
        {&S::samples, "samples", {1, 16}, "", "Samples per pixel along each axis, box filter"}};
    return kTable;
  }
};

template <bool kColoured>
class Supersampled : public Technique {
 public:
  using Settings = SupersampledSettings<kColoured>;
  explicit Supersampled(const Settings& settings)
      : samples_(settings.samples), inner_(makeInner(settings.inner)) {}

  void prepare(frame::Frame& frame) override {
    const glm::ivec2 sizePx = frame.sizePx() * samples_;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(sizePx.x, sizePx.y) > largest)
      throw Error(
          std::to_string(samples_) + " samples along each axis need an image of " + std::to_string(sizePx.x) +
              " x " + std::to_string(sizePx.y),
          "samples",
          "this driver has at most " + std::to_string(largest) + ": lower 'samples' or the image size");
    mean_ =
        &frame.context().programs().compute("renderer/techniques/soft_shadows/multisample/box_mean.comp.glsl",
                                            {{"VISIBILITY_FORMAT", kColoured ? "rgba32f" : "r32f"}});
    visibility_.emplace(kColoured ? gl::Format::RGBA32F : gl::Format::R32F, frame.sizePx());
    frame.passes().setBytesHeld(kSupersampledPass, visibility_->bytes());
    sampled_.emplace(frame, "supersampled/inner", sizePx);
    inner_->prepare(*sampled_);
  }

  void render(frame::Frame& frame) override {
    sampled_->setTime(frame.timeS());
    sampled_->begin();
    inner_->render(*sampled_);
    sampled_->end();
    const auto scope = frame.passes().open(kSupersampledPass);
    mean_->set("samples", samples_);
    mean_->set("sizePx", frame.sizePx());
    inner_->product().bindTexture(kBoxMeanSampledUnit);
    visibility_->bindImage(kBoxMeanVisibilityImage, gl::Access::Write);
    mean_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *visibility_; }
  std::vector<std::string> remarks() const override { return inner_->remarks(); }

 private:
  int samples_;
  std::unique_ptr<Technique> inner_;
  const gl::Program* mean_ = nullptr;
  std::optional<gl::Texture> visibility_;
  std::optional<frame::Frame> sampled_;
};

const RegisteredTechnique<Supersampled<false>> kSupersampledRegistered{
    {.name = "soft_shadows/supersampled",
     .version = 1,
     .summary = "Another technique's visibility at many samples over each pixel, averaged",
     .source = "bench: reference for Schwarz 2009, section 4.6",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .reference = true}};

const RegisteredTechnique<Supersampled<true>> kSupersampledColouredRegistered{
    {.name = "soft_shadows/supersampled_coloured",
     .version = 1,
     .summary =
         "Another technique's visible share of a coloured light at many samples over each pixel, averaged",
     .source = "bench: reference for Schwarz 2009, section 4.6",
     .product = ProductKind::LightColour,
     .needs = {"area_light"},
     .reference = true}};

}  // namespace
}  // namespace limen::techniques
