// SPDX-License-Identifier: BSD-3-Clause
// Which values of the parameters about occluders go together, and all kinds of occluders on scenes made to
// break them.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

/// Names of techniques or scenes, each with values of its parameters.
using Kinds = std::vector<std::pair<std::string, std::map<std::string, ParameterValue>>>;

using OccluderKinds = TechniqueTest;

TEST_F(OccluderKinds, WhatBelongsToAnotherKindCannotBeWritten) {
  const std::string quads = "microquads", both = "microquads_microtris", table = "half_space_table",
                    rects = "microrects", stored = "stored", morphing = "morphing_microquads",
                    masks = "soft_shadows/bitmask", areas = "soft_shadows/backprojection";
  const Kinds cases = {{masks, {{"occluders", both}, {"occluders.mask", std::string("approximate")}}},
                       {masks, {{"occluders.mask", table}}},
                       {masks, {{"occluders", quads}, {"occluders.mask.size", int64_t{64}}}},
                       {masks, {{"occluders", quads}, {"occluders.gap_fill", std::string("diagonal")}}},
                       {areas, {{"occluders", quads}, {"occluders.gap_fill", std::string("none")}}},
                       {masks, {{"pattern.rectangle_table", int64_t{64}}}},
                       {masks, {{"pattern.seed", int64_t{2}}}},
                       {areas, {{"occluders.inset", 0.5}}},
                       {areas, {{"occluders.area", std::string("signed")}}},
                       {masks, {{"occluders.merge_metric", std::string("relative")}}},
                       {masks, {{"occluders", rects}, {"occluders.mask", table}}},
                       {masks, {{"bias", stored}, {"bias.slope", 1.0}}},
                       {masks, {{"bias", std::string("constant")}, {"bias.max_slope", 1.0}}},
                       {masks, {{"bias", stored}, {"bias.growth", 3.0}}},
                       {masks, {{"bias.scale", 2.0}}},
                       {areas, {{"occluders.level", 1.0}}},
                       {areas, {{"occluders", morphing}, {"occluders.gap_fill", std::string("none")}}}};
  for (const auto& [technique, given] : cases)
    EXPECT_THROW(ParameterValues(TechniqueRegistry::instance().get(technique).parameters, given), Error)
        << given.rbegin()->first;
}

TEST_F(OccluderKinds, ConflictsAreRefused) {
  struct Case {
    const char* technique;
    Given given;
    const char* where;
  };
  const std::string quads = "microquads", stored = "stored", fixed = "fixed",
                    morphing = "morphing_microquads";
  const std::vector<Case> cases = {
      {"soft_shadows/bitmask",
       {{"occluders", quads},
        {"occluders.mask", std::string("arithmetic")},
        {"pattern", std::string("random_256")}},
       "occluders.mask"},
      {"soft_shadows/bitmask",
       {{"levels", fixed}, {"levels.level", int64_t{7}}, {"resolution", int64_t{64}}},
       "levels.level"},
      {"soft_shadows/bitmask",
       {{"levels", fixed}, {"levels.level", int64_t{2}}, {"budget.limit", int64_t{25}}},
       "budget"},
      {"soft_shadows/bitmask", {{"bias", stored}}, "bias"},
      {"soft_shadows/backprojection",
       {{"occluders", morphing}, {"occluders.level", 6.5}, {"resolution", int64_t{64}}},
       "occluders.level"},
      {"soft_shadows/backprojection",
       {{"occluders", morphing}, {"levels", fixed}, {"levels.level", int64_t{1}}},
       "levels"},
      {"soft_shadows/backprojection", {{"occluders", morphing}, {"bias", stored}}, "bias"}};
  for (const Case& one : cases) {
    const std::optional<Error> error = refusal(one.technique, one.given);
    ASSERT_TRUE(error) << one.where;
    EXPECT_EQ(error->where(), one.where) << error->what();
    EXPECT_FALSE(error->hint().empty());
    const TechniqueInfo& info = TechniqueRegistry::instance().get(one.technique);
    EXPECT_THROW((void)info.make(ParameterValues(info.parameters, one.given)), Error);
  }
}

