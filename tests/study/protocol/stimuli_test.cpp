// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "tests/experiments/base/declare.h"
#include "tests/study/protocol/example.h"

namespace limen::study {
namespace {

PlannedTrial firstTrial(const Protocol& protocol) { return makeDesign(protocol, 1, 0).blocks[0].trials[0]; }

TEST(Stimuli, ValuesAreWorkedOutByHand) {
  const Protocol protocol = exampleProtocol(kYesNo + R"(variables: {speed: 2, at: 2.25, cue_kind: arrow}
factors:
  pair:
    coarse: {fine_level: 1, tiles: 3}
  kind: [stone]
stimulus:
  scene: {name: box, distance: = 4 + at * speed, tile: = tiles * 4, kind: = kind, textured: false}
  levels: {object: = tiles, before: = fine_level + 1, after: = fine_level, others: omitted}
  shading: {ambient: = 1 / 4}
  presentation: static
  duration_s: = 2 * at
  change_at_s: = at
  start_s: = 1 - speed
  showings: 3
  gap_s: = 30 / refresh_hz
  samples: 4
  catch_shows: after
  cue: {kind: = cue_kind, x_px: 512, y_px: = 384 - 8 / speed, duration_s: 2}
trials: {change: 1, catch: 1}
order: fixed
)");
  const Design design = makeDesign(protocol, 1, 0);
  const std::vector<Stimulus> stimuli = stimuliOf(protocol, design.blocks[0].trials[0]);
  ASSERT_EQ(stimuli.size(), 1U);
  const Stimulus& s = stimuli[0];
  EXPECT_EQ(s.scene.name, "box");
  EXPECT_EQ(s.scene.version, 3);
  EXPECT_EQ(realOf(s.scene.values, "distance"), 8.5);
  EXPECT_EQ(integerOf(s.scene.values, "tile"), 12);
  EXPECT_EQ(textOf(s.scene.values, "kind"), "stone");
  EXPECT_FALSE(booleanOf(s.scene.values, "textured"));
  EXPECT_EQ(s.levels->object, 3);
  EXPECT_EQ(s.levels->before, 2);
  EXPECT_EQ(s.levels->after, 1);
  EXPECT_EQ(s.levels->others, "omitted");
  EXPECT_EQ(realOf(s.shading, "ambient"), 0.25);
  EXPECT_EQ(s.presentation, Presentation::Static);
  EXPECT_EQ(s.durationS, 4.5);
  EXPECT_EQ(s.changeAtS, 2.25);
  EXPECT_EQ(s.sceneStartS, -1);
  EXPECT_EQ(s.showings, 3);
  EXPECT_EQ(s.gapS, 0.5);  // the display's 60 Hz
  EXPECT_EQ(s.samples, 4);
  EXPECT_TRUE(s.catchShowsAfter);
  EXPECT_EQ(s.cue.kind, Cue::Kind::Arrow);
  EXPECT_EQ(s.cue.yPx, 380);
  EXPECT_TRUE(s.changes);
  const Stimulus caught = stimuliOf(protocol, design.blocks[0].trials[1])[0];
  EXPECT_FALSE(caught.changes);
}

TEST(Stimuli, WhatIsLeftOutHasItsDefault) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox);
  const Stimulus s = stimuliOf(protocol, firstTrial(protocol))[0];
  EXPECT_EQ(realOf(s.scene.values, "distance"), 5.0);
  EXPECT_EQ(realOf(s.shading, "ambient"), 0.2);
  EXPECT_EQ(s.changeAtS, s.durationS / 2);
}

TEST(Stimuli, TheTargetAloneChanges) {
  const Protocol protocol = exampleProtocol(R"(task: {type: interval, alternatives: 3, question: "Which?"}
)" + kBox + "trials: {change: 6}\n");
  const Design design = makeDesign(protocol, 1, 0);
  for (const PlannedTrial& trial : design.blocks[0].trials) {
    const std::vector<Stimulus> stimuli = stimuliOf(protocol, trial);
    ASSERT_EQ(stimuli.size(), 3U);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(stimuli[static_cast<size_t>(i)].changes, i == trial.target);
  }
}

TEST(Stimuli, ItemsStandWhereThePlanSays) {
  const Protocol protocol = exampleProtocol(R"(task: {type: pairwise, question: "Better?"}
items: setting
factors:
  setting:
    low: {shown: {name: fast, quality: 1}}
    exact: {shown: {name: exact}}
stimulus: {scene: {name: box}, before: = shown}
order: fixed
)");
  const std::vector<PlannedTrial> trials = makeDesign(protocol, 1, 0).blocks[0].trials;
  ASSERT_EQ(trials.size(), 2U);
  for (const PlannedTrial& trial : trials) {
    EXPECT_EQ(trial.condition.at("item_b"), "exact");
    const std::vector<Stimulus> stimuli = stimuliOf(protocol, trial);
    ASSERT_EQ(stimuli.size(), 2U);
    EXPECT_EQ(stimuli[static_cast<size_t>(trial.target)].before->name, "exact");
    EXPECT_EQ(stimuli[static_cast<size_t>(1 - trial.target)].before->name, "fast");
    EXPECT_EQ(integerOf(stimuli[static_cast<size_t>(1 - trial.target)].before->values, "quality"), 1);
    EXPECT_FALSE(stimuli[0].changes);
  }
}

TEST(Stimuli, AxesOfTheProcedureAreVariables) {
  const Protocol protocol = exampleProtocol(kYesNo + R"(stimulus:
  scene: {name: box, distance: = 1 / nearness}
  levels: {before: 1, after: 0}
procedure: {type: constant, stimulus: {name: nearness, values: [0.05, 0.25]}, repetitions: 2}
)");
  EXPECT_EQ(
      realOf(stimuliOf(protocol, firstTrial(protocol), {{"nearness", 0.125}})[0].scene.values, "distance"),
      8.0);
  EXPECT_THROW(stimuliOf(protocol, firstTrial(protocol)), Error);
}

TEST(Stimuli, AChangeOfTechniqueIsOne) {
  const Protocol protocol = exampleProtocol(
      kYesNo +
      "stimulus: {scene: {name: box}, before: {name: fast, pattern: \"16\"}, after: {name: exact}}\n");
  const Stimulus s = stimuliOf(protocol, firstTrial(protocol))[0];
  EXPECT_TRUE(s.changes);
  EXPECT_EQ(s.before->version, 2);
  EXPECT_EQ(textOf(s.before->values, "pattern"), "16");
  EXPECT_EQ(s.after->name, "exact");
  EXPECT_FALSE(s.levels);
}

TEST(Stimuli, FilesAreFoundBesideTheProtocol) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "protocol_files";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mesh.obj") << "v 0 0 0\n";
  const Protocol protocol = parseProtocol(
      protocolText(kYesNo +
                   "stimulus: {scene: {name: model, file: mesh.obj}, levels: {before: 1, after: 0}}\n"),
      (folder / "study.yaml").string(), exampleCatalogue());
  const Stimulus s = stimuliOf(protocol, firstTrial(protocol))[0];
  EXPECT_EQ(s.scene.fileHashes.at("file"), sha256("v 0 0 0\n"));
  ASSERT_EQ(protocol.fileHashes.size(), 1U);
  EXPECT_EQ(protocol.fileHashes.begin()->second, sha256("v 0 0 0\n"));
  EXPECT_EQ(textOf(s.scene.values, "file"), protocol.fileHashes.begin()->first);
}

}  // namespace
}  // namespace limen::study
