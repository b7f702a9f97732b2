// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occluder backprojection and area accumulation (SS-10, SS-11, SS-26, SS-30): areas
// of all micro-occluders on the light are summed, so overlapping ones count twice. Source: Schwarz 2009,
// sections 4.1 (after Guennebaud 2006), 4.4.1 and 4.4.3.
//
// Whether a microquad that folds over on the light adds or takes away is left open by the thesis: it sums the
// signed areas of a quad's two triangles. `quad_area` has both readings.
#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

constexpr const char* kDefaultQuadArea = "absolute";
constexpr double kDefaultInset = 0.0;

gl::ShaderDefines backprojectionDefines(const ParameterValues& values) {
  if (values.text("quad_area") == "signed") return {{"SIGNED_AREAS", "1"}};
  return {};
}

void checkBackprojection(const ParameterValues& values) {
  OccluderSearch::checkSearch(values);
  const std::string& occluders = values.text("occluders");
  if (occluders.find("microquads") == std::string::npos && values.text("quad_area") != kDefaultQuadArea)
    throw Error("'quad_area' is about microquads, and there are none", "quad_area",
                "leave it out, or give occluders: microquads");
  if (occluders != "contours" && values.real("contour_inset") != kDefaultInset)
    throw Error("'contour_inset' is about contours, and there are none", "contour_inset",
                "leave it out, or give occluders: contours");
}

class Backprojection : public OccluderSearch {
 public:
  explicit Backprojection(const ParameterValues& values)
      : OccluderSearch(values, "renderer/techniques/soft_shadows/backprojection/backprojection.comp.glsl",
                       "soft_shadows/backprojection", backprojectionDefines(values)),
        contourInset_(static_cast<float>(values.real("contour_inset"))) {
    checkBackprojection(values);
  }

 protected:
  void configure(const gl::Program& program) const override {
    OccluderSearch::configure(program);
    program.set("contourInset", contourInset_);
  }

 private:
  float contourInset_;
};

std::vector<Parameter> backprojectionParameters() {
  std::vector<Parameter> all =
      OccluderSearch::searchParameters({"micropatches", "microquads", "microquads_microtris", "contours",
                                        "microrects", "morphing_microquads"});
  all.push_back(choiceParameter(
      "quad_area", kDefaultQuadArea, {"absolute", "signed"},
      "Area that a microquad adds: its size, or with the sign of its orientation, so that folds cancel",
      "Schwarz 2009, section 4.4.1 (open there)"));
  all.push_back(realParameter(
      "contour_inset", kDefaultInset, 0.0, 1.0, "",
      "Place of contours (t): 0 along the borders of the texels that block, 1 through their centres",
      "Schwarz 2009, section 4.4.5 (after Guennebaud 2007)"));
  return all;
}

const Registered<TechniqueInfo> kBackprojectionRegistered{
    {.name = "soft_shadows/backprojection",
     .version = 1,
     .summary = "Micro-occluders backprojected onto the light, their areas summed",
     .source = "Schwarz 2009, sections 4.1 and 4.4 (SS-10, SS-11, SS-26, SS-30, SS-31)",
     .product = ProductKind::Visibility,
     .parameters = backprojectionParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Backprojection>(values); },
     .errorBound = {},
     .counters = OccluderSearch::counterNames(),
     .check = checkBackprojection}};

}  // namespace
}  // namespace limen::techniques
