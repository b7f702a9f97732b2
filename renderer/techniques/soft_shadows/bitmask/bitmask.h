// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"
#include "renderer/techniques/soft_shadows/bitmask/kept_masks.h"
#include "renderer/techniques/soft_shadows/occluder_search.h"

namespace limen::techniques {

/// Soft shadow mapping with occlusion bitmasks: light samples that some micro-occluder covers are bits that
/// are set once, so overlapping occluders fuse, also those of several shadow maps. On a light that does not
/// fill its rectangle only the samples that lie on it count. Source: Schwarz 2009, sections 4.2 and 4.4.
///
/// Convex hulls differ from the thesis in that their corners are rounded to 1/4096 of the distance between
/// two samples (exact from there on), that the table of half-spaces holds upward lines alone, and that rows
/// are filled between a hull's edges at once.
class Bitmask : public OccluderSearch {
 public:
  using Settings = BitmaskSettings;
  explicit Bitmask(const BitmaskSettings& settings) : Bitmask(settings, false) {}

  /// Those of every search, and maps_read, maps_with_casters and mask_bytes.
  static std::vector<Quantity> quantities();

  void render(frame::Frame& frame) override;
  std::vector<Counter> count(frame::Frame& frame) override;

 protected:
  /// `keepsMasks`: in an image, after a frame, though there be one map alone.
  Bitmask(const BitmaskSettings& settings, bool keepsMasks);

  void prepareSearch(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;
  bool readsMap(const frame::Frame&, size_t map) const override { return isDue_[map]; }
  void finish(frame::Frame& frame) override;

  /// Samples of the light, in the order of the mask's bits; valid from prepare() on.
  const std::vector<glm::dvec2>& samples() const { return samples_; }
  /// What shaders that include occlusion_mask.glsl are compiled with; valid from prepare() on.
  const gl::ShaderDefines& maskDefines() const { return maskDefines_; }
  /// Binds the kept masks and what they need; returns the number of sets, which are to be joined.
  int bindMasks() const;

 private:
  /// Decides which maps the frame reads.
  void chooseMaps(const frame::Frame& frame);
  /// Maps that a frame reads while the camera rests.
  size_t mapsAtRest() const;
  /// Maps that see anything at all. Waits for the GPU.
  int mapsWithCasters(frame::Frame& frame) const;

  /// Each object has a map and masks of its own.
  bool perObject() const { return std::holds_alternative<ObjectMaps>(mapChoice_); }

  SampleChoice pattern_;
  int halfSpaceSize_, rectangleSize_;  ///< 0: no table
  MapChoice mapChoice_;
  bool keepsMasks_;
  gl::ShaderDefines maskDefines_;
  std::vector<glm::dvec2> samples_;
  std::optional<gl::Texture> halfSpaces_, rectangles_;
  std::optional<gl::Buffer> lightMask_;  ///< of a light that does not fill its rectangle
  std::optional<KeptMasks> masks_;
  const gl::Program* join_ = nullptr;
  std::vector<bool> isDue_;  ///< of each map
  size_t nextUpdate_ = 0;
  double keptForS_ = 0.0;  ///< time whose camera the kept masks belong to
  bool hasMasks_ = false;
};

}  // namespace limen::techniques
