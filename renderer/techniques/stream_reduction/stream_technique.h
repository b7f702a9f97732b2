// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Width of a Stream; its height follows from the scene's stream.
inline constexpr int kStreamWidth = 1024;
glm::ivec2 streamSizePx(const frame::Frame& frame);

/// What the items of a stream carry, and how invalid ones are marked.
struct StreamItemSettings {
  int payload = 1;
  bool flagged = false;
  static const SettingsTable<StreamItemSettings>& table();
};

/// Base of techniques that turn the scene's stream into another one on the GPU. The product is written when
/// it is asked for, so that a frame holds nothing but the technique itself.
class StreamTechnique : public Technique {
 public:
  explicit StreamTechnique(const StreamItemSettings& settings = {}) : settings_(settings) {}
  void prepare(frame::Frame& frame) override;
  const gl::Texture& product() const override;

 protected:
  /// Compiles and allocates what render() needs; returns the bytes that it holds.
  virtual int64_t prepareForm(frame::Frame& frame) = 0;
  /// Room of output().
  virtual int64_t outputBytes(uint32_t items) const;
  /// Word of counts() that holds the number of items in output().
  virtual uint32_t countAt() const = 0;

  uint32_t itemCount() const { return itemCount_; }
  const StreamItemSettings& itemSettings() const { return settings_; }
  const gl::Buffer& items() const { return *items_; }
  const gl::Buffer* flags() const { return flags_ ? &*flags_ : nullptr; }
  const gl::Buffer& output() const { return *output_; }
  const gl::Buffer& counts() const { return *counts_; }

 private:
  StreamItemSettings settings_;
  uint32_t itemCount_ = 0;
  std::optional<gl::Buffer> items_, flags_, output_, counts_;
  std::optional<gl::Texture> product_;
  const gl::Program* show_ = nullptr;
};

}  // namespace limen::techniques
