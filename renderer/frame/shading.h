// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/shaded.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/program.h"

namespace limen::frame {

// What Shaded is made of, for shaders that light a few surfaces of a scene as it does.

/// Defines of shaded_surface.glsl.
gl::ShaderDefines shadingDefines(const Frame& frame, const ShadedSetting& setting);
/// Uniforms of shaded_surface.glsl; binds the buffers that it reads.
void bindShading(const gl::Program& program, const Frame& frame, const ShadedSetting& setting);
/// Uniforms of shadow_lookup.glsl.
void setShadowLookup(const gl::Program& program, const LightFrustum& frustum, int resolution);

}  // namespace limen::frame
