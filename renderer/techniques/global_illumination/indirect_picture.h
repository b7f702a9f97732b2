// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "renderer/frame/light_paths.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::ray_tracing {
class RayTree;
}

namespace limen::techniques {

/// The picture of a technique whose shader includes indirect_picture.glsl (or indirect_point.glsl alone):
/// what each pixel sees, lit by the lamp, by itself and by what the shader's indirectLight() gathers, as the
/// settings choose.
class IndirectPicture {
 public:
  /// `pass`: under which it is timed; it has to outlive this.
  IndirectPicture(frame::Frame& frame, const std::string& shader, const gl::ShaderDefines& defines,
                  const frame::SurfaceLightSettings& lighting, const char* pass);

  /// `configure` sets what indirectLight() needs; `tree`: see configureSurfaceLight(). `after`: further
  /// passes over the picture, which is bound as an image, timed as part of this one.
  void render(frame::Frame& frame, const std::function<void(const gl::Program&)>& configure,
              const ray_tracing::RayTree* tree = nullptr, const std::function<void()>& after = {}) const;
  /// A program for these, which includes indirect_point.glsl.
  const gl::Program& program(frame::Frame& frame, const std::string& shader,
                             const gl::ShaderDefines& defines) const;
  void configure(const gl::Program& program, frame::Frame& frame, const ray_tracing::RayTree* tree) const;
  const gl::Texture& texture() const { return picture_; }

 private:
  frame::SurfaceLightSettings lighting_;
  const gl::Program& program_;
  const char* pass_;
  gl::Texture picture_;
};

}  // namespace limen::techniques
