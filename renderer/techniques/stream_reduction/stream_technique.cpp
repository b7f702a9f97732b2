// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/stream_reduction/stream_technique.h"

#include <epoxy/gl.h>

#include "renderer/compute/stream_reduction.h"
#include "renderer/techniques/stream_reduction/stream_bindings.h"

namespace limen::techniques {
namespace {

constexpr int64_t kCountWords = 32;

std::vector<uint32_t> withPayload(const scene::ItemStream& stream, const StreamItemSettings& settings) {
  std::vector<uint32_t> out;
  out.reserve(stream.items.size() * static_cast<size_t>(settings.payload) + 4);
  for (const uint32_t item : stream.items) {
    out.push_back(item);
    if (settings.payload == 2) out.push_back(item ^ kPairBits);
  }
  // Shaders read whole 16 bytes.
  out.resize((out.size() + 3) / 4 * 4);
  return out;
}

std::vector<uint32_t> flagsOf(const scene::ItemStream& stream) {
  std::vector<uint32_t> out;
  out.reserve(stream.items.size() + 4);
  for (const uint32_t item : stream.items) out.push_back(item == scene::ItemStream::kInvalid ? 0 : 1);
  out.resize((out.size() + 3) / 4 * 4);
  return out;
}

}  // namespace

const SettingsTable<StreamItemSettings>& StreamItemSettings::table() {
  using S = StreamItemSettings;
  static const SettingsTable<S> kTable = {
      {&S::payload, "payload", {1, 2}, "words", "Words of 32 bits that an item has"},
      {&S::flagged, "flagged",
       "Marks valid items by a stream of flags rather than invalid ones by a number of their own"}};
  return kTable;
}

glm::ivec2 streamSizePx(const frame::Frame& frame) {
  // The stream, and a texel at least that ends it.
  const auto count = static_cast<int>(frame.scene().items->items.size());
  return {kStreamWidth, count / kStreamWidth + 1};
}

int64_t StreamTechnique::outputBytes(uint32_t items) const {
  return compute::StreamReduction::bytesFor(items, settings_.payload);
}

void StreamTechnique::prepare(frame::Frame& frame) {
  static_assert(compute::kInvalidItem == scene::ItemStream::kInvalid);
  const scene::ItemStream& stream = *frame.scene().items;
  itemCount_ = static_cast<uint32_t>(stream.items.size());
  items_.emplace(withPayload(stream, settings_));
  if (settings_.flagged) flags_.emplace(flagsOf(stream));
  output_.emplace(outputBytes(itemCount_), nullptr);
  counts_.emplace(kCountWords * 4, nullptr);
  counts_->clearUint(0);
  product_.emplace(gl::Format::R32F, streamSizePx(frame));
  show_ = &frame.context().programs().compute("renderer/techniques/stream_reduction/stream_numbers.comp.glsl",
                                              {{"LANES", std::to_string(settings_.payload)}});
  const int64_t formBytes = prepareForm(frame);
  frame.passes().setBytesHeld("stream_reduction/reduce", items_->bytes() + (flags_ ? flags_->bytes() : 0) +
                                                             output_->bytes() + counts_->bytes() + formBytes);
}

const gl::Texture& StreamTechnique::product() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  output_->bindStorage(kStreamItemsBuffer);
  counts_->bindStorage(kStreamCountBuffer);
  product_->bindImage(kStreamImage, gl::Access::Write);
  show_->set("sizePx", product_->sizePx());
  show_->set("countAt", countAt());
  show_->set("room", itemCount_);
  show_->use();
  show_->dispatch(product_->sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  return *product_;
}

}  // namespace limen::techniques
