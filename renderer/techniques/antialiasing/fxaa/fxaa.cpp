// SPDX-License-Identifier: BSD-3-Clause
// A filter of the finished picture in the manner of FXAA, written from its published description: an edge is
// where lightness as displayed differs among a pixel and its neighbours; the distances to both ends of the
// edge's run say how much of the pixel lies beyond it. Departures: lightness is that of sRGB, colours are
// blended in linear light, and runs are followed a pixel at a time. Source: Lottes 2009 (comparator of
// Holländer 2013, section 4.3.6).
#include <epoxy/gl.h>

#include <optional>

#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/one_sample_picture.h"
#include "renderer/techniques/antialiasing/sample_costs.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct FxaaSettings {
  double leastRange = 1.0 / 16.0, edgeShare = 0.125, subpixel = 0.75;
  int reach = 12;
  SampleShading samples;
  static const SettingsTable<FxaaSettings>& table() {
    using S = FxaaSettings;
    static const SettingsTable<S> kTable = {
        {&S::leastRange,
         "least_range",
         {0.0, 1.0},
         "",
         "Range of lightness below which there is no edge",
         "Lottes 2009"},
        {&S::edgeShare,
         "edge_share",
         {0.0, 1.0},
         "",
         "Range as a share of the largest lightness below which there is no edge",
         "Lottes 2009"},
        {&S::subpixel,
         "subpixel",
         {0.0, 1.0},
         "",
         "Largest share of blending for features of a pixel",
         "Lottes 2009"},
        {&S::reach,
         "reach",
         {1, 64},
         "px",
         "How far an edge's run is followed to either side",
         "Lottes 2009"},
        included(&S::samples)};
    return kTable;
  }
};

class Fxaa : public Technique {
 public:
  using Settings = FxaaSettings;
  explicit Fxaa(const FxaaSettings& settings) : settings_(settings), first_(settings.samples) {}

  void prepare(frame::Frame& frame) override {
    first_.prepare(frame);
    program_ = &frame.context().programs().compute("renderer/techniques/antialiasing/fxaa/fxaa.comp.glsl");
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("antialiasing/filter", picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    first_.render(frame);
    const auto scope = frame.passes().open("antialiasing/filter");
    program_->set("sizePx", frame.sizePx());
    program_->set("leastRange", static_cast<float>(settings_.leastRange));
    program_->set("edgeShare", static_cast<float>(settings_.edgeShare));
    program_->set("subpixel", static_cast<float>(settings_.subpixel));
    program_->set("reach", settings_.reach);
    first_.texture().bindTexture(kFilterColoursUnit);
    picture_->bindImage(kFilterOutImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }
  std::vector<Counter> count(frame::Frame&) override { return sampleCosts(1.0, 1.0, 1); }

 private:
  FxaaSettings settings_;
  OneSamplePicture first_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> picture_;
};

const RegisteredTechnique<Fxaa> kFxaa{
    {.name = "antialiasing/fxaa",
     .version = 1,
     .summary = "One sample a pixel, blended across edges of the finished picture",
     .source = "Lottes 2009 (HOL-55)",
     .product = ProductKind::Colour,
     .counters = sampleCostQuantities()}};

}  // namespace
}  // namespace limen::techniques
