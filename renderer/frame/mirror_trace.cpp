// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/mirror_trace.h"

#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/surface_point.h"
#include "renderer/ray_tracing/ray_scene.h"

namespace limen::frame {

gl::ShaderDefines mirrorTraceDefines(const ShadedSetting& shading, const Frame& frame) {
  gl::ShaderDefines defines = shadingDefines(shading, frame);
  defines.merge(surfaceDefines(frame, true));
  defines.erase("SHADOW");  // of shadow maps
  return defines;
}

void configureMirrorTrace(const gl::Program& program, Frame& frame, const ShadedSetting& shading,
                          const ray_tracing::RayTree* tree) {
  configureShading(program, frame, shading);
  program.set("flatShading", shading.smoothNormals ? 0 : 1);
  configureRayOrigins(program, frame.gpuScene());
  (tree ? *tree : frame.gpuScene().rays(frame.context())).bind(program);
}

}  // namespace limen::frame
