// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <cmath>

namespace limen::techniques {
namespace {

gl::ShaderDefines withGapFill(const ParameterValues& values, gl::ShaderDefines defines) {
  const std::string& fill = values.text("gap_fill");
  defines["GAP_FILL"] = fill == "none" ? "0" : fill == "left_bottom" ? "1" : "2";
  return defines;
}

}  // namespace

std::vector<Parameter> OccluderSearch::searchParameters() {
  // A micropatch of the receiver's own plane stands above that plane by the slope over one texel. Leaving out
  // the receiver's texel and the next leaves only patches whose false elevation is below half of the plane's
  // own.
  std::vector<Parameter> all = commonParameters(2.0);
  all.push_back(integerParameter("budget", 256, 0, 1 << 24, "",
                                 "Micro-occluders allowed for a pixel; its root counts per axis; 0: no limit",
                                 "Schwarz 2009, sections 4.1 and 4.5"));
  all.push_back(integerParameter("refinements", 2, 0, 3, "",
                                 "Times that the search area is narrowed by its depth range",
                                 "Schwarz 2009, section 4.1"));
  all.push_back(choiceParameter("gap_fill", "left_bottom", {"none", "left_bottom", "diagonal"},
                                "Neighbours to which a micropatch is stretched to close gaps",
                                "Schwarz 2009, section 4.1 (after Guennebaud 2006; diagonal: Bavoil 2008)"));
  return all;
}

OccluderSearch::OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                               gl::ShaderDefines defines)
    : VisibilityTechnique(values, std::move(shader), std::move(pass),
                          withGapFill(values, std::move(defines))),
      budget_(static_cast<int>(values.integer("budget"))),
      refinements_(static_cast<int>(values.integer("refinements"))) {}

const frame::LightFrustum& OccluderSearch::bindMap(frame::Frame& frame) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(mapSettings());
  pyramid.minimum().bindTexture(1);
  pyramid.maximum().bindTexture(2);
  levels_ = pyramid.levels();
  maxIterations_ = frame.context().device().software ? 60000 : 0x7fffffff;
  return pyramid.frustum();
}

void OccluderSearch::configure(const gl::Program& program) const {
  program.set("levels", levels_);
  program.set("maxIterations", maxIterations_);
  program.set("refinements", refinements_);
  program.set("budgetPerAxis",
              budget_ == 0 ? 1 << 14 : std::max(1, static_cast<int>(std::floor(std::sqrt(double(budget_))))));
}

}  // namespace limen::techniques
