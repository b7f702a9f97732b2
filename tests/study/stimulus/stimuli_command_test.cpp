// SPDX-License-Identifier: BSD-3-Clause
// limen study stimuli: the videos are what sessions of the protocol showed.
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/base/error.h"
#include "experiments/base/video.h"
#include "experiments/store/sessions.h"
#include "perception/vision/display.h"
#include "study/stimulus/stimulus_renderer.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/run_program.h"

namespace limen::study {
namespace {

class StimuliCommand : public gl::GlTest {
 protected:
  StimuliCommand()
      : folder_(std::filesystem::temp_directory_path() / ("limen_stimuli_" + std::to_string(getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~StimuliCommand() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// Values that are not the same of 256 codes; the images divide them by 255 in different ways.
int64_t differingCodes(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  int64_t count = 0;
  for (size_t i = 0; i < std::min(a.data.size(), b.data.size()); ++i)
    count += std::lround(255.0F * a.data[i]) != std::lround(255.0F * b.data[i]);
  return count;
}

TEST_F(StimuliCommand, VideosHoldTheFramesThatSessionsShow) {
  const ProgramRun run = runProgram("limen-study stimuli quick --format .mkv -o " + path("videos"));
  if (run.code == 2 && run.text.find("behind OpenCV") != std::string::npos)
    GTEST_SKIP() << "FFV1 needs FFmpeg behind OpenCV";
  ASSERT_EQ(run.code, 0) << run.text;
  ASSERT_EQ(
      runProgram("limen-study simulate quick --observers 2 --seed 2 --quiet --store " + path("s.sqlite"))
          .code,
      0);
  std::map<std::string, Stimulus> shown;
  for (const store::StudySession& session : store::readSessions(path("s.sqlite")))
    for (const store::StudyTrial& trial : store::readTrials(path("s.sqlite"), session.id))
      for (size_t i = 0; i < trial.stimuli.size(); ++i)
        shown.emplace(trial.stimulusHashes.at(i), stimulusFromJson(trial.stimuli.at(i)));

  const perception::DisplayProfile display = perception::displayPreset("desktop_24");
  std::ifstream table(path("videos/stimuli.csv"));
  std::string line;
  std::getline(table, line);
  size_t rows = 0;
  for (; std::getline(table, line); ++rows) {
    std::istringstream fields(line);
    std::string file, hash;
    std::getline(fields, file, ',');
    std::getline(fields, hash, ',');
    ASSERT_EQ(shown.count(hash), 1U) << line;
    StimulusRenderer renderer(context(), shown.at(hash), {320, 240}, display);
    VideoReader video(path("videos/" + file));
    ASSERT_EQ(video.facts().frames, renderer.frameCount());
    EXPECT_EQ(video.facts().framesPerSecond, display.refreshHz);
    // The first, the last before the change, the first after it, the last.
    const int changed = renderer.timeline().changed;
    for (const int frame : {0, changed - 1, changed, renderer.frameCount() - 1}) {
      if (frame < 0 || frame >= renderer.frameCount()) continue;
      EXPECT_EQ(differingCodes(video.frame(frame), renderer.readBack(frame)), 0)
          << file << ", frame " << frame;
    }
  }
  EXPECT_EQ(rows, shown.size());
}

TEST_F(StimuliCommand, RefusesWhatItCannotShow) {
  const ProgramRun unknown = runProgram("limen-study stimuli quick --format .gif -o " + path("a"));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.text, testing::HasSubstr("--format"));
  EXPECT_FALSE(std::filesystem::exists(path("a")));
}

}  // namespace
}  // namespace limen::study
