// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/mirror_trace.h"

#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/surface_point.h"
#include "renderer/ray_tracing/ray_scene.h"

namespace limen::techniques {

gl::ShaderDefines mirrorTraceDefines(const frame::ShadedSetting& shading, const frame::Frame& frame) {
  gl::ShaderDefines defines = frame::shadingDefines(shading, frame);
  defines.merge(frame::surfaceDefines(frame, true));
  defines.erase("SHADOW");  // of shadow maps
  return defines;
}

void configureMirrorTrace(const gl::Program& program, frame::Frame& frame,
                          const frame::ShadedSetting& shading) {
  frame::configureShading(program, frame, shading);
  program.set("flatShading", shading.smoothNormals ? 0 : 1);
  frame::configureRayOrigins(program, frame.gpuScene());
  frame.gpuScene().rays(frame.context()).bind(program);
}

}  // namespace limen::techniques
