// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/many_lods/listed_cuts.h"
#include "renderer/many_lods/worker_pool.h"

namespace limen::many_lods {

/// Basic cuts that CPU and GPU share. Views and nodes are on the GPU, so that the CPU waits for them and
/// reads them back in every frame, and what it finds is uploaded: this is the form's cost, and timed. The
/// cuts are those of BasicCuts. Of complete binary trees. Source: Holländer 2013, section 3.7.3, table 3.4:
/// events (what becomes of an entry) and sums, on either side, in one or several tasks; the split by levels
/// is the bench's own.
class HybridCuts : public ListedCuts {
 public:
  HybridCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
             const HybridSettings& settings);
  void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) override;

 protected:
  void step(uint32_t rule, uint32_t number, uint32_t last, bool counting) override;

 private:
  /// Cuts of the top of the tree, as the list to start from. False: some had no room for all of it.
  bool writeTop(uint32_t levels);
  void findEvents(const CutStep& now, uint32_t firstTile, uint32_t endTile);
  void sumUp(CutStep now, uint32_t number, uint32_t last);

  HybridSettings settings_;
  const gl::Program* firstHalf_;
  WorkerPool pool_;
  // As read back in this frame.
  std::vector<glm::vec4> nodes_;
  std::vector<CutView> views_;
};

}  // namespace limen::many_lods
