// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

struct TriangleBitmaskSettings {
  GridPattern pattern = GridPattern::Jittered16;
  static const SettingsTable<TriangleBitmaskSettings>& table();
};

/// Bit field of light samples, filled from the scene's own triangles: for each receiver point every triangle
/// between it and the light hides the samples within its projection. Exact at the samples except for
/// rounding. Source: Schwarz 2009, section 3.3 ("Backprojecting triangles") and the outlook.
class TriangleBitmask : public Technique {
 public:
  using Settings = TriangleBitmaskSettings;
  explicit TriangleBitmask(const TriangleBitmaskSettings& settings);
  void prepare(frame::Frame& frame) override;
  void render(frame::Frame& frame) override;
  const gl::Texture& product() const override { return *visibility_; }
  std::vector<Counter> count(frame::Frame& frame) override;

  /// Samples hidden at each pixel, row by row, after count(): bit b of a pixel's words is sample b of
  /// lightSamples(). None if there is no receiver.
  const std::vector<uint32_t>& masks() const { return masks_; }

  static std::vector<Quantity> counters();

 private:
  struct Work {
    gl::Texture counts;
    gl::Buffer masks;
  };
  void run(frame::Frame& frame, const gl::Program& program, const Work* work);

  GridPattern pattern_;
  gl::ShaderDefines defines_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> visibility_;
  std::optional<gl::Buffer> nodes_, triangles_, planes_, lightShape_;
  int lightSamples_ = 0;
  uint32_t triangleCount_ = 0;
  double reach_ = 1.0;
  std::vector<uint32_t> masks_;
};

}  // namespace limen::techniques
