// SPDX-License-Identifier: BSD-3-Clause
// What answers a question, and what does not.
#include <csignal>
#include <fstream>
#include <sstream>

#include "experiments/base/image.h"
#include "tests/study/application/session_at_window.h"

namespace limen {
namespace {

/// Of a button's face, which a highlight brightens.
float brightnessAt(const Image& image, int x, int y) { return image.at(x, y, 1); }

TEST_F(SessionAtWindow, APointerThatHappensToRestOnAnAnswerSuggestsAndAnswersNothing) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments({"--screenshots", path("shots")}), path("messages"));
  ASSERT_TRUE(startsPractice(run));
  ASSERT_TRUE(run.reaches("stimulus"));
  run.act({"mousemove", "420", "270"});  // where "no" will be
  ASSERT_TRUE(run.reaches("question"));
  run.act({"click", "1"});
  run.act({"mousemove", "220", "270", "click", "1"});
  ASSERT_TRUE(run.reaches("stimulus"));
  run.signal(SIGTERM);
  run.finish();
  EXPECT_EQ(column("SELECT answer FROM response"), std::vector<std::string>{"yes"})
      << "the first click counted";
  bool seen = false;
  for (const fs::directory_entry& entry : fs::directory_iterator(path("shots"))) {
    if (entry.path().filename().string().find("_question_1") == std::string::npos) continue;
    seen = true;
    const Image image = readImage(entry.path().string());
    // Inside the buttons, beside their lettering.
    EXPECT_EQ(brightnessAt(image, 240, 250), brightnessAt(image, 400, 250));
    EXPECT_NE(brightnessAt(image, 240, 250), brightnessAt(image, 10, 10)) << "no button there";
  }
  EXPECT_TRUE(seen);
}

TEST_F(SessionAtWindow, AnswersStandOnTheSidesThatTheProtocolDeclares) {
  std::ostringstream text;
  text << std::ifstream(path("quick.yaml")).rdbuf();
  std::string protocol = text.str();
  const std::string task = "task: {type: yes_no,";
  protocol.replace(protocol.find(task), task.size(), task + " answer_sides: reversed,");
  std::ofstream(path("quick.yaml")) << protocol << "\nwords: german\n";
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments({"--screenshots", path("shots")}), path("messages"));
  // In this small window German instructions take more than one page.
  std::string screen;
  while ((screen = run.line()) != "screen: question") {
    ASSERT_NE(screen, "");
    if (screen != "screen: stimulus") run.key(screen == "screen: consent" ? "y" : "space");
  }
  run.act({"mousemove", "420", "270", "click", "1"});
  ASSERT_TRUE(run.reaches("question"));
  run.key("Left");
  ASSERT_TRUE(run.reaches("practice_result"));
  run.signal(SIGTERM);
  run.finish();
  // On the right is yes, which German participants read as "ja".
  EXPECT_EQ(column("SELECT answer FROM response ORDER BY event"), (std::vector<std::string>{"yes", "no"}));
  EXPECT_EQ(column("SELECT json_extract(data, '$.answers_from_the_left.main') FROM event WHERE number = 0"),
            std::vector<std::string>{"[\"no\",\"yes\"]"});
  EXPECT_EQ(column("SELECT json_extract(facts, '$.front_end.language') FROM environment"),
            std::vector<std::string>{"Deutsch"});
}

TEST_F(SessionAtWindow, KeysBeforeTheQuestionAreLoggedAndAnswerNothing) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments(), path("messages"));
  ASSERT_TRUE(startsPractice(run));
  ASSERT_TRUE(run.reaches("stimulus"));
  run.key("y");
  ASSERT_TRUE(run.reaches("question"));
  // The buttons stand in the middle; the right one is "no".
  run.act({"mousemove", "420", "270", "click", "1"});
  ASSERT_TRUE(run.reaches("stimulus"));
  run.signal(SIGTERM);
  EXPECT_EQ(run.finish(), 128 + SIGTERM) << run.messages();
  EXPECT_EQ(column("SELECT answer FROM response"), std::vector<std::string>{"no"});
  EXPECT_EQ(column("SELECT device FROM response"), std::vector<std::string>{"mouse"});
  EXPECT_EQ(column("SELECT json_extract(extra, '$.early_inputs[0].key') FROM response"),
            std::vector<std::string>{"y"});
  EXPECT_EQ(column("SELECT state FROM session"), std::vector<std::string>{"paused"});
}

TEST_F(SessionAtWindow, WhatIsTypedEarlyIsNotStored) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments(), path("messages"));
  ASSERT_TRUE(startsPractice(run));
  ASSERT_TRUE(run.reaches("stimulus"));
  for (const char* key : {"s", "m", "1", "t", "h"}) run.key(key);
  ASSERT_TRUE(run.reaches("question"));
  run.key("n");
  ASSERT_TRUE(run.reaches("stimulus"));
  run.signal(SIGTERM);
  run.finish();
  const std::vector<std::string> extras = column("SELECT extra FROM response");
  ASSERT_EQ(extras.size(), 1u);
  const std::vector<std::string> keys =
      column("SELECT json_extract(value, '$.key') FROM response, json_each(extra, '$.early_inputs')");
  EXPECT_EQ(keys, (std::vector<std::string>{"other", "other", "1", "other", "other"}));
  // Nor in the log of events.
  EXPECT_EQ(
      column("SELECT count(*) FROM event WHERE data LIKE '%\"key\":\"s\"%' OR data LIKE '%\"key\":\"m\"%' OR "
             "data LIKE '%\"key\":\"h\"%'"),
      std::vector<std::string>{"0"});
  EXPECT_EQ(fs::status(path("s.sqlite")).permissions() & (fs::perms::group_all | fs::perms::others_all),
            fs::perms::none);
}

}  // namespace
}  // namespace limen
