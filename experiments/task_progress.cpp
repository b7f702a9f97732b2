// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/task_progress.h"

#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "experiments/base/clock.h"
#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"
#include "experiments/console.h"

namespace limen::experiments {
namespace {

using std::chrono::steady_clock;

constexpr size_t kFailuresKept = 10;

std::string thisHost() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

class ProgressWriter : public SweepObserver {
 public:
  explicit ProgressWriter(std::string path) : path_(std::move(path)) { progress_.host = thisHost(); }
  ~ProgressWriter() override {
    progress_.holding = 0;
    write();
  }
  ProgressWriter(const ProgressWriter&) = delete;
  ProgressWriter& operator=(const ProgressWriter&) = delete;

  void begin(size_t planned, size_t alreadyDone) override {
    progress_.planned = planned;
    progress_.done = alreadyDone;
    write();
  }
  void measuring(const PlannedRun&, size_t batchSize) override {
    progress_.holding = batchSize;
    // Batches that end within a second of each other would never be seen at work; two writes a second at most.
    if (writtenHolding_ == 0)
      write();
    else
      writeNowAndThen();
  }
  void finished(const PlannedRun& run, const store::Run& row) override {
    ++finished_;
    if (progress_.holding > 0) --progress_.holding;
    if (row.status == "done") {
      ++progress_.done;
    } else {
      ++progress_.failed;
      if (progress_.failures.size() < kFailuresKept) progress_.failures.push_back(describeFinished(run, row));
    }
    writeNowAndThen();
  }
  void doneElsewhere(const PlannedRun&) override { ++progress_.done; }
  void waiting(size_t) override {}
  void leftToOther(const PlannedRun&) override { --progress_.planned; }

 private:
  void writeNowAndThen() {
    if (steady_clock::now() - written_ >= std::chrono::seconds(1)) write();
  }

  /// A disk that is full stops the store, not this.
  void write() {
    written_ = steady_clock::now();
    writtenHolding_ = progress_.holding;
    if (finished_ > 0)
      progress_.secondsEach =
          std::chrono::duration<double>(written_ - start_).count() / static_cast<double>(finished_);
    const nlohmann::json json = {{"planned", progress_.planned},
                                 {"done", progress_.done},
                                 {"failed", progress_.failed},
                                 {"holding", progress_.holding},
                                 {"seconds_each", progress_.secondsEach},
                                 {"host", progress_.host},
                                 {"at", utcNow()},
                                 {"failures", progress_.failures}};
    try {
      replaceFile(path_, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const Error&) {
    }
  }

  std::string path_;
  TaskProgress progress_;
  size_t finished_ = 0;
  steady_clock::time_point start_ = steady_clock::now(), written_;
  size_t writtenHolding_ = 0;
};

}  // namespace

std::unique_ptr<SweepObserver> makeProgressWriter(const std::string& path) {
  return std::make_unique<ProgressWriter>(path);
}

std::optional<TaskProgress> readProgress(const std::string& path) {
  std::ifstream in(path);
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    TaskProgress out;
    json.at("planned").get_to(out.planned);
    json.at("done").get_to(out.done);
    json.at("failed").get_to(out.failed);
    json.at("holding").get_to(out.holding);
    json.at("seconds_each").get_to(out.secondsEach);
    json.at("host").get_to(out.host);
    json.at("at").get_to(out.at);
    json.at("failures").get_to(out.failures);
    return out;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace limen::experiments
