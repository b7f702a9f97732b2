// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/frame/bias_map.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// By how much an occluder must be nearer to the light than a receiver to count, beyond the constant share of
/// the receiver's distance that all forms have: by the receiver's slope, by nothing, by a factor for each
/// level, or by what each texel stores. Only the test is biased; what is backprojected lies at its own depth.
/// Source: Schwarz 2009, section 4.5.4.
class BiasForm {
 public:
  /// `values` must hold parameters() and those of every visibility technique.
  explicit BiasForm(const ParameterValues& values);
  static std::vector<Parameter> parameters();
  /// Throws Error where values of these parameters do not go together; `defaultSlopeBias` is the technique's.
  static void check(const ParameterValues& values, double defaultSlopeBias);

  gl::ShaderDefines defines() const;
  /// Makes what is stored for texels; binds nothing that lasts.
  void make(frame::Frame& frame, const frame::ShadowMapSettings& map);
  /// To texture unit 12.
  void bind() const;
  void configure(const gl::Program& program) const;
  /// Of stored biases; 0 for other forms.
  int64_t bytes() const { return stored_ ? stored_->bytes() : 0; }

 private:
  bool byLevel_, isStored_;
  float growth_, scale_;
  float constant_, maxSlope_;
  const frame::BiasLevels* stored_ = nullptr;
};

}  // namespace limen::techniques
