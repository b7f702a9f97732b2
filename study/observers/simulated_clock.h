// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "study/session/run.h"

namespace limen::study {

/// Time that passes only when told to.
class SimulatedClock : public Clock {
 public:
  /// `utcMs`: milliseconds since 1970-01-01T00:00:00Z.
  explicit SimulatedClock(int64_t utcMs = kEpochMs, int64_t monotonicNs = 0)
      : utcMs_(utcMs), startNs_(monotonicNs), nowNs_(monotonicNs) {}

  std::string utc() override;
  int64_t monotonicNs() override { return nowNs_; }
  void advance(double seconds);

  /// 2000-01-01T00:00:00Z, so that no simulated session looks like a recent one.
  static constexpr int64_t kEpochMs = 946684800000;

 private:
  int64_t utcMs_, startNs_, nowNs_;
};

/// "2000-01-01T00:00:00.000Z" and back. The latter throws Error on invalid text.
std::string utcText(int64_t utcMs);
int64_t utcMilliseconds(const std::string& text);

}  // namespace limen::study
