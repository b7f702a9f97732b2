// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

#include "renderer/gl/context.h"

namespace limen::experiments {

/// Keeps a GPU's clock high around timed frames and reads it. An idle GPU lowers its clock within seconds and
/// needs up to 0.8 s of continuous work to raise it again; until then times look steady but are several
/// times too long. For a software renderer every member does nothing.
class GpuClock {
 public:
  explicit GpuClock(gl::Context& context);

  /// Call after frames have been timed. Sporadic work (an occasional picture or metric) does not keep the
  /// clock high and does not count.
  void touch() { lastWork_ = std::chrono::steady_clock::now(); }
  /// Keeps the GPU busy for half a second if it was idle for more than a second, and, where its clock can be
  /// read, longer until that is as high as before or has risen no more for .4 s; some three seconds at most.
  void wake();
  /// Clock of the shader processors in MHz, where GL_ARB_shader_clock exists; waits for the GPU.
  std::optional<double> measureMhz();

 private:
  void spinFor(std::chrono::milliseconds time);

  const bool software_;
  const gl::Program* busy_ = nullptr;
  const gl::Program* counter_ = nullptr;
  double expectedMhz_ = 0.0;  ///< of the chip at work; 0: not known yet
  std::chrono::steady_clock::time_point lastWork_{};
};

}  // namespace limen::experiments
