// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/many_lods/cut_finder.h"
#include "renderer/many_lods/cut_mode.h"
#include "renderer/many_lods/tree_shape.h"

namespace limen::many_lods {

/// The thesis's own form: entries are points, a geometry shader with two streams says what becomes of each,
/// and transform feedback captures what the next pass looks at and what is finished. Counts stay on the GPU:
/// each pass draws what the one before has captured. Finished entries of a pass are appended to the list by a
/// second draw, as a stream of one pass cannot go on where another pass's ended. As many passes as the tree
/// has levels, and one. What the lists have no room for is lost, as transform feedback drops it: then
/// CutControl::refused is 1. Of complete binary trees. Source: Holländer 2013, section 3.5.3, listing 3.1.
class FeedbackCuts : public CutFinder {
 public:
  FeedbackCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
               const GeometryShaderCuts& settings);
  ~FeedbackCuts() override;
  FeedbackCuts(const FeedbackCuts&) = delete;
  FeedbackCuts& operator=(const FeedbackCuts&) = delete;

  void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) override;
  void restart() override { fresh_ = true; }
  const gl::Buffer& list() const override { return lists_[now_]; }
  const gl::Buffer& control() const override { return control_; }
  int64_t bytes() const override;

 private:
  GeometryShaderCuts settings_;
  uint32_t capacity_, views_, passes_;
  bool fresh_ = true;
  size_t now_ = 0;  // list of this frame
  gl::Buffer roots_, counts_, control_;
  std::vector<gl::Buffer> open_, finished_, lists_;  // two each
  const gl::Program *classify_, *append_, *count_;
  // Names of the driver.
  std::array<uint32_t, 2> passObjects_{}, listObjects_{};
  std::vector<uint32_t> queries_;  // two a pass
  uint32_t framebuffer_ = 0, vertices_ = 0, nodesTexture_ = 0, viewsTexture_ = 0;
};

}  // namespace limen::many_lods
