// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/rounds.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <thread>

#include "experiments/base/error.h"

namespace limen::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr size_t kMostFailures = 5;
constexpr size_t kLongestMessage = 1 << 16;
constexpr int kViolation = 77;  ///< exit status of a child that found one

/// What the child tells, also when it dies.
struct Progress {
  volatile int round, read, refused;
  volatile double cpuS;  ///< the child's own, when the round began
  char what[2000];
};

double cpuSecondsOf(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void limitMemory() {
#if !defined(__SANITIZE_ADDRESS__)  // which maps terabytes of shadow memory
  const rlimit limit{3ULL << 30U, 3ULL << 30U};
  setrlimit(RLIMIT_AS, &limit);
#endif
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
}

[[noreturn]] void report(Progress& progress, const std::string& what) {
  std::strncpy(progress.what, what.c_str(), sizeof progress.what - 1);
  _exit(kViolation);
}

void makeInput(const Parser& parser, uint64_t seed, const std::string& path) {
  Random random(seed);
  if (parser.make) {
    parser.make(random, path);
    return;
  }
  const std::string input = parser.mutate(random, random.pick(parser.corpus), parser.corpus);
  std::ofstream(path, std::ios::binary) << input;
}

void readInput(const Parser& parser, const std::string& path, Progress& progress) {
  try {
    parser.read(path);
    progress.read = progress.read + 1;
  } catch (const Error& error) {
    progress.refused = progress.refused + 1;
    const std::string message = error.what();
    if (message.find(fs::path(path).filename().string()) == std::string::npos)
      report(progress, "an error does not name the file: " + message);
    if (message.size() > kLongestMessage)
      report(progress,
             "a message of " + std::to_string(message.size()) + " bytes: " + message.substr(0, 500));
  } catch (const Violation& violation) {
    report(progress, violation.what);
  } catch (const std::bad_alloc&) {
    report(progress, "std::bad_alloc");
  } catch (const std::exception& error) {
    report(progress, std::string("an exception other than Error: ") + error.what());
  }
}

/// How the child ended; "" if it did all rounds.
std::string watch(pid_t child, const Parser& parser, const Progress& progress) {
  auto roundBegan = Clock::now();
  int round = -1;
  for (;;) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) {
      if (WIFSIGNALED(status)) return "crashed with signal " + std::to_string(WTERMSIG(status));
      if (WEXITSTATUS(status) == kViolation) return progress.what;
      return WEXITSTATUS(status) == 0 ? "" : "ended with status " + std::to_string(WEXITSTATUS(status));
    }
    if (progress.round != round) {
      round = progress.round;
      roundBegan = Clock::now();
    }
    const bool slow = cpuSecondsOf(child) - progress.cpuS > parser.secondsPerRound;
    if (slow || Clock::now() - roundBegan > std::chrono::duration<double>(6.0 * parser.secondsPerRound)) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return "took longer than " + std::to_string(parser.secondsPerRound) + " s";
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

std::string savedName(const Parser& parser, uint64_t seed) {
  const fs::path folder = fs::temp_directory_path() / "limen_fuzz";
  fs::create_directories(folder);
  return (folder / (parser.name + "_" + std::to_string(seed) + parser.extension)).string();
}

uint64_t fromEnvironment(const char* name, uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

}  // namespace

Outcome runRounds(const Parser& parser, uint64_t firstSeed, int rounds) {
  std::string pattern = (fs::temp_directory_path() / "limen_fuzz_XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  const std::string path = (folder / ("input" + parser.extension)).string();
  auto* const progress = static_cast<Progress*>(
      mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  Outcome out;
  for (int next = 0; next < rounds && out.failures.size() < kMostFailures;) {
    progress->what[0] = '\0';
    progress->round = next;
    progress->cpuS = 0.0;
    const pid_t child = fork();
    if (child == 0) {
      limitMemory();
      // Libraries complain there by themselves.
      if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
      for (int round = next; round < rounds; ++round) {
        progress->cpuS = cpuSecondsOf(getpid());
        progress->round = round;
        makeInput(parser, firstSeed + static_cast<uint64_t>(round), path);
        readInput(parser, path, *progress);
      }
      _exit(0);
    }
    const std::string what = watch(child, parser, *progress);
    if (what.empty()) break;
    const uint64_t seed = firstSeed + static_cast<uint64_t>(progress->round);
    const std::string saved = savedName(parser, seed);
    std::error_code code;
    fs::copy_file(path, saved, fs::copy_options::overwrite_existing, code);
    out.failures.push_back({seed, what, saved});
    next = progress->round + 1;
  }
  out.read = progress->read;
  out.refused = progress->refused;
  munmap(progress, sizeof(Progress));
  fs::remove_all(folder);
  return out;
}

void expectRobust(const Parser& parser) {
  const uint64_t first = fromEnvironment("LIMEN_FUZZ_SEED", 1);
  const auto rounds =
      static_cast<int>(fromEnvironment("LIMEN_FUZZ_ROUNDS", static_cast<uint64_t>(parser.rounds)));
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const Outcome outcome = runRounds(parser, first, rounds);
  for (const Failure& failure : outcome.failures)
    ADD_FAILURE() << "seed " << failure.seed << ": " << failure.what << "\ninput: " << failure.saved
                  << "\nrepeat: LIMEN_FUZZ_SEED=" << failure.seed
                  << " LIMEN_FUZZ_ROUNDS=1 test_fuzz --gtest_filter='" << test->test_suite_name() << '.'
                  << test->name() << "'";
  if (rounds >= 100 && outcome.failures.empty()) {
    EXPECT_GT(outcome.read, 0) << "no input was read";
    EXPECT_GT(outcome.refused, 0) << "no input was refused";
  }
  testing::Test::RecordProperty("read", outcome.read);
  testing::Test::RecordProperty("refused", outcome.refused);
  if (std::getenv("LIMEN_FUZZ_ROUNDS") != nullptr)
    std::printf("%s: %d read, %d refused\n", parser.name.c_str(), outcome.read, outcome.refused);
}

std::vector<std::string> shippedFiles(const std::string& folder, const std::string& extension) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(LIMEN_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> out;
  for (const fs::path& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    out.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return out;
}

}  // namespace limen::fuzz
