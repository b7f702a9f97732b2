// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "experiments/base/yaml_tree.h"
#include "perception/vision/display.h"
#include "renderer/catalogue.h"
#include "renderer/scene/scene.h"
#include "study/protocol/design.h"
#include "tests/experiments/base/declare.h"

namespace limen::study {
namespace {

const std::shared_ptr<const Catalogue>& catalogue() {
  static const std::shared_ptr<const Catalogue> kCatalogue = catalogueFromRegistries();
  return kCatalogue;
}

std::vector<PlannedTrial> plannedTrials(const Protocol& protocol) {
  std::vector<PlannedTrial> out;
  for (const PlannedBlock& block : makeDesign(protocol, 1, 0).blocks)
    if (!block.practice) out.insert(out.end(), block.trials.begin(), block.trials.end());
  return out;
}

/// Where a point is in the window, by pinhole geometry.
glm::dvec2 projected(const scene::Camera& camera, glm::dvec3 point, const WindowSetting& window) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const glm::dvec3 way = point - camera.eye;
  const double scale =
      0.5 * window.heightPx / std::tan(glm::radians(0.5 * camera.verticalFovDeg)) / glm::dot(way, forward);
  return {0.5 * window.widthPx + scale * glm::dot(way, right),
          0.5 * window.heightPx - scale * glm::dot(way, up)};
}

/// Middle of the patch, by the weights of a cubic B-spline.
glm::dvec3 tipOf(const scene::Scene& scene) {
  glm::dvec3 tip(0.0);
  constexpr std::array<double, 4> kWeights = {1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0};
  for (size_t k = 0; k < 16; ++k) tip += kWeights[k % 4] * kWeights[k / 4] * scene.patches[0].points[k];
  return tip;
}

/// Scene time of the first frame that is shown.
double firstFrameS(const Stimulus& s) {
  return s.sceneStartS + (s.presentation == Presentation::Static ? s.changeAtS : 0.0);
}

TEST(ShippedProtocols, AllReadAndGiveStimuli) {
  const std::string features = readTextFile(LIMEN_SOURCE_DIR "/experiments/features.yaml");
  std::set<std::string> names;
  for (const auto& [name, title] : shippedProtocols()) {
    names.insert(name);
    EXPECT_FALSE(title.empty());
    const Protocol protocol = readProtocol(name, catalogue());
    EXPECT_EQ(protocol.name, name);
    for (const std::string& feature : protocol.features)
      EXPECT_THAT(features, testing::HasSubstr("id: " + feature + ",")) << name;
    for (const std::string& text : {protocol.texts.consent, protocol.texts.instructions,
                                    protocol.texts.practice, protocol.texts.pause, protocol.texts.debrief})
      EXPECT_FALSE(text.empty()) << name;
    for (const PlannedTrial& trial : plannedTrials(protocol)) {
      if (trial.procedure < 0) {
        EXPECT_FALSE(stimuliOf(protocol, trial).empty());
      }
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"experiment_1", "experiment_2", "patch_in_motion", "quality_pairs",
                                          "quick", "threshold_2ifc"}));
}

TEST(ShippedProtocols, TheReadmesExampleReads) {
  const std::string readme = readTextFile(LIMEN_SOURCE_DIR "/study/protocols/README.md");
  const size_t begin = readme.find("    title:"), end = readme.find("\n## ", begin);
  ASSERT_NE(begin, std::string::npos);
  std::string text;
  std::istringstream lines(readme.substr(begin, end - begin));
  for (std::string line; std::getline(lines, line);) text += (line.empty() ? line : line.substr(4)) + "\n";
  // 4 speeds x 2 presentations x 2 changes, 3 + 1 trials of each.
  EXPECT_EQ(plannedTrials(parseProtocol(text, "example.yaml", catalogue())).size(), 64U);
}

TEST(ShippedProtocols, ExperimentOneHasTheThesisDesign) {
  const Protocol protocol = readProtocol("experiment_1", catalogue());
  const std::vector<PlannedTrial> trials = plannedTrials(protocol);
  ASSERT_EQ(trials.size(), 112U);
  std::map<std::map<std::string, std::string>, std::pair<int, int>> counts;
  int changes = 0;
  for (size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(trials[i].condition.at("presentation"), i < 56 ? "dynamic" : "static");
    auto& [change, none] = counts[trials[i].condition];
    ++(trials[i].change ? change : none);
    changes += trials[i].change ? 1 : 0;
  }
  EXPECT_EQ(changes, 84);
  EXPECT_EQ(counts.size(), 28U);
  for (const auto& [condition, count] : counts) EXPECT_EQ(count, std::make_pair(3, 1));
}

TEST(ShippedProtocols, ExperimentOneChangesAtItsDistanceAndPointsAtTheTip) {
  const Protocol protocol = readProtocol("experiment_1", catalogue());
  for (const PlannedTrial& trial : plannedTrials(protocol)) {
    const Stimulus s = stimuliOf(protocol, trial)[0];
    EXPECT_EQ(s.durationS, 4.5);
    if (trial.repetition > 0 || !trial.change) continue;
    const scene::Scene scene = scene::buildScene(s.scene.name, s.scene.values);
    const glm::dvec3 middle = scene.lodObjects[0].bounds.centre();
    const scene::Camera camera = scene.camera.at(s.sceneStartS + s.changeAtS);
    EXPECT_NEAR(glm::distance(camera.eye, middle), std::stod(trial.condition.at("switch_distance")), 1e-9);
    // The camera moves all the time.
    EXPECT_NEAR(
        glm::distance(scene.camera.at(s.sceneStartS + 4.4).eye, scene.camera.at(s.sceneStartS + 4.5).eye),
        0.1, 1e-9);
    // Uniform cubic B-splines are 1, 23, 23 and 1 of 48 in the middle of a patch.
    const glm::dvec3 tip = tipOf(scene);
    const glm::dvec2 place = projected(scene.camera.at(firstFrameS(s)), tip, protocol.window);
    EXPECT_EQ(s.cue.kind, Cue::Kind::Arrow);
    EXPECT_NEAR(s.cue.xPx, place.x, 1.0);
    EXPECT_NEAR(s.cue.yPx, place.y, 1.0);
  }
}

