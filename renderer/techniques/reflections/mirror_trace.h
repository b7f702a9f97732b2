// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/shaded.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// For programs that include mirror_trace.glsl: its defines, and its uniforms, storage and tree.
gl::ShaderDefines mirrorTraceDefines(const frame::ShadedSetting& shading, const frame::Frame& frame);
void configureMirrorTrace(const gl::Program& program, frame::Frame& frame,
                          const frame::ShadedSetting& shading);

}  // namespace limen::techniques
