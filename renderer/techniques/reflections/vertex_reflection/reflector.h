// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/techniques/reflections/vertex_reflection/reflected_mesh.h"
#include "renderer/techniques/reflections/vertex_reflection/reflector_texture.h"
#include "renderer/techniques/reflections/vertex_reflection/star_mesh.h"
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_settings.h"

namespace limen::techniques {

/// A part of the scene that reflects, ready for the solver.
struct StarReflector {
  scene::TriangleRange triangles;
  reflections::StarCentre centre;  ///< world space
  std::shared_ptr<const reflections::StarMesh> mesh;
  double filledShare = 0.0;
  ReflectorTexture map;
  reflections::ReflectedMesh::Range ownVertices;  ///< which are not reflected in it
  gl::Buffer reflected;  ///< vec4 a vertex of the reflected mesh, see vertex_reflection_bindings.h
};

/// One for each part of `shown` whose material reflects. Throws Error if a part is not star-shaped.
std::vector<StarReflector> makeReflectors(const scene::Scene& scene, const ReflectorMapSettings& settings,
                                          const reflections::ReflectedMesh& mesh,
                                          const frame::ShownMirrors& shown = {});

/// Defines and uniforms of secant.glsl. `eyeOffset`: of the solver's eye from the camera's, world space.
gl::ShaderDefines secantDefines(const SecantSettings& solver, const ReflectorMapSettings& map);
void configureSecant(const gl::Program& program, const frame::Frame& frame, const SecantSettings& solver,
                     const StarReflector& reflector, glm::dvec3 eyeOffset = glm::dvec3(0.0));

}  // namespace limen::techniques
