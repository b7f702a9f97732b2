// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

#include "renderer/gl/context.h"

namespace limen::experiments {

/// Keeps a GPU's clock up around timed frames and reads it. An idle GPU lowers its clock within seconds and
/// needs up to 0.34 s of continuous work to raise it again, while times look steady and are several times too
/// long. A software renderer needs none of this: every member does nothing then.
class GpuClock {
 public:
  explicit GpuClock(gl::Context& context);

  /// Call after frames have been timed. Scattered work (a picture here, a metric there) does not keep the
  /// clock up and does not count.
  void touch() { lastWork_ = std::chrono::steady_clock::now(); }
  /// Keeps the GPU busy for half a second if it was left alone for more than a second.
  void wake();
  /// Clock of the shader processors in MHz, where GL_ARB_shader_clock exists; waits for the GPU.
  std::optional<double> measureMhz();

 private:
  void spin(int repetitions);

  const bool software_;
  const gl::Program* busy_ = nullptr;
  const gl::Program* counter_ = nullptr;
  std::chrono::steady_clock::time_point lastWork_{};
};

}  // namespace limen::experiments
