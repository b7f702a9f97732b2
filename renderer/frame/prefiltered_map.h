// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/layer_averages.h"
#include "renderer/frame/shadow_map.h"

namespace limen::frame {

/// What is stored for each depth d, so that its averages tell something about a comparison with d.
enum class DepthBasis {
  Moments,      ///< d and d^2: variance shadow map
  Exponential,  ///< exp(c (d - d0)): exponential shadow map
  Fourier       ///< cos and sin of odd multiples of pi d: convolution shadow map, one layer per term
};

struct PrefilterSettings {
  ShadowMapSettings map;
  DepthBasis basis = DepthBasis::Moments;
  Prefilter prefilter = Prefilter::Sums;
  SumForm form = SumForm::Float;
  /// Bits of a value, SumForm::Fixed only; 0: as many as cannot overflow (see sumBits()).
  int bits = 0;
  double exponent = 80.0;  ///< c of the exponential basis, for depths from 0 to 1
  int terms = 16;          ///< of the Fourier basis
  /// Share of half the series' period that the depths span, Fourier basis only.
  double periodShare = 0.875;
  /// Fourier basis only: also d times each term, for averages of blocker depths.
  bool withDepths = false;
  std::string key() const;
};

/// Bits that a value may have so that 32 hold the sum over a square map of this many texels per side; at
/// most 24.
int sumBits(int resolution);

/// Depths of a shadow map in a form that can be averaged before it is compared. Depths are mapped so that the
/// map's near plane is 0 and the deepest point in its frustum is 1; anything beyond, and empty texels, count
/// as 1. Source: Schwarz 2009, section 3.2.1.
class PrefilteredMap : public FrameInput {
 public:
  static constexpr const char* kName = "prefiltered_map";
  PrefilteredMap(Frame& frame, PrefilterSettings settings);
  void make(Frame& frame) override;
  const LightFrustum& frustum() const { return frustum_; }
  /// Light-space z that becomes 1.
  double deepest() const { return deepest_; }
  /// Binds sums or averages to a texture unit (and means to storage binding 0).
  void bind(uint32_t unit) const { averages_.bind(unit); }
  /// Sets the uniforms of prefiltered_map.glsl.
  void configure(const gl::Program& program) const;
  /// Sums or averages as stored, an array of layers.
  const gl::Texture& texture() const { return averages_.texture(); }
  int64_t bytes() const { return averages_.bytes(); }
  /// For shaders that include prefiltered_map.glsl.
  static gl::ShaderDefines defines(const PrefilterSettings& settings);

 private:
  PrefilterSettings settings_;
  LightFrustum frustum_;
  double deepest_;
  const gl::Program& fill_;
  LayerAverages averages_;
};

/// Light-space z of the farthest point of the scene's surfaces within the frustum; the near plane's if there
/// is none.
double deepestSeen(const scene::Scene& scene, const LightFrustum& frustum);

}  // namespace limen::frame
