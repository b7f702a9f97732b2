// SPDX-License-Identifier: BSD-3-Clause
// Predictions of stimuli against the predictor fed by hand, and against the technique that renders for
// itself.
#include <epoxy/gl.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "perception/popping/predictor.h"
#include "perception/vision/colour.h"
#include "renderer/frame/motion.h"
#include "study/stimulus/cued_place.h"
#include "study/stimulus/prediction.h"
#include "study/stimulus/prepared_stimulus.h"
#include "tests/study/stimulus/stimulus_fixture.h"

namespace limen::study {
namespace {

constexpr glm::ivec2 kPredictionSize{96, 72};

class PredictionTest : public gl::GlTest {
 protected:
  /// The first frame after the change as the display gets it, coded by the closed form of sRGB.
  static Image coded(const Stimulus& stimulus, int level) {
    const frame::SceneOnGpu onGpu(scene::buildScene(stimulus.scene.name, stimulus.scene.values));
    frame::Frame frame(context(), onGpu, kPredictionSize, stimulus.changeAtS);
    frame.setLevels(scene::uniformLevels(onGpu.scene, level));
    frame.begin();
    Image image = frame.get<frame::Shaded>(frame::ShadedSetting{}).texture().read();
    frame.end();
    for (float& value : image.data)
      value = static_cast<float>(std::round(255.0 * perception::encodeSrgb(std::min(1.0, double{value}))) /
                                 255.0);
    return image;
  }

