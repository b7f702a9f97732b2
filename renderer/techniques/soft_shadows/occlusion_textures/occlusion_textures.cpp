// SPDX-License-Identifier: BSD-3-Clause
// Occlusion textures (SS-08): the scene is cut into slices parallel to the light, each flattened to an image
// of its coverage. Visibility is the product, over the slices in front of the receiver, of the part of the
// light's cone that each leaves open, as if they blocked independently of each other. Occluders within the
// receiver's own slice are missed. Source: Schwarz 2009, section 3.2.1 (after Eisemann and Décoret 2006 and
// 2008; formula reconstructed). Here the slices are seen in perspective from the light's centre and made in
// one pass, one bit of a texel each.
#include "renderer/frame/occlusion_slices.h"
#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

struct OcclusionTexturesSettings {
  int resolution = 256, slices = 16;
  SlopeBias bias;
  frame::Prefilter prefilter = frame::Prefilter::Sums;
  static const SettingsTable<OcclusionTexturesSettings>& table() {
    using S = OcclusionTexturesSettings;
    static const SettingsTable<S> kTable = {
        {&S::resolution, "resolution", oneOf({1, 2, 64, 128, 256, 512, 1024, 2048, 4096}), "texel",
         "Side of each slice's picture", "Schwarz 2009, section 4.5"},
        {&S::slices,
         "slices",
         {1, 32},
         "",
         "Slices between the nearest and the farthest caster",
         "Schwarz 2009, section 3.2.1 (number not given there)"},
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::prefilter, "prefilter",
         "Structure for averages: sums: summed-area table, any rectangle; mips: pyramid, squares of "
         "the window's area",
         "Schwarz 2009, section 3.2.1"}};
    return kTable;
  }
};

gl::ShaderDefines occlusionTexturesDefines(frame::Prefilter prefilter) {
  if (prefilter == frame::Prefilter::Mips) return {{"MIPS", "1"}};
  return frame::SummedAreaTable::defines(frame::SumForm::Fixed);
}

class OcclusionTextures : public VisibilityTechnique {
 public:
  using Settings = OcclusionTexturesSettings;
  explicit OcclusionTextures(const OcclusionTexturesSettings& settings)
      : VisibilityTechnique(
            {.resolution = settings.resolution}, settings.bias,
            "renderer/techniques/soft_shadows/occlusion_textures/occlusion_textures.comp.glsl",
            "soft_shadows/occlusion_textures", occlusionTexturesDefines(settings.prefilter)),
        settings_{settings.resolution, settings.slices, settings.prefilter} {}

  static std::vector<Quantity> counters() {
    std::vector<Quantity> all = quantities();
    all.push_back(structureBytes());
    return all;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = VisibilityTechnique::count(frame);
    all.push_back({structureBytes().name, static_cast<double>(slices_->bytes())});
    return all;
  }

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    slices_ = &frame.get<frame::OcclusionSlices>(settings_);
    slices_->bind(kAveragesUnit);
    return slices_->frustum();
  }

  void configure(const gl::Program& program) const override {
    program.set("slices", settings_.slices);
    program.set("sliceBegin", static_cast<float>(slices_->begin()));
    program.set("sliceDepth", static_cast<float>(slices_->depth()));
    program.set("sumsUnit", 1.0F);
  }

 private:
  frame::OcclusionSliceSettings settings_;
  const frame::OcclusionSlices* slices_ = nullptr;
};

const RegisteredTechnique<OcclusionTextures> kOcclusionTexturesRegistered{
    {.name = "soft_shadows/occlusion_textures",
     .version = 1,
     .summary =
         "Occlusion textures: product over slices of the part of the light's cone that each leaves open",
     .source = "Schwarz 2009, section 3.2.1 (SS-08)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = OcclusionTextures::counters()}};

}  // namespace
}  // namespace limen::techniques
