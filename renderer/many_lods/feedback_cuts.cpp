// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/feedback_cuts.h"

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <string>

#include "experiments/base/error.h"
#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {
namespace {

constexpr int64_t kPointBytes = 8;

std::vector<glm::uvec2> rootsOf(uint32_t views) {
  std::vector<glm::uvec2> out;
  out.reserve(views);
  for (uint32_t view = 0; view < views; ++view) out.emplace_back(kRootNode, view);
  return out;
}

void checkTexels(int64_t texels) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (texels > most)
    throw Error(
        "geometry shaders read the tree and the views from buffer textures, of which this device allows " +
            std::to_string(most) + " texels; " + std::to_string(texels) + " are needed",
        "cuts", "lower 'levels' or the number of views, or choose other cuts");
}

}  // namespace

FeedbackCuts::FeedbackCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
                           const GeometryShaderCuts& settings)
    : settings_(settings),
      capacity_(capacity),
      views_(views),
      passes_(static_cast<uint32_t>(shape.height) + 1),
      roots_(rootsOf(views)),
      counts_(8 * int64_t{passes_}, nullptr),
      control_(int64_t{sizeof(CutControl)}, nullptr) {
  if (shape.links)
    throw Error("geometry shaders walk complete trees only", "cuts", "choose other cuts, or a balanced tree");
  checkTexels(int64_t{2} << shape.height);
  checkTexels(5 * int64_t{views});
  for (int i = 0; i < 2; ++i)
    for (std::vector<gl::Buffer>* buffers : {&open_, &finished_, &lists_})
      buffers->emplace_back(kPointBytes * capacity, nullptr);
  const std::string path = "renderer/many_lods/feedback_cut";
  classify_ = &context.programs().get({path + ".vert.glsl", path + ".geom.glsl"});
  append_ = &context.programs().get({path + ".vert.glsl"}, {{"APPEND", "1"}});
  count_ = &context.programs().compute("renderer/many_lods/feedback_count.comp.glsl");
  classify_->set("leaves", 1U << shape.height);
  glCreateTransformFeedbacks(2, passObjects_.data());
  glCreateTransformFeedbacks(2, listObjects_.data());
  for (size_t i = 0; i < 2; ++i) {
    glTransformFeedbackBufferBase(passObjects_[i], 0, open_[i].id());
    glTransformFeedbackBufferBase(passObjects_[i], 1, finished_[i].id());
    glTransformFeedbackBufferBase(listObjects_[i], 0, lists_[i].id());
  }
  queries_.resize(2 * size_t{passes_});
  glCreateQueries(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, static_cast<GLsizei>(queries_.size()),
                  queries_.data());
  // Draws need a complete framebuffer even if nothing is rasterised.
  glCreateFramebuffers(1, &framebuffer_);
  glNamedFramebufferParameteri(framebuffer_, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
  glNamedFramebufferParameteri(framebuffer_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  glCreateVertexArrays(1, &vertices_);
  glEnableVertexArrayAttrib(vertices_, 0);
  glVertexArrayAttribIFormat(vertices_, 0, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(vertices_, 0, 0);
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &nodesTexture_);
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &viewsTexture_);
}

FeedbackCuts::~FeedbackCuts() {
  glDeleteTransformFeedbacks(2, passObjects_.data());
  glDeleteTransformFeedbacks(2, listObjects_.data());
  glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteVertexArrays(1, &vertices_);
  glDeleteTextures(1, &nodesTexture_);
  glDeleteTextures(1, &viewsTexture_);
}

int64_t FeedbackCuts::bytes() const {
  return roots_.bytes() + counts_.bytes() + control_.bytes() + 6 * kPointBytes * int64_t{capacity_};
}

void FeedbackCuts::update(const gl::Buffer& nodes, const gl::Buffer& views, bool) {
  const bool fromRoot = fresh_ || settings_.start == FeedbackStart::Root;
  fresh_ = false;
  const size_t before = now_;
  now_ = 1 - now_;
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TRANSFORM_FEEDBACK_BARRIER_BIT |
                  GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  glTextureBuffer(nodesTexture_, GL_RGBA32F, nodes.id());
  glTextureBuffer(viewsTexture_, GL_RGBA32F, views.id());
  glBindTextureUnit(kFeedbackNodesUnit, nodesTexture_);
  glBindTextureUnit(kFeedbackViewsUnit, viewsTexture_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
  glBindVertexArray(vertices_);
  glEnable(GL_RASTERIZER_DISCARD);
  const auto read = [&](const gl::Buffer& from) {
    glVertexArrayVertexBuffer(vertices_, 0, from.id(), 0, kPointBytes);
  };
  for (uint32_t pass = 0; pass < passes_; ++pass) {
    const size_t here = pass % 2;
    classify_->use();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, passObjects_[here]);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries_[2 * size_t{pass}]);
    glBeginTransformFeedback(GL_POINTS);
    if (pass > 0) {
      read(open_[1 - here]);
      glDrawTransformFeedbackStream(GL_POINTS, passObjects_[1 - here], 0);
    } else if (fromRoot) {
      read(roots_);
      glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(views_));
    } else {
      read(lists_[before]);
      glDrawTransformFeedback(GL_POINTS, listObjects_[before]);
    }
    glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    append_->use();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, listObjects_[now_]);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, queries_[2 * size_t{pass} + 1]);
    if (pass == 0)
      glBeginTransformFeedback(GL_POINTS);
    else
      glResumeTransformFeedback();
    read(finished_[here]);
    glDrawTransformFeedbackStream(GL_POINTS, passObjects_[here], 1);
    if (pass + 1 < passes_)
      glPauseTransformFeedback();
    else
      glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  }
  glDisable(GL_RASTERIZER_DISCARD);
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
  glBindVertexArray(0);
  for (size_t i = 0; i < queries_.size(); ++i)
    glGetQueryBufferObjectuiv(queries_[i], counts_.id(), GL_QUERY_RESULT, static_cast<GLintptr>(4 * i));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_QUERY_BUFFER_BARRIER_BIT);
  counts_.bindStorage(kCutTilesBuffer);
  control_.bindStorage(kCutControlBuffer);
  lists_[now_].bindStorage(kCutListBuffer);
  count_->set("passes", passes_);
  count_->set("capacity", capacity_);
  count_->use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

}  // namespace limen::many_lods
