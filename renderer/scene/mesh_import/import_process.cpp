// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/mesh_import/import_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "renderer/scene/mesh_import/mesh_stream.h"

namespace limen::scene {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const char* const kHint = "export it again as OBJ, PLY or glTF with triangles or polygons";

std::string importProgram() {
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path() / "limen_import_mesh";
  if (code || !fs::exists(program, code))
    throw Error("the program that reads meshes is not built", program.string(),
                "build Limen again; it belongs beside the other programs");
  return program.string();
}

/// Thrown where the child says no more.
struct Silent {};
struct Late {};

/// A child that is dead, and buried, once this is.
class Child {
 public:
  Child(const std::vector<std::string>& words, Clock::time_point deadline) : deadline_(deadline) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error("no pipe can be made", words[1]);
    from_ = ends[0];
    constexpr int kPipeBytes = 1 << 20;
    fcntl(from_, F_SETPIPE_SZ, kPipeBytes);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // First, for the standard streams may be closed and the pipe among their numbers.
    posix_spawn_file_actions_adddup2(&actions, ends[1], kMeshStream);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXCPU}) sigaddset(&usual, signal);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int failed =
        posix_spawn(&child_, words[0].c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failed != 0) {
      close(from_);
      throw Error(
          "the program that reads meshes cannot be started: " + std::system_category().message(failed),
          words[1]);
    }
  }
  ~Child() {
    close(from_);
    if (child_ == 0) return;
    kill(child_, SIGKILL);
    end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void receive(void* data, size_t bytes) {
    char* next = static_cast<char*>(data);
    while (bytes > 0) {
      constexpr int kLookMs = 50;
      pollfd readable{from_, POLLIN, 0};
      const int ready = poll(&readable, 1, kLookMs);
      throwIfInterrupted();
      if (Clock::now() > deadline_) throw Late{};
      if (ready <= 0) continue;
      const ssize_t got = read(from_, next, bytes);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw Silent{};
      next += got;
      bytes -= static_cast<size_t>(got);
    }
  }

  /// Waits for the end and returns its status.
  int end() {
    int status = 0;
    pid_t waited = 0;
    do waited = waitpid(child_, &status, 0);
    while (waited < 0 && errno == EINTR);
    child_ = 0;
    return status;
  }

 private:
  Clock::time_point deadline_;
  int from_ = -1;
  pid_t child_ = 0;
};

Error outOfTime(const std::string& path, double seconds) {
  return Error(fmt::format("the import takes longer than {:.0f} s", seconds), path, kHint);
}

/// Why a child said nothing.
Error explain(int status, const std::string& path, const ImportLimits& limits, double seconds) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == kImportOutOfMemory)
    return Error(fmt::format("the import takes more memory than it may ({:.0f} MiB and {:.0f} times the size "
                             "of the file)",
                             limits.memoryMiB, limits.memoryPerByte),
                 path, kHint);
  if (!WIFSIGNALED(status))
    return Error(fmt::format("the import ended with exit code {}", WEXITSTATUS(status)), path, kHint);
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return outOfTime(path, seconds);
  const char* why = signal == SIGABRT                       ? "gave up on it"
                    : signal == SIGSEGV || signal == SIGBUS ? "crashed on it"
                                                            : "was ended";
  return Error(fmt::format("not a mesh that can be read: the importer {} (signal {})", why, signal), path,
               kHint);
}

}  // namespace

ImportedMesh importInProcess(const std::string& path, const ImportLimits& limits) {
  std::error_code code;
  const auto size = fs::file_size(path, code);
  if (code) throw Error("cannot read the mesh file", path, "check its permissions");
  const double seconds = limits.seconds + limits.secondsPerMiB * static_cast<double>(size) / 1048576.0;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(limits.patience * seconds));
  Child child({importProgram(), path, fmt::format("{}", limits.memoryMiB),
               fmt::format("{}", limits.memoryPerByte), fmt::format("{}", seconds)},
              deadline);
  try {
    ReceivedMesh received = receiveMesh([&](void* data, size_t bytes) { child.receive(data, bytes); });
    if (received.refusal.empty()) return std::move(received.mesh);
    throw Error(received.refusal, path, kHint);
  } catch (const Silent&) {
    throwIfInterrupted();
    throw explain(child.end(), path, limits, seconds);
  } catch (const Late&) {
    throw outOfTime(path, limits.patience * seconds);
  } catch (const std::bad_alloc&) {
    throw Error("the mesh takes more memory than there is", path, kHint);
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(error.message(), path, kHint);
  }
}

}  // namespace limen::scene
