// SPDX-License-Identifier: BSD-3-Clause
// Recursive refinement by geometry shaders and transform feedback (SC-45): each pass reads the parts that the
// last one captured, and captures those that it splits them into (Schwarz 2009, section 7.2.5). Finished
// parts go through all later passes, since a stage captures into one buffer from its start; the host reads
// nothing back. A pass may split up to `levels` times: what one invocation may write limits that. Parts are
// those of `recursion/queues`, in an order that is the same in each run, and are diced alike.
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/recursion/diced_parts.h"
#include "renderer/techniques/recursion/part_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

struct GeometryShaderSettings {
  PartSettings parts;
  int levels = 1;
  static const SettingsTable<GeometryShaderSettings>& table() {
    using S = GeometryShaderSettings;
    static const SettingsTable<S> kTable = {
        included(&S::parts),
        {&S::levels, "levels", {1, 4}, "steps", "Splits in one pass at most; drivers may refuse 4"}};
    return kTable;
  }
};

/// Queries of all passes of a frame.
class Queries {
 public:
  explicit Queries(int count) : ids_(static_cast<size_t>(count)) { glGenQueries(count, ids_.data()); }
  ~Queries() { glDeleteQueries(static_cast<GLsizei>(ids_.size()), ids_.data()); }
  Queries(const Queries&) = delete;
  Queries& operator=(const Queries&) = delete;
  uint32_t operator[](size_t i) const { return ids_[i]; }
  std::vector<int64_t> read() const {
    std::vector<int64_t> out;
    for (const uint32_t id : ids_) {
      GLuint value = 0;
      glGetQueryObjectuiv(id, GL_QUERY_RESULT, &value);
      out.push_back(value);
    }
    return out;
  }

 private:
  std::vector<uint32_t> ids_;
};

/// A buffer as shaders of all stages may read it.
class BufferTexture {
 public:
  BufferTexture(GLenum format, const gl::Buffer& buffer) {
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id_);
    glTextureBuffer(id_, format, buffer.id());
  }
  ~BufferTexture() { glDeleteTextures(1, &id_); }
  BufferTexture(const BufferTexture&) = delete;
  BufferTexture& operator=(const BufferTexture&) = delete;
  void bind(uint32_t unit) const { glBindTextureUnit(unit, id_); }

 private:
  uint32_t id_ = 0;
};

/// Parts that passes read and capture in turn.
class CapturedParts {
 public:
  explicit CapturedParts(int64_t bytes) : buffer_(bytes, nullptr) {
    glCreateTransformFeedbacks(1, &feedback_);
    glTransformFeedbackBufferBase(feedback_, 0, buffer_.id());
    glCreateVertexArrays(1, &vertexArray_);
    glVertexArrayAttribFormat(vertexArray_, 0, 4, GL_FLOAT, GL_FALSE, offsetof(RecursionPart, corners));
    glVertexArrayAttribFormat(vertexArray_, 1, 2, GL_FLOAT, GL_FALSE, offsetof(RecursionPart, lastU));
    glVertexArrayAttribIFormat(vertexArray_, 2, 1, GL_UNSIGNED_INT, offsetof(RecursionPart, patchNumber));
    glVertexArrayAttribIFormat(vertexArray_, 3, 1, GL_UNSIGNED_INT, offsetof(RecursionPart, steps));
    for (GLuint attribute = 0; attribute < 4; ++attribute) {
      glVertexArrayAttribBinding(vertexArray_, attribute, 0);
      glEnableVertexArrayAttrib(vertexArray_, attribute);
    }
    glVertexArrayVertexBuffer(vertexArray_, 0, buffer_.id(), 0, sizeof(RecursionPart));
  }
  ~CapturedParts() {
    glDeleteTransformFeedbacks(1, &feedback_);
    glDeleteVertexArrays(1, &vertexArray_);
  }
  CapturedParts(const CapturedParts&) = delete;
  CapturedParts& operator=(const CapturedParts&) = delete;
  const gl::Buffer& buffer() const { return buffer_; }
  uint32_t feedback() const { return feedback_; }
  void bindVertices() const { glBindVertexArray(vertexArray_); }

