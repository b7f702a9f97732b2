// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

#include "experiments/base/error.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

/// Programs get this long to stop by themselves when a terminal has sent the signal to all of them.
constexpr std::chrono::milliseconds kBeforePassingOn{500};

int statusOf(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

struct FileActions {
  posix_spawn_file_actions_t actions{};
  FileActions() { posix_spawn_file_actions_init(&actions); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  void open(int descriptor, const char* path, int flags) {
    posix_spawn_file_actions_addopen(&actions, descriptor, path, flags, 0666);
  }
  void copy(int from, int to) { posix_spawn_file_actions_adddup2(&actions, from, to); }
};

/// Signals that this process blocks are not blocked in its children. 0: not started.
pid_t spawn(const std::vector<std::string>& words, const FileActions& files,
            const std::function<bool(const std::string&)>& leaveOut = {}) {
  std::vector<char*> arguments, variables;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  for (char** each = environ; *each; ++each) {
    const std::string assignment = *each;
    if (!leaveOut || !leaveOut(assignment.substr(0, assignment.find('=')))) variables.push_back(*each);
  }
  variables.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, arguments[0], &files.actions, &attributes, arguments.data(), variables.data());
  posix_spawnattr_destroy(&attributes);
  return failed == 0 ? child : 0;
}

int waitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) != child)
    if (errno != EINTR) return 127;
  return statusOf(status);
}

class Keeper {
 public:
  Keeper(const std::vector<KeptProgram>& programs, const std::function<bool(size_t)>& again,
         const std::function<void()>& tick)
      : programs_(programs), again_(again), tick_(tick) {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&signals_, signal);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~Keeper() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  std::vector<int> run() {
    children_.assign(programs_.size(), 0);
    statuses_.assign(programs_.size(), 127);
    for (size_t i = 0; i < programs_.size(); ++i) {
      children_[i] = programs_[i].started;
      if (children_[i] == 0) start(i);
    }
    auto nextTick = steady_clock::now() + std::chrono::seconds(1);
    while (std::any_of(children_.begin(), children_.end(), [](pid_t child) { return child != 0; })) {
      const timespec wait{0, 200'000'000};
      const int signal = sigtimedwait(&signals_, nullptr, &wait);
      if ((signal == SIGINT || signal == SIGTERM) && stopped_ == 0) {
        stopped_ = signal;
        passOn_ = steady_clock::now() + kBeforePassingOn;
      }
      collect();
      if (stopped_ != 0 && steady_clock::now() >= passOn_) {
        for (const pid_t child : children_)
          if (child != 0) kill(child, SIGTERM);
        passOn_ = steady_clock::time_point::max();
      }
      if (tick_ && steady_clock::now() >= nextTick) {
        tick_();
        nextTick = steady_clock::now() + std::chrono::seconds(1);
      }
    }
    return statuses_;
  }

  int stopped() const { return stopped_; }

 private:
  void start(size_t index) {
    FileActions files;
    const std::string& log = programs_[index].log;
    if (!log.empty()) {
      files.open(STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND);
      files.copy(STDOUT_FILENO, STDERR_FILENO);
    }
    children_[index] = spawn(programs_[index].words, files);
  }

  void collect() {
    for (size_t i = 0; i < children_.size(); ++i) {
      int status = 0;
      if (children_[i] == 0 || waitpid(children_[i], &status, WNOHANG) != children_[i]) continue;
      children_[i] = 0;
      statuses_[i] = statusOf(status);
      if (WIFSIGNALED(status) && stopped_ == 0 && again_(i)) start(i);
    }
  }

  const std::vector<KeptProgram>& programs_;
  const std::function<bool(size_t)>& again_;
  const std::function<void()>& tick_;
  std::vector<pid_t> children_;
  std::vector<int> statuses_;
  sigset_t signals_{}, before_{};
  int stopped_ = 0;
  steady_clock::time_point passOn_ = steady_clock::time_point::max();
};

}  // namespace

std::string ownProgram() {
  std::error_code code;
  const fs::path path = fs::read_symlink("/proc/self/exe", code);
  if (code) throw Error("cannot tell which program runs: " + code.message(), "/proc/self/exe", "mount /proc");
  return path.string();
}

