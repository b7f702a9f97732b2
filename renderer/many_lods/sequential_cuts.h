// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "experiments/base/settings_table.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/many_lods/view_atlas.h"

namespace limen::many_lods {

struct SequentialSettings {
  static constexpr const char *kKind = "sequential",
                              *kSummary = "from the root, one invocation for each view (micro-rendering)";
  static const SettingsTable<SequentialSettings>& table();
};

/// Micro-rendering: an invocation walks down the tree for its view and draws what it comes to, without any
/// list or stack. Its nodes and tiles are those of InPlaceCuts; views are the only parallelism. Source:
/// Ritschel and others 2009; Holländer 2013, section 3.5.1.
class SequentialCuts {
 public:
  SequentialCuts(gl::Context& context, uint32_t views, int depth, Discs discs = Discs::Spheres);
  /// Clears `atlas` and draws the cuts. Binds storage buffers 0, 1, 3, 5 and 7.
  void draw(const gl::Buffer& nodes, const gl::Buffer& views, const ViewAtlas& atlas,
            const ViewAtlas::Settings& settings) const;
  const gl::Buffer& countsBuffer() const { return counts_; }  ///< InPlaceCounts: drawn and unfinished (views)
  InPlaceCounts counts() const;                               ///< waits for the GPU

 private:
  uint32_t views_, leaves_;
  gl::Buffer counts_;
  const gl::Program& program_;
};

}  // namespace limen::many_lods
