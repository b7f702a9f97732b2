// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/techniques/soft_shadows/bias_form.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/soft_shadows/visibility_pass.h"

namespace limen::techniques {

/// A soft-shadow technique of one pass over one shadow map: derive from it, give it a shader, and set the
/// shader's uniforms. Others compose parts themselves (search_technique.h).
class VisibilityTechnique : public Technique, public CountsPixels, private PassInputs {
 public:
  void prepare(frame::Frame& frame) override;
  void render(frame::Frame& frame) override;
  const gl::Texture& product() const override { return pass_.visibility(); }
  /// visibilityCounters().
  std::vector<Counter> count(frame::Frame& frame) override;
  const PixelCounts& counted() const override { return counted_; }

  /// What count() returns.
  static std::vector<Quantity> quantities() { return visibilityQuantities(); }

 protected:
  /// `shader` is a path from the repository root, `pass` the name in the pass list.
  VisibilityTechnique(const MapSettings& map, const BiasSettings& bias, std::string shader, std::string pass,
                      gl::ShaderDefines defines = {});

  /// Sets the technique's own uniforms.
  virtual void configure(const gl::Program& program) const = 0;
  /// Makes and binds the map, from texture unit 1; returns its frustum. Unless overridden: the linear map.
  virtual const frame::LightFrustum& bindMap(frame::Frame& frame);

  const frame::ShadowMapSettings& mapSettings() const { return map_; }
  /// The map's pyramid, for bindMap(): call it last there; sets pyramidLevels().
  const frame::LightFrustum& bindPyramid(frame::Frame& frame);
  /// Levels of the pyramid that was bound last.
  int pyramidLevels() const { return pyramidLevels_; }
  static int maxIterations(frame::Frame& frame) { return maxLoopIterations(frame); }

 private:
  const frame::LightFrustum& bindInputs(frame::Frame& frame, const frame::ShadowMapSettings& map) override;
  void setUniforms(const gl::Program& program) const override;
  /// `counts` is null in a plain frame.
  void run(frame::Frame& frame, const CountImages* counts);

  frame::ShadowMapSettings map_;
  BiasForm bias_;
  VisibilityPass pass_;
  int pyramidLevels_ = 0;
  PixelCounts counted_;
};

}  // namespace limen::techniques
