// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/layer_averages.h"
#include "renderer/frame/shadow_map.h"

namespace limen::frame {

struct OcclusionSliceSettings {
  int resolution = 256;  ///< texels per side; a power of two
  int slices = 16;       ///< 1 to 32
  Prefilter prefilter = Prefilter::Sums;
  std::string key() const;
};

/// Which texels the scene covers in each of several slices of equal depth between the nearest and the
/// farthest point of its casters: a picture of every slice from the light's centre, all made in one pass, one
/// bit per slice (Eisemann and Décoret 2006; Schwarz 2009, section 3.2.1). Then one layer per slice, ready to
/// be averaged. Nothing hides what lies behind it; fragments beyond the last slice are dropped.
class OcclusionSlices : public FrameInput {
 public:
  static constexpr const char* kName = "occlusion_slices";
  OcclusionSlices(Frame& frame, OcclusionSliceSettings settings);
  void make(Frame& frame) override;
  const LightFrustum& frustum() const { return frustum_; }
  /// R32UI: bit k is set where something lies in slice k.
  const gl::Texture& bits() const { return bits_; }
  /// Binds sums or averages to a texture unit.
  void bind(uint32_t unit) const { averages_.bind(unit); }
  /// Light-space z where the first slice begins, and the depth of each. Slice k ends at the plane in which
  /// its contents are taken to lie, at begin() + (k + 1) * depth().
  double begin() const { return begin_; }
  double depth() const { return depth_; }
  int64_t bytes() const { return bits_.bytes() + target_.bytes() + averages_.bytes(); }

 private:
  OcclusionSliceSettings settings_;
  LightFrustum frustum_;
  double begin_, depth_;
  const gl::Program &raster_, &unpack_;
  gl::Texture bits_, target_;
  gl::Framebuffer framebuffer_;
  LayerAverages averages_;
};

}  // namespace limen::frame
