// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/perceptual_lod/level_view.h"
#include "renderer/techniques/perceptual_lod/settings.h"
#include "renderer/techniques/perceptual_lod/tested_levels.h"

namespace limen::techniques {

/// What the GPU counts for one object.
struct CountRequest {
  int object = 0, level = 0;
  scene::TriangleRange triangles;  ///< of the object's current level
  PixelRect pixels;
};

/// Counts of tests that arrive frames later: by occlusion queries (Schwarz 2009, section 9.5), or in a
/// compute shader whose sums are copied to mapped memory behind a fence. Batches, one per frame, are read in
/// order; nothing waits unless asked to.
class TestCounts {
 public:
  /// `visible` is R32F, cleared each frame and set to 1 where a test found a visible difference. `withNext`:
  /// the next coarser level is tested too.
  TestCounts(gl::Context& context, CountMethod method, int testsPerFrame, bool withNext,
             const gl::Texture& visible);
  ~TestCounts();
  TestCounts(const TestCounts&) = delete;
  TestCounts& operator=(const TestCounts&) = delete;

  /// False if too many batches are in flight for another one.
  bool ready() const { return batches_[next_].tests.empty(); }
  void begin(int64_t frame, float blackCdM2, float rangeCdM2);
  /// The textures of lod_difference.glsl are bound by the caller.
  void count(const CountRequest& request);
  void end();
  /// The oldest batch, if it is of frame `newest` or earlier and has arrived.
  std::optional<std::vector<LevelTest>> take(int64_t newest, bool wait);
  int64_t bytes() const { return counts_.bytes() * (1 + kBatches); }

 private:
  static constexpr size_t kBatches = 8, kQueries = 3;
  struct Batch {
    int64_t frame = 0;
    std::vector<LevelTest> tests;  ///< empty: free
    void* fence = nullptr;
  };
  bool arrived(const Batch& batch, bool wait) const;
  void read(size_t batch);
  uint32_t query(size_t batch, size_t test, size_t kind) const {
    return queries_[(batch * testsPerFrame_ + test) * kQueries + kind];
  }

  CountMethod method_;
  size_t testsPerFrame_;
  bool withNext_;
  const gl::Program& program_;
  const gl::Texture& visible_;
  gl::Buffer counts_;
  uint32_t readBack_ = 0, vertexArray_ = 0;
  const uint32_t* mapped_ = nullptr;
  std::optional<gl::Framebuffer> target_;
  std::vector<uint32_t> queries_;
  std::vector<Batch> batches_;
  size_t next_ = 0, oldest_ = 0;
};

}  // namespace limen::techniques
