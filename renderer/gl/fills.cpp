// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gl/fills.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>

#include "renderer/gl/context.h"
#include "renderer/gl/fill_bindings.h"

namespace limen::gl {
namespace {

constexpr int64_t kLeastBytes = 65536;
constexpr int64_t kPartBytes = int64_t{1} << 27;  // of a storage block, which every implementation grants
constexpr int64_t kGroupBytes = 4 * int64_t{kFillGroup} * kFillWords;
static_assert((kPartBytes + kGroupBytes - 1) / kGroupBytes <= 65535);

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
std::atomic<bool> onSoftware = false;

/// The program of before, again at the end.
class KeptProgram {
 public:
  KeptProgram() { glGetIntegerv(GL_CURRENT_PROGRAM, &program_); }
  ~KeptProgram() {
    // One that was deleted while in use is gone as soon as another one is used.
    const auto program = static_cast<GLuint>(program_);
    glUseProgram(glIsProgram(program) ? program : 0);
  }
  KeptProgram(const KeptProgram&) = delete;
  KeptProgram& operator=(const KeptProgram&) = delete;

 private:
  GLint program_ = 0;
};

/// So is the image unit.
class KeptImage {
 public:
  KeptImage() {
    for (size_t i = 0; i < 6; ++i) glGetIntegeri_v(kNames[i], kFilledImage, &values_[i]);
  }
  ~KeptImage() {
    // A unit's format is valid where no image is bound, too.
    glBindImageTexture(kFilledImage, static_cast<GLuint>(values_[0]), values_[1],
                       static_cast<GLboolean>(values_[2]), values_[3], static_cast<GLenum>(values_[4]),
                       static_cast<GLenum>(values_[5]));
  }
  KeptImage(const KeptImage&) = delete;
  KeptImage& operator=(const KeptImage&) = delete;

 private:
  static constexpr GLenum kNames[6] = {GL_IMAGE_BINDING_NAME,    GL_IMAGE_BINDING_LEVEL,
                                       GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                       GL_IMAGE_BINDING_ACCESS,  GL_IMAGE_BINDING_FORMAT};
  GLint values_[6] = {};
};

/// And the binding of a storage block.
class KeptBuffer {
 public:
  KeptBuffer() {
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, kFilledBuffer, &buffer_);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, kFilledBuffer, &start_);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, kFilledBuffer, &size_);
  }
  ~KeptBuffer() {
    const auto buffer = static_cast<GLuint>(buffer_);
    if (size_ > 0)
      glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, buffer, static_cast<GLintptr>(start_),
                        static_cast<GLsizeiptr>(size_));
    else
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, buffer);
  }
  KeptBuffer(const KeptBuffer&) = delete;
  KeptBuffer& operator=(const KeptBuffer&) = delete;

 private:
  GLint buffer_ = 0;
  GLint64 start_ = 0, size_ = 0;
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
  const KeptProgram keptProgram;
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
  const KeptProgram program;
  const KeptBuffer kept;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  buffer_->set("value", value);
  buffer_->use();
  for (int64_t first = 0; first < bytes; first += kPartBytes) {
    const int64_t part = std::min(bytes - first, kPartBytes);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kFilledBuffer, id, first, part);
    buffer_->set("wordCount", static_cast<uint32_t>(part / 4));
    glDispatchCompute(static_cast<GLuint>((part + kGroupBytes - 1) / kGroupBytes), 1, 1);
  }
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

const Fills* Fills::forBytes(int64_t bytes) { return bytes >= kLeastBytes ? currentFills : nullptr; }

void Fills::madeCurrent(const Context& context) {
  currentFills = nullptr;
  if (context.device().software && !onSoftware) return;
  AllFills& all = allFills();
  const std::lock_guard lock(all.mutex);
  std::unique_ptr<Fills>& own = all.of[&context];
  if (!own) own = std::make_unique<Fills>();
  currentFills = own.get();
}

void Fills::useOnSoftware(bool use) { onSoftware = use; }

void Fills::gone(const Context& context) {
  currentFills = nullptr;
  AllFills& all = allFills();
  const std::lock_guard lock(all.mutex);
  all.of.erase(&context);
}

}  // namespace limen::gl
