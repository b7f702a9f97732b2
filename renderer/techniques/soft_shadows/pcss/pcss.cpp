// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer soft shadows (SS-02): the filter window follows from the average depth of the blockers
// found. Source: Schwarz 2009, section 3.3 (after Fernando 2005). The thesis gives search and filter windows
// on the near plane; here both are in tangents, so the near plane cancels: w (1/n - 1/p_z) and w (1/z -
// 1/p_z).
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

class Pcss : public VisibilityTechnique {
 public:
  explicit Pcss(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/pcss/pcss.comp.glsl",
                            "soft_shadows/pcss"),
        searchScale_(values.real("search_scale")),
        searchTaps_(static_cast<int>(values.integer("search_taps"))),
        filterTaps_(static_cast<int>(values.integer("filter_taps"))) {}

 protected:
  void configure(const gl::Program& program) const override {
    program.set("searchScale", static_cast<float>(searchScale_));
    program.set("searchTaps", searchTaps_);
    program.set("filterTaps", filterTaps_);
  }

 private:
  double searchScale_;
  int searchTaps_, filterTaps_;
};

std::vector<Parameter> pcssParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(1.0);
  all.push_back(realParameter("search_scale", 1.0, 0.01, 4.0, "",
                              "Window of the blocker search as a share of the light's extents"));
  all.push_back(integerParameter("search_taps", 8, 1, 32, "", "Taps of the blocker search along a side"));
  all.push_back(integerParameter("filter_taps", 16, 1, 32, "", "Taps of the filter along a side"));
  return all;
}

const Registered<TechniqueInfo> kPcssRegistered{
    {.name = "soft_shadows/pcss",
     .version = 1,
     .summary = "Percentage-closer soft shadows: filter window from the blockers' average depth",
     .source = "Schwarz 2009, section 3.3 (SS-02)",
     .product = ProductKind::Visibility,
     .parameters = pcssParameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Pcss>(values); },
     .errorBound = {},
     .counters = VisibilityTechnique::counterNames()}};

}  // namespace
}  // namespace limen::techniques
