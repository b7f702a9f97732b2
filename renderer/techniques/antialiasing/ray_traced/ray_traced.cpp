// SPDX-License-Identifier: BSD-3-Clause
// Reference of anti-aliasing: the mean of each pixel's square by rays, one at a random place in each cell of
// a grid, through the tree of the scene's triangles. It shares neither the sample places nor the rasteriser
// with the techniques, but their shading, so that it judges sampling alone.
#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/sample_view.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct PixelReferenceSettings {
  int64_t places = 256;
  int64_t seed = 1;
  SampleShading samples;
  static const SettingsTable<PixelReferenceSettings>& table() {
    using S = PixelReferenceSettings;
    static const SettingsTable<S> kTable = {
        {&S::places, "places", {64, 16384}, "rays", "Rays per pixel, a square number"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the places within cells"},
        included(&S::samples)};
    return kTable;
  }
  void check() const {
    const auto side = int64_t(std::lround(std::sqrt(double(places))));
    if (side * side != places)
      throw Error("'places' is " + std::to_string(places) + ", not a square number", "places",
                  "give " + std::to_string(side * side));
  }
};

class PixelReference : public Technique {
 public:
  using Settings = PixelReferenceSettings;
  explicit PixelReference(const PixelReferenceSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    program_ = &frame.context().programs().compute(
        "renderer/techniques/antialiasing/ray_traced/ray_traced.comp.glsl",
        sampleShadingDefines(settings_.samples, frame));
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("antialiasing/rays",
                                picture_->bytes() + frame.gpuScene().rays(frame.context()).bytes());
  }

  void render(frame::Frame& frame) override {
    makeShadowOf(frame, settings_.samples);
    const auto scope = frame.passes().open("antialiasing/rays");
    configureSampleShading(*program_, frame, settings_.samples);
    frame.gpuScene().rays(frame.context()).bind(*program_);
    const int side = static_cast<int>(std::lround(std::sqrt(double(settings_.places))));
    program_->set("side", side);
    program_->set("seed", static_cast<uint32_t>(settings_.seed));
    program_->set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
    picture_->bindImage(kSampleOutImage, gl::Access::ReadWrite);
    for (int row = 0; row < side; ++row) {
      program_->set("first", row);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  const gl::Texture& product() const override { return *picture_; }

 private:
  PixelReferenceSettings settings_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

/// Hoeffding 1963, for colours in [0, 1]: a mean of N independent values deviates from its expectation by
/// more than e with a probability of at most 2 exp(-2 N e^2).
double noiseOf(const PixelReferenceSettings& settings) {
  return std::sqrt(std::log(2.0 / 0.001) / (2.0 * double(settings.places)));
}

const RegisteredTechnique<PixelReference> kPixelReference{
    {.name = "antialiasing/ray_traced",
     .version = 1,
     .summary = "Mean of each pixel's square by rays at random places, one in each cell of a grid",
     .source = "bench",
     .product = ProductKind::Colour,
     .reference = true},
    &noiseOf};

}  // namespace
}  // namespace limen::techniques
