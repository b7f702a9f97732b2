// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

namespace limen::techniques {

/// Times a part of each frame for a controller, without waiting for the GPU: timestamps are read once they
/// have arrived, frames later; a frame that starts while all of them are in flight is not timed. A software
/// renderer's timestamps are wrong, so there it uses wall time between two calls of glFinish, which does
/// wait.
class FrameStopwatch {
 public:
  struct Sample {
    double tag = 0.0, ms = 0.0;
  };

  explicit FrameStopwatch(bool software);
  ~FrameStopwatch();
  FrameStopwatch(const FrameStopwatch&) = delete;
  FrameStopwatch& operator=(const FrameStopwatch&) = delete;

  /// Begins a frame's part; one that was begun and not ended is dropped. `tag` is returned with its time.
  void start(double tag);
  /// Does nothing without a start.
  void stop();
  /// Times that have arrived since the last call, oldest first. Valid until the next call.
  const std::vector<Sample>& collect();

 private:
  static constexpr uint64_t kUnderWay = 8;  // frames
  struct Slot {
    std::array<uint32_t, 2> queries{};
    double tag = 0.0;
  };
  bool software_, running_ = false;
  std::array<Slot, kUnderWay> slots_;
  uint64_t oldest_ = 0, next_ = 0;  // slots in use, modulo their number
  double wallTag_ = 0.0;
  std::chrono::steady_clock::time_point begun_;
  std::vector<Sample> arrived_, collected_;
};

}  // namespace limen::techniques
