// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/tessellation/compute/compute_settings.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

/// What the fragments of trimmed surfaces look up (SC-18): for each vertex its place in the surface's own
/// parameters, and of each surface a layer of a texture over these. Fragments that are trimmed away are
/// discarded, so that neither depth nor multisampling knows the trimmed edge but by pixel centres.
class TrimPass {
 public:
  TrimPass(frame::Frame& frame, const TrimByTexture& settings, const gl::ShaderDefines& defines,
           int64_t vertexCapacity);
  /// Opens the pass tessellation/trims. Factors, offsets and totals are bound; ends with a barrier for
  /// vertex attributes.
  void run(frame::Frame& frame, int cornerFix, int invocations) const;
  /// To be read as attribute 3 of a vertex array.
  const gl::Buffer& places() const { return places_; }
  /// For surface.frag.glsl with TRIMMED.
  void bindTexture() const { texture_.bindTexture(kTrimsUnit); }
  int64_t bytes() const { return patchTrims_.bytes() + places_.bytes() + texture_.bytes(); }
  /// Largest share of a surface's domain for which the texture says otherwise than its curves.
  double error() const;

 private:
  const surfaces::PatchSet& set_;
  surfaces::TrimTest test_;
  const gl::Program& program_;
  gl::Buffer patchTrims_, places_;
  gl::Texture texture_;
};

}  // namespace limen::techniques
