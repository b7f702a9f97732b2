// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer filtering (SS-02): the share of taps over a window of fixed size that do not block.
// Sources: Schwarz 2009, section 3.3; Reeves, Salesin and Cook 1987.
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

struct PcfSettings {
  MapSettings map;
  TexelBiasSettings bias = PlaneBias{};
  double filterRadius = 4.0;
  int filterTaps = 8;
  static const SettingsTable<PcfSettings>& table() {
    using S = PcfSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::filterRadius, "filter_radius", {0, 256}, "texel", "Half-width of the filter window"},
        {&S::filterTaps, "filter_taps", {1, 32}, "", "Taps per side of the window"}};
    return kTable;
  }
};

class Pcf : public VisibilityTechnique {
 public:
  using Settings = PcfSettings;
  explicit Pcf(const PcfSettings& settings)
      : VisibilityTechnique(settings.map, anyBias(settings.bias),
                            "renderer/techniques/soft_shadows/pcf/pcf.comp.glsl", "soft_shadows/pcf"),
        settings_(settings) {}

 protected:
  void configure(const gl::Program& program) const override {
    program.set("filterRadius", static_cast<float>(settings_.filterRadius));
    program.set("filterTaps", settings_.filterTaps);
  }

 private:
  PcfSettings settings_;
};

const RegisteredTechnique<Pcf> kPcfRegistered{
    {.name = "soft_shadows/pcf",
     .version = 2,
     .summary = "Percentage-closer filtering over a window of fixed size",
     .source = "Schwarz 2009, section 3.3 (SS-02)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = VisibilityTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