  /// What popping/lod_switch_reference, which has views of its own and does not round to codes, finds.
  static std::map<std::string, double> technique(const Stimulus& stimulus, const std::string& presentation) {
    Given given = stimulus.scene.values.all();
    given["camera.time_s"] = stimulus.changeAtS;
    const NamedEntry moved = sceneEntry(stimulus.scene.name, given);
    const frame::SceneOnGpu onGpu(scene::buildScene(moved.name, moved.values));
    frame::Frame frame(context(), onGpu, kPredictionSize);
    const auto& info = techniques::TechniqueRegistry::instance().get("popping/lod_switch_reference");
    const auto made = info.make(ParameterValues(
        info.parameters, {{"presentation", presentation}, {"display", std::string("schwarz_2009")}}));
    made->prepare(frame);
    frame.begin();
    made->render(frame);
    frame.end();
    std::map<std::string, double> out;
    for (const techniques::Counter& counter : made->count(frame)) out[counter.name] = counter.value;
    return out;
  }
};

TEST_F(PredictionTest, IsThePredictorsWordOnThePicturesAsTheyAreShown) {
  Stimulus stimulus = patchStimulus();
  stimulus.presentation = Presentation::Static;
  stimulus.samples = 1;
  perception::PoppingInput input;
  input.actual = coded(stimulus, 0);
  input.predicted = coded(stimulus, 1);
  input.isSwitch = true;
  const perception::PoppingResult expected = perception::predictPopping(input, studyDisplay());
  const PredictedPopping found = Predictor(context(), kPredictionSize, studyDisplay()).predict(stimulus);
  ASSERT_GT(expected.regions.regions.size(), 0U);
  ASSERT_EQ(found.regions.size(), expected.regions.regions.size());
  EXPECT_NEAR(found.rating, expected.summary.largestRating, 1e-9);
  EXPECT_NEAR(found.detectionProbability, expected.summary.detectionProbability, 1e-12);
  EXPECT_NEAR(found.largestJnd, expected.summary.largestJnd, 1e-9);
  EXPECT_EQ(found.poppingPx, expected.summary.regionPx);
  EXPECT_NEAR(found.coverage, double(found.poppingPx) / (kPredictionSize.x * kPredictionSize.y), 1e-12);
}

TEST_F(PredictionTest, AgreesWithTheTechniqueButForRoundingToCodes) {
  // Rounding moves each value by half a code at most, about 0.5 % of a bright grey's light: a contrast of
  // half to one JND at the eye's best frequency, less at a pixel's. Ratings of some 3 move by little.
  for (const bool dynamic : {false, true}) {
    Stimulus stimulus = patchStimulus();
    stimulus.presentation = dynamic ? Presentation::Dynamic : Presentation::Static;
    const PredictedPopping found = Predictor(context(), kPredictionSize, studyDisplay()).predict(stimulus);
    const std::map<std::string, double> expected = technique(stimulus, dynamic ? "dynamic" : "static");
    EXPECT_NEAR(found.rating, expected.at("rating"), 0.1) << dynamic;
    EXPECT_NEAR(found.detectionProbability, expected.at("detection_probability"), 0.05);
    EXPECT_NEAR(found.coverageOfObject, expected.at("coverage_of_object"), 0.05);
    EXPECT_NEAR(found.largestDe94, expected.at("max_de94"), 1.5);
  }
}

TEST_F(PredictionTest, ACatchIsReportedAtTheGuessRate) {
  Stimulus stimulus = patchStimulus();
  stimulus.changes = false;
  const PredictedPopping found = Predictor(context(), kPredictionSize, studyDisplay()).predict(stimulus);
  EXPECT_TRUE(found.regions.empty());
  EXPECT_DOUBLE_EQ(found.detectionProbability, 0.0446);
  EXPECT_TRUE(std::isfinite(found.rating));
}

TEST_F(PredictionTest, TheRegionAtTheCueIsThePredictionAndTheRestASecondFigure) {
  Stimulus stimulus = patchStimulus();
  stimulus.presentation = Presentation::Static;
  Predictor predictor(context(), kPredictionSize, studyDisplay());
  const PredictedPopping uncued = predictor.predict(stimulus);
  ASSERT_GT(uncued.regions.size(), 0U);
  EXPECT_FALSE(uncued.restRating.has_value());
  EXPECT_TRUE(uncued.popsAtCue());
  const PredictedPopping::Region& highest = uncued.regions.front();

  // Everything lies within a circle around the window.
  stimulus.cue = {Cue::Kind::Circle, 48.0, 36.0, 100.0, 1.0};
  const PredictedPopping around = predictor.predict(stimulus);
  EXPECT_EQ(around.rating, uncued.rating);
  EXPECT_LT(*around.restRating, uncued.regions.back().rating);
  EXPECT_EQ(*around.restDetectionProbability, 0.0446);

  // Nothing within a circle that holds no pixel centre: what is left is all of it.
  stimulus.cue = {Cue::Kind::Circle, 0.0, 0.0, 0.5, 1.0};
  const PredictedPopping corner = predictor.predict(stimulus);
  EXPECT_FALSE(corner.popsAtCue());
  EXPECT_EQ(corner.detectionProbability, 0.0446);
  EXPECT_LT(corner.rating, uncued.regions.back().rating);
  EXPECT_EQ(*corner.restRating, uncued.rating);
  EXPECT_EQ(*corner.restDetectionProbability, uncued.detectionProbability);
  EXPECT_EQ(corner.regions.size(), uncued.regions.size());
  EXPECT_EQ(corner.coverage, uncued.coverage);

  // Wherever it points, the higher of both is the highest of all, and only regions that come near the cue are
  // asked about.
  for (const glm::dvec2 at : {glm::dvec2(48, 36), glm::dvec2(30, 20), glm::dvec2(70, 50)}) {
    stimulus.cue = {Cue::Kind::Circle, at.x, at.y, 4.0, 1.0};
    const PredictedPopping one = predictor.predict(stimulus);
    EXPECT_EQ(std::max(one.rating, *one.restRating), highest.rating);
    for (const PredictedPopping::Region& region : one.regions) {
      const glm::dvec2 nearest = glm::clamp(at, glm::dvec2(region.leastPx), glm::dvec2(region.mostPx) + 1.0);
      if (!region.atCue) continue;
      EXPECT_LE(glm::distance(nearest, at), 4.0);
    }
  }
}

TEST_F(PredictionTest, ACueIsFollowedToTheFrameOfTheChange) {
  // The renderer's own displacement of the pixel where the cue is found leads back to the cue.
  Stimulus stimulus = patchStimulus();
  stimulus.scene = sceneEntry("lod/patch", {{"distance", 4.0}, {"motion.speed", 10.0}});
  stimulus.cue = {Cue::Kind::Arrow, 57.5, 41.5, 50.0, 1.0};
  const Timeline timeline = timelineOf(stimulus, 60.0);
  const frame::SceneOnGpu onGpu(scene::buildScene(stimulus.scene.name, stimulus.scene.values));
  frame::Frame frame(context(), onGpu, kPredictionSize, timeline.changeSceneTimeS);
  const auto place = cuedPlace(frame, stimulus, timeline, studyDisplay());
  ASSERT_TRUE(place.has_value());
  EXPECT_EQ(frame.timeS(), timeline.changeSceneTimeS);
  EXPECT_DOUBLE_EQ(place->radiusPx, studyDisplay().pixelsPerDegree());
  EXPECT_GT(glm::distance(place->centrePx, {57.5, 41.5}), 2.0);
  frame.begin();
  const Image moved =
      frame.get<frame::Motion>(frame::MotionSetting{timeline.changeSceneTimeS - timeline.sceneTimeS(0)})
          .displacement()
          .read();
  frame.end();
  // Displacements of the four pixels around the place; they change by 0.03 px from one to the next.
  const glm::dvec2 corner = glm::floor(place->centrePx - 0.5), t = place->centrePx - 0.5 - corner;
  const glm::ivec2 at(corner);
  for (int c = 0; c < 2; ++c) {
    const double above = glm::mix(moved.at(at.x, at.y, c), moved.at(at.x + 1, at.y, c), float(t.x));
    const double below = glm::mix(moved.at(at.x, at.y + 1, c), moved.at(at.x + 1, at.y + 1, c), float(t.x));
    EXPECT_NEAR(place->centrePx[c] - glm::mix(above, below, t.y), c == 0 ? 57.5 : 41.5, 0.01);
  }

  stimulus.presentation = Presentation::Static;
  const auto still = cuedPlace(frame, stimulus, timelineOf(stimulus, 60.0), studyDisplay());
  EXPECT_EQ(still->centrePx, glm::dvec2(57.5, 41.5));
  stimulus.cue.kind = Cue::Kind::None;
  EXPECT_FALSE(cuedPlace(frame, stimulus, timeline, studyDisplay()).has_value());
}

TEST_F(PredictionTest, ATechniquesChangeIsPredictedToo) {
  Stimulus stimulus;
  stimulus.scene = sceneEntry("sphere_grid", {});
  stimulus.before = techniqueEntry("soft_shadows/hard");
  stimulus.after = techniqueEntry("soft_shadows/pcf", {});
  stimulus.durationS = 0.2;
  stimulus.changeAtS = 0.1;
  Predictor predictor(context(), kPredictionSize, studyDisplay());
  const PredictedPopping changed = predictor.predict(stimulus);
  EXPECT_GT(changed.largestJnd, 0.0);
  EXPECT_EQ(changed.coverage, changed.coverageOfObject);
  stimulus.after = stimulus.before;
  const PredictedPopping same = predictor.predict(stimulus);
  EXPECT_EQ(same.largestJnd, 0.0);
  EXPECT_TRUE(same.regions.empty());
}

TEST_F(PredictionTest, CacheKeepsWhatWasFoundAndTellsStimuliApart) {
  const std::string file = (std::filesystem::path(testing::TempDir()) /
                            ("limen_predictions_" + std::to_string(getpid()) + ".json"))
                               .string();
  std::filesystem::remove(file);
  Stimulus stimulus = patchStimulus();
  stimulus.presentation = Presentation::Static;
  PredictedPopping first;
  std::string key;
  {
    PredictionCache cache(file);
    Predictor predictor(context(), kPredictionSize, studyDisplay(), {}, &cache);
    first = predictor.predict(stimulus);
    key = predictor.key(stimulus);
    Stimulus other = stimulus;
    other.showings = 3;  // shows the same change
    EXPECT_EQ(predictor.key(other), key);
    other.cue.durationS = 2.0;
    EXPECT_EQ(predictor.key(other), key);
    other.cue.kind = Cue::Kind::Arrow;
    EXPECT_NE(predictor.key(other), key);
    other.levels->before = 2;
    EXPECT_NE(predictor.key(other), key);
    EXPECT_NE(Predictor(context(), kPredictionSize + 1, studyDisplay()).key(stimulus), key);
    perception::DisplayProfile nearer = studyDisplay();
    nearer.distanceM = 0.5;
    EXPECT_NE(Predictor(context(), kPredictionSize, nearer).key(stimulus), key);
    EXPECT_NE(Predictor(context(), kPredictionSize, studyDisplay(),
                        ParameterValues(perception::PoppingSettings::table().parameters(),
                                        {{"flicker", "ignored"}}))
                  .key(stimulus),
              key);
  }
  PredictionCache again(file);
  ASSERT_TRUE(again.find(key).has_value());
  EXPECT_EQ(*again.find(key), first);
  EXPECT_EQ(Predictor(context(), kPredictionSize, studyDisplay(), {}, &again).predict(stimulus), first);
  std::ofstream(file) << "{}";
  EXPECT_THROW(PredictionCache{file}, Error);
  std::filesystem::remove(file);
}

class PreparedStimulusTest : public gl::GlTest {
 protected:
  static Image layer(const gl::Texture& layers, int number) {
    const glm::ivec2 size = layers.sizePx();
    Image out(size.x, size.y, 4);
    glGetTextureSubImage(layers.id(), 0, 0, 0, number, size.x, size.y, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(out.data.size() * sizeof(float)), out.data.data());
    return out;
  }
};

TEST_F(PreparedStimulusTest, LayersAreTheFramesWhetherAheadOrLive) {
  const Stimulus stimulus = patchStimulus();
  StimulusRenderer direct(context(), stimulus, kPredictionSize, studyDisplay());
  const int64_t needed = int64_t{12} * kPredictionSize.x * kPredictionSize.y * 4;
  for (const int64_t budget : {needed, needed - 1}) {
    int told = 0;
    PreparedStimulus prepared(
        std::make_unique<StimulusRenderer>(context(), stimulus, kPredictionSize, studyDisplay()), budget,
        [&](int, int all) { told += all == 12 ? 1 : 100; });
    EXPECT_EQ(prepared.ahead(), budget == needed);
    EXPECT_EQ(prepared.warning().empty(), prepared.ahead());
    EXPECT_LE(prepared.bytes(), budget);
    EXPECT_EQ(told, prepared.ahead() ? 12 : 0);
    for (const int frame : {0, 5, 6, 11}) {
      const int at = prepared.picture(frame);
      EXPECT_EQ(layer(prepared.layers(), at).data, direct.render(frame).read().data) << frame;
    }
  }
}

TEST_F(PreparedStimulusTest, AStaticSequenceTakesTwoLayers) {
  Stimulus stimulus = patchStimulus();
  stimulus.presentation = Presentation::Static;
  PreparedStimulus prepared(
      std::make_unique<StimulusRenderer>(context(), stimulus, kPredictionSize, studyDisplay()),
      pictureBudgetBytes());
  EXPECT_EQ(prepared.layerOfFrame(), (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(prepared.bytes(), int64_t{2} * kPredictionSize.x * kPredictionSize.y * 4);
}

}  // namespace
}  // namespace limen::study
