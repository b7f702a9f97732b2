// SPDX-License-Identifier: BSD-3-Clause
// limen study predict on a small protocol, and what the analysis makes of it.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/store/predictions.h"
#include "perception/vision/display.h"
#include "study/stimulus/prediction.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/run_program.h"

namespace limen::study {
namespace {

using nlohmann::json;

class PredictCommand : public gl::GlTest {
 protected:
  PredictCommand()
      : folder_(std::filesystem::temp_directory_path() / ("limen_predict_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~PredictCommand() override { std::filesystem::remove_all(folder_); }
  std::string store() const { return folder_ / "s.sqlite"; }

 private:
  std::filesystem::path folder_;
};

TEST_F(PredictCommand, PredictsWhatWasShownOnce) {
  ASSERT_EQ(runProgram("limen-study simulate quick --observers 3 --seed 2 --quiet --store " + store()).code,
            0);
  const ProgramRun first = runProgram("limen-study predict --quiet --json " + store());
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_EQ(json::parse(first.text).at("made"), 2);  // two distances
  const ProgramRun second = runProgram("limen-study predict --quiet --json " + store());
  EXPECT_EQ(json::parse(second.text).at("made"), 0);
  EXPECT_EQ(json::parse(second.text).at("known"), 2);

  // The stimuli with a change, and only those, as the predictor sees them when it is asked directly.
  std::map<std::string, json> shown;
  for (const store::StudySession& session : store::readSessions(store()))
    for (const store::StudyTrial& trial : store::readTrials(store(), session.id))
      if (trial.change) shown[trial.stimulusHashes.at(0)] = trial.stimuli.at(0);
  const std::vector<store::StudyPrediction> predictions = store::readPredictions(store());
  ASSERT_EQ(predictions.size(), 2U);
  Predictor predictor(context(), {320, 240}, perception::displayPreset("desktop_24"));
  for (const store::StudyPrediction& one : predictions) {
    ASSERT_EQ(shown.count(one.stimulusHash), 1U);
    EXPECT_EQ(one.widthPx, 320);
    EXPECT_EQ(one.displayHash, perception::displayPreset("desktop_24").hash());
    const PredictedPopping popping = predictor.predict(stimulusFromJson(shown[one.stimulusHash]));
    EXPECT_DOUBLE_EQ(one.figures.at("rating").get<double>(), popping.rating);
    EXPECT_DOUBLE_EQ(one.figures.at("max_de94").get<double>(), popping.largestDe94);
    EXPECT_EQ(one.figures.at("region_count").get<size_t>(), popping.regions.size());
  }

  const ProgramRun validated = runProgram("limen-analyse validate --json " + store());
  ASSERT_EQ(validated.code, 0) << validated.text;
  const json part = json::parse(validated.text).at("sections").at(0);
  EXPECT_EQ(part.at("scenarios").size(), 2U);
}

TEST_F(PredictCommand, RefusesWhatItCannotDo) {
  const ProgramRun none = runProgram("limen-study predict " + store());
  EXPECT_EQ(none.code, 2);
  ASSERT_EQ(runProgram("limen-study simulate quick --observers 1 --quiet --store " + store()).code, 0);
  const ProgramRun protocol = runProgram("limen-study predict --protocol quik " + store());
  EXPECT_EQ(protocol.code, 2);
  EXPECT_THAT(protocol.text, testing::HasSubstr("quick"));
  const ProgramRun setting = runProgram("limen-study predict --set region_treshold_jnd=1 " + store());
  EXPECT_EQ(setting.code, 2);
  EXPECT_THAT(setting.text, testing::HasSubstr("'regions.threshold_jnd'"));
  const ProgramRun validated = runProgram("limen-analyse validate " + store());
  EXPECT_EQ(validated.code, 2);
  EXPECT_THAT(validated.text, testing::HasSubstr("limen study predict"));
}

}  // namespace
}  // namespace limen::study
