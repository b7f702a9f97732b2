// SPDX-License-Identifier: BSD-3-Clause
// Soft shadow mapping with occlusion bitmasks (SS-12 to SS-15, SS-27 to SS-30): light samples that some
// micro-occluder covers are bits that are set once, so overlapping occluders fuse. Source: Schwarz 2009,
// sections 4.2 and 4.4.
//
// Convex hulls differ from the thesis in that their corners are rounded to 1/4096 of the distance between two
// samples (exact from there on), that the table of half-spaces holds upward lines alone, and that rows are
// filled between a hull's edges at once.
#include <optional>

#include "base/error.h"
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {
namespace {

constexpr const char *kPass = "soft_shadows/bitmask", *kTables = "soft_shadows/mask_tables";
constexpr uint32_t kRectangleUnit = 6, kHalfSpaceUnit = 7;
constexpr const char *kDefaultTableSize = "256", *kDefaultRectangles = "128";
constexpr int64_t kDefaultSeed = 1;

gl::ShaderDefines definesOf(const ParameterValues& values) {
  const std::string &pattern = values.text("pattern"), &mask = values.text("quad_mask");
  gl::ShaderDefines defines = {{"PATTERN", pattern == "jittered_16" ? "160"
                                           : isGridPattern(pattern) ? pattern.substr(pattern.rfind('_') + 1)
                                                                    : "0"},
                               {"QUAD_MASK", mask == "approximate"        ? "0"
                                             : mask == "half_space_table" ? "1"
                                                                          : "2"},
                               {"TABLE_SIZE", values.text("table_size")}};
  if (!isGridPattern(pattern)) {
    defines["SAMPLES"] = std::to_string(lightSamples(pattern).size());
    defines["RECTANGLES"] = values.text("rectangle_table");
  }
  return defines;
}

void check(const ParameterValues& values) {
  OccluderSearch::checkSearch(values);
  const std::string &occluders = values.text("occluders"), &mask = values.text("quad_mask"),
                    &pattern = values.text("pattern");
  if (!occluders.starts_with("microquads") && mask != "approximate")
    throw Error("'quad_mask' is about microquads, and there are none", "quad_mask",
                "leave it out, or give occluders: microquads");
  if (occluders == "microquads_microtris" && mask == "approximate")
    throw Error("'quad_mask: approximate' says nothing about a triangle, and microtris are triangles",
                "quad_mask", "give quad_mask: arithmetic or half_space_table, or occluders: microquads");
  if (mask == "arithmetic" && !isGridPattern(pattern))
    throw Error("'quad_mask: arithmetic' needs samples in rows, which " + pattern + " has not", "quad_mask",
                "give quad_mask: half_space_table, or a regular or jittered pattern");
  if (mask != "half_space_table" && values.text("table_size") != kDefaultTableSize)
    throw Error("'table_size' is about the table of half-spaces, and there is none", "table_size",
                "leave it out, or give quad_mask: half_space_table");
  if (isGridPattern(pattern) && values.text("rectangle_table") != kDefaultRectangles)
    throw Error("'rectangle_table' is about patterns without a grid, and " + pattern + " has one",
                "rectangle_table", "leave it out, or give another pattern");
  if (!pattern.starts_with("random_") && !pattern.starts_with("stratified_") &&
      values.integer("pattern_seed") != kDefaultSeed)
    throw Error("'pattern_seed' is about random patterns, and " + pattern + " is none", "pattern_seed",
                "leave it out, or give another pattern");
}

class Bitmask : public OccluderSearch {
 public:
  explicit Bitmask(const ParameterValues& values)
      : OccluderSearch(values, "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl", kPass,
                       definesOf(values)),
        pattern_(values.text("pattern")),
        seed_(values.integer("pattern_seed")),
        halfSpaceSize_(values.text("quad_mask") == "half_space_table" ? std::stoi(values.text("table_size"))
                                                                      : 0),
        rectangleSize_(
            isGridPattern(pattern_) || halfSpaceSize_ > 0 ? 0 : std::stoi(values.text("rectangle_table"))) {
    check(values);
  }

  void prepare(frame::Frame& frame) override {
    OccluderSearch::prepare(frame);
    const std::vector<glm::dvec2> samples = lightSamples(pattern_, seed_);
    if (halfSpaceSize_ > 0) halfSpaces_.emplace(makeHalfSpaceTable(samples, halfSpaceSize_));
    if (rectangleSize_ > 0) rectangles_.emplace(makeRectangleTable(samples, rectangleSize_));
    const int64_t bytes = (halfSpaces_ ? halfSpaces_->bytes() : 0) + (rectangles_ ? rectangles_->bytes() : 0);
    if (bytes > 0) frame.passes().setBytesHeld(kTables, bytes);
  }

 protected:
  void configure(const gl::Program& program) const override {
    OccluderSearch::configure(program);
    if (halfSpaces_) halfSpaces_->bindTexture(kHalfSpaceUnit);
    if (rectangles_) rectangles_->bindTexture(kRectangleUnit);
  }

 private:
  std::string pattern_;
  int64_t seed_;
  int halfSpaceSize_, rectangleSize_;  ///< 0: no table
  std::optional<gl::Texture> halfSpaces_, rectangles_;
};

std::vector<Parameter> parameters() {
  std::vector<Parameter> all =
      OccluderSearch::searchParameters({"micropatches", "microquads", "microquads_microtris", "microrects"});
  all.push_back(
      choiceParameter("pattern", "jittered_16", lightSamplePatterns(),
                      "Light samples: regular grids, 16 x 16 in rotated pairs, or places without a grid",
                      "Schwarz 2009, sections 4.2.1 and 4.2.2"));
  all.push_back(integerParameter("pattern_seed", kDefaultSeed, 0, 1000000, "",
                                 "Seed of random and stratified patterns"));
  all.push_back(choiceParameter("rectangle_table", kDefaultRectangles, {"16", "32", "64", "128", "256"},
                                "Steps on either axis of the table of rectangles for patterns without a grid",
                                "Schwarz 2009, section 4.2.1 (value not given there)"));
  all.push_back(
      choiceParameter("quad_mask", "approximate", {"approximate", "half_space_table", "arithmetic"},
                      "Samples that a microquad covers: those of a rectangle in its place, or those "
                      "of its convex hull by a table or by arithmetic",
                      "Schwarz 2009, sections 4.4.2 and 4.4.4"));
  all.push_back(choiceParameter(
      "table_size", kDefaultTableSize, {"64", "128", "256", "512", "1024"},
      "Angles, and distances, of lines that the table of half-spaces holds; its memory grows by the square",
      "Schwarz 2009, section 4.4.4 (value not given there)"));
  return all;
}

const Registered<TechniqueInfo> kRegistered{
    {.name = "soft_shadows/bitmask",
     .version = 1,
     .summary = "Micro-occluders backprojected onto a bit field of light samples",
     .source = "Schwarz 2009, sections 4.2 and 4.4 (SS-12 to SS-15, SS-27 to SS-30)",
     .product = ProductKind::Visibility,
     .parameters = parameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Bitmask>(values); },
     .errorBound = {},
     .counters = OccluderSearch::counterNames(),
     .check = check}};

}  // namespace
}  // namespace limen::techniques
