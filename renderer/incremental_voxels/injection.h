// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/incremental_voxels/depth_view.h"
#include "renderer/incremental_voxels/sampled_volume.h"

namespace limen::incremental_voxels {

/// Order and places of the points of an image at which it is sampled (Gaitatzes 2012, section 7.6).
enum class PointPattern {
  Rows,
  Blocks,  ///< 8 x 8 points at a time; the same points
  Stipple  ///< every other row shifted by half a cell
};
constexpr EnumNames<PointPattern, 3> enumNames(PointPattern) {
  return {
      {{{PointPattern::Rows, "rows"}, {PointPattern::Blocks, "blocks"}, {PointPattern::Stipple, "stipple"}}}};
}

struct PointSettings {
  int side = 256;
  PointPattern pattern = PointPattern::Rows;
  int subsets = 1;
  bool shift = true;
  static const SettingsTable<PointSettings>& table();
  int64_t perStep() const { return (int64_t{side} * side + subsets - 1) / subsets; }
};

/// How samples are lit: by the first light of the frame's scene, if there is a view of it.
struct SampleLighting {
  double strength = 0.8;   ///< radiance of a white surface that faces it (frame/light_paths.h)
  double brightest = 1.0;  ///< no sample shows more
};

/// Fills voxels from samples of depth images: a grid of points in each (Gaitatzes 2012, section 7.4.2), or a
/// subset of it in each step. Attributes are means over a voxel's samples, the same whatever the order.
class Injection {
 public:
  /// `views`: the camera's and, if there are two, the light's; `used` of them, the first, give samples.
  Injection(gl::Context& context, const PointSettings& settings, const SampledVolume& volume, int views,
            int used);
  /// `step`: number of the step, for subsets and shifts. Opens no pass.
  void run(const frame::Frame& frame, const SampledVolume& volume, const std::vector<DepthView>& views,
           const SampleLighting& lighting, int step) const;

 private:
  void dispatch(const gl::Program& program) const;
  PointSettings settings_;
  int used_;
  const gl::Program& inject_;
  const gl::Program* settle_ = nullptr;
};

/// Uniforms of shaders that include seen_samples.glsl, which are compiled with pointDefines(); a step's
/// subset and shift.
gl::ShaderDefines pointDefines(const PointSettings& settings);
void configurePoints(const gl::Program& program, const PointSettings& settings, int step);
/// Uniforms of shaders that include seen_surface.glsl.
void configureSampleLights(const gl::Program& program, const frame::Frame& frame,
                           const SampleLighting& lighting);

}  // namespace limen::incremental_voxels
