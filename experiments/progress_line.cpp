// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "experiments/console.h"
#include "experiments/gathering.h"
#include "experiments/task_progress.h"

namespace limen::experiments {

void ProgressLine::show() {
  using std::chrono::steady_clock;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal && steady_clock::now() - shown_ < std::chrono::seconds(10)) return;
  shown_ = steady_clock::now();
  size_t done = 0, failed = 0;
  for (int task = 1; task <= submission_.tasks; ++task)
    if (const auto progress = readProgress(progressFile(submission_, task))) {
      done += progress->done + progress->failed;
      failed += progress->failed;
    }
  const double seconds = std::chrono::duration<double>(shown_ - start_).count();
  const double left =
      done == 0 ? -1.0 : seconds / static_cast<double>(done) * static_cast<double>(planned_ - done);
  winsize size{};
  const bool known = terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::string text = barText(done, planned_, failed, left, "", known ? size.ws_col - 1U : 79U);
  std::fprintf(stderr, terminal ? "\r\033[K%s" : "%s\n", text.c_str());
  std::fflush(stderr);
}

void ProgressLine::end() {
  if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

}  // namespace limen::experiments
