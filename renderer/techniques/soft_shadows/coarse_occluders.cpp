// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/coarse_occluders.h"

#include <bit>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::techniques {
namespace {

constexpr const char *kMicrorects = "microrects", *kMorphing = "morphing_microquads";
constexpr const char *kDefaultMetric = "absolute", *kDefaultDiagonal = "contained";
constexpr int64_t kByBudget = -1;
constexpr double kDefaultMorph = 0.0;
constexpr int kCoarsest = 12;  // the only texel of the largest map
constexpr uint32_t kDepthUnit = 10, kExtentUnit = 11;

bool isMorphing(const ParameterValues& values) { return values.text("occluders") == kMorphing; }

int coarsestLevel(const ParameterValues& values) {
  return std::bit_width(static_cast<unsigned>(std::stoi(values.text("resolution")))) - 1;
}

}  // namespace

CoarseOccluders::CoarseOccluders(const ParameterValues& values)
    : microrects_(values.text("occluders") == kMicrorects),
      fixedLevel_(static_cast<int>(values.integer("fixed_level"))) {
  if (values.text("merge_metric") != kDefaultMetric) rule_.metric = frame::MergeMetric::Relative;
  if (values.text("diagonal_merge") != kDefaultDiagonal) rule_.diagonal = frame::DiagonalMerge::Nearest;
  if (isMorphing(values)) {
    morphLevel_ = static_cast<float>(values.real("morph_level"));
    fixedLevel_ = static_cast<int>(std::floor(morphLevel_));
  }
}

std::vector<Parameter> CoarseOccluders::parameters(bool morphing) {
  std::vector<Parameter> all = {
      integerParameter("fixed_level", kByBudget, kByBudget, kCoarsest, "",
                       "Level of the shadow map that all micro-occluders come from; -1: as the budget asks",
                       "Schwarz 2009, section 4.5"),
      choiceParameter("merge_metric", kDefaultMetric, {kDefaultMetric, "relative"},
                      "Difference of depth by which a microrect is merged with one of two neighbours: as it "
                      "is, or as a share of the nearer one's depth",
                      "Schwarz 2009, section 4.5.2 (absolute)"),
      choiceParameter("diagonal_merge", kDefaultDiagonal, {kDefaultDiagonal, "nearest"},
                      "Who takes a microrect that two axes drop: the lower left one that spans it already or "
                      "else the upper right one, or the nearest in depth of four",
                      "Schwarz 2009, section 4.5.2 (contained)")};
  if (morphing)
    all.push_back(realParameter("morph_level", kDefaultMorph, 0.0, double{kCoarsest}, "",
                                "Level, between two of the shadow map's, to which microquads have moved",
                                "Schwarz 2009, section 5.1.2"));
  return all;
}

void CoarseOccluders::check(const ParameterValues& values) {
  const int64_t level = values.integer("fixed_level");
  if (values.text("occluders") != kMicrorects && values.text("merge_metric") != kDefaultMetric)
    throw Error("'merge_metric' is about microrects, and there are none", "merge_metric",
                "leave it out, or give occluders: microrects");
  if (values.text("occluders") != kMicrorects && values.text("diagonal_merge") != kDefaultDiagonal)
    throw Error("'diagonal_merge' is about microrects, and there are none", "diagonal_merge",
                "leave it out, or give occluders: microrects");
  if (level > coarsestLevel(values))
    throw Error("'fixed_level' asks for level " + std::to_string(level) + " of a map of " +
                    values.text("resolution") + " texels a side, of which level " +
                    std::to_string(coarsestLevel(values)) + " is a single texel",
                "fixed_level", "give a lower level, or a higher resolution");
  const bool morphing = isMorphing(values);
  if (morphing && level != kByBudget)
    throw Error("'fixed_level' is whole, and morphing microquads lie between levels", "fixed_level",
                "leave it out and give 'morph_level'");
  if ((morphing || level != kByBudget) && values.integer("budget") != kDefaultBudget)
    throw Error("'budget' leads to a level for each pixel, and here all have one level", "budget",
                morphing ? "leave it out" : "leave it out, or leave out 'fixed_level'");
  if (values.has("morph_level")) {
    const double morph = values.real("morph_level");
    if (!morphing && morph != kDefaultMorph)
      throw Error("'morph_level' is about morphing microquads, and there are none", "morph_level",
                  "leave it out, or give occluders: morphing_microquads");
    if (morph > coarsestLevel(values))
      throw Error("'morph_level' asks for level " + shortestNumber(morph) + " of a map of " +
                      values.text("resolution") + " texels a side",
                  "morph_level", "give a lower level, or a higher resolution");
  }
}

void CoarseOccluders::make(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  if (microrects_) rects_ = &frame.get<frame::MicrorectMap>(frame::MicrorectSettings{map, rule_}).levels();
}

void CoarseOccluders::bind() const {
  if (!rects_) return;
  rects_->depths().bindTexture(kDepthUnit);
  rects_->extents().bindTexture(kExtentUnit);
}

void CoarseOccluders::configure(const gl::Program& program) const {
  program.set("fixedLevel", fixedLevel_);
  program.set("morphLevel", morphLevel_);
}

}  // namespace limen::techniques
