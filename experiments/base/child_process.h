// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace limen {

/// The program that runs now, as a path without links. Throws Error.
std::string ownProgram();

/// The first file of this name that PATH leads to and that may be executed; "" if there is none.
std::string findProgram(const std::string& name);

struct ProgramOutput {
  int status = 127;      ///< exit status, 128 plus the signal that ended it, 127 if it could not be started
  std::string out, err;  ///< what it wrote
};

/// Starts a program (found through PATH; no shell is involved), waits for its end and returns what it wrote.
/// `leaveOut` says which variables of the environment it is not to see.
ProgramOutput runAndRead(const std::vector<std::string>& words,
                         const std::function<bool(const std::string& variable)>& leaveOut = {});

/// Starts a program that writes where this one does, or to nowhere, and waits for its end. Returns the status
/// as above.
int runAndWait(const std::vector<std::string>& words, bool quiet);

/// One of several programs that are kept running.
struct KeptProgram {
  std::vector<std::string> words;
  std::string log;    ///< file that its output is added to; "": where this process writes
  pid_t started = 0;  ///< a child of this process that is to be kept as if started with `words`; 0: none yet
};

/// Runs programs side by side until all have ended. One that a signal ended is started again while
/// `again(index)` allows it. SIGINT and SIGTERM, of which this process must have no other handler, go on to
/// the programs, none of which is started again then. `tick` is called about once a second. Returns their
/// statuses; `stopped`, if given, gets the signal or 0.
std::vector<int> keepRunning(const std::vector<KeptProgram>& programs,
                             const std::function<bool(size_t index)>& again,
                             const std::function<void()>& tick = {}, int* stopped = nullptr);

/// A child of this process whose standard input and output it holds the other end of.
class PipedProcess {
 public:
  /// Starts a program. Throws Error if it cannot be started.
  explicit PipedProcess(const std::vector<std::string>& words);
  /// Ends it, unless released.
  ~PipedProcess();
  PipedProcess(PipedProcess&& other) noexcept;
  PipedProcess& operator=(PipedProcess&&) = delete;

  /// Waits for a line that it writes; nothing if it ends before.
  std::optional<std::string> read();
  /// False if it has ended.
  bool write(const std::string& line);
  /// Leaves it to the caller, who waits for its end; the other end is closed.
  pid_t release();

 private:
  pid_t process_ = 0;
  int end_ = -1;
};

/// From now on this process gets SIGTERM when the one that started it ends; ends at once if that has already
/// happened. `parent`: its id.
void endWithParent(pid_t parent);

}  // namespace limen
