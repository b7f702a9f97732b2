// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by a geometry shader that drops invalid items and transform feedback that captures the
// others (Roger 2008, section 4.2).
#include "experiments/base/error.h"
#include "renderer/compute/buffer_texture.h"
#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

/// Names of the driver that are deleted with it.
struct FeedbackObjects {
  FeedbackObjects() {
    glCreateTransformFeedbacks(1, &feedback);
    glCreateQueries(GL_PRIMITIVES_GENERATED, 1, &query);
    // Draws need a complete framebuffer even if nothing is rasterised.
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(framebuffer, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  }
  ~FeedbackObjects() {
    glDeleteTransformFeedbacks(1, &feedback);
    glDeleteQueries(1, &query);
    glDeleteFramebuffers(1, &framebuffer);
  }
  FeedbackObjects(const FeedbackObjects&) = delete;
  FeedbackObjects& operator=(const FeedbackObjects&) = delete;
  GLuint feedback = 0, query = 0, framebuffer = 0;
};

class GeometryShaderForm : public StreamReduction::BackEnd {
 public:
  GeometryShaderForm(gl::Context& context, uint32_t most, const ReductionSettings& settings)
      : lanes_(settings.lanes),
        items_(lanes_ == 1 ? GL_R32UI : GL_RG32UI),
        flags_(GL_R32UI),
        count_(GL_R32UI),
        generated_(4, nullptr),
        noRoom_(16, nullptr) {
    if (int64_t{most} + 4 > BufferTexture::mostTexels())
      throw Error("the driver reads at most " + std::to_string(BufferTexture::mostTexels()) +
                      " items from a buffer texture",
                  {}, "another form of stream reduction has no such limit");
    const std::string path = "renderer/compute/reduction_feedback";
    const gl::ShaderDefines defines = reductionDefines(settings);
    program_ = &context.programs().get({path + ".vert.glsl", path + ".geom.glsl"}, defines);
    finish_ = &context.programs().compute(path + "_count.comp.glsl", {{"LANES", std::to_string(lanes_)}});
  }

  void run(const StreamInput& in, const StreamOutput& out) const override {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TRANSFORM_FEEDBACK_BARRIER_BIT);
    items_.bind(kReductionItemsUnit, in.items);
    flags_.bind(kReductionFlagsUnit, in.flags ? *in.flags : in.items);
    count_.bind(kReductionCountUnit, in.count ? *in.count : out.count);
    setStream(*program_, in, out);
    program_->use();
    // What does not fit is not captured; a binding has some bytes, however.
    const int64_t room = int64_t{out.capacity} * lanes_ * 4;
    glTransformFeedbackBufferRange(objects_.feedback, 0, room > 0 ? out.items.id() : noRoom_.id(), 0,
                                   room > 0 ? room : noRoom_.bytes());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, objects_.framebuffer);
    noVertices_.bind();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, objects_.feedback);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginQuery(GL_PRIMITIVES_GENERATED, objects_.query);
    glBeginTransformFeedback(GL_POINTS);
    if (in.most > 0) glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(in.most));
    glEndTransformFeedback();
    glEndQuery(GL_PRIMITIVES_GENERATED);
    glDisable(GL_RASTERIZER_DISCARD);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glBindVertexArray(0);
    glGetQueryBufferObjectuiv(objects_.query, generated_.id(), GL_QUERY_RESULT, 0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_QUERY_BUFFER_BARRIER_BIT);
    bindStream(in, out);
    generated_.bindStorage(kReductionStateBuffer);
    finish_->use();
    setStream(*finish_, in, out);
    glDispatchCompute(1, 1, 1);
  }

  int64_t bytes() const override { return generated_.bytes() + noRoom_.bytes(); }

 private:
  int lanes_;
  BufferTexture items_, flags_, count_;
  NoVertices noVertices_;
  FeedbackObjects objects_;
  gl::Buffer generated_, noRoom_;
  const gl::Program *program_ = nullptr, *finish_ = nullptr;
};

}  // namespace

std::unique_ptr<StreamReduction::BackEnd> makeGeometryShaderForm(gl::Context& context, uint32_t most,
                                                                 const ReductionSettings& settings) {
  return std::make_unique<GeometryShaderForm>(context, most, settings);
}

}  // namespace limen::compute