std::string findProgram(const std::string& name) {
  const char* const value = std::getenv("PATH");
  std::string rest = value ? value : "";
  while (true) {
    const size_t colon = rest.find(':');
    const std::string folder = rest.substr(0, colon);
    const fs::path candidate = fs::path(folder.empty() ? "." : folder) / name;
    std::error_code code;
    if (fs::is_regular_file(candidate, code) && access(candidate.c_str(), X_OK) == 0)
      return candidate.string();
    if (colon == std::string::npos) return "";
    rest = rest.substr(colon + 1);
  }
}

ProgramOutput runAndRead(const std::vector<std::string>& words,
                         const std::function<bool(const std::string&)>& leaveOut) {
  ProgramOutput result;
  std::array<int, 2> out{}, err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0) return result;
  if (pipe2(err.data(), O_CLOEXEC) != 0) {
    close(out[0]), close(out[1]);
    return result;
  }
  FileActions files;
  files.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  files.copy(out[1], STDOUT_FILENO);
  files.copy(err[1], STDERR_FILENO);
  const pid_t child = spawn(words, files, leaveOut);
  close(out[1]), close(err[1]);
  std::array<pollfd, 2> ends{{{out[0], POLLIN, 0}, {err[0], POLLIN, 0}}};
  const std::array<std::string*, 2> texts{&result.out, &result.err};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (poll(ends.data(), ends.size(), -1) < 0) continue;
    for (size_t i = 0; i < ends.size(); ++i) {
      if (ends[i].fd < 0 || ends[i].revents == 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t count = read(ends[i].fd, buffer.data(), buffer.size());
      if (count > 0)
        texts[i]->append(buffer.data(), static_cast<size_t>(count));
      else if (count == 0 || errno != EINTR)
        ends[i].fd = -1;
    }
  }
  close(out[0]), close(err[0]);
  if (child != 0) result.status = waitFor(child);
  return result;
}

int runAndWait(const std::vector<std::string>& words, bool quiet) {
  FileActions files;
  if (quiet) files.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
  const pid_t child = spawn(words, files);
  return child == 0 ? 127 : waitFor(child);
}

PipedProcess::PipedProcess(const std::vector<std::string>& words) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw Error("cannot be started: " + std::system_category().message(errno), words.at(0),
                "close some programs");
  FileActions files;
  files.copy(ends[1], STDIN_FILENO);
  files.copy(ends[1], STDOUT_FILENO);
  process_ = spawn(words, files);
  end_ = ends[0];
  close(ends[1]);
  if (process_ != 0) return;
  close(end_);
  throw Error("cannot be started", words.at(0), "see that the file is there and may be executed");
}

PipedProcess::PipedProcess(PipedProcess&& other) noexcept
    : process_(std::exchange(other.process_, 0)), end_(std::exchange(other.end_, -1)) {}

PipedProcess::~PipedProcess() {
  if (process_ == 0) return;
  kill(process_, SIGTERM);
  waitFor(release());
}

std::optional<std::string> PipedProcess::read() {
  std::string line;
  for (char c = 0;;) {
    const ssize_t count = recv(end_, &c, 1, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return std::nullopt;
    if (c == '\n') return line;
    line += c;
  }
}

bool PipedProcess::write(const std::string& line) {
  const std::string text = line + "\n";
  for (size_t sent = 0; sent < text.size();) {
    const ssize_t count = send(end_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<size_t>(count);
  }
  return true;
}

pid_t PipedProcess::release() {
  close(std::exchange(end_, -1));
  return std::exchange(process_, 0);
}

std::vector<int> keepRunning(const std::vector<KeptProgram>& programs,
                             const std::function<bool(size_t)>& again, const std::function<void()>& tick,
                             int* stopped) {
  Keeper keeper(programs, again, tick);
  std::vector<int> statuses = keeper.run();
  if (stopped) *stopped = keeper.stopped();
  return statuses;
}

void endWithParent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(128 + SIGTERM);
}

}  // namespace limen
