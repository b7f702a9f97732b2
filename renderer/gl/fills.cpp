// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/fills.h"

#include <epoxy/gl.h>

#include <map>
#include <memory>
#include <mutex>

#include "renderer/gl/context.h"
#include "renderer/gl/fill_bindings.h"

namespace limen::gl {
namespace {

constexpr int64_t kLeastBytes = 65536;
constexpr GLuint kMostGroups = 65535;

/// Of all contexts. Never destroyed, as contexts may be objects of static storage.
struct AllFills {
  std::mutex mutex;
  std::map<const Context*, std::unique_ptr<Fills>> of;
};
AllFills& allFills() {
  static auto* all = new AllFills;
  return *all;
}

/// A thread has one current context.
thread_local const Fills* currentFills = nullptr;

/// The image unit and the program of before, again at the end.
class KeptImage {
 public:
  KeptImage() {
    glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
    for (size_t i = 0; i < 6; ++i) glGetIntegeri_v(kNames[i], kFilledImage, &values_[i]);
  }
  ~KeptImage() {
    // A unit's format is valid where no image is bound, too.
    glBindImageTexture(kFilledImage, static_cast<GLuint>(values_[0]), values_[1],
                       static_cast<GLboolean>(values_[2]), values_[3], static_cast<GLenum>(values_[4]),
                       static_cast<GLenum>(values_[5]));
    glUseProgram(static_cast<GLuint>(program_));
  }
  KeptImage(const KeptImage&) = delete;
  KeptImage& operator=(const KeptImage&) = delete;

 private:
  static constexpr GLenum kNames[6] = {GL_IMAGE_BINDING_NAME,    GL_IMAGE_BINDING_LEVEL,
                                       GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                       GL_IMAGE_BINDING_ACCESS,  GL_IMAGE_BINDING_FORMAT};
  GLint program_ = 0, values_[6] = {};
};

}  // namespace

Fills::Fills() {
  const auto program = [&](const char* image, bool layers, bool isUnsigned) {
    ShaderDefines defines{{"IMAGE", image}};
    if (layers) defines["LAYERS"] = "1";
    if (isUnsigned) defines["UNSIGNED"] = "1";
    return &programs_.compute("renderer/gl/fill_image.comp.glsl", defines);
  };
  flat_ = program("image2D", false, false);
  layers_ = program("image2DArray", true, false);
  flatUnsigned_ = program("uimage2D", false, true);
  layersUnsigned_ = program("uimage2DArray", true, true);
  buffer_ = &programs_.compute("renderer/gl/fill_buffer.comp.glsl");
}

void Fills::dispatch(const Program& program, const Level& level) const {
  const KeptImage kept;
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  glBindImageTexture(kFilledImage, level.id, level.level, GL_TRUE, 0, GL_WRITE_ONLY, level.internalFormat);
  program.use();
  const glm::uvec2 groups((level.sizePx + kGroupSide - 1) / kGroupSide);
  glDispatchCompute(groups.x, groups.y, static_cast<GLuint>(glm::max(level.layers, 1)));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void Fills::fill(const Level& level, glm::vec4 value) const {
  const Program& program = level.layers > 0 ? *layers_ : *flat_;
  program.set("value", value);
  dispatch(program, level);
}

void Fills::fill(const Level& level, glm::uvec4 value) const {
  const Program& program = level.layers > 0 ? *layersUnsigned_ : *flatUnsigned_;
  program.set("valueX", value.x);
  program.set("valueY", value.y);
  program.set("valueZ", value.z);
  program.set("valueW", value.w);
  dispatch(program, level);
}

void Fills::fillBuffer(uint32_t id, int64_t bytes, uint32_t value) const {
  GLint program = 0, buffer = 0;
  GLint64 start = 0, size = 0;
  glGetIntegerv(GL_CURRENT_PROGRAM, &program);
  glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, kFilledBuffer, &buffer);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, kFilledBuffer, &start);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, kFilledBuffer, &size);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, id);
  const int64_t words = bytes / 4, perGroup = int64_t{kFillGroup} * kFillWords;
  buffer_->set("wordCount", static_cast<uint32_t>(words));
  buffer_->set("value", value);
  buffer_->use();
  const auto groups = static_cast<GLuint>((words + perGroup - 1) / perGroup);
  const GLuint rows = (groups + kMostGroups - 1) / kMostGroups;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  if (size > 0)
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, static_cast<GLuint>(buffer),
                      static_cast<GLintptr>(start), static_cast<GLsizeiptr>(size));
  else
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, static_cast<GLuint>(buffer));
  glUseProgram(static_cast<GLuint>(program));
}

const Fills* Fills::forBytes(int64_t bytes) { return bytes >= kLeastBytes ? currentFills : nullptr; }

void Fills::madeCurrent(const Context& context) {
  currentFills = nullptr;
  if (context.device().software) return;
  AllFills& all = allFills();
  const std::lock_guard lock(all.mutex);
  std::unique_ptr<Fills>& own = all.of[&context];
  if (!own) own = std::make_unique<Fills>();
  currentFills = own.get();
}

void Fills::gone(const Context& context) {
  currentFills = nullptr;
  AllFills& all = allFills();
  const std::lock_guard lock(all.mutex);
  all.of.erase(&context);
}

}  // namespace limen::gl
