// SPDX-License-Identifier: BSD-3-Clause
// A program that runs a session, or goes on with one, and may be killed at any moment:
//   kill_victim STORE SESSION [largest file in bytes]
// It writes a byte to standard output each time that the session asks for something.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <optional>

#include "experiments/base/error.h"
#include "experiments/store/sessions.h"
#include "tests/study/session/scripted.h"

namespace {

using namespace limen;
using namespace limen::study;

struct Announcing : ScriptedFrontEnd {
  using ScriptedFrontEnd::ScriptedFrontEnd;
  ScreenResult show(const Screen& screen, const Session& session) override {
    announce();
    return ScriptedFrontEnd::show(screen, session);
  }
  TrialResult present(const Trial& trial, const Session& session) override {
    announce();
    usleep(500);  // some kills should meet a trial on the screen
    return ScriptedFrontEnd::present(trial, session);
  }
  static void announce() {
    if (write(STDOUT_FILENO, ".", 1) != 1) _exit(3);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  if (argc > 3) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{std::stoull(argv[3]), std::stoull(argv[3])};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  // A user without rights meets a folder that cannot be written; root would not.
  if (geteuid() == 0 && access("as_nobody", F_OK) == 0 && setuid(65534) != 0) return 3;
  try {
    const Protocol protocol = killedProtocol();
    Announcing frontEnd(protocol);
    frontEnd.trialOutcome = killedOutcome;
    SessionRequest request;
    request.store = argv[1];
    request.participant = "p01";
    request.session = argv[2];
    request.seed = 77;
    request.durability = Durability::ProcessKill;
    request.display = perception::displayPreset("desktop_24");
    const auto known = store::SessionLog(request.store).find("p01", request.session);
    if (known && known->state == "finished") return 0;  // killed after the last event
    request.resume = known.has_value();
    runSession(protocol, request, frontEnd);
    return 0;
  } catch (const Error& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
