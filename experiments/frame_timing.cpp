// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/frame_timing.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>

#include "experiments/measured_quantities.h"

namespace limen::experiments {
namespace {

using std::chrono::steady_clock;

int64_t threadCpuNanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

double secondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

/// Linear interpolation between order statistics (Hyndman and Fan, type 7).
double quantileMs(std::vector<int64_t> nanoseconds, double q) {
  std::sort(nanoseconds.begin(), nanoseconds.end());
  const double at = q * static_cast<double>(nanoseconds.size() - 1);
  const auto below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, nanoseconds.size() - 1);
  const double share = at - static_cast<double>(below);
  return 1e-6 * ((1.0 - share) * static_cast<double>(nanoseconds[below]) +
                 share * static_cast<double>(nanoseconds[above]));
}

/// Every technique needs these; they are not its own cost.
bool isGBuffer(const std::string& pass) { return pass == "frame/triangle_ids" || pass == "frame/receivers"; }

}  // namespace

void FrameTiming::warmUp(frame::Frame& frame, techniques::Technique& technique) const {
  const auto start = steady_clock::now();
  for (int i = 0; i < std::max(timing_.warmup, 1) && (i == 0 || secondsSince(start) < 0.5); ++i) {
    frame.begin();
    technique.render(frame);
    frame.end();
    if (clock_ == gl::Clock::Wall) glFinish();
  }
}

void FrameTiming::measureRound(frame::Frame& frame, techniques::Technique& technique, int round,
                               double maxSeconds) {
  // Frames are shared evenly; the first rounds take the remainder.
  const int planned = timing_.frames / timing_.rounds + (round < timing_.frames % timing_.rounds ? 1 : 0);
  if (clock_ != gl::Clock::Gpu) {
    wholeFrames_ += record(frame, technique, round, planned, maxSeconds, gl::Recorded::Both);
    return;
  }
  const int done = record(frame, technique, round, planned, maxSeconds, gl::Recorded::Frames);
  wholeFrames_ += done;
  record(frame, technique, round, (done + 3) / 4, maxSeconds, gl::Recorded::Passes);
}

int FrameTiming::record(frame::Frame& frame, techniques::Technique& technique, int round, int planned,
                        double maxSeconds, gl::Recorded what) {
  glFinish();
  frame.passes().startRecording(clock_, planned, what);
  const auto start = steady_clock::now();
  int done = 0;
  for (; done < planned && (done == 0 || secondsSince(start) < maxSeconds); ++done) {
    const auto wall = steady_clock::now();
    const int64_t cpu = threadCpuNanoseconds();
    frame.begin();
    technique.render(frame);
    frame.end();
    if (what != gl::Recorded::Passes) {
      times_.push_back({frames_ + done, round, "cpu", threadCpuNanoseconds() - cpu});
      times_.push_back(
          {frames_ + done, round, "wall",
           std::chrono::duration_cast<std::chrono::nanoseconds>(steady_clock::now() - wall).count()});
    }
    // With a long queue, seconds of work would pass before the limit above is noticed.
    if (done == 0 && planned > 1) glFinish();
  }
  for (const gl::PassTime& time : frame.passes().finishRecording())
    times_.push_back({frames_ + time.frame, round, time.pass, time.nanoseconds});
  frames_ += done;
  return done;
}

std::vector<store::Measurement> FrameTiming::summarise() const {
  std::map<std::string, std::vector<int64_t>> byPass;
  for (const store::FrameTime& time : times_) byPass[time.pass].push_back(time.nanoseconds);
  std::vector<store::Measurement> out;
  const auto add = [&](const std::string& name, const std::vector<int64_t>& values, double q) {
    if (!values.empty()) out.push_back(measured(name, quantileMs(values, q)));
  };
  add("gpu_ms", byPass["frame"], 0.5);
  add("gpu_ms_p95", byPass["frame"], 0.95);
  if (!byPass["frame"].empty()) {
    double own = quantileMs(byPass["frame"], 0.5);
    for (const auto& [pass, nanoseconds] : byPass)
      if (isGBuffer(pass)) own -= quantileMs(nanoseconds, 0.5);
    out.push_back(measured("technique_ms", own));
  }
  add("wall_ms", byPass["wall"], 0.5);
  add("cpu_ms", byPass["cpu"], 0.5);
  out.push_back(measured("timed_frames", static_cast<double>(wholeFrames_)));
  return out;
}

}  // namespace limen::experiments
