// SPDX-License-Identifier: BSD-3-Clause
// Whole sessions at a real window, under a virtual display, with keys and mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "experiments/base/image.h"
#include "study/session/session_seed.h"
#include "tests/study/application/session_at_window.h"

namespace limen {
namespace {

using testing::HasSubstr;

TEST_F(SessionAtWindow, StoresTheAnswersThatWereGivenInTheirOrder) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments({"--full-screen", "--screenshots", path("shots")}),
                     path("messages"));
  const std::vector<std::string> meant = answerAll(run);
  EXPECT_EQ(run.finish(), 0) << run.messages();
  // Two of practice, then 2 distances x (2 with a change + 1 without).
  EXPECT_EQ(meant.size(), 8u);
  EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), meant);
  EXPECT_EQ(column("SELECT DISTINCT device FROM response"), std::vector<std::string>{"keyboard"});
  EXPECT_EQ(column("SELECT count(*) FROM response WHERE reaction_time_s < 0"), std::vector<std::string>{"0"});
  EXPECT_EQ(column("SELECT state FROM session"), std::vector<std::string>{"finished"});
  // 30 frames of half a second at 60 Hz in each of the 8 trials.
  EXPECT_EQ(column("SELECT count(*) FROM frame_log"), std::vector<std::string>{"240"});
  EXPECT_THAT(run.messages(), HasSubstr("timing is not fit for a lab"));
  EXPECT_EQ(column("SELECT json_extract(facts, '$.front_end.lab_ready') FROM environment"),
            std::vector<std::string>{"0"});

  std::map<std::string, int> shots;
  for (const fs::directory_entry& entry : fs::directory_iterator(path("shots"))) {
    const Image image = readImage(entry.path().string());
    const auto [least, most] = std::minmax_element(image.data.begin(), image.data.end());
    EXPECT_GT(*most - *least, 0.2F) << entry.path() << " is blank";
    const std::string name = entry.path().filename().string();
    ++shots[name.substr(5, name.rfind('_') - 5)];
  }
  for (const char* name :
       {"consent", "instructions", "practice_start", "practice_result", "block_start", "debrief"})
    EXPECT_GE(shots[name], 1) << name;
  EXPECT_EQ(shots["question"], 8);
  EXPECT_EQ(shots["stimulus"], 8);
  EXPECT_EQ(shots["feedback"], 2) << "in practice only";
}

TEST_F(SessionAtWindow, PausedInTheMiddleAndTakenUpAgain) {
  const test::XServer server(640, 480);
  std::vector<std::string> meant;
  {
    test::StudyRun run(server.display(), arguments(), path("messages"));
    ASSERT_TRUE(startsPractice(run));
    ASSERT_TRUE(run.reaches("question"));
    run.key("y");
    ASSERT_TRUE(run.reaches("question"));
    run.key("Escape");
    ASSERT_TRUE(run.reaches("pause"));
    run.key("space");  // goes on: the trial is shown again
    ASSERT_TRUE(run.reaches("question"));
    run.key("n");
    ASSERT_TRUE(run.reaches("practice_result"));
    run.key("Escape");
    ASSERT_TRUE(run.reaches("pause"));
    run.key("s");
    ASSERT_TRUE(run.reaches("pause_stop"));
    run.key("l");
    EXPECT_EQ(run.finish(), 1);
    EXPECT_THAT(run.rest(), HasSubstr("--resume"));
  }
  EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), (std::vector<std::string>{"yes", "no"}));
  EXPECT_EQ(column("SELECT reason FROM trial WHERE valid = 0"),
            std::vector<std::string>{"paused in the middle"});
  EXPECT_EQ(column("SELECT state FROM session"), std::vector<std::string>{"paused"});
  test::StudyRun run(server.display(), arguments({"--resume"}), path("messages"));
  const std::vector<std::string> later = answerAll(run, 2);
  EXPECT_EQ(run.finish(), 0) << run.messages();
  EXPECT_EQ(later.size(), 6u);
  std::vector<std::string> all = {"yes", "no"};
  all.insert(all.end(), later.begin(), later.end());
  EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), all);
}

