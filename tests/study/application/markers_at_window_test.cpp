// SPDX-License-Identifier: BSD-3-Clause
// What a recorder is told of a session.
#include "tests/study/application/session_at_window.h"
#include "tests/study/presentation/pseudo_terminal.h"

namespace limen {
namespace {

using testing::HasSubstr;

TEST_F(SessionAtWindow, ARecorderGetsEveryMarkerAndTheStoreKnowsWhen) {
  const test::XServer server(640, 480);
  test::PseudoTerminal recorder;
  test::StudyRun run(server.display(), arguments({"--markers", "serial:" + recorder.device()}),
                     path("messages"));
  answerAll(run);
  ASSERT_EQ(run.finish(), 0) << run.messages();
  const std::string all =
      "FROM event, json_each(event.data, '$.markers') AS marker WHERE kind = 'answered' ORDER BY number, "
      "marker.key";
  const auto stored = [&](const std::string& what) {
    std::vector<int64_t> out;
    for (const std::string& text : column("SELECT json_extract(marker.value, '$." + what + "') " + all))
      out.push_back(std::stoll(text));
    return out;
  };
  const std::vector<int64_t> codes = stored("code"), sent = stored("sent_ns"), due = stored("due_ns");
  // In each of 8 trials: stimulus, its end, question, answer; a change in those that have one.
  const size_t changes = std::stoul(column("SELECT count(*) FROM trial WHERE change = 1").at(0));
  ASSERT_EQ(codes.size(), 8 * 4 + changes);
  ASSERT_TRUE(recorder.waitFor(codes.size()));
  const auto received = recorder.received();
  ASSERT_EQ(received.size(), codes.size());
  for (size_t i = 0; i < codes.size(); ++i) {
    EXPECT_EQ(received[i].first, codes[i]) << i;
    EXPECT_GE(sent[i], due[i]);
    // The listener is another thread of this machine, which has two processors and much to do.
    EXPECT_NEAR(static_cast<double>(received[i].second - sent[i]) * 1e-9, 0.0, 0.25) << i;
  }
  // A stimulus's marker carries the time of its first frame, the question's and the answer's those of the
  // answer.
  const std::string ofKind =
      "SELECT json_extract(marker.value, '$.due_ns') FROM event, "
      "json_each(event.data, '$.markers') AS marker WHERE kind = 'answered' AND "
      "json_extract(marker.value, '$.marker') = ";
  EXPECT_EQ(column(ofKind + "'stimulus' ORDER BY number"),
            column("SELECT min(swap_ns) FROM frame_log GROUP BY trial ORDER BY trial"));
  EXPECT_EQ(column(ofKind + "'question' ORDER BY number"),
            column("SELECT question_ns FROM response ORDER BY event"));
  EXPECT_EQ(column(ofKind + "'answer' ORDER BY number"),
            column("SELECT answered_ns FROM response ORDER BY event"));
  EXPECT_EQ(column("SELECT json_extract(facts, '$.front_end.markers.codes.change') FROM environment"),
            std::vector<std::string>{"2"});
}

TEST_F(SessionAtWindow, AMarkerPortThatDoesNotWorkIsNamedBeforeTheSession) {
  const test::XServer server(640, 480);
  test::StudyRun run(server.display(), arguments({"--markers", "serial:/dev/no_such_tty"}), path("messages"));
  EXPECT_EQ(run.finish(), 2);
  EXPECT_THAT(run.messages(), HasSubstr("/dev/no_such_tty"));
  EXPECT_FALSE(fs::exists(path("s.sqlite")));
}

TEST_F(SessionAtWindow, ARecorderThatIsUnpluggedStopsTheSession) {
  const test::XServer server(640, 480);
  test::PseudoTerminal recorder;
  test::StudyRun run(server.display(), arguments({"--markers", "serial:" + recorder.device()}),
                     path("messages"));
  ASSERT_TRUE(startsPractice(run, [&] { recorder.hangUp(); }));
  EXPECT_EQ(run.finish(), 1);
  EXPECT_THAT(run.rest(), testing::AllOf(HasSubstr(recorder.device()), HasSubstr("--resume")));
  EXPECT_EQ(column("SELECT state FROM session"), std::vector<std::string>{"paused"});
}

}  // namespace
}  // namespace limen
