// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

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

/// Unchanged stimuli of the session's trials by what they show: {before, after}.
std::pair<int, int> unchanged(const Protocol& protocol, const std::vector<PlannedTrial>& trials) {
  std::pair<int, int> out;
  for (const PlannedTrial& trial : trials)
    for (const Stimulus& stimulus : stimuliOf(protocol, trial))
      if (!stimulus.changes) ++(stimulus.catchShowsAfter ? out.second : out.first);
  return out;
}

TEST(Stimuli, HalfOfTheCatchTrialsShowEachLevelInEveryCondition) {
  const Protocol protocol =
      exampleProtocol(kYesNo + kBox + "factors: {kind: [a, b, c]}\ntrials: {change: 2, catch: 4}\n");
  std::set<std::string> orders;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    std::map<std::string, std::vector<PlannedTrial>> conditions;
    std::string order;
    const Design design = makeDesign(protocol, seed, 0);
    for (const PlannedTrial& trial : design.blocks[0].trials) {
      conditions[trial.condition.at("kind")].push_back(trial);
      if (!trial.change) order += stimuliOf(protocol, trial)[0].catchShowsAfter ? 'a' : 'b';
    }
    for (const auto& [name, trials] : conditions)
      EXPECT_EQ(unchanged(protocol, trials), std::pair(2, 2)) << name << ", seed " << seed;
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 8U) << "which ones is not to be foreseen";
}

TEST(Stimuli, SingleCatchTrialsOfConditionsAreBalancedWithinTheBlock) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox +
                                            "factors: {kind: [a, b, c, d, e], where: [x, y]}\nblocks: {by: "
                                            "where, order: fixed}\ntrials: {catch: 1}\n");
  std::set<std::string> sidesOfFirst;
  for (uint64_t seed = 0; seed < 20; ++seed)
    for (const PlannedBlock& block : makeDesign(protocol, seed, 0).blocks) {
      const auto [before, after] = unchanged(protocol, block.trials);
      EXPECT_EQ(before + after, 5);
      EXPECT_LE(std::abs(before - after), 1);
      sidesOfFirst.insert(before > after ? "before" : "after");
    }
  EXPECT_EQ(sidesOfFirst.size(), 2U) << "the odd one is drawn";
}

TEST(Stimuli, CatchTrialsOfProceduresAndPracticeAreBalancedToo) {
  const Protocol protocol = exampleProtocol(kYesNo + R"(stimulus:
  scene: {name: box, distance: = 1 / nearness}
  levels: {before: 1, after: 0}
procedure: {type: constant, stimulus: {name: nearness, values: [0.05, 0.25]}, repetitions: 10}
trials: {catch: 6}
practice: {trials: 8, stimuli: [{nearness: 0.1}]}
)");
  const Design design = makeDesign(protocol, 5, 0);
  ASSERT_EQ(design.blocks.size(), 2U);
  for (const PlannedBlock& block : design.blocks) {
    int before = 0, after = 0;
    for (const PlannedTrial& trial : block.trials)
      if (!trial.change)
        ++(stimuliOf(protocol, trial, {{"nearness", 0.1}})[0].catchShowsAfter ? after : before);
    EXPECT_LE(std::abs(before - after), 1) << block.name;
    EXPECT_EQ(before + after, block.practice ? 2 : 6);
  }
}

TEST(Stimuli, UnchangedIntervalsShowBothLevelsEquallyOften) {
  for (const int alternatives : {2, 3}) {
    const Protocol protocol =
        exampleProtocol("task: {type: interval, alternatives: " + std::to_string(alternatives) +
                        ", question: \"Which?\"}\n" + kBox + "trials: {change: 12}\n");
    const Design design = makeDesign(protocol, 1, 0);
    const int each = 12 * (alternatives - 1) / 2;
    EXPECT_EQ(unchanged(protocol, design.blocks[0].trials), std::pair(each, each));
    // Of several in a trial one shows each, so that the changing one is not the odd one out at either end.
    if (alternatives == 3) {
      for (const PlannedTrial& trial : design.blocks[0].trials)
        EXPECT_EQ(unchanged(protocol, {trial}), std::pair(1, 1));
    }
  }
}

TEST(Stimuli, WhatCatchTrialsShowCanBeChosen) {
  const auto shown = [](const std::string& levels, const std::string& setting) {
    const Protocol protocol =
        exampleProtocol(kYesNo + "stimulus: {scene: {name: box}, levels: " + levels +
                        ", catch_shows: " + setting + "}\ntrials: {change: 1, catch: 4}\n");
    return unchanged(protocol, makeDesign(protocol, 1, 0).blocks[0].trials);
  };
  const std::pair allBefore(4, 0), allAfter(0, 4);
  EXPECT_EQ(shown("{before: 1, after: 0}", "before"), allBefore);
  EXPECT_EQ(shown("{before: 1, after: 0}", "after"), allAfter);
  // Level 0 is the finest.
  EXPECT_EQ(shown("{before: 1, after: 0}", "coarse"), allBefore);
  EXPECT_EQ(shown("{before: 1, after: 0}", "fine"), allAfter);
  EXPECT_EQ(shown("{before: 0, after: 2}", "coarse"), allAfter);
  EXPECT_EQ(shown("{before: 0, after: 2}", "fine"), allBefore);
  EXPECT_EQ(shown("{before: 1, after: 0}", "balanced"), std::pair(2, 2));
}

TEST(Stimuli, OfTechniquesNoneIsCoarse) {
  EXPECT_THAT(refusal(protocolText(kYesNo + R"(stimulus:
  scene: {name: box}
  before: {name: fast}
  after: {name: exact}
  catch_shows: coarse
)")),
              testing::AllOf(testing::HasSubstr("test.yaml:6:"), testing::HasSubstr("'catch_shows: coarse'"),
                             testing::HasSubstr("before, after or balanced")));
}

TEST(Stimuli, APlanOfAnEarlierVersionShowsWhatItShowed) {
  const Protocol protocol = exampleProtocol(kYesNo + kBox + "trials: {change: 2, catch: 4}\n");
  Design design = makeDesign(protocol, 3, 1);
  EXPECT_TRUE(design.answersMirrored);
  asPlannedBefore(design, 1);
  EXPECT_EQ(unchanged(protocol, design.blocks[0].trials), std::pair(4, 0));
  EXPECT_FALSE(design.answersMirrored);
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
