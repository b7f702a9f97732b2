// SPDX-License-Identifier: BSD-3-Clause
#include "study/stimulus/stimulus.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/base/error.h"
#include "tests/experiments/base/declare.h"

namespace limen::study {
namespace {

using nlohmann::json;

ParameterValues values(double distance, int64_t tile, const std::string& kind) {
  return {{realParameter("distance", 5, 0, 50, "", ""), integerParameter("tile", 0, 0, 63, "", ""),
           choiceParameter("kind", "wood", {"wood", "stone"}, ""), booleanParameter("textured", true, "")},
          {{"distance", distance}, {"tile", tile}, {"kind", kind}}};
}

Stimulus example() {
  Stimulus out;
  out.scene = {"box", 3, values(4.0, 7, "wood"), {}};
  out.levels = LevelChange{1, 2, 1, "distance"};
  out.shading = values(0.1 + 0.2, 1, "stone");
  out.cue = {Cue::Kind::Circle, 10.5, 20.25, 50.0, 2.0};
  return out;
}

TEST(Stimulus, ComesBackFromJsonAsItWas) {
  Stimulus with = example();
  with.before = NamedEntry{"fast", 2, values(1e-17, -1 + 1, "wood"), {{"kind", "abc"}}};
  with.after = NamedEntry{"exact", 1, {}, {}};
  for (const Stimulus& stimulus : {Stimulus{}, example(), with}) {
    const json first = toJson(stimulus);
    // Through text, as files and stores keep it.
    const Stimulus back = stimulusFromJson(json::parse(first.dump()));
    EXPECT_EQ(toJson(back), first);
    EXPECT_EQ(stimulusHash(back), stimulusHash(stimulus));
  }
  const Stimulus back = stimulusFromJson(json::parse(toJson(with).dump()));
  EXPECT_EQ(realOf(back.scene.values, "distance"), 4.0);
  EXPECT_EQ(integerOf(back.scene.values, "tile"), 7);
  EXPECT_EQ(textOf(back.scene.values, "kind"), "wood");
  EXPECT_TRUE(booleanOf(back.scene.values, "textured"));
  EXPECT_EQ(back.levels->others, "distance");
  EXPECT_EQ(back.cue.kind, Cue::Kind::Circle);
}

TEST(Stimulus, EveryDifferenceGivesAnotherHash) {
  const std::vector<std::function<void(Stimulus&)>> changes = {
      [](Stimulus&) {},
      [](Stimulus& s) { s.scene.name = "ball"; },
      [](Stimulus& s) { s.scene.version = 4; },
      [](Stimulus& s) { s.scene.values = values(std::nextafter(4.0, 5.0), 7, "wood"); },
      [](Stimulus& s) { s.scene.values = values(4.0, 8, "wood"); },
      [](Stimulus& s) { s.scene.values = values(4.0, 7, "stone"); },
      [](Stimulus& s) { s.levels.reset(); },
      [](Stimulus& s) { s.levels->object = 2; },
      [](Stimulus& s) { s.levels->before = 3; },
      [](Stimulus& s) { s.levels->after = 0; },
      [](Stimulus& s) { s.levels->others = "omitted"; },
      [](Stimulus& s) { s.shading = {}; },
      [](Stimulus& s) {
        s.before = NamedEntry{"fast", 1, {}, {}};
      },
      [](Stimulus& s) {
        s.after = NamedEntry{"fast", 1, {}, {}};
      },
      [](Stimulus& s) { s.changes = false; },
      [](Stimulus& s) { s.catchShowsAfter = true; },
      [](Stimulus& s) { s.presentation = Presentation::Static; },
      [](Stimulus& s) { s.durationS = 4.5; },
      [](Stimulus& s) { s.changeAtS = 2.25; },
      [](Stimulus& s) { s.sceneStartS = -1; },
      [](Stimulus& s) { s.showings = 2; },
      [](Stimulus& s) { s.gapS = 0.5; },
      [](Stimulus& s) { s.samples = 1; },
      [](Stimulus& s) { s.cue.kind = Cue::Kind::Arrow; },
      [](Stimulus& s) { s.cue.xPx = 11; },
      [](Stimulus& s) { s.cue.yPx = 11; },
      [](Stimulus& s) { s.cue.radiusPx = 11; },
      [](Stimulus& s) { s.cue.durationS = 11; }};
  std::set<std::string> hashes;
  for (const auto& change : changes) {
    Stimulus stimulus = example();
    change(stimulus);
    hashes.insert(stimulusHash(stimulus));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(Stimulus, AFileCountsByWhatItHolds) {
  const auto with = [](const std::string& path, const std::string& content) {
    Stimulus out;
    out.scene = {"model", 1, {{fileParameter("file", "")}, {{"file", path}}}, {{"file", content}}};
    return stimulusHash(out);
  };
  EXPECT_EQ(with("/a/bunny.obj", "1234"), with("/b/hare.obj", "1234"));
  EXPECT_NE(with("/a/bunny.obj", "1234"), with("/a/bunny.obj", "5678"));
}

TEST(Stimulus, RefusesWhatIsNone) {
  for (const json& wrong : {json(), json::object(), json::array({1}), json{{"scene", 1}}})
    EXPECT_THROW(stimulusFromJson(wrong), Error) << wrong;
  json unknown = toJson(example());
  unknown["presentation"] = "fast";
  EXPECT_THROW(stimulusFromJson(unknown), Error);
  json wrongType = toJson(example());
  wrongType["duration_s"] = "long";
  EXPECT_THROW(stimulusFromJson(wrongType), Error);
}

}  // namespace
}  // namespace limen::study
