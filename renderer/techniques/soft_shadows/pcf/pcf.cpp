// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer filtering (SS-02): the share of taps over a window of fixed size that do not block.
// Sources: Schwarz 2009, section 3.3; Reeves, Salesin and Cook 1987.
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

class Pcf : public VisibilityTechnique {
 public:
  explicit Pcf(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/pcf/pcf.comp.glsl", "soft_shadows/pcf"),
        radius_(values.real("filter_radius")),
        taps_(static_cast<int>(values.integer("filter_taps"))) {}

 protected:
  void configure(const gl::Program& program) const override {
    program.set("filterRadius", static_cast<float>(radius_));
    program.set("filterTaps", taps_);
  }

 private:
  double radius_;
  int taps_;
};

std::vector<Parameter> pcfParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(1.0);
  all.push_back(
      realParameter("filter_radius", 4.0, 0.0, 256.0, "texel", "Half the side of the filter window"));
  all.push_back(integerParameter("filter_taps", 8, 1, 32, "", "Taps along a side of the window"));
  return all;
}

const Registered<TechniqueInfo> kPcfRegistered{
    {.name = "soft_shadows/pcf",
     .version = 1,
     .summary = "Percentage-closer filtering over a window of fixed size",
     .source = "Schwarz 2009, section 3.3 (SS-02)",
     .product = ProductKind::Visibility,
     .parameters = pcfParameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Pcf>(values); },
     .errorBound = {},
     .counters = VisibilityTechnique::counterNames()}};

}  // namespace
}  // namespace limen::techniques
