// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/surface_light.h"

#include <string>

#include "renderer/frame/mirror_trace.h"

namespace limen::techniques {

gl::ShaderDefines surfaceLightDefines(const frame::SurfaceLightSettings& settings,
                                      const frame::Frame& frame) {
  gl::ShaderDefines defines = frame::mirrorTraceDefines(settings.lamp(), frame);
  if (frame.scene().traits().count("refractive_materials") != 0) defines["TRANSPARENT"] = "1";
  defines["MOST_PASSAGES"] = std::to_string(frame::kMostPassages);
  return defines;
}

void configureSurfaceLight(const gl::Program& program, frame::Frame& frame,
                           const frame::SurfaceLightSettings& settings, const ray_tracing::RayTree* tree) {
  frame::configureMirrorTrace(program, frame, settings.lamp(), tree);
  program.set("sizePx", frame.sizePx());
}

}  // namespace limen::techniques
