// SPDX-License-Identifier: BSD-3-Clause
// Morphological anti-aliasing of the finished picture: runs of edges between pixels, and how they turn at
// their ends, tell the straight silhouette that they stand for (Reshetov 2009). Departures: all channels are
// judged together by lightness as displayed, at a threshold that is a setting; colours are blended in linear
// light, and across columns or rows only, whichever cuts off more (Jimenez et al. 2012).
#include <epoxy/gl.h>

#include <optional>

#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/one_sample_picture.h"
#include "renderer/techniques/antialiasing/sample_costs.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct MorphologicalSettings {
  double threshold = 0.05;
  int reach = 32;
  SampleShading samples;
  static const SettingsTable<MorphologicalSettings>& table() {
    using S = MorphologicalSettings;
    static const SettingsTable<S> kTable = {
        {&S::threshold,
         "threshold",
         {0.0, 1.0},
         "",
         "Difference of lightness, 0..1 as displayed, that makes an edge",
         "Reshetov 2009 (there by the leading bits of each channel)"},
        {&S::reach, "reach", {1, 256}, "px", "How far a run is followed to either side", "Reshetov 2009"},
        included(&S::samples)};
    return kTable;
  }
};

class Morphological : public Technique {
 public:
  using Settings = MorphologicalSettings;
  explicit Morphological(const MorphologicalSettings& settings)
      : settings_(settings), first_(settings.samples) {}

  void prepare(frame::Frame& frame) override {
    first_.prepare(frame);
    gl::ProgramCache& programs = frame.context().programs();
    findEdges_ = &programs.compute("renderer/techniques/antialiasing/morphological/edges.comp.glsl");
    blend_ = &programs.compute("renderer/techniques/antialiasing/morphological/morphological.comp.glsl");
    edges_.emplace(gl::Format::R32UI, frame.sizePx());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    frame.passes().setBytesHeld("antialiasing/edges", edges_->bytes());
    frame.passes().setBytesHeld("antialiasing/filter", picture_->bytes());
  }

  void render(frame::Frame& frame) override {
    first_.render(frame);
    {
      const auto scope = frame.passes().open("antialiasing/edges");
      findEdges_->set("sizePx", frame.sizePx());
      findEdges_->set("threshold", static_cast<float>(settings_.threshold));
      first_.texture().bindTexture(kFilterColoursUnit);
      edges_->bindImage(kFilterEdgesImage, gl::Access::Write);
      findEdges_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    const auto scope = frame.passes().open("antialiasing/filter");
    blend_->set("sizePx", frame.sizePx());
    blend_->set("reach", settings_.reach);
    first_.texture().bindTexture(kFilterColoursUnit);
    edges_->bindTexture(kFilterEdgesUnit);
    picture_->bindImage(kFilterOutImage, gl::Access::Write);
    blend_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }
  std::vector<Counter> count(frame::Frame&) override { return sampleCosts(1.0, 1.0, 1); }

 private:
  MorphologicalSettings settings_;
  OneSamplePicture first_;
  const gl::Program *findEdges_ = nullptr, *blend_ = nullptr;
  std::optional<gl::Texture> edges_, picture_;
};

const RegisteredTechnique<Morphological> kMorphological{
    {.name = "antialiasing/morphological",
     .version = 1,
     .summary = "One sample a pixel, blended by the silhouettes that its staircases stand for",
     .source = "Reshetov 2009",
     .product = ProductKind::Colour,
     .counters = sampleCostQuantities()}};

}  // namespace
}  // namespace limen::techniques
