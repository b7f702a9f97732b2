// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace limen::gl {

/// How passes are timed. A software renderer's timer queries are wrong, so it is timed with the host's clock
/// between calls of glFinish.
enum class Clock { None, Gpu, Wall };

/// What is timed. A timestamp waits until all before it is done: between passes it keeps the end of one and
/// the start of the next from overlapping, and takes a microsecond or two itself. So whole frames are timed
/// without any within them.
enum class Recorded { Frames, Passes, Both };

/// Time of one pass of one frame. The pass "frame" is the whole frame.
struct PassTime {
  int frame = 0;
  std::string pass;
  int64_t nanoseconds = 0;
};

/// The passes of a frame: their order, the bytes they hold and, while recording, their times. Timestamps go
/// into queries created in advance and are read only after recording, so a frame never waits for them.
class PassList {
 public:
  struct Pass {
    std::string name;
    int64_t bytesHeld = 0;
    bool ran = false;  ///< in the last frame
  };

  PassList() = default;
  ~PassList();
  PassList(const PassList&) = delete;
  PassList& operator=(const PassList&) = delete;

  /// A pass, open until destroyed. Passes do not nest.
  class Scope {
   public:
    Scope(PassList& list, size_t index);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PassList& list_;
    size_t index_;
  };
  Scope open(const std::string& name);
  /// Prefix for the names given to open() and setBytesHeld() from now on, so that the same passes of several
  /// views in one frame stay distinct ("finest/frame/depth").
  void setPrefix(const std::string& prefix) { prefix_ = prefix; }
  /// Bytes of textures and buffers that the pass's results occupy.
  void setBytesHeld(const std::string& name, int64_t bytes);

  void beginFrame();
  void endFrame();

  /// Starts recording at most `frames` frames of the passes known by then; run a warm-up frame first.
  void startRecording(Clock clock, int frames, Recorded what = Recorded::Both);
  /// Ends recording; waits for the GPU and returns all times, in order of frames.
  std::vector<PassTime> finishRecording();

  const std::vector<Pass>& passes() const { return passes_; }

 private:
  using HostClock = std::chrono::steady_clock;
  size_t indexOf(const std::string& name);
  void mark(size_t slot, bool begin);

  std::vector<Pass> passes_;
  std::string prefix_;
  Clock clock_ = Clock::None;
  Recorded what_ = Recorded::Both;
  int frame_ = -1, capacity_ = 0;
  size_t slots_ = 0;               // passes + 1 (the frame itself, last)
  std::vector<uint32_t> queries_;  // [frame][slot][begin, end]
  std::vector<HostClock::time_point> marks_;
  std::vector<uint8_t> used_;  // [frame][slot]
};

}  // namespace limen::gl
