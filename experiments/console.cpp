// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/printable.h"
#include "experiments/base/text.h"
#include "experiments/measured_quantities.h"

namespace limen::experiments {
namespace {

using Clock = std::chrono::steady_clock;

bool startsCodePoint(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) != 0x80; }

size_t columnsOf(const std::string& text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), startsCodePoint));
}

size_t terminalColumns(std::FILE* terminal) {
  winsize size{};
  return ioctl(fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string describePlanned(const PlannedRun& run) {
  return run.technique.name + (run.label.empty() ? "" : " " + run.label) + " · " + run.scene.name +
         (run.setting.empty() ? "" : " " + run.setting);
}

const store::Measurement* find(const store::Run& row, const std::string& name) {
  const auto match =
      std::find_if(row.measurements.begin(), row.measurements.end(),
                   [&](const store::Measurement& measurement) { return measurement.name == name; });
  return match == row.measurements.end() ? nullptr : &*match;
}

class LinePrinter : public SweepObserver {
 public:
  explicit LinePrinter(std::FILE* out) : out_(out) {}

  void begin(size_t planned, size_t alreadyDone) override {
    total_ = planned;
    seen_ = alreadyDone;
    if (alreadyDone > 0) print(fmt::format("{} of {} runs are already done", alreadyDone, planned));
  }
  void measuring(const PlannedRun&, size_t) override {}
  void finished(const PlannedRun& run, const store::Run& row) override {
    numbered(describeFinished(run, row));
  }
  void doneElsewhere(const PlannedRun& run) override {
    numbered(describePlanned(run) + " · done by another sweep");
  }
  void waiting(size_t heldByOthers) override {
    if (!saidWaiting_) print(fmt::format("waiting for {} runs held by another sweep", heldByOthers));
    saidWaiting_ = true;
  }

 private:
  void numbered(const std::string& text) {
    ++seen_;
    print(fmt::format("[{:>{}}/{}] {}", seen_, fmt::formatted_size("{}", total_), total_, text));
  }
  void print(const std::string& line) {
    std::fputs((printable(line) + "\n").c_str(), out_);
    std::fflush(out_);
  }

  std::FILE* out_;
  size_t total_ = 0, seen_ = 0;
  bool saidWaiting_ = false;
};

class ProgressBar : public SweepObserver {
 public:
  explicit ProgressBar(std::FILE* terminal) : terminal_(terminal) {}
  ~ProgressBar() override {
    if (drawn_) std::fputs("\r\x1b[K", terminal_);
    std::fflush(terminal_);
  }

  void begin(size_t planned, size_t alreadyDone) override {
    total_ = planned;
    seen_ = alreadyDone;
    start_ = Clock::now();
    draw();
  }
  void measuring(const PlannedRun& first, size_t batchSize) override {
    current_ =
        printable(describePlanned(first)) + (batchSize > 1 ? fmt::format(" and {} more", batchSize - 1) : "");
    draw();
  }
  void finished(const PlannedRun& run, const store::Run& row) override {
    ++seen_;
    ++measured_;
    secondsMeasured_ = std::chrono::duration<double>(Clock::now() - start_).count();
    if (row.status == "failed") {
      ++failed_;
      std::fputs(("\r\x1b[K" + printable(describeFinished(run, row)) + "\n").c_str(), terminal_);
    }
    draw();
  }
  void doneElsewhere(const PlannedRun&) override {
    ++seen_;
    draw();
  }
  void waiting(size_t heldByOthers) override {
    current_ = fmt::format("waiting for {} runs held by another sweep", heldByOthers);
    draw();
  }

 private:
  void draw() {
    // Runs measured so far are representative of those left, as techniques take turns.
    const double left = measured_ == 0 ? -1.0
                                       : secondsMeasured_ / static_cast<double>(measured_) *
                                             static_cast<double>(total_ - std::min(seen_, total_));
    // The last column stays empty: writing there makes some terminals wrap.
    const std::string text = barText(seen_, total_, failed_, left, current_, terminalColumns(terminal_) - 1);
    std::fputs(("\r\x1b[K" + text).c_str(), terminal_);
    std::fflush(terminal_);
    drawn_ = true;
  }

  std::FILE* terminal_;
  size_t total_ = 0, seen_ = 0, measured_ = 0, failed_ = 0;
  double secondsMeasured_ = 0.0;
  Clock::time_point start_ = Clock::now();
  std::string current_;
  bool drawn_ = false;
};

class JsonPrinter : public SweepObserver {
 public:
  explicit JsonPrinter(std::FILE* out) : out_(out) {}
  void begin(size_t, size_t) override {}
  void measuring(const PlannedRun&, size_t) override {}
  void finished(const PlannedRun& run, const store::Run& row) override {
    nlohmann::json values = nlohmann::json::object();
    for (const store::Measurement& measurement : row.measurements)
      values[measurement.name] = measurement.value && std::isfinite(*measurement.value)
                                     ? nlohmann::json(*measurement.value)
                                     : nullptr;
    const nlohmann::json line = {
        {"key", row.key},     {"status", row.status},   {"technique", row.technique}, {"scene", row.scene},
        {"label", run.label}, {"setting", run.setting}, {"measurements", values},     {"error", row.error}};
    std::fputs((line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n").c_str(), out_);
    std::fflush(out_);
  }
  void doneElsewhere(const PlannedRun&) override {}
  void waiting(size_t) override {}

 private:
  std::FILE* out_;
};

class Pair : public SweepObserver {
 public:
  Pair(std::unique_ptr<SweepObserver> first, std::unique_ptr<SweepObserver> second)
      : first_(std::move(first)), second_(std::move(second)) {}
  void begin(size_t planned, size_t alreadyDone) override {
    first_->begin(planned, alreadyDone), second_->begin(planned, alreadyDone);
  }
  void measuring(const PlannedRun& first, size_t batchSize) override {
    first_->measuring(first, batchSize), second_->measuring(first, batchSize);
  }
  void finished(const PlannedRun& run, const store::Run& row) override {
    first_->finished(run, row), second_->finished(run, row);
  }
  void doneElsewhere(const PlannedRun& run) override {
    first_->doneElsewhere(run), second_->doneElsewhere(run);
  }
  void waiting(size_t heldByOthers) override {
    first_->waiting(heldByOthers), second_->waiting(heldByOthers);
  }
  void leftToOther(const PlannedRun& run) override { first_->leftToOther(run), second_->leftToOther(run); }

 private:
  std::unique_ptr<SweepObserver> first_, second_;
};

}  // namespace

std::unique_ptr<SweepObserver> makeProgressBar(std::FILE* terminal) {
  return std::make_unique<ProgressBar>(terminal);
}
std::unique_ptr<SweepObserver> makeLinePrinter(std::FILE* out) { return std::make_unique<LinePrinter>(out); }
std::unique_ptr<SweepObserver> makeJsonPrinter(std::FILE* out) { return std::make_unique<JsonPrinter>(out); }
std::unique_ptr<SweepObserver> makePair(std::unique_ptr<SweepObserver> first,
                                        std::unique_ptr<SweepObserver> second) {
  return std::make_unique<Pair>(std::move(first), std::move(second));
}

std::string describeFinished(const PlannedRun& run, const store::Run& row) {
  std::string out = describePlanned(run);
  if (row.status == "failed") return out + " · FAILED: " + row.error;
  const auto append = [&](const store::Measurement& measurement, bool named) {
    const std::string value = measurement.value ? fmt::format("{:.4g}", *measurement.value) : "not a number";
    out += " · " + (named ? measurement.name + " " : "") + value;
    if (!measurement.unit.empty()) out += " " + measurement.unit;
  };
  const store::Measurement* time = find(row, "gpu_ms");
  if (!time) time = find(row, "wall_ms");
  if (time) append(*time, false);
  for (const store::Measurement& measurement : row.measurements)
    if (measurement.kind == "error" && !isCommonQuantity(measurement.name)) append(measurement, true);
  return out;
}

std::string describeDuration(double seconds) {
  const auto whole = static_cast<int64_t>(std::ceil(std::max(0.0, seconds)));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

std::string cutToColumns(const std::string& text, size_t columns) {
  if (columnsOf(text) <= columns) return text;
  if (columns == 0) return {};
  size_t end = 0;
  for (size_t kept = 0; end < text.size(); ++end)
    if (startsCodePoint(text[end]) && kept++ == columns - 1) break;
  return text.substr(0, end) + "…";
}

std::string barText(size_t done, size_t total, size_t failed, double secondsLeft, const std::string& current,
                    size_t columns) {
  std::string counts = fmt::format("{}/{}", done, total);
  if (failed > 0) counts += fmt::format(", {} failed", failed);
  if (secondsLeft >= 0.0 && done < total) counts += ", " + describeDuration(secondsLeft) + " left";
  // On a narrow terminal the bar goes first and the counts stay.
  const size_t width = columns >= 60 ? std::min<size_t>(30, columns / 4) : 0;
  std::string bar;
  if (width > 0) {
    const size_t filled = total == 0 ? width : std::min(width, width * done / total);
    bar = "[" + std::string(filled, '#') + std::string(width - filled, '-') + "] ";
  }
  return cutToColumns(bar + counts + (current.empty() ? "" : ", " + current), columns);
}

}  // namespace limen::experiments
