// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/test_counts.h"

#include <epoxy/gl.h>

#include <cassert>

#include "renderer/techniques/perceptual_lod/perceptual_lod_bindings.h"

namespace limen::techniques {
namespace {

constexpr int64_t kWordsPerTest = 4;

const gl::Program& programOf(gl::Context& context, CountMethod method, const gl::ShaderDefines& defines) {
  const std::string folder = "renderer/techniques/perceptual_lod/";
  if (method == CountMethod::Compute)
    return context.programs().compute(folder + "count_visible.comp.glsl", defines);
  return context.programs().get({folder + "full_screen.vert.glsl", folder + "count_visible.frag.glsl"},
                                defines);
}

}  // namespace

TestCounts::TestCounts(gl::Context& context, CountMethod method, const gl::ShaderDefines& defines,
                       int testsPerFrame, glm::ivec2 sizePx)
    : method_(method),
      testsPerFrame_(static_cast<size_t>(testsPerFrame)),
      program_(programOf(context, method, defines)),
      counts_(kWordsPerTest * 4 * testsPerFrame, nullptr),
      batches_(kBatches) {
  for (Batch& batch : batches_) {
    batch.tests.reserve(testsPerFrame_);
    batch.numbers.reserve(testsPerFrame_);
  }
  if (method == CountMethod::Query) {
    queries_.resize(kBatches * testsPerFrame_ * kQueries);
    glCreateQueries(GL_SAMPLES_PASSED, static_cast<GLsizei>(queries_.size()), queries_.data());
    glCreateVertexArrays(1, &vertexArray_);
    colour_.emplace(gl::Format::R8, sizePx);
    target_.emplace(std::vector<const gl::Texture*>{&*colour_}, nullptr);
    return;
  }
  const auto bytes = static_cast<GLsizeiptr>(counts_.bytes() * int64_t{kBatches});
  constexpr GLbitfield kFlags = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  glCreateBuffers(1, &readBack_);
  glNamedBufferStorage(readBack_, bytes, nullptr, kFlags);
  mapped_ = static_cast<const uint32_t*>(glMapNamedBufferRange(readBack_, 0, bytes, kFlags));
}

TestCounts::~TestCounts() {
  for (const Batch& batch : batches_) glDeleteSync(static_cast<GLsync>(batch.fence));
  if (!queries_.empty()) glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
  glDeleteVertexArrays(1, &vertexArray_);
  if (readBack_) glUnmapNamedBuffer(readBack_);
  glDeleteBuffers(1, &readBack_);
}

void TestCounts::begin(int64_t frame) {
  assert(ready());
  batches_[next_].frame = frame;
  batches_[next_].numbers.clear();
  if (method_ == CountMethod::Compute) counts_.clearUint(0);
}

void TestCounts::count(const ObjectTest& test, int number, const PixelRect& pixels) {
  Batch& batch = batches_[next_];
  assert(number >= 0 && static_cast<size_t>(number) < testsPerFrame_);
  batch.tests.push_back({test.object, test.level, 0, 0, 0, test.next});
  batch.numbers.push_back(number);
  program_.set("test", number);
  const glm::ivec2 size = pixels.high - pixels.low;
  if (method_ == CountMethod::Compute) {
    counts_.bindStorage(kLevelTestCountsBuffer);
    program_.dispatch(size);
    return;
  }
  target_->bind();
  program_.use();
  glBindVertexArray(vertexArray_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(pixels.low.x, pixels.low.y, size.x, size.y);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (size_t kind = 0; kind < kQueries; ++kind) {
    program_.set("counted", static_cast<int>(kind));
    glBeginQuery(GL_SAMPLES_PASSED, query(next_, static_cast<size_t>(number), kind));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEndQuery(GL_SAMPLES_PASSED);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
}

void TestCounts::end() {
  Batch& batch = batches_[next_];
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT);
  if (batch.tests.empty()) return;
  if (method_ == CountMethod::Compute) {
    glCopyNamedBufferSubData(counts_.id(), readBack_, 0, static_cast<GLintptr>(next_) * counts_.bytes(),
                             counts_.bytes());
    batch.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  }
  next_ = (next_ + 1) % kBatches;
}

bool TestCounts::arrived(const Batch& batch, bool wait) const {
  if (method_ == CountMethod::Compute) {
    constexpr GLuint64 kSecond = 1'000'000'000;
    GLenum result = GL_TIMEOUT_EXPIRED;
    do {
      result =
          glClientWaitSync(static_cast<GLsync>(batch.fence), GL_SYNC_FLUSH_COMMANDS_BIT, wait ? kSecond : 0);
    } while (wait && result == GL_TIMEOUT_EXPIRED);
    return result == GL_ALREADY_SIGNALED || result == GL_CONDITION_SATISFIED;
  }
  if (wait) return true;  // reading a query waits for it
  GLuint available = GL_FALSE;
  // Queries complete in order: if the last of the batch is available, all are.
  glGetQueryObjectuiv(query(oldest_, static_cast<size_t>(batch.numbers.back()), kQueries - 1),
                      GL_QUERY_RESULT_AVAILABLE, &available);
  return available == GL_TRUE;
}

std::optional<std::vector<LevelTest>> TestCounts::take(int64_t newest, bool wait) {
  Batch& batch = batches_[oldest_];
  if (batch.tests.empty() || batch.frame > newest || !arrived(batch, wait)) return std::nullopt;
  read(oldest_);
  // In the objects' turn; they were counted layer by layer.
  std::optional<std::vector<LevelTest>> out(batch.tests);
  for (size_t i = 0; i < batch.tests.size(); ++i)
    (*out)[static_cast<size_t>(batch.numbers[i])] = batch.tests[i];
  batch.tests.clear();
  glDeleteSync(static_cast<GLsync>(batch.fence));
  batch.fence = nullptr;
  oldest_ = (oldest_ + 1) % kBatches;
  return out;
}

void TestCounts::read(size_t number) {
  std::vector<LevelTest>& tests = batches_[number].tests;
  for (size_t i = 0; i < tests.size(); ++i) {
    uint32_t counts[kQueries] = {0, 0, 0};
    const auto at = static_cast<size_t>(batches_[number].numbers[i]);
    if (method_ == CountMethod::Compute) {
      const uint32_t* from = mapped_ + static_cast<int64_t>(number) * counts_.bytes() / 4 +
                             static_cast<int64_t>(at) * kWordsPerTest;
      std::copy(from, from + kQueries, counts);
    } else {
      for (size_t kind = 0; kind < kQueries; ++kind)
        glGetQueryObjectuiv(query(number, at, kind), GL_QUERY_RESULT, &counts[kind]);
    }
    tests[i].coveredPx = counts[0];
    tests[i].visiblePx = counts[1];
    tests[i].nextVisiblePx = counts[2];
  }
}

}  // namespace limen::techniques
