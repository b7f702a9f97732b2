// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/level_of_quality.h"

#include <string>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char *kSplit = "split", *kFinestWithin = "finest_within", *kCoarsestOver = "coarsest_over",
                     *kNarrowBlend = "narrow_blend", *kDither = "dither", *kFiltered = "filtered_depth",
                     *kDefaultOrder = "tiles";
constexpr int64_t kDefaultRadius = 5;
constexpr double kDefaultWidth = 0.1, kDefaultSigma = 3.0, kDefaultThreshold = 0.02;

bool isHard(const ParameterValues& values) {
  const std::string& levels = values.text("levels");
  return levels == kFinestWithin || levels == kCoarsestOver;
}

}  // namespace

std::vector<Parameter> LevelOfQuality::parameters() {
  return {
      choiceParameter("passes", "single", {"single", kSplit},
                      "All work on a pixel in one pass, or search, smoothing of levels and the loop over "
                      "micro-occluders in passes of their own, of which the last has no pixels without work",
                      "Schwarz 2009, sections 4.1 and 5.2.1"),
      choiceParameter("work_order", kDefaultOrder, {kDefaultOrder, "loop_length"},
                      "Order in which split passes go over pixels: by tiles of the image, or those with the "
                      "longest loops over micro-occluders first",
                      "Schwarz 2009, section 5.2.2 (coherence)"),
      choiceParameter(
          "levels", kFinestWithin, {kFinestWithin, kCoarsestOver, "blend", kNarrowBlend, kDither},
          "Level of the micro-occluders: the finest within the budget; of a real level, at which it "
          "is just kept, its floor, which exceeds it; both around it blended, or blended over "
          "'blend_width' alone, or one of them at random",
          "Schwarz 2009, sections 5.2.1 and 5.2.2 (formula reconstructed)"),
      choiceParameter("level_source", "search_area", {"search_area", kFiltered},
                      "What the real level follows from: the narrowed search area, or depths of the pyramid "
                      "that are filtered linearly",
                      "Schwarz 2009, section 5.2 (filtered_depth: after Guennebaud 2007)"),
      realParameter("blend_width", kDefaultWidth, 0.001, 1.0, "level",
                    "Width of the zone in which narrow_blend blends two levels; 1 is a full blend",
                    "Schwarz 2009, section 5.2.2"),
      integerParameter("smoothing_radius", kDefaultRadius, 0, 10, "px",
                       "Reach of the filter that smooths real levels that are blended; 0: none",
                       "Schwarz 2009, section 5.2.2 (support 11 x 11)"),
      realParameter("smoothing_sigma", kDefaultSigma, 0.1, 100.0, "px",
                    "Standard deviation of that filter's weights",
                    "Schwarz 2009, section 5.2.1 (open there)"),
      realParameter("depth_threshold", kDefaultThreshold, 0.0, 1.0, "",
                    "Step of depth from pixel to pixel at which that filter stops, as a share of the depth",
                    "Schwarz 2009, section 5.2.1 (open there)")};
}

void LevelOfQuality::check(const ParameterValues& values) {
  const std::string& levels = values.text("levels");
  const bool hard = isHard(values), splits = values.text("passes") == kSplit;
  const int64_t radius = values.integer("smoothing_radius");
  if (!splits && values.text("work_order") != kDefaultOrder)
    throw Error("'work_order' is about a list of pixels, and a single pass has none", "work_order",
                "leave it out, or give passes: split");
  if (levels == kFinestWithin && values.text("level_source") == kFiltered)
    throw Error("'level_source: filtered_depth' makes a real level, and finest_within counts", "level_source",
                "give levels: blend, or another choice that takes a real level");
  if (levels != kNarrowBlend && values.real("blend_width") != kDefaultWidth)
    throw Error("'blend_width' is about a narrow blend, and there is none", "blend_width",
                "leave it out, or give levels: narrow_blend");
  if (hard && radius != kDefaultRadius)
    throw Error("'smoothing_radius' is about levels that are blended, and " + levels + " is a hard choice",
                "smoothing_radius", "leave it out, or give levels: blend");
  if (!hard && !splits && radius > 0)
    throw Error("levels are smoothed between two passes, and there is one", "smoothing_radius",
                "give passes: split, or smoothing_radius: 0");
  if ((hard || radius == 0) && (values.real("smoothing_sigma") != kDefaultSigma ||
                                values.real("depth_threshold") != kDefaultThreshold))
    throw Error("'smoothing_sigma' and 'depth_threshold' are about a filter, and there is none",
                values.real("smoothing_sigma") != kDefaultSigma ? "smoothing_sigma" : "depth_threshold",
                "leave them out, or give levels: blend and a smoothing_radius");
}

LevelOfQuality::Levels LevelOfQuality::levelsOf(const ParameterValues& values) {
  const std::string& name = values.text("levels");
  return name == kFinestWithin   ? Levels::FinestWithin
         : name == kCoarsestOver ? Levels::CoarsestOver
         : name == kNarrowBlend  ? Levels::NarrowBlend
         : name == kDither       ? Levels::Dither
                                 : Levels::Blend;
}

LevelOfQuality::LevelOfQuality(const ParameterValues& values)
    : splits_(values.text("passes") == kSplit),
      orders_(values.text("work_order") != kDefaultOrder),
      filtered_(values.text("level_source") == kFiltered),
      levels_(levelsOf(values)),
      smoothingRadius_(isHard(values) ? 0 : static_cast<int>(values.integer("smoothing_radius"))),
      blendWidth_(values.real("blend_width")),
      sigma_(values.real("smoothing_sigma")),
      depthThreshold_(values.real("depth_threshold")) {}

void LevelOfQuality::define(gl::ShaderDefines& defines) const {
  defines["LEVELS"] = std::to_string(static_cast<int>(levels_));
  if (filtered_) defines["FILTERED_LEVEL"] = "1";
}

void LevelOfQuality::configure(const gl::Program& program) const {
  program.set("blendWidth", static_cast<float>(blendWidth_));
}

void LevelOfQuality::configureSmoothing(const gl::Program& program) const {
  program.set("radius", smoothingRadius_);
  program.set("sigma", static_cast<float>(sigma_));
  program.set("depthThreshold", static_cast<float>(depthThreshold_));
}

}  // namespace limen::techniques
