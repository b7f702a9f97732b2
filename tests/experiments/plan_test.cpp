// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "experiments/base/error.h"
#include "tests/experiments/base/declare.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Plan planOf(const std::string& text, const Catalogue& catalogue = fakeCatalogue(),
            const std::string& path = "d.yaml") {
  return makePlan(parseDescriptor(text, path, catalogue, {}), catalogue);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::vector<std::string> described(const Plan& plan) {
  std::vector<std::string> out;
  for (const PlannedRun& run : plan.runs) out.push_back(describe(run));
  return out;
}

std::set<std::string> keysOf(const Plan& plan) {
  std::set<std::string> out;
  for (const PlannedRun& run : plan.runs) out.insert(run.key);
  return out;
}

TEST(Plan, IsTheFullGridWithTechniquesByTurns) {
  const Plan plan = planOf(validDescriptor());
  EXPECT_THAT(
      described(plan),
      ElementsAre("soft/bitmask samples=8, grid light_size=0.5", "soft/pcss radius=0.02, grid light_size=0.5",
                  "soft/bitmask samples=16, grid light_size=0.5",
                  "soft/pcss radius=0.05, grid light_size=0.5",
                  "soft/bitmask samples=32, grid light_size=0.5", "soft/bitmask samples=8, grid light_size=1",
                  "soft/pcss radius=0.02, grid light_size=1", "soft/bitmask samples=16, grid light_size=1",
                  "soft/pcss radius=0.05, grid light_size=1", "soft/bitmask samples=32, grid light_size=1"));
  EXPECT_THAT(plan.groups, ElementsAre(std::pair<size_t, size_t>(0, 5), std::pair<size_t, size_t>(5, 10)));
  EXPECT_EQ(keysOf(plan).size(), 10U);
  for (const PlannedRun& run : plan.runs) EXPECT_EQ(integerOf(run.reference.values, "samples"), 256);
}

TEST(Plan, AxesOfOneEntryMultiplyAndTheLastChangesFastest) {
  const Plan plan = planOf(
      "title: a\nquestion: b\nscenes: [{name: grid}]\n"
      "techniques: [{name: soft/bitmask, samples: [1, 2], pattern: [regular_8, regular_16]}]\n");
  EXPECT_THAT(described(plan), ElementsAre("soft/bitmask pattern=regular_8, samples=1, grid",
                                           "soft/bitmask pattern=regular_16, samples=1, grid",
                                           "soft/bitmask pattern=regular_8, samples=2, grid",
                                           "soft/bitmask pattern=regular_16, samples=2, grid"));
}

TEST(Plan, ImageSizesAreAxesOrAList) {
  EXPECT_EQ(
      planOf(replaced(validDescriptor(), "width: 64, height: 48", "width: [64, 65], height: [48, 49, 50]"))
          .runs.size(),
      60U);
  const Plan list = planOf(replaced(validDescriptor(), "{width: 64, height: 48}",
                                    "[{width: 64, height: 48}, {width: 1, height: 1}]"));
  EXPECT_EQ(list.runs.size(), 20U);
  EXPECT_EQ(list.groups.size(), 4U);
  EXPECT_EQ(list.runs.back().setting, "light_size=1, 1x1");
}

TEST(Plan, LabelsNameWhatDiffersAmongEntriesOfOneName) {
  const Plan plan = planOf(
      "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques:\n"
      "  - {name: soft/pcss, radius: 0.1, fail: false}\n  - {name: soft/pcss, radius: 0.2}\n"
      "  - {name: soft/bitmask, samples: 8}\n");
  EXPECT_THAT(described(plan),
              ElementsAre("soft/pcss radius=0.1, grid", "soft/pcss radius=0.2, grid", "soft/bitmask, grid"));
}

TEST(Plan, KeysDependOnWhatDecidesTheResultAndOnNothingElse) {
  const std::set<std::string> keys = keysOf(planOf(validDescriptor()));
  // Words, order of writing, and spelled-out defaults change no result.
  EXPECT_EQ(keysOf(planOf(replaced(validDescriptor(), "title: Bitmask", "title: Another"))), keys);
  EXPECT_EQ(keysOf(planOf(replaced(validDescriptor(), "[8, 16, 32]", "[32, 8, 16]"))), keys);
  EXPECT_EQ(keysOf(planOf(replaced(validDescriptor(), "soft/bitmask, ", "soft/bitmask, bias: 0.001, "))),
            keys);
  const auto changesAll = [&](const std::string& from, const std::string& to) {
    for (const std::string& key : keysOf(planOf(replaced(validDescriptor(), from, to))))
      EXPECT_FALSE(keys.count(key)) << from << " -> " << to;
  };
  changesAll("samples: 256", "samples: 257");
  changesAll("width: 64", "width: 65");
  changesAll("frames: 4", "frames: 5");
  changesAll("[rmse, crack_count]", "[rmse]");
}

TEST(Plan, ARaisedVersionChangesTheKeysOfItsRunsOnly) {
  const std::set<std::string> keys = keysOf(planOf(validDescriptor()));
  Catalogue raised = fakeCatalogue();
  raised.techniques["soft/bitmask"].version++;
  const Plan plan = planOf(validDescriptor(), raised);
  for (const PlannedRun& run : plan.runs)
    EXPECT_EQ(keys.count(run.key), run.technique.name == "soft/bitmask" ? 0U : 1U);
  for (const char* kind : {"scene", "reference", "metric"}) {
    Catalogue other = fakeCatalogue();
    const std::string word = kind;
    (word == "scene"    ? other.scenes["grid"]
     : word == "metric" ? other.metrics["rmse"]
                        : other.techniques["soft/sampled"])
        .version++;
    for (const PlannedRun& run : planOf(validDescriptor(), other).runs)
      EXPECT_FALSE(keys.count(run.key)) << kind;
  }
}

TEST(Plan, FilesCountByContentNotByPlace) {
  std::string pattern = (std::filesystem::temp_directory_path() / "limen_plan_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
  write("a.obj", "v 0 0 0\n");
  write("same.obj", "v 0 0 0\n");
  const auto keys = [&](const std::string& file) {
    return keysOf(planOf("title: a\nquestion: b\nscenes: [{name: mesh, file: " + file +
                             "}]\ntechniques: [{name: soft/pcss}]\n",
                         fakeCatalogue(), (folder / "d.yaml").string()));
  };
  const auto before = keys("a.obj");
  EXPECT_EQ(keys("same.obj"), before);
  write("a.obj", "v 0 0 1\n");
  EXPECT_NE(keys("a.obj"), before);
  std::filesystem::remove_all(folder);
}

TEST(Plan, AParameterDeclaredLaterLeavesTheKeysOfOlderResults) {
  std::string pattern = (std::filesystem::temp_directory_path() / "limen_plan_XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
  write("walk.yaml", "one");
  write("same.yaml", "one");
  write("other.yaml", "two");
  Catalogue later = fakeCatalogue();
  Parameter camera = textParameter("camera", "", "View");
  Parameter path = optionalFileParameter("camera_path", "Path");
  camera.keyedIfGiven = path.keyedIfGiven = true;
  later.scenes["grid"].parameters.insert(later.scenes["grid"].parameters.end(), {camera, path});
  const auto keys = [&](const std::string& scene, const Catalogue& catalogue) {
    return keysOf(planOf(
        "title: a\nquestion: b\nscenes: [{name: grid" + scene + "}]\ntechniques: [{name: soft/pcss}]\n",
        catalogue, (folder / "d.yaml").string()));
  };
  const auto before = keys("", fakeCatalogue());
  EXPECT_EQ(keys("", later), before);
  EXPECT_EQ(keys(", camera: ''", later), before);
  // All others differ from it and from each other, but for files of one content.
  std::set<std::string> all = before;
  for (const char* scene : {", camera: a", ", camera: b", ", camera_path: walk.yaml",
                            ", camera_path: other.yaml", ", camera: a, camera_path: walk.yaml"})
    EXPECT_TRUE(all.insert(*keys(scene, later).begin()).second) << scene;
  EXPECT_EQ(keys(", camera_path: same.yaml", later), keys(", camera_path: walk.yaml", later));
  // The record says both, whatever they are.
  const Plan plan = planOf(
      "title: a\nquestion: b\nscenes: [{name: grid}]\n"
      "techniques: [{name: soft/pcss}]\n",
      later);
  EXPECT_EQ(plan.runs[0].parameters["scene"]["camera"], "");
  std::filesystem::remove_all(folder);
}

TEST(Plan, ScenesWhoseValuesDoNotGoTogetherAreRefusedWithTheirPlace) {
  Catalogue catalogue = fakeCatalogue();
  catalogue.scenes["grid"].check = [](const ParameterValues& values) {
    if (integerOf(values, "bars") == 3) throw Error("three bars", "", "take four");
  };
  const std::string start = "title: a\nquestion: b\nscenes:\n  - {name: grid, bars: ",
                    end = "}\ntechniques: [{name: soft/pcss}]\n";
  EXPECT_EQ(planOf(start + "[2, 4]" + end, catalogue).runs.size(), 2U);
  try {
    planOf(start + "[2, 3]" + end, catalogue);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("d.yaml:4:5: three bars; take four"));
  }
}

TEST(Plan, ShardsAreAPartition) {
  const Plan plan =
      planOf(replaced(validDescriptor(), "[8, 16, 32]", "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]"));
  for (const int count : {1, 2, 3, 7}) {
    std::vector<int> hits(plan.runs.size(), 0);
    for (int index = 1; index <= count; ++index) {
      const std::vector<bool> mask = shardMask(plan, index, count);
      for (size_t i = 0; i < mask.size(); ++i) hits[i] += mask[i] ? 1 : 0;
    }
    EXPECT_THAT(hits, testing::Each(1)) << count;
  }
}

TEST(Plan, CountsWithoutOverflowBeforeExpanding) {
  // Sixteen axes of 20 values: 20^16 exceeds 2^64.
  Catalogue catalogue = fakeCatalogue();
  std::string axes, list = "[0";
  for (int i = 1; i < 20; ++i) list += ", " + std::to_string(i);
  for (int i = 0; i < 16; ++i) {
    const std::string name = "p" + std::to_string(i);
    catalogue.techniques["soft/pcss"].parameters.push_back(integerParameter(name, 0, 0, 100, "", "Test"));
    axes += ", " + name + ": " + list + "]";
  }
  try {
    planOf("title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/pcss" + axes + "}]\n",
           catalogue);
    FAIL() << "planned";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("more than 18446744073709551615 runs"));
  }
}

TEST(Plan, RefusesValuesThatDoNotGoTogetherWithLineAndMend) {
  Catalogue catalogue = fakeCatalogue();
  catalogue.techniques["soft/bitmask"].check = [](const ParameterValues& values) {
    if (textOf(values, "pattern") == "jittered_16" && integerOf(values, "samples") == 16)
      throw Error("16 samples cannot be jittered", "pattern", "give more samples");
  };
  EXPECT_EQ(planOf(validDescriptor(), catalogue).runs.size(), 10U);
  const std::string jittered =
      replaced(validDescriptor(), "samples: [8, 16, 32]", "samples: [8, 16, 32], pattern: jittered_16");
  try {
    planOf(jittered, catalogue);
    FAIL() << "planned";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("d.yaml:7"));
    EXPECT_THAT(error.what(), HasSubstr("16 samples cannot be jittered; give more samples"));
  }
}

TEST(Plan, RefusesAReferenceWhoseValuesDoNotGoTogether) {
  Catalogue catalogue = fakeCatalogue();
  catalogue.techniques["soft/sampled"].check = [](const ParameterValues& values) {
    if (integerOf(values, "samples") == 256) throw Error("256 is too many", "samples", "take 64");
  };
  try {
    planOf(validDescriptor(), catalogue);
    FAIL() << "planned";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("256 is too many; take 64"));
  }
}

}  // namespace
}  // namespace limen::experiments
