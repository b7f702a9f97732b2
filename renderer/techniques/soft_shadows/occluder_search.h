// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// Base of the techniques that backproject the shadow map's texels onto the light: finds the texels that can
/// matter for a receiver by the min/max pyramid and loops over them as micropatches. What a micropatch does
/// to the visibility is the shader's own (area, bitmask). Source: Schwarz 2009, sections 4.1 and 4.2.
class OccluderSearch : public VisibilityTechnique {
 public:
  static std::vector<Parameter> searchParameters();

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
