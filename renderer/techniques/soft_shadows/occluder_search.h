// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// Base of the techniques that backproject the shadow map's texels onto the light: finds the texels that can
/// matter for a receiver by the min/max pyramid and loops over them as micro-occluders. What a micro-occluder
/// does to the visibility is the shader's own (area, bitmask). Source: Schwarz 2009, sections 4.1, 4.2 and
/// 4.4.
class OccluderSearch : public VisibilityTechnique {
 public:
  /// `occluders` are the kinds that the shader can gather.
  static std::vector<Parameter> searchParameters(std::vector<std::string> occluders);
  /// Throws Error where values of these parameters do not go together.
  static void checkSearch(const ParameterValues& values);

 protected:
  OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                 gl::ShaderDefines defines = {});
  const frame::LightFrustum& bindMap(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;

 private:
  int budget_, refinements_;
  int levels_ = 0, maxIterations_ = 0;
};

}  // namespace limen::techniques
