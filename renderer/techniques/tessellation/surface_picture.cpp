// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/surface_picture.h"

#include <epoxy/gl.h>

#include <array>
#include <set>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {
namespace {

/// Triangles of the parts that are not made of patches.
std::vector<scene::TriangleRange> meshRanges(const scene::Scene& scene) {
  std::set<uint32_t> curved;
  for (const surfaces::Patch& patch : scene.surfaces.patches) curved.insert(patch.part);
  for (const surfaces::SubdivisionSurface& surface : scene.subdivisions) curved.insert(surface.part);
  std::vector<scene::TriangleRange> out;
  for (uint32_t part = 0; part < scene.parts.size(); ++part)
    if (!curved.contains(part))
      out.push_back({scene.parts[part].firstTriangle, scene.parts[part].triangleCount});
  return out;
}

}  // namespace

SurfacePicture::SurfacePicture(frame::Frame& frame, const frame::ShadedSetting& shading,
                               const std::string& pass)
    : SurfacePicture(frame, shading, pass, frame::Raster::Hardware) {}

SurfacePicture::SurfacePicture(frame::Frame& frame, const frame::ShadedSetting& shading,
                               const std::string& pass, frame::Raster raster, bool textured)
    : shading_(shading),
      pass_(pass),
      meshProgram_(frame.context().programs().get(
          {"renderer/frame/triangle_ids.vert.glsl", "renderer/frame/triangle_ids.frag.glsl"})),
      shadeProgram_(frame.context().programs().compute(
          "renderer/techniques/tessellation/surface_shade.comp.glsl", frame::shadingDefines(shading, frame))),
      mesh_(frame.scene().parts.size()),
      ids_(gl::Format::R32UI, frame.sizePx()),
      normals_(gl::Format::RGBA32F, frame.sizePx()),
      depth_(gl::Format::Depth32F, frame.sizePx()),
      picture_(gl::Format::RGBA32F, frame.sizePx()),
      framebuffer_({&ids_, &normals_}, &depth_) {
  mesh_.set(meshRanges(frame.scene()));
  if (raster == frame::Raster::Compute) {
    constexpr int kVertexWords = sizeof(TessellatedVertex) / sizeof(float);
    gl::Context& context = frame.context();
    std::optional<frame::ComputeRaster> mesh;
    if (mesh_.triangleCount() > 0)
      mesh.emplace(context, frame.sizePx(), frame::ComputeRasterSettings{.ids = true, .textures = false});
    const bool inOnePass = frame::ComputeRaster::canPack() && !frame.gpuScene().surface().hasAttributes();
    frame::ComputeRaster surface(context, frame.sizePx(),
                                 {.ids = true,
                                  .listedVertexWords = kVertexWords,
                                  .textures = false,
                                  .sharesWith = inOnePass && mesh ? &*mesh : nullptr});
    gl::ShaderDefines defines;
    if (textured) defines["TEXTURED"] = "1";
    if (surface.packed()) defines["PACKED"] = "1";
    if (mesh) defines["MESH"] = "1";
    const gl::Program& resolve =
        context.programs().compute("renderer/techniques/tessellation/surface_resolve.comp.glsl", defines);
    gl::ShaderDefines colours = frame::shadingDefines(shading, frame);
    if (!mesh) colours["SURFACES_ALONE"] = "1";
    if (textured) colours["TEXTURED"] = "1";
    compute_.emplace(
        Compute{resolve, std::move(mesh), std::move(surface),
                inOnePass ? &context.programs().compute(
                                "renderer/techniques/tessellation/surface_in_one_pass.comp.glsl", colours)
                          : nullptr});
  }
  frame.passes().setBytesHeld(pass_ + "/raster",
                              ids_.bytes() + normals_.bytes() + depth_.bytes() +
                                  (compute_ ? compute_->surface.bytes() : 0) +
                                  (compute_ && compute_->mesh ? compute_->mesh->bytes() : 0));
  frame.passes().setBytesHeld(pass_ + "/shade", picture_.bytes());
}

