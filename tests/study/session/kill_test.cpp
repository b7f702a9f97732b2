// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "perception/psychometrics/random.h"
#include "tests/study/session/session_fixture.h"

namespace limen::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

class KillTest : public SessionStoreTest {
 protected:
  /// Starts the victim, its standard output on `pipe_`.
  pid_t start(const std::string& store, const std::string& session, const std::string& limit = {}) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    // Made before: another thread may hold the allocator's lock while the process is copied.
    const std::string program = std::string(LIMEN_BIN_DIR) + "/kill_victim", err = path("err");
    const pid_t child = fork();
    if (child == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
      if (chdir(folder_.c_str()) != 0) _exit(126);
      execl(program.c_str(), program.c_str(), store.c_str(), session.c_str(),
            limit.empty() ? nullptr : limit.c_str(), nullptr);
      _exit(127);
    }
    close(ends[1]);
    pipe_ = ends[0];
    return child;
  }
  /// Waits for so many signs of life. False: the program has ended.
  bool waitFor(uint64_t signs) const {
    char byte = 0;
    for (uint64_t i = 0; i < signs; ++i)
      if (read(pipe_, &byte, 1) != 1) return false;
    return true;
  }
  int end(pid_t child) {
    char byte = 0;
    while (read(pipe_, &byte, 1) == 1) {
    }
    close(pipe_);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  std::string said() const {
    std::ifstream file(path("err"));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  int pipe_ = -1;
};

/// What must not depend on interruptions: order, stimuli, answers and what the procedures know.
nlohmann::json essence(const store::SessionReader& reader, const store::StudySession& session) {
  nlohmann::json out = nlohmann::json::array();
  for (const store::StudyTrial& trial : reader.trials(session.id)) {
    if (trial.reason == "interrupted") continue;
    nlohmann::json entry = {trial.number, trial.block, trial.stimulusHashes, trial.procedureStimulus,
                            trial.target, trial.reason};
    if (trial.response)
      entry.insert(entry.end(), {trial.response->answer, trial.response->reactionTimeS,
                                 trial.response->severity.value_or(0)});
    out.push_back(std::move(entry));
  }
  const Verification verification = verifySession(reader, session, killedProtocol());
  EXPECT_THAT(verification.differences, IsEmpty());
  nlohmann::json state = verification.state;
  for (const char* key : {"attempts", "next_event", "block_begun_at"}) state.erase(key);
  return {out, state};
}

TEST_F(KillTest, KilledAHundredTimesASessionLosesAtMostTheTrialInProgressEachTime) {
  ASSERT_EQ(end(start(path("whole.sqlite"), "1")), 0) << said();
  nlohmann::json whole;
  {
    const store::SessionReader reader(path("whole.sqlite"));
    whole = essence(reader, reader.sessions().at(0));
    ASSERT_GT(whole[0].size(), 40U);
  }
  psychometrics::Random random(2024);
  int kills = 0, killsOfSession = 0, lost = 0;
  for (int name = 1; kills < 100; ++name) {
    const std::string session = std::to_string(name);
    killsOfSession = 0;
    while (true) {
      const pid_t victim = start(path("s.sqlite"), session);
      // From before the first event to some trials on, and then some microseconds.
      const bool alive = kills >= 100 ? (waitFor(~0ull), false) : waitFor(random.below(5));
      if (alive) {
        usleep(static_cast<useconds_t>(random.below(3000)));
        kill(victim, SIGKILL);
      }
      const int code = end(victim);
      if (code == 0) break;
      ASSERT_EQ(code, -SIGKILL) << said();
      ++kills;
      ++killsOfSession;
    }
    const store::SessionReader reader(path("s.sqlite"));
    const store::StudySession row = reader.sessions().back();
    ASSERT_EQ(row.name, session);
    EXPECT_EQ(row.state, "finished");
    int interrupted = 0;
    for (const store::StudyTrial& trial : reader.trials(row.id))
      interrupted += trial.reason == "interrupted" ? 1 : 0;
    EXPECT_LE(interrupted, killsOfSession);
    lost += interrupted;
    EXPECT_EQ(essence(reader, row), whole)
        << "session " << session << " after " << killsOfSession << " kills";
  }
  EXPECT_GT(lost, 10);  // the kills did meet trials on the screen
}

TEST_F(KillTest, AFullDiskGivesOneMessageAndWhatWasStoredStays) {
  // The system refuses to let any file grow beyond this: the store's write-ahead log meets it in mid-session.
  const pid_t victim = start(path("s.sqlite"), "1", "700000");
  const int code = end(victim);
  EXPECT_EQ(code, 2);
  EXPECT_THAT(said(), AllOf(HasSubstr(path("s.sqlite")), HasSubstr("finished work is kept")));
  const std::string message = said();
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  size_t before = 0;
  {
    const store::SessionReader reader(path("s.sqlite"));
    before = reader.trials(1).size();
    EXPECT_GT(before, 0U);
    EXPECT_THAT(verify(killedProtocol()), IsEmpty());
  }
  EXPECT_EQ(end(start(path("s.sqlite"), "1")), 0) << said();
  const store::SessionReader reader(path("s.sqlite"));
  EXPECT_GT(reader.trials(1).size(), before);
  EXPECT_EQ(reader.sessions()[0].state, "finished");
  EXPECT_THAT(verify(killedProtocol()), IsEmpty());
}

TEST_F(KillTest, AFolderThatCannotBeWrittenIsNamed) {
  std::ofstream(path("as_nobody"));
  std::ofstream(path("err"));
  std::filesystem::create_directory(path("closed"));
  std::filesystem::permissions(path("closed"), std::filesystem::perms(0555));
  std::filesystem::permissions(folder_, std::filesystem::perms(0755));
  EXPECT_EQ(end(start(path("closed/s.sqlite"), "1")), 2);
  EXPECT_THAT(said(), AllOf(HasSubstr(path("closed")), HasSubstr("cannot be written")));
  std::filesystem::permissions(path("closed"), std::filesystem::perms(0755));
  EXPECT_TRUE(std::filesystem::is_empty(path("closed")));
}

}  // namespace
}  // namespace limen::study
