// SPDX-License-Identifier: BSD-3-Clause
// limen study export --clips on a small protocol, and scores of these clips in limen analyse validate.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/base/image.h"
#include "experiments/base/video.h"
#include "experiments/store/predictions.h"
#include "perception/vision/display.h"
#include "study/stimulus/stimulus_renderer.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/run_program.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;

class ClipsCommand : public gl::GlTest {
 protected:
  ClipsCommand() : folder_(fs::temp_directory_path() / ("limen_clips_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ClipsCommand() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ / name; }
  /// Rows of a table without quotes, the header first.
  std::vector<std::vector<std::string>> rows(const std::string& name) const {
    std::ifstream in(path(name));
    std::vector<std::vector<std::string>> out;
    for (std::string line; std::getline(in, line);) {
      std::istringstream cells(line);
      out.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) out.back().push_back(cell);
    }
    return out;
  }

 private:
  fs::path folder_;
};

TEST_F(ClipsCommand, WritesWhatWasSeenAndTakesScoresOfIt) {
  const std::string store = path("s.sqlite");
  ASSERT_EQ(runProgram("limen-study simulate quick --observers 1 --seed 2 --quiet --store " + store).code, 0);
  const ProgramRun exported = runProgram("limen-study export " + store + " -o " + path("out") +
                                         " --clips --clip-format .avi --clip-format .exr");
  ASSERT_EQ(exported.code, 0) << exported.text;

  // Each stimulus of each trial, under the name that the store gives it.
  std::map<std::string, nlohmann::json> shown;
  size_t intervals = 0, changes = 0;
  const perception::DisplayProfile display = perception::displayPreset("desktop_24");
  for (const store::StudySession& session : store::readSessions(store))
    for (const store::StudyTrial& trial : store::readTrials(store, session.id))
      for (size_t i = 0; i < trial.stimuli.size(); ++i, ++intervals)
        shown[store::clipName(trial.stimulusHashes[i], display.hash(), 320, 240)] = trial.stimuli[i];
  const auto clips = rows("out/clips/clips.csv"), trials = rows("out/clips/clip_trials.csv");
  ASSERT_EQ(clips.size(), shown.size() + 1);
  EXPECT_EQ(trials.size(), intervals + 1);
  for (size_t row = 1; row < trials.size(); ++row) EXPECT_EQ(shown.count(trials[row].back()), 1U);

  std::ofstream scores(path("scores.csv"));
  scores << "clip,mine\n";
  for (size_t row = 1; row < clips.size(); ++row) {
    const std::string& name = clips[row][0];
    scores << name << "," << row << "\n";
    ASSERT_EQ(shown.count(name), 1U);
    StimulusRenderer renderer(context(), stimulusFromJson(shown[name]), {320, 240}, display);
    const Timeline& timeline = renderer.timeline();
    EXPECT_EQ(VideoReader(path("out/clips/" + name + ".avi")).facts().frames, timeline.frames);
    const auto expectLight = [&](const std::string& folder, int frame, const Image& codes) {
      char file[32];
      std::snprintf(file, sizeof file, "/frame_%04d.exr", frame);
      const Image light = readImage(path("out/clips/" + folder + file));
      ASSERT_EQ(light.data.size(), codes.data.size());
      for (size_t i = 0; i < light.data.size(); ++i)
        ASSERT_NEAR(light.data[i], display.decode(codes.data[i]), 1e-6) << folder << " " << frame;
    };
    expectLight(name, 0, renderer.readBack(0));
    const bool change = timeline.changed < timeline.frames;
    EXPECT_EQ(fs::exists(path("out/clips/" + name + "_reference.avi")), change);
    if (!change) continue;
    ++changes;
    expectLight(name, timeline.changed, renderer.readBack(timeline.changed));
    expectLight(name + "_reference", timeline.changed,
                renderer.readBackState(timeline.sceneTimeS(timeline.changed), false));
  }
  EXPECT_EQ(changes, 2U);  // two distances
  scores.close();
  const ProgramRun validated =
      runProgram("limen-analyse validate " + store + " --samples 0 --scores " + path("scores.csv"));
  EXPECT_EQ(validated.code, 0) << validated.text;
  EXPECT_NE(validated.text.find("mine"), std::string::npos) << validated.text;
}

}  // namespace
}  // namespace limen::study
