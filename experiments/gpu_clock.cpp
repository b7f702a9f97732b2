// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/gpu_clock.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "experiments/gpu_clock_bindings.h"
#include "renderer/gl/buffer.h"

namespace limen::experiments {

using std::chrono::steady_clock;

GpuClock::GpuClock(gl::Context& context) : software_(context.device().software) {
  if (software_) return;
  busy_ = &context.programs().compute("experiments/gpu_busy.comp.glsl");
  if (epoxy_has_gl_extension("GL_ARB_shader_clock"))
    counter_ = &context.programs().compute("experiments/gpu_clock.comp.glsl");
}

void GpuClock::spinFor(std::chrono::milliseconds time) {
  const auto start = steady_clock::now();
  const gl::Buffer out(64, nullptr);
  out.bindStorage(kClockOutBuffer);
  while (steady_clock::now() - start < time) {
    for (int i = 0; i < 16; ++i) busy_->dispatch({64 * 1024, 1}, {kBusyGroup, 1});
    glFinish();
  }
}

void GpuClock::wake() {
  if (software_ || steady_clock::now() - lastWork_ < std::chrono::seconds(1)) return;
  using std::chrono::milliseconds;
  spinFor(milliseconds(500));
  constexpr double kSame = 0.02;  // share by which clocks of a chip at work differ
  // A chip that has been idle for long raises it in steps of .2 s: 345, 405, 720, 1065, 1980 MHz on an NVIDIA
  // H200. One that stays slower than before, as a hot one, is taken as it is.
  constexpr int kSteadyTimes = 4, kMostTimes = 24;
  double before = 0.0;
  for (int i = 0, steady = 0; counter_ && i < kMostTimes; ++i) {
    const double mhz = measureMhz().value_or(0.0);
    if (expectedMhz_ > 0.0 && mhz > (1.0 - kSame) * expectedMhz_) break;
    steady = mhz > (1.0 + kSame) * before ? 0 : steady + 1;
    before = mhz;
    if (steady == kSteadyTimes || i + 1 == kMostTimes) {
      expectedMhz_ = mhz;
      break;
    }
    spinFor(milliseconds(100));
  }
  touch();
}

std::optional<double> GpuClock::measureMhz() {
  if (!counter_) return {};
  constexpr double kTicks = 2e6;
  const gl::Buffer out(64, nullptr);
  out.bindStorage(kClockOutBuffer);
  GLuint query = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &query);
  counter_->set("ticks", static_cast<uint32_t>(kTicks));
  glBeginQuery(GL_TIME_ELAPSED, query);
  counter_->dispatch({1, 1}, {1, 1});
  glEndQuery(GL_TIME_ELAPSED);
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
  glDeleteQueries(1, &query);
  const auto counted = out.read<uint32_t>(0, 1);
  touch();
  if (nanoseconds == 0) return {};
  const double mhz = counted[0] * 1e3 / static_cast<double>(nanoseconds);
  // A chip that turns out to be faster than when it was woken is waited for next time.
  if (expectedMhz_ > 0.0) expectedMhz_ = std::max(expectedMhz_, mhz);
  return mhz;
}

}  // namespace limen::experiments