void SurfacePicture::render(frame::Frame& frame, const std::function<void()>& draw) {
  {
    const auto scope = frame.passes().open(pass_ + "/raster");
    framebuffer_.bind();
    constexpr std::array<GLuint, 4> kBackground = {frame::TriangleIds::kNone, 0, 0, 0};
    constexpr GLfloat kFar = 0.0F;  // reversed depth: 0 is infinitely far
    constexpr std::array<GLfloat, 4> kNothing = {};
    glClearBufferuiv(GL_COLOR, 0, kBackground.data());
    glClearBufferfv(GL_COLOR, 1, kNothing.data());
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDisable(GL_CULL_FACE);
    meshProgram_.use();
    meshProgram_.set("anchorToClip", frame::anchorToClip(frame));
    glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // its shader writes no normals
    frame.gpuScene().draw(&mesh_);
    glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    draw();
    glDisable(GL_DEPTH_TEST);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
  shade(frame);
}

void SurfacePicture::startMesh(frame::Frame& frame) {
  if (!compute_->inOnePass || !compute_->mesh) return;
  const auto scope = frame.passes().open(pass_ + "/mesh");
  compute_->mesh->drawStep({frame.gpuScene(), &mesh_, nullptr}, frame::anchorToClip(frame),
                           frame::nearPlane(frame), frame::ComputeRaster::Step::Small);
  meshStarted_ = true;
}

void SurfacePicture::finishMesh(frame::Frame& frame) {
  if (!meshStarted_) return;
  const auto scope = frame.passes().open(pass_ + "/mesh_bands");
  compute_->mesh->drawStep({frame.gpuScene(), &mesh_, nullptr}, frame::anchorToClip(frame),
                           frame::nearPlane(frame), frame::ComputeRaster::Step::Large);
  meshFinished_ = true;
}

void SurfacePicture::renderInOnePass(frame::Frame& frame, const frame::ListedTriangles& triangles) {
  using Step = frame::ComputeRaster::Step;
  const bool meshDrawn = meshFinished_;
  if (!meshDrawn) startMesh(frame);
  {
    const auto scope = frame.passes().open(pass_ + "/raster");
    const glm::mat4 clip = frame::anchorToClip(frame);
    compute_->surface.drawListedStep(triangles, clip, frame::nearPlane(frame), Step::Small);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    compute_->surface.drawListedStep(triangles, clip, frame::nearPlane(frame), Step::Large);
  }
  if (!meshDrawn) finishMesh(frame);
  meshStarted_ = meshFinished_ = false;
  const auto scope = frame.passes().open(pass_ + "/shade");
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  const gl::Program& program = *compute_->inOnePass;
  frame::configureShading(program, frame, shading_);
  const glm::uvec2 queues = (compute_->mesh ? *compute_->mesh : compute_->surface).queuePlaces();
  program.set("firstQueue", queues.x);
  program.set("secondQueue", queues.y);
  compute_->surface.bindPixels(kPictureGatheredBuffer);
  triangles.vertices.bindStorage(kPictureVerticesBuffer);
  triangles.indices.bindStorage(kPictureIndicesBuffer);
  picture_.bindImage(kSurfacePictureImage, gl::Access::Write);
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

void SurfacePicture::renderListed(frame::Frame& frame, const frame::ListedTriangles& triangles) {
  if (compute_->inOnePass) {
    renderInOnePass(frame, triangles);
    return;
  }
  {
    const auto scope = frame.passes().open(pass_ + "/raster");
    const glm::mat4 clip = frame::anchorToClip(frame);
    if (compute_->mesh)
      compute_->mesh->draw({frame.gpuScene(), &mesh_, nullptr}, clip, frame::nearPlane(frame));
    compute_->surface.drawListed(triangles, clip, frame::nearPlane(frame));
    const gl::Program& resolve = compute_->resolve;
    resolve.set("sizePx", frame.sizePx());
    resolve.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
    resolve.set("anchorToCamera", glm::mat4(frame.anchorToCamera()));
    compute_->surface.bindGathered(
        {kResolveSurfaceDepthsBuffer, kResolveSurfaceIdsBuffer, kResolveSurfaceQueueBuffer});
    if (compute_->mesh)
      compute_->mesh->bindGathered(
          {kResolveMeshDepthsBuffer, kResolveMeshIdsBuffer, kResolveMeshQueueBuffer});
    ids_.bindImage(kResolveIdsImage, gl::Access::Write);
    normals_.bindImage(kResolveNormalsImage, gl::Access::Write);
    triangles.vertices.bindStorage(kResolveVerticesBuffer);
    triangles.indices.bindStorage(kResolveIndicesBuffer);
    resolve.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }
  shade(frame);
}

uint32_t SurfacePicture::countTriangles(frame::Frame& frame, const std::function<void()>& draw) {
  uint32_t query = 0, triangles = 0;
  glGenQueries(1, &query);
  render(frame, [&] {
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    draw();
    glEndQuery(GL_PRIMITIVES_GENERATED);
  });
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
  glDeleteQueries(1, &query);
  return triangles;
}

void SurfacePicture::shade(frame::Frame& frame) {
  const auto scope = frame.passes().open(pass_ + "/shade");
  frame::configureShading(shadeProgram_, frame, shading_);
  ids_.bindTexture(kSurfaceIdsUnit);
  normals_.bindTexture(kSurfaceNormalsUnit);
  picture_.bindImage(kSurfacePictureImage, gl::Access::Write);
  shadeProgram_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
