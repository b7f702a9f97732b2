// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/compute/block_lines.h"

#include <bit>

#include "experiments/base/error.h"
#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

gl::Texture streamTexture(uint32_t most, const ReductionSettings& settings) {
  const auto width = static_cast<uint32_t>(settings.rowWidth);
  return {settings.lanes == 1 ? gl::Format::R32UI : gl::Format::RG32UI,
          {settings.rowWidth, static_cast<int>(blocksOf(most, width))}};
}

}  // namespace

BlockLines::BlockLines(gl::Context& context, uint32_t most, const ReductionSettings& settings)
    : lanes_(settings.lanes),
      rowWidth_(static_cast<uint32_t>(settings.rowWidth)),
      rows_(std::bit_ceil(blocksOf(most, rowWidth_))),
      twice_(settings.join == BlockJoin::LinesTwice),
      texture_(streamTexture(most, settings)),
      framebuffer_({&texture_}, nullptr),
      gatheredTexture_(lanes_ == 1 ? GL_R32UI : GL_RG32UI),
      sumsTexture_(GL_R32UI) {
  GLint viewport[2] = {};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  if (2 * int64_t{rowWidth_} > viewport[0] || int64_t{rows_} > viewport[1])
    throw Error("blocks drawn as lines take a viewport of " + std::to_string(2 * rowWidth_) + " x " +
                    std::to_string(rows_) + " px; the driver grants " + std::to_string(viewport[0]) + " x " +
                    std::to_string(viewport[1]),
                {}, "choose another width of rows, or join blocks by compute");
  if (int64_t{most} + kLongestBlock > BufferTexture::mostTexels())
    throw Error("the driver reads at most " + std::to_string(BufferTexture::mostTexels()) +
                    " items from a buffer texture",
                {}, "join blocks by compute");
  gl::ShaderDefines defines{{"BLOCK", std::to_string(settings.blockSize)}};
  if (twice_) defines["TWICE"] = "1";
  const std::string path = "renderer/compute/reduction_lines.";
  std::vector<std::string> stages{path + "vert.glsl", path + "frag.glsl"};
  if (!twice_) stages.insert(stages.begin() + 1, path + "geom.glsl");
  program_ = &context.programs().get(stages, defines);
}

void BlockLines::draw(const gl::Buffer& gathered, const gl::Buffer& sums, uint32_t blocks,
                      const gl::Buffer& to, uint32_t capacity) const {
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gatheredTexture_.bind(kReductionItemsUnit, gathered);
  sumsTexture_.bind(kReductionSumsUnit, sums);
  framebuffer_.bind();
  glViewport(0, 0, static_cast<GLsizei>(2 * rowWidth_), static_cast<GLsizei>(rows_));
  program_->set("rowWidth", rowWidth_);
  program_->set("rows", rows_);
  program_->use();
  noVertices_.bind();
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(blocks * (twice_ ? 4 : 2)));
  glBindVertexArray(0);
  copy(to, capacity);
}

void BlockLines::copy(const gl::Buffer& to, uint32_t capacity) const {
  const auto width = static_cast<GLsizei>(rowWidth_);
  const auto held = rowWidth_ * static_cast<uint32_t>(texture_.sizePx().y);
  const uint32_t items = std::min(capacity, held);
  const GLenum format = lanes_ == 1 ? GL_RED_INTEGER : GL_RG_INTEGER;
  const auto rows = static_cast<GLsizei>(items / rowWidth_), rest = static_cast<GLsizei>(items % rowWidth_);
  const int64_t whole = int64_t{rows} * width * lanes_ * 4;
  glMemoryBarrier(GL_PIXEL_BUFFER_BARRIER_BIT);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, to.id());
  const auto take = [&](GLint row, GLsizei columns, GLsizei count, int64_t at) {
    if (columns > 0 && count > 0)
      glGetTextureSubImage(texture_.id(), 0, 0, row, 0, columns, count, 1, format, GL_UNSIGNED_INT,
                           static_cast<GLsizei>(int64_t{columns} * count * lanes_ * 4),
                           reinterpret_cast<void*>(at));
  };
  take(0, width, rows, 0);
  take(rows, rest, 1, whole);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace limen::compute
