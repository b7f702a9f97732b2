// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "renderer/frame/multi_scale_map.h"
#include "renderer/techniques/soft_shadows/search_pictures.h"

namespace limen::techniques {
namespace {

constexpr const char *kDefaultGapFill = "left_bottom", *kDefaultBase = "256",
                     *kDefaultSamples = "one_then_four";

Structure structureOf(const std::string& name) {
  return name == "none"       ? Structure::None
         : name == "hsm"      ? Structure::Hsm
         : name == "mssm"     ? Structure::Mssm
         : name == "n_buffer" ? Structure::NBuffer
                              : Structure::Ysm;
}

bool hasLayers(Structure structure) { return structure >= Structure::Mssm; }

gl::ShaderDefines withSearch(const ParameterValues& values, gl::ShaderDefines defines) {
  const std::string &fill = values.text("gap_fill"), &occluders = values.text("occluders");
  defines["GAP_FILL"] = fill == "none" ? "0" : fill == "left_bottom" ? "1" : "2";
  defines["OCCLUDERS"] = occluders == "micropatches" ? "0"
                         : occluders == "microquads" ? "1"
                         : occluders == "contours"   ? "3"
                                                     : "2";
  const Structure structure = structureOf(values.text("structure"));
  defines[structure == Structure::None  ? "STRUCTURE_NONE"
          : structure == Structure::Hsm ? "STRUCTURE_HSM"
          : structure == Structure::Ysm ? "STRUCTURE_YSM"
                                        : "STRUCTURE_WINDOWS"] = "1";
  if (structure == Structure::NBuffer) defines["CORNER"] = "1";
  if (hasLayers(structure) && values.boolean("growth")) defines["GROW"] = "1";
  return defines;
}

/// Depth ranges of a pixel, from the first on, that one square answers.
int roughQueries(const std::string& samples) { return samples == "one" ? 1000 : samples == "four" ? 0 : 1; }

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
  all.push_back(
      choiceParameter("structure", "hsm", {"none", "hsm", "mssm", "n_buffer", "ysm"},
                      "What finds the depth range of a search area: nothing, hierarchical shadow map, "
                      "multi-scale shadow map, N-buffer, Y shadow map",
                      "Schwarz 2009, sections 4.1 and 4.3; N-buffer: Décoret 2005"));
  all.push_back(choiceParameter("ysm_base", kDefaultBase, {"64", "128", "256", "512"},
                                "Texels along a side of the Y shadow map's layers, at most the map's",
                                "Schwarz 2009, section 4.3.2"));
  all.push_back(choiceParameter("range_samples", kDefaultSamples, {"one", "one_then_four", "four"},
                                "Squares that answer a depth range in the structures with layers: one around "
                                "the area, four at its corners, or one for the first range of a pixel",
                                "Schwarz 2009, section 4.3.1 (one_then_four)"));
  all.push_back(booleanParameter("growth", true,
                                 "Structures with layers take whole micro-occluders of the level that the "
                                 "budget leads to; without, a seam stands where pixels become fully lit",
                                 "Schwarz 2009, section 4.3.1"));
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
  const Structure structure = structureOf(values.text("structure"));
  if (structure != Structure::Ysm && values.text("ysm_base") != kDefaultBase)
    throw Error("'ysm_base' is about the Y shadow map, and there is none", "ysm_base",
                "leave it out, or give structure: ysm");
  if (!hasLayers(structure) && values.text("range_samples") != kDefaultSamples)
    throw Error("'range_samples' is about structures with layers, and there are none", "range_samples",
                "leave it out, or give structure: mssm, n_buffer or ysm");
  if (!hasLayers(structure) && !values.boolean("growth"))
    throw Error("'growth' is about structures with layers, and there are none", "growth",
                "leave it out, or give structure: mssm, n_buffer or ysm");
}

OccluderSearch::OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                               gl::ShaderDefines defines)
    : VisibilityTechnique(values, std::move(shader), std::move(pass), withSearch(values, std::move(defines))),
      budget_(static_cast<int>(values.integer("budget"))),
      refinements_(static_cast<int>(values.integer("refinements"))),
      roughQueries_(roughQueries(values.text("range_samples"))),
      structure_(structureOf(values.text("structure"))),
      base_(structure_ == Structure::Ysm
                ? std::min(std::stoi(values.text("ysm_base")), mapSettings().resolution)
                : mapSettings().resolution) {
  checkSearch(values);
}

const frame::LightFrustum& OccluderSearch::bindMap(frame::Frame& frame) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(mapSettings());
  levels_ = pyramid.levels();
  int64_t bytes = pyramid.minimum().bytes() + pyramid.maximum().bytes();
  if (hasLayers(structure_)) {
    const auto& layers = frame.get<frame::MultiScaleMap>(frame::MultiScaleSettings{
        mapSettings(), base_,
        structure_ == Structure::NBuffer ? frame::WindowAnchor::Corner : frame::WindowAnchor::Centre});
    layers.texture().bindTexture(3);
    baseLevel_ = layers.baseLevel();
    bytes += layers.texture().bytes();
  }
  structureBytes_.resize(maps().size());
  structureBytes_[currentMap()] = bytes;
  // Last, since making the inputs binds textures too.
  pyramid.minimum().bindTexture(1);
  pyramid.maximum().bindTexture(2);
  maxIterations_ = frame.context().device().software ? 60000 : 0x7fffffff;
  return pyramid.frustum();
}

void OccluderSearch::configure(const gl::Program& program) const {
  program.set("levels", levels_);
  program.set("maxIterations", maxIterations_);
  program.set("refinements", refinements_);
  program.set("roughQueries", hasLayers(structure_) ? roughQueries_ : 0);
  program.set("baseLevel", baseLevel_);
  program.set("budgetPerAxis",
              budget_ == 0 ? 1 << 14 : std::max(1, static_cast<int>(std::floor(std::sqrt(double(budget_))))));
}

std::vector<std::string> OccluderSearch::counterNames() {
  std::vector<std::string> names = VisibilityTechnique::counterNames();
  names.emplace_back("structure_bytes");
  return names;
}

std::vector<Counter> OccluderSearch::count(frame::Frame& frame) {
  std::vector<Counter> all = VisibilityTechnique::count(frame);
  const int64_t bytes = std::accumulate(structureBytes_.begin(), structureBytes_.end(), int64_t{0});
  all.push_back({"structure_bytes", static_cast<double>(bytes), "byte", true});
  return all;
}

std::map<std::string, Image> OccluderSearch::pictures() const {
  if (counted().work.empty()) return {};
  return {{"search_area", searchAreaPicture(counted())}, {"levels", levelPicture(counted())}};
}

}  // namespace limen::techniques
