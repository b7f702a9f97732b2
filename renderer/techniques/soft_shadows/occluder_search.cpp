// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <cmath>

#include "base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kDefaultGapFill = "left_bottom";

gl::ShaderDefines withOccluders(const ParameterValues& values, gl::ShaderDefines defines) {
  const std::string &fill = values.text("gap_fill"), &occluders = values.text("occluders");
  defines["GAP_FILL"] = fill == "none" ? "0" : fill == "left_bottom" ? "1" : "2";
  defines["OCCLUDERS"] = occluders == "micropatches" ? "0"
                         : occluders == "microquads" ? "1"
                         : occluders == "contours"   ? "3"
                                                     : "2";
  return defines;
}

}  // namespace

std::vector<Parameter> OccluderSearch::searchParameters(std::vector<std::string> occluders) {
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
  all.push_back(choiceParameter("gap_fill", kDefaultGapFill, {"none", "left_bottom", "diagonal"},
                                "Neighbours to which a micropatch is stretched to close gaps",
                                "Schwarz 2009, section 4.1 (after Guennebaud 2006; diagonal: Bavoil 2008)"));
  all.push_back(choiceParameter("occluders", "micropatches", std::move(occluders),
                                "What is made of texels that block: rectangles at one depth, a mesh between "
                                "their centres, that with triangles where three of four block, or contours",
                                "Schwarz 2009, sections 4.1, 4.4.1, 4.4.3 and 4.4.5"));
  return all;
}

void OccluderSearch::checkSearch(const ParameterValues& values) {
  if (values.text("occluders") != "micropatches" && values.text("gap_fill") != kDefaultGapFill)
    throw Error("'gap_fill' stretches micropatches; there are none, and no gaps", "gap_fill",
                "leave it out, or give occluders: micropatches");
}

OccluderSearch::OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                               gl::ShaderDefines defines)
    : VisibilityTechnique(values, std::move(shader), std::move(pass),
                          withOccluders(values, std::move(defines))),
      budget_(static_cast<int>(values.integer("budget"))),
      refinements_(static_cast<int>(values.integer("refinements"))) {
  checkSearch(values);
}

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