 private:
  gl::Buffer buffer_;
  uint32_t feedback_ = 0, vertexArray_ = 0;
};

/// Draws need a complete framebuffer even if nothing is rasterised.
class EmptyFramebuffer {
 public:
  EmptyFramebuffer() {
    glCreateFramebuffers(1, &id_);
    glNamedFramebufferParameteri(id_, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glNamedFramebufferParameteri(id_, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  }
  ~EmptyFramebuffer() { glDeleteFramebuffers(1, &id_); }
  EmptyFramebuffer(const EmptyFramebuffer&) = delete;
  EmptyFramebuffer& operator=(const EmptyFramebuffer&) = delete;
  void bind() const { glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id_); }

 private:
  uint32_t id_ = 0;
};

class GeometryShaderRecursion : public Technique {
 public:
  using Settings = GeometryShaderSettings;
  explicit GeometryShaderRecursion(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const surfaces::PatchSet& set = frame.scene().surfaces;
    requireCubic(set);
    const int most = 1 << (2 * settings_.levels);
    requireOutput(most);
    patches_.emplace(frame.scene(), frame.gpuScene().anchor());
    diced_.emplace(frame, *patches_, settings_.parts);
    gl::ShaderDefines defines = settings_.parts.defines({});
    defines["LEVELS"] = std::to_string(settings_.levels);
    defines["MAX_PARTS"] = std::to_string(most);
    const std::string folder = "renderer/techniques/recursion/geometry_shader/";
    program_ =
        &frame.context().programs().get({folder + "split.vert.glsl", folder + "split.geom.glsl"}, defines);
    std::vector<glm::vec4> points;
    for (const glm::dvec4& p : set.points)
      points.emplace_back(glm::vec3(glm::dvec3(p) - p.w * frame.gpuScene().anchor()), p.w);
    std::vector<glm::uvec2> firsts;
    for (const surfaces::Patch& patch : set.patches)
      firsts.emplace_back(patch.firstPoint, patch.domain == surfaces::Domain::Rectangle ? 1 : 0);
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    if (points.size() > static_cast<size_t>(texels))
      throw Error("the scene has more control points than the driver reads from a buffer texture", "scene",
                  "recursion/queues has no such limit");
    points_.emplace(points), firsts_.emplace(firsts);
    pointsTexture_.emplace(GL_RGBA32F, *points_), firstsTexture_.emplace(GL_RG32UI, *firsts_);
    first_.emplace(wholePatches(set));
    const int64_t bytes = diced_->partCapacity() * int64_t{sizeof(RecursionPart)};
    for (auto& parts : parts_) parts.emplace(bytes);
    counters_.emplace(int64_t{sizeof(RecursionCounters)}, nullptr);
    passes_ = settings_.parts.mostSteps / settings_.levels + 1;
    generated_.emplace(passes_), written_.emplace(passes_), framebuffer_.emplace();
    frame.passes().setBytesHeld("recursion/split", patches_->bytes() + points_->bytes() + firsts_->bytes() +
                                                       first_->bytes() + 2 * bytes);
  }

  void render(frame::Frame& frame) override {
    split(frame);
    diced_->render(frame, last().buffer(), *counters_);
  }

  const gl::Texture& product() const override { return diced_->picture(); }

