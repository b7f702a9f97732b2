// SPDX-License-Identifier: BSD-3-Clause
// All samples of every pixel on an ordered grid, averaged: what adaptive shading saves on, and with one
// sample a picture without anti-aliasing. One invocation shades a pixel and keeps the sum, so that no
// samples' colours are stored. Source: Holländer 2013, section 4.3.6.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/sample_costs.h"
#include "renderer/techniques/antialiasing/sample_view.h"

namespace limen::techniques {
namespace {

struct FullSamplingSettings {
  int window = 4;
  SampleGradients gradients;
  SampleShading samples;
  static const SettingsTable<FullSamplingSettings>& table() {
    using S = FullSamplingSettings;
    static const SettingsTable<S> kTable = {{&S::window,
                                             "window",
                                             {1, kMostWindow},
                                             "",
                                             "Samples per pixel along each axis",
                                             "Holländer 2013, section 4.3.1"},
                                            gradientsBinding(&S::gradients),
                                            included(&S::samples)};
    return kTable;
  }
};

class FullSampling : public Technique {
 public:
  using Settings = FullSamplingSettings;
  explicit FullSampling(const FullSamplingSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    view_.emplace(frame, settings_.window, settings_.samples, settings_.gradients);
    gl::ShaderDefines defines = view_->defines();
    defineEnum(defines, "FORM", SampleForm::Full);
    program_ = &frame.context().programs().compute("renderer/techniques/antialiasing/shade_samples.comp.glsl",
                                                   defines);
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("antialiasing/shade", picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    view_->make();
    const auto scope = frame.passes().open("antialiasing/shade");
    view_->configure(*program_);
    picture_->bindImage(kSampleOutImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    return sampleCosts(pixels * settings_.window * settings_.window, pixels, settings_.window);
  }

 private:
  FullSamplingSettings settings_;
  std::optional<SampleView> view_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<FullSampling> kFullSampling{
    {.name = "antialiasing/full",
     .version = 1,
     .summary = "All samples of every pixel on an ordered grid",
     .source = "Holländer 2013, section 4.3.6 (HOL-42, HOL-55)",
     .product = ProductKind::Colour,
     .counters = sampleCostQuantities()}};

const RegisteredTechnique<FullSampling> kOneSample{
    {.name = "antialiasing/one_sample",
     .version = 1,
     .summary = "One sample in the middle of every pixel: no anti-aliasing",
     .source = "Holländer 2013, section 4.3.6 (HOL-55)",
     .product = ProductKind::Colour,
     .counters = sampleCostQuantities()},
    FullSamplingSettings{.window = 1, .gradients = {}, .samples = {}}};

}  // namespace
}  // namespace limen::techniques
