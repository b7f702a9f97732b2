// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/perceptual_lod/layer_images.h"
#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/settings.h"
#include "renderer/techniques/perceptual_lod/tested_levels.h"

namespace limen::techniques {

/// Counts of tests that arrive frames later: by occlusion queries (Schwarz 2009, section 9.5), or in a
/// compute shader whose sums are copied to mapped memory behind a fence. Batches, one per frame, are read in
/// order; nothing waits unless asked to.
class TestCounts {
 public:
  /// `defines`: of gathered.glsl. `sizePx`: of the picture.
  TestCounts(gl::Context& context, CountMethod method, const gl::ShaderDefines& defines, int testsPerFrame,
             glm::ivec2 sizePx);
  ~TestCounts();
  TestCounts(const TestCounts&) = delete;
  TestCounts& operator=(const TestCounts&) = delete;

  /// False if too many batches are in flight for another one.
  bool ready() const { return batches_[next_].tests.empty(); }
  void begin(int64_t frame);
  /// What lod_difference.glsl reads is bound by the caller. `number`: of the frame's planned tests.
  void count(const ObjectTest& test, int number, const PixelRect& pixels);
  const gl::Program& program() const { return program_; }
  void end();
  /// The oldest batch, if it is of frame `newest` or earlier and has arrived.
  std::optional<std::vector<LevelTest>> take(int64_t newest, bool wait);
  int64_t bytes() const { return counts_.bytes() * (1 + kBatches) + (colour_ ? colour_->bytes() : 0); }

 private:
  static constexpr size_t kBatches = 8, kQueries = 3;
  struct Batch {
    int64_t frame = 0;
    std::vector<LevelTest> tests;  ///< empty: free
    std::vector<int> numbers;      ///< of the tests in their frame
    void* fence = nullptr;
  };
  bool arrived(const Batch& batch, bool wait) const;
  void read(size_t batch);
  uint32_t query(size_t batch, size_t test, size_t kind) const {
    return queries_[(batch * testsPerFrame_ + test) * kQueries + kind];
  }

  CountMethod method_;
  size_t testsPerFrame_;
  const gl::Program& program_;
  gl::Buffer counts_;
  uint32_t readBack_ = 0, vertexArray_ = 0;
  const uint32_t* mapped_ = nullptr;
  std::optional<gl::Texture> colour_;  ///< nothing is written to it; queries need a target
  std::optional<gl::Framebuffer> target_;
  std::vector<uint32_t> queries_;
  std::vector<Batch> batches_;
  size_t next_ = 0, oldest_ = 0;
};

}  // namespace limen::techniques
