// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/far_environment.h"

#include <epoxy/gl.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace limen::techniques {
namespace {

/// Clip space of a face of a cube map around `centre`, whose picture has row 0 at the top, t growing down, as
/// the context's clip control has it.
glm::mat4 anchorToFace(int face, glm::dvec3 centre, double nearest) {
  const glm::dvec3 forward = reflections::cubeDirection({face, 0.0, 0.0});
  const glm::dvec3 alongS = reflections::cubeDirection({face, 1.0, 0.0}) - forward;
  const glm::dvec3 alongT = reflections::cubeDirection({face, 0.0, 1.0}) - forward;
  // Rows: s, -t (clip y points up), reversed depth, distance.
  glm::dmat4 out(0.0);
  for (int i = 0; i < 3; ++i) {
    out[i][0] = alongS[i];
    out[i][1] = -alongT[i];
    out[i][3] = forward[i];
  }
  out[3][2] = nearest;
  return glm::mat4(out * glm::translate(glm::dmat4(1.0), -centre));
}

}  // namespace

FarEnvironment::FarEnvironment(frame::Frame& frame, const StarReflector& reflector,
                               const FarSurroundings& settings, const frame::ShadedSetting& shading) {
  const int n = settings.resolution;
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &id_);
  glTextureStorage2D(id_, 1, GL_RGBA32F, n, n);
  for (const GLenum name : {GL_TEXTURE_MAG_FILTER, GL_TEXTURE_MIN_FILTER})
    glTextureParameteri(id_, name, GL_LINEAR);
  bytes_ = int64_t{6} * n * n * 16;
  const std::string folder = "renderer/techniques/reflections/vertex_reflection/";
  const gl::Program& program = frame.context().programs().get(
      {folder + "far_faces.vert.glsl", folder + "far_faces.frag.glsl"}, shadingDefines(shading, frame));
  const gl::Texture colour(gl::Format::RGBA32F, {n, n}), depth(gl::Format::Depth32F, {n, n});
  const gl::Framebuffer target({&colour}, &depth);
  frame::configureShading(program, frame, shading);
  const glm::dvec3 centre = reflector.centre.position - frame.gpuScene().anchor();
  // Highlights as the reflector sees them.
  program.set("eye", glm::vec3(centre));
  program.set("faceCentre", glm::vec3(centre));
  program.set("fadeStart", static_cast<float>(settings.distance * reflector.centre.meanRadius));
  program.set("reflectorFirst", reflector.triangles.first);
  program.set("reflectorCount", reflector.triangles.count);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  for (int face = 0; face < 6; ++face) {
    target.bind();
    const glm::vec4 nothing(0.0F);
    constexpr GLfloat kFar = 0.0F;  // reversed depth
    glClearBufferfv(GL_COLOR, 0, &nothing.x);
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    program.use();
    program.set("anchorToFace", anchorToFace(face, centre, 1e-3 * reflector.centre.meanRadius));
    frame.gpuScene().draw();
    glCopyImageSubData(colour.id(), GL_TEXTURE_2D, 0, 0, 0, 0, id_, GL_TEXTURE_CUBE_MAP, 0, 0, 0, face, n, n,
                       1);
  }
  glDisable(GL_DEPTH_TEST);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

FarEnvironment::~FarEnvironment() {
  if (id_) glDeleteTextures(1, &id_);
}

void FarEnvironment::bindTexture(uint32_t unit) const { glBindTextureUnit(unit, id_); }

}  // namespace limen::techniques
