// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"

namespace limen::frame {

/// For passes that find points of surfaces with surface_point.glsl: its defines, and its uniforms and storage
/// (buffers of the scene and of its surfaces, frame_bindings.h).
gl::ShaderDefines surfaceDefines(const Frame& frame, bool smoothNormals);
/// `seenBy`: whose eye sees highlights.
void configureSurfacePoints(const gl::Program& program, const Frame& frame, const scene::Camera& seenBy);

}  // namespace limen::frame
