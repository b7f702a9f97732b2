// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/light_paths.h"
#include "renderer/gl/program.h"

namespace limen::ray_tracing {
class RayTree;
}

namespace limen::techniques {

/// For programs that include surface_light.glsl: its defines, and its uniforms, storage and tree. `tree`:
/// null: the one that the scene keeps, of its triangles at rest.
gl::ShaderDefines surfaceLightDefines(const frame::SurfaceLightSettings& settings, const frame::Frame& frame);
void configureSurfaceLight(const gl::Program& program, frame::Frame& frame,
                           const frame::SurfaceLightSettings& settings,
                           const ray_tracing::RayTree* tree = nullptr);

}  // namespace limen::techniques
