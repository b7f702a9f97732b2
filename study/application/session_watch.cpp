// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/session_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limen::study {

void SessionWatch::progress(int trialsDone, int trialsInAll) {
  done_ = trialsDone;
  inAll_ = trialsInAll;
}

void SessionWatch::began(const Trial& trial, int64_t nowNs) {
  beganNs_ = lastEndNs_ != 0 ? lastEndNs_ : nowNs;
  screen_ = (trial.plan.practice ? "practice trial " : "trial ") + std::to_string(trial.number + 1);
  if (trial.attempt > 0) screen_ += ", asked again (" + std::to_string(trial.attempt) + ")";
}

void SessionWatch::ended(const TrialResult& result, int64_t nowNs) {
  ++shown_;
  if (result.outcome == Outcome::Invalid) ++invalid_[result.reason];
  trialSeconds_ += static_cast<double>(nowNs - beganNs_) * 1e-9;
  ++timedTrials_;
  lastEndNs_ = nowNs;
  for (size_t i = 0; i < result.frames.size(); ++i) {
    const ShownFrame& frame = result.frames[i];
    missed_ += frame.missedBlanks;
    if (i == 0) continue;
    const ShownFrame& before = result.frames[i - 1];
    if (before.stimulus != frame.stimulus || before.showing != frame.showing) continue;
    const double ms = static_cast<double>(frame.swapNs - before.swapNs) * 1e-6;
    ++count_;
    const double off = ms - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (ms - mean_);
    longest_ = std::max(longest_, ms);
  }
}

int SessionWatch::trialsInvalid() const {
  int sum = 0;
  for (const auto& [reason, count] : invalid_) sum += count;
  return sum;
}

IntervalStatistics SessionWatch::intervals() const {
  return {count_, mean_, count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : 0.0, longest_};
}

double SessionWatch::secondsLeft() const {
  if (timedTrials_ == 0) return -1.0;
  return trialSeconds_ / timedTrials_ * std::max(inAll_ - done_, 0);
}

std::vector<std::string> SessionWatch::lines() const {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("answered: {} of {} trials", done_, inAll_));
  if (const double left = secondsLeft(); left >= 0 && done_ < inAll_)
    lines.push_back(
        fmt::format("time left: about {:.0f} min, without breaks", std::max(std::ceil(left / 60), 1.0)));
  lines.push_back(fmt::format("invalid: {} of {} trials shown", trialsInvalid(), shown_));
  for (const auto& [reason, count] : invalid_) lines.push_back(fmt::format("  {} x {}", count, reason));
  const IntervalStatistics times = intervals();
  if (times.count == 0)
    lines.push_back("frames: none shown");
  else
    lines.push_back(
        fmt::format("frames: {} intervals, mean {:.3f} ms, SD {:.3f} ms, longest {:.3f} ms; {} missed",
                    times.count, times.meanMs, times.sdMs, times.longestMs, missed_));
  return lines;
}

}  // namespace limen::study
