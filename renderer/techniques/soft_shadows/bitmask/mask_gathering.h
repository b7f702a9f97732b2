// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.h"
#include "renderer/techniques/soft_shadows/gathering.h"

namespace limen::techniques {

/// Occlusion bitmasks: each light sample covered by a micro-occluder is one bit, so overlapping occluders
/// fuse, including those of several shadow maps. If the light does not fill its rectangle, only the samples
/// on it count. Source: Schwarz 2009, sections 4.2 and 4.4.
///
/// Convex hulls differ from the thesis in that their corners are rounded to 1/4096 of the distance between
/// two samples (exact after that), that the table of half-spaces holds upward lines only, and that rows
/// between a hull's edges are filled at once.
class MaskGathering : public Gathering {
 public:
  enum class Masks {
    Joined,  ///< into the visibility
    Stored   ///< into an image for later use, even for a single map
  };
  MaskGathering(const MaskedOccluders& occluders, const SampleChoice& samples, Masks masks);

  gl::ShaderDefines prepare(frame::Frame& frame, const MapSource& maps) override;
  void configure(const gl::Program& program, size_t map) const override;
  void join(frame::Frame& frame, const gl::Texture& visibility) override;
  std::vector<Counter> count(frame::Frame& frame) const override;
  /// What count() returns.
  static std::vector<Quantity> quantities();

  /// Samples of the light, in the order of the mask's bits; valid from prepare() on.
  const std::vector<glm::dvec2>& samples() const { return samples_; }
  /// Defines for shaders that include occlusion_mask.glsl; valid from prepare() on.
  const gl::ShaderDefines& maskDefines() const { return maskDefines_; }
  /// Binds the stored masks and what they need; returns the number of sets to combine.
  int bindMasks() const;

 private:
  /// Number of non-empty maps. Waits for the GPU.
  int mapsWithCasters(frame::Frame& frame) const;

  SampleChoice pattern_;
  QuadMaskChoice quads_;
  int halfSpaceSize_, rectangleSize_;  ///< 0: no table
  Masks stored_;
  gl::ShaderDefines maskDefines_;
  std::vector<glm::dvec2> samples_;
  std::optional<gl::Texture> halfSpaces_, rectangles_;
  std::optional<gl::Buffer> lightMask_;  ///< of a light that does not fill its rectangle
  std::optional<KeptMasks> masks_;
  int sets_ = 1;
  const gl::Program* join_ = nullptr;
  const MapSource* maps_ = nullptr;
};

}  // namespace limen::techniques
