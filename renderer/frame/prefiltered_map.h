// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/layer_averages.h"
#include "renderer/frame/shadow_map.h"

namespace limen::frame {

/// What is stored of each depth d, so that averages of it say something of a comparison with d.
enum class DepthBasis {
  Moments,      ///< d and d^2: variance shadow map
  Exponential,  ///< exp(c (d - d0)): exponential shadow map
  Fourier       ///< cos and sin of odd multiples of pi d: convolution shadow map, a layer a term
};

struct PrefilterSettings {
  ShadowMapSettings map;
  DepthBasis basis = DepthBasis::Moments;
  Prefilter prefilter = Prefilter::Sums;
  SumForm form = SumForm::Float;
  /// Bits of a value, SumForm::Fixed only; 0: as many as never overflow (see sumBits()).
  int bits = 0;
  double exponent = 80.0;  ///< c of the exponential basis, for depths from 0 to 1
  int terms = 16;          ///< of the Fourier basis
  /// Share of half the series' period that the depths span, Fourier basis only.
  double periodShare = 0.875;
  /// Fourier basis only: also d times each term, for averages of the depths that block.
  bool withDepths = false;
  std::string key() const;
};

/// Bits that a value may have for 32 to hold the sum over a square map of this many texels a side, 24 at
/// most.
int sumBits(int resolution);

/// Depths of a shadow map in a form that can be averaged before it is compared. Depths are brought from the
/// map's near plane and the deepest point that its frustum sees to 0 and 1; what lies beyond is taken as 1,
/// and so is nothing. Source: Schwarz 2009, section 3.2.1.
class PrefilteredMap : public FrameInput {
 public:
  static constexpr const char* kName = "prefiltered_map";
  PrefilteredMap(Frame& frame, PrefilterSettings settings);
  void make(Frame& frame) override;
  const LightFrustum& frustum() const { return frustum_; }
  /// Light-space z that becomes 1.
  double deepest() const { return deepest_; }
  /// Sums or averages to a texture unit (and means to storage binding 0).
  void bind(uint32_t unit) const { averages_.bind(unit); }
  /// Sets the uniforms of prefiltered_map.glsl.
  void configure(const gl::Program& program) const;
  /// Sums or averages as they are held, an array of layers.
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