TEST(ShippedProtocols, ThePatchInMotionMovesAsItsFactorSays) {
  const Protocol protocol = readProtocol("patch_in_motion", catalogue());
  const perception::DisplayProfile display = perception::displayPreset(protocol.display);
  std::map<std::string, int> trials;
  for (const PlannedTrial& trial : plannedTrials(protocol)) {
    const Stimulus s = stimuliOf(protocol, trial).front();
    const std::string level = trial.condition.at("speed");
    const double degS = level == "rest" ? 0.0 : std::stod(level);
    ++trials[level];
    EXPECT_EQ(s.presentation, degS > 0.0 ? Presentation::Dynamic : Presentation::Static);
    const scene::Scene scene = scene::buildScene(s.scene.name, s.scene.values);
    const glm::dvec3 tip = tipOf(scene);
    const auto at = [&](double timeS) { return projected(scene.camera.at(timeS), tip, protocol.window); };
    // In the middle when the level changes, and moving there at the speed that it is named after.
    EXPECT_NEAR(at(0.0).x, 512.0, 0.5);
    EXPECT_NEAR(glm::distance(at(0.5 / 60.0), at(-0.5 / 60.0)) * 60.0 / display.pixelsPerDegree(), degS,
                0.01 * degS);
    EXPECT_NEAR(s.cue.xPx, at(firstFrameS(s)).x, 5.0);
    EXPECT_NEAR(s.cue.yPx, at(firstFrameS(s)).y, 1.0);
    EXPECT_LT(std::abs(at(firstFrameS(s)).x - 512.0), 512.0);
  }
  EXPECT_EQ(trials.size(), 5U);
  for (const auto& [level, count] : trials) EXPECT_EQ(count, 2 * 3 * 4) << level;
}

TEST(ShippedProtocols, ExperimentTwoHasTheThesisDesign) {
  const Protocol protocol = readProtocol("experiment_2", catalogue());
  std::map<std::string, std::map<std::map<std::string, std::string>, std::pair<int, int>>> counts;
  for (const PlannedTrial& trial : plannedTrials(protocol)) {
    auto& [change, none] = counts[protocol.parts[static_cast<size_t>(trial.part)].name][trial.condition];
    ++(trial.change ? change : none);
    const Stimulus s = stimuliOf(protocol, trial)[0];
    const bool dynamic = trial.condition.at("presentation") == "dynamic";
    EXPECT_EQ(s.presentation == Presentation::Dynamic, dynamic);
    EXPECT_EQ(s.showings, dynamic ? 3 : 2);
    EXPECT_EQ(s.gapS, 1.0);
    EXPECT_EQ(s.durationS, 4.0);
    EXPECT_EQ(s.cue.kind, trial.part == 0 ? Cue::Kind::None : Cue::Kind::Circle);
  }
  ASSERT_EQ(counts.size(), 2U);
  for (const auto& [part, conditions] : counts) {
    EXPECT_EQ(conditions.size(), 16U);
    for (const auto& [condition, count] : conditions) EXPECT_EQ(count, std::make_pair(1, 1));
  }
  // Which part comes first alternates.
  EXPECT_NE(makeDesign(protocol, 1, 0).blocks[0].part, makeDesign(protocol, 1, 1).blocks[0].part);
}

TEST(ShippedProtocols, ExperimentTwoMarksTheTileThatChanges) {
  const Protocol protocol = readProtocol("experiment_2", catalogue());
  for (const PlannedTrial& trial : plannedTrials(protocol)) {
    if (trial.part == 0 || !trial.change) continue;
    const Stimulus s = stimuliOf(protocol, trial)[0];
    const scene::Scene scene = scene::buildScene(s.scene.name, s.scene.values);
    const glm::dvec3 tile = scene.lodObjects[static_cast<size_t>(s.levels->object)].bounds.centre();
    const glm::dvec2 place = projected(scene.camera.at(firstFrameS(s)), tile, protocol.window);
    EXPECT_NEAR(s.cue.xPx, place.x, 1.0);
    EXPECT_NEAR(s.cue.yPx, place.y, 1.0);
    EXPECT_EQ(s.cue.radiusPx, 50.0);
    EXPECT_EQ(s.cue.durationS, 2.0);
    EXPECT_NEAR(glm::distance(scene.camera.at(s.sceneStartS + s.changeAtS).eye, tile),
                realOf(s.scene.values, "distance"), 1e-9);
  }
}

TEST(ShippedProtocols, ThresholdAndPairsHaveTheirTrials) {
  const Protocol threshold = readProtocol("threshold_2ifc", catalogue());
  EXPECT_EQ(plannedTrials(threshold).size(), 160U);
  EXPECT_EQ(makeDesign(threshold, 1, 0).procedures.size(), 4U);
  const Protocol pairs = readProtocol("quality_pairs", catalogue());
  EXPECT_EQ(plannedTrials(pairs).size(), 7U * 6U / 2U * 2U * 2U);
  EXPECT_EQ(plannedTrials(readProtocol("quick", catalogue())).size(), 6U);
}

}  // namespace
}  // namespace limen::study
