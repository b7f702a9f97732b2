// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/frame/shadow_map.h"
#include "renderer/gl/program.h"
#include "renderer/techniques/soft_shadows/pixel_counts.h"

namespace limen::techniques {

/// What a visibility shader reads besides receivers: the shadow map and everything specific to the technique.
class PassInputs {
 public:
  virtual ~PassInputs() = default;
  /// Makes and binds the map and associated inputs, from texture unit 1; returns its frustum.
  virtual const frame::LightFrustum& bindInputs(frame::Frame& frame, const frame::ShadowMapSettings& map) = 0;
  /// Sets the uniforms, biases among them.
  virtual void setUniforms(const gl::Program& program) const = 0;
};

/// A compute shader over the receivers into a visibility image. The shader includes shadow_lookup.glsl, which
/// declares what this class binds:
///   texture unit 0: receivers; from unit 1: what PassInputs binds
///   image unit 0: visibility; units 1 and 2, if COUNT is defined: CountImages
class VisibilityPass {
 public:
  /// `shader` is a path from the repository root, `name` the one in the pass list.
  VisibilityPass(std::string shader, std::string name, gl::ShaderDefines defines);

  const std::string& name() const { return name_; }
  /// Adds defines for the shader; call before prepare().
  void define(const gl::ShaderDefines& more);
  /// Allocates the visibility image.
  void prepare(frame::Frame& frame);
  /// What run() dispatches in plain frames.
  void compile(frame::Frame& frame) { plain_ = &program(frame, false); }
  /// Valid from prepare() on.
  const gl::Texture& visibility() const { return *visibility_; }

  /// The shader; compiles it the first time.
  const gl::Program& program(frame::Frame& frame, bool counting, const gl::ShaderDefines& more = {}) const;
  /// Makes everything that bind() will bind, outside of any pass.
  static void makeInputs(frame::Frame& frame, PassInputs& inputs, const frame::ShadowMapSettings& map);
  /// `counts` is null in a plain frame.
  void bind(frame::Frame& frame, const gl::Program& program, PassInputs& inputs,
            const frame::ShadowMapSettings& map, const CountImages* counts) const;
  /// One dispatch over all pixels; after compile().
  void run(frame::Frame& frame, PassInputs& inputs, const frame::ShadowMapSettings& map,
           const CountImages* counts) const;

 private:
  std::string shader_, name_;
  gl::ShaderDefines defines_;
  std::optional<gl::Texture> visibility_;
  const gl::Program* plain_ = nullptr;
};

/// Sets the uniforms of shadow_lookup.glsl for a map of this frustum.
void setMapUniforms(const gl::Program& program, const frame::Frame& frame, const frame::LightFrustum& frustum,
                    const frame::ShadowMapSettings& map);

/// Levels of the pyramid that was bound, and its frustum.
struct BoundPyramid {
  const frame::LightFrustum& frustum;
  int levels;
};
/// The map's pyramid: minimum at texture unit 1, maximum at 2. Making it binds textures too: call this first,
/// or after it has been made.
BoundPyramid bindPyramid(frame::Frame& frame, const frame::ShadowMapSettings& map);
/// Number of iterations that a shader loop may have: llvmpipe silently exits any loop after 65,535.
int maxLoopIterations(frame::Frame& frame);

}  // namespace limen::techniques
