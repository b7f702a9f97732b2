// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {

/// Acceleration structure: what tells the depth range of an area of the shadow map.
enum class Structure { None, Hsm, Mssm, NBuffer, Ysm };

/// Base of the techniques that backproject the shadow map's texels onto the light: finds the texels that can
/// matter for a receiver by an acceleration structure and loops over them as micro-occluders. What a
/// micro-occluder does to the visibility is the shader's own (area, bitmask). Source: Schwarz 2009,
/// sections 4.1 to 4.4.
class OccluderSearch : public VisibilityTechnique {
 public:
  /// `occluders` are the kinds that the shader can gather.
  static std::vector<Parameter> searchParameters(std::vector<std::string> occluders);
  /// Throws Error where values of these parameters do not go together.
  static void checkSearch(const ParameterValues& values);
  /// Those of every visibility technique, and structure_bytes: the minimum/maximum pyramid, of which every
  /// structure needs the minimum for micro-occluders, and the layers on top of it; of all maps together.
  static std::vector<std::string> counterNames();

  std::vector<Counter> count(frame::Frame& frame) override;
  /// Search areas in the colours of the thesis's figure 4.10 and levels as in figure 4.11, once count() ran.
  std::map<std::string, Image> pictures() const override;

 protected:
  OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                 gl::ShaderDefines defines = {});
  const frame::LightFrustum& bindMap(frame::Frame& frame) override;
  void configure(const gl::Program& program) const override;

 private:
  int budget_, refinements_, roughQueries_;
  Structure structure_;
  int base_;  // resolution of the layers
  int levels_ = 0, baseLevel_ = 0, maxIterations_ = 0;
  std::vector<int64_t> structureBytes_;  // of each map
};

}  // namespace limen::techniques