TEST_F(SessionAtWindow, StimuliAreSeenBesideTheExperimentersWindow) {
  const test::XServer server(1500, 800);
  for (const char* folder : {"alone", "beside"}) {
    std::vector<std::string> more = {"--screenshots", path(folder)};
    if (std::string(folder) == "beside") more.push_back("--experimenter-window");
    fs::remove(path("s.sqlite"));
    test::StudyRun run(server.display(), arguments(more), path("messages"));
    const std::vector<std::string> meant = answerAll(run);
    EXPECT_EQ(run.finish(), 0) << run.messages();
    EXPECT_EQ(meant.size(), 8u) << folder;
    EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), meant) << folder;
  }
  const auto stimuli = [this](const std::string& folder) {
    std::map<std::string, std::string> out;
    for (const fs::directory_entry& entry : fs::directory_iterator(path(folder))) {
      const std::string name = entry.path().filename().string();
      if (name.find("stimulus") != std::string::npos)
        out[name.substr(name.find("stimulus"))] = entry.path().string();
    }
    return out;
  };
  const auto alone = stimuli("alone"), beside = stimuli("beside");
  ASSERT_EQ(alone.size(), 8u);
  ASSERT_EQ(beside.size(), 8u);
  for (const auto& [name, file] : alone)
    EXPECT_EQ(readImage(beside.at(name)).data, readImage(file).data) << name;
}

TEST_F(SessionAtWindow, DecliningEndsItAndKeepsNoAnswers) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments(), path("messages"));
  ASSERT_TRUE(run.reaches("consent"));
  run.key("n");
  ASSERT_TRUE(run.reaches("consent_declined"));
  run.key("e");
  EXPECT_EQ(run.finish(), 1);
  EXPECT_EQ(column("SELECT state FROM session"), std::vector<std::string>{"aborted"});
  EXPECT_EQ(column("SELECT count(*) FROM trial"), std::vector<std::string>{"0"});
}

// A seed made of the code would tell it to whoever tries all codes.
TEST_F(SessionAtWindow, TheSeedIsRandomUnlessItIsGiven) {
  const test::XServer server(640, 480);
  std::vector<std::string> words = arguments();
  words.erase(std::find(words.begin(), words.end(), "--seed"),
              std::find(words.begin(), words.end(), "--announce"));
  test::StudyRun run(server.display(), words, path("messages"));
  ASSERT_TRUE(run.reaches("consent"));
  run.key("n");
  ASSERT_TRUE(run.reaches("consent_declined"));
  run.key("e");
  EXPECT_EQ(run.finish(), 1);
  const std::string name = column("SELECT name FROM session").at(0),
                    seed = column("SELECT seed FROM session").at(0);
  EXPECT_NE(seed, std::to_string(
                      study::formerSessionSeed(column("SELECT protocol FROM session").at(0), "p01", name)));
  EXPECT_NE(seed, "1");
  EXPECT_NE(seed, "0");
}

TEST_F(SessionAtWindow, DisplayTakenAwayLosesNothing) {
  test::XServer server(640, 480);
  {
    test::StudyRun run(server.display(), arguments(), path("messages"));
    ASSERT_TRUE(startsPractice(run));
    ASSERT_TRUE(run.reaches("question"));
    run.key("y");
    ASSERT_TRUE(run.reaches("stimulus"));
    server.stop();
    EXPECT_EQ(run.finish(), 1) << "the window library ends the process";
  }
  EXPECT_EQ(column("SELECT answer FROM response"), std::vector<std::string>{"yes"});
  const test::XServer other(640, 480);
  test::StudyRun run(other.display(), arguments({"--resume"}), path("messages"));
  ASSERT_TRUE(run.reaches("question")) << run.messages();
  run.key("n");
  ASSERT_TRUE(run.reaches("practice_result")) << "the second round of practice, not the first one again";
  run.signal(SIGTERM);
  run.finish();
  EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), (std::vector<std::string>{"yes", "no"}));
}

TEST_F(SessionAtWindow, SaysWhatItNeedsWithoutAWindowSystem) {
  test::StudyRun run("", arguments(), path("messages"));
  EXPECT_EQ(run.finish(), 2);
  EXPECT_THAT(run.messages(), HasSubstr("no window system"));
  EXPECT_THAT(run.messages(), HasSubstr("limen study simulate"));
  EXPECT_FALSE(fs::exists(path("s.sqlite"))) << "nothing was begun";
}

TEST_F(SessionAtWindow, RefusesAWindowThatIsTooSmallForTheStimuli) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), {"quick", "--participant", "p01", "--window", "200x200"},
                     path("messages"));
  EXPECT_EQ(run.finish(), 2) << run.messages();
  EXPECT_FALSE(run.messages().empty());
}

}  // namespace
}  // namespace limen