  std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame& frame) override {
    return diced_->surface(frame, last().buffer(), *counters_);
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const std::vector<int64_t> generated = generated_->read(), written = written_->read();
    const int64_t captured = std::accumulate(written.begin(), written.end(), int64_t{0});
    return {{"faces", double(written.back())},
            {"tessellated_triangles", double(tessellation(frame)->triangles.size())},
            {"parts_captured", double(captured)},
            {"parts_left_out",
             double(std::accumulate(generated.begin(), generated.end(), int64_t{0}) - captured)}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    return {{"faces", "Finished parts", "faces", lower},
            {"tessellated_triangles", "Triangles made", "triangles", lower},
            {"parts_captured", "Parts that all passes captured, finished ones once a pass", "parts", lower},
            {"parts_left_out", "Parts left out for want of capacity", "parts", lower}};
  }

 private:
  static void requireOutput(int parts) {
    GLint vertices = 0, components = 0;
    glGetIntegerv(GL_MAX_GEOMETRY_OUTPUT_VERTICES, &vertices);
    glGetIntegerv(GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS, &components);
    constexpr int kComponents = static_cast<int>(sizeof(RecursionPart) / 4);
    if (parts <= vertices && parts * kComponents <= components) return;
    throw Error("the driver lets a geometry shader write " + std::to_string(vertices) + " vertices and " +
                    std::to_string(components) + " components; this many levels take " +
                    std::to_string(parts) + " and " + std::to_string(parts * kComponents),
                "levels", "use fewer levels");
  }

  const CapturedParts& last() const { return *parts_[static_cast<size_t>((passes_ - 1) % 2)]; }

  void split(frame::Frame& frame) {
    const auto scope = frame.passes().open("recursion/split");
    const RecursionCounters start{};
    counters_->write(0, sizeof start, &start);
    // Stands for what a pass before the first one would have captured.
    glCopyNamedBufferSubData(first_->id(), parts_[1]->buffer().id(), 0, 0, first_->bytes());
    settings_.parts.setUniforms(*program_, frame);
    pointsTexture_->bind(kPartPointsUnit);
    firstsTexture_->bind(kPartPatchesUnit);
    framebuffer_->bind();
    glEnable(GL_RASTERIZER_DISCARD);
    for (int pass = 0; pass < passes_; ++pass) {
      const auto to = static_cast<size_t>(pass % 2);
      const CapturedParts &from = *parts_[1 - to], &into = *parts_[to];
      program_->set("lastPass", pass + 1 == passes_ ? 1 : 0);
      program_->use();
      from.bindVertices();
      glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, into.feedback());
      glBeginQuery(GL_PRIMITIVES_GENERATED, (*generated_)[static_cast<size_t>(pass)]);
      glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, (*written_)[static_cast<size_t>(pass)]);
      glBeginTransformFeedback(GL_POINTS);
      if (pass == 0) {
        glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(patches_->count()));
      } else {
        glDrawTransformFeedback(GL_POINTS, from.feedback());
      }
      glEndTransformFeedback();
      glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
      glEndQuery(GL_PRIMITIVES_GENERATED);
    }
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBuffer(GL_QUERY_BUFFER, counters_->id());
    glGetQueryObjectuiv((*written_)[static_cast<size_t>(passes_ - 1)], GL_QUERY_RESULT,
                        reinterpret_cast<GLuint*>(offsetof(RecursionCounters, finished)));
    glBindBuffer(GL_QUERY_BUFFER, 0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_QUERY_BUFFER_BARRIER_BIT);
    diced_->advance(*counters_);
  }

  Settings settings_;
  int passes_ = 1;
  std::optional<PatchBuffers> patches_;
  std::optional<DicedParts> diced_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Buffer> points_, firsts_, first_, counters_;
  std::optional<BufferTexture> pointsTexture_, firstsTexture_;
  std::array<std::optional<CapturedParts>, 2> parts_;
  std::optional<Queries> generated_, written_;
  std::optional<EmptyFramebuffer> framebuffer_;
};

const RegisteredTechnique<GeometryShaderRecursion> kGeometryShaderRecursionRegistered{
    {.name = "recursion/geometry_shader",
     .version = 1,
     .summary = "Curved surfaces split recursively by geometry shaders, whose output the next pass reads",
     .source = "Schwarz 2009, section 7.2.5 (SC-45)",
     .product = ProductKind::Colour,
     .needs = {"curved_surfaces"},
     .tessellates = true,
     .counters = GeometryShaderRecursion::quantities()}};

}  // namespace
}  // namespace limen::techniques
