// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/shaded.h"
#include "renderer/gl/program.h"

namespace limen::ray_tracing {
class RayTree;
}

namespace limen::frame {

/// For programs that include mirror_trace.glsl: its defines, and its uniforms, storage and tree. `tree`:
/// null: the one that the scene keeps, of its triangles at rest.
gl::ShaderDefines mirrorTraceDefines(const ShadedSetting& shading, const Frame& frame);
void configureMirrorTrace(const gl::Program& program, Frame& frame, const ShadedSetting& shading,
                          const ray_tracing::RayTree* tree = nullptr);

}  // namespace limen::frame
