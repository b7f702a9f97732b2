// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer soft shadows (SS-02): the filter window follows from the average depth of the blockers
// found. Source: Schwarz 2009, section 3.3 (after Fernando 2005). The thesis gives search and filter windows
// on the near plane; here both are in tangents, so the near plane cancels: w (1/n - 1/p_z) and w (1/z -
// 1/p_z).
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

struct PcssSettings {
  MapSettings map;
  TexelBiasSettings bias = PlaneBias{};
  double searchScale = 1.0;
  int searchTaps = 8, filterTaps = 16;
  static const SettingsTable<PcssSettings>& table() {
    using S = PcssSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::searchScale,
         "search_scale",
         {0.01, 4},
         "",
         "Window of the blocker search as a share of the light's extents"},
        {&S::searchTaps, "search_taps", {1, 32}, "", "Taps of the blocker search per side"},
        {&S::filterTaps, "filter_taps", {1, 32}, "", "Taps of the filter per side"}};
    return kTable;
  }
};

class Pcss : public VisibilityTechnique {
 public:
  using Settings = PcssSettings;
  explicit Pcss(const PcssSettings& settings)
      : VisibilityTechnique(settings.map, anyBias(settings.bias),
                            "renderer/techniques/soft_shadows/pcss/pcss.comp.glsl", "soft_shadows/pcss"),
        settings_(settings) {}

 protected:
  void configure(const gl::Program& program) const override {
    program.set("searchScale", static_cast<float>(settings_.searchScale));
    program.set("searchTaps", settings_.searchTaps);
    program.set("filterTaps", settings_.filterTaps);
  }

 private:
  PcssSettings settings_;
};

const RegisteredTechnique<Pcss> kPcssRegistered{
    {.name = "soft_shadows/pcss",
     .version = 2,
     .summary = "Percentage-closer soft shadows: filter window from the blockers' average depth",
     .source = "Schwarz 2009, section 3.3 (SS-02)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = VisibilityTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