/// Every kind of occluder and mask that the techniques take, beside micropatches on grids.
Kinds kinds() {
  const std::string quads = "microquads", both = "microquads_microtris";
  Kinds out;
  for (const double inset : {0.0, 1.0})
    out.push_back({"soft_shadows/backprojection",
                   {{"occluders", std::string("contours")}, {"occluders.inset", inset}}});
  for (const char* pattern : {"random_128", "random_1024", "halton_256"}) {
    out.push_back({"soft_shadows/bitmask", {{"pattern", std::string(pattern)}}});
    out.push_back({"soft_shadows/bitmask", {{"pattern", std::string(pattern)}, {"occluders", quads}}});
    out.push_back({"soft_shadows/bitmask",
                   {{"pattern", std::string(pattern)},
                    {"occluders", both},
                    {"occluders.mask", std::string("half_space_table")}}});
  }
  const std::string rects = "microrects", morphing = "morphing_microquads", stored = "stored";
  out.push_back({"soft_shadows/backprojection", {{"occluders", rects}}});
  out.push_back({"soft_shadows/backprojection", {{"occluders", morphing}}});
  out.push_back(
      {"soft_shadows/bitmask", {{"occluders", rects}, {"occluders.merge_metric", std::string("relative")}}});
  out.push_back({"soft_shadows/bitmask", {{"bias", std::string("per_level")}}});
  for (const std::string& occluders : {std::string("micropatches"), quads})
    out.push_back({"soft_shadows/bitmask",
                   {{"occluders", occluders},
                    {"occluders.depths", std::string("nearest")},
                    {"bias", stored},
                    {"bias.scale", 0.0}}});
  for (const std::string& occluders : {quads, both}) {
    for (const char* area : {"absolute", "signed"})
      out.push_back(
          {"soft_shadows/backprojection", {{"occluders", occluders}, {"occluders.area", std::string(area)}}});
    for (const char* pattern : {"regular_8", "regular_32", "jittered_16"})
      for (const char* mask : {"approximate", "half_space_table", "arithmetic"})
        if (occluders == quads || mask != std::string("approximate"))
          out.push_back({"soft_shadows/bitmask",
                         {{"occluders", occluders},
                          {"occluders.mask", std::string(mask)},
                          {"pattern", std::string(pattern)}}});
  }
  return out;
}

TEST_F(OccluderKinds, LoopsThatTheDriverLeavesEarlyAreNoResult) {
  if (!context().device().software) GTEST_SKIP() << "only software renderers leave loops";
  // A light over all of the map: 511 x 511 cells, of which llvmpipe would visit a quarter.
  const scene::Scene scene = makeScene("box_under_light", {{"light_size", 10.0}});
  for (const Kinds::value_type& kind :
       {Kinds::value_type{"soft_shadows/backprojection", {{"occluders", std::string("microquads")}}},
        {"soft_shadows/backprojection", {{"occluders", std::string("contours")}}},
        {"soft_shadows/bitmask",
         {{"occluders", std::string("microquads")}, {"occluders.mask", std::string("arithmetic")}}}}) {
    Given given = kind.second;
    given["resolution"] = int64_t{512};
    given["budget.limit"] = int64_t{0};
    const Rendered rendered = render(scene, kind.first, given, {16, 12});
    EXPECT_TRUE(std::any_of(rendered.product.data.begin(), rendered.product.data.end(),
                            [](float value) { return std::isnan(value); }));
    try {
      render(scene, kind.first, given, {16, 12}, true);
      ADD_FAILURE() << kind.first << " counts";
    } catch (const Error& error) {
      EXPECT_NE(error.hint().find("'budget'"), std::string::npos);
    }
  }
}

TEST_F(OccluderKinds, HardScenesStayFiniteAndBounded) {
  const Kinds scenes = {{"degenerate_soup", {{"light_size", 3.0}}},
                        {"box_under_light", {{"light_size", 10.0}}},
                        {"two_boxes", {{"gap", 0.0}, {"light_size", 0.001}}}};
  for (const auto& [name, given] : scenes) {
    const scene::Scene scene = makeScene(name, given);
    for (const auto& [technique, kind] : kinds())
      for (const Given& corner :
           {Given{{"bias.constant", 0.0}, {"bias.slope", 0.0}, {"refinements", int64_t{0}}},
            Given{{"resolution", int64_t{1}}},
            Given{{"resolution", int64_t{2}}, {"budget.limit", int64_t{1}}},
            Given{{"budget.limit", int64_t{1}}}}) {
        Given all = kind;
        all.insert(corner.begin(), corner.end());
        all.emplace("resolution", int64_t{64});
        // What a kind does not have, or has no use for.
        if (all.count("bias") != 0) all.erase("bias.slope");
        if (all.count("occluders") != 0 &&
            all["occluders"] == ParameterValue(std::string("morphing_microquads")))
          all.erase("budget.limit");
        const Rendered rendered = render(scene, technique, all, {16, 12});
        for (const float value : rendered.product.data)
          ASSERT_TRUE(value >= 0.0F && value <= 1.0F)
              << name << ", " << technique << ", "
              << ParameterValues(TechniqueRegistry::instance().get(technique).parameters, all).toJson()
              << ": " << value;
      }
  }
}

}  // namespace
}  // namespace limen::techniques
