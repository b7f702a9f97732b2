// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/tessellation/factor_pass.h"
#include "renderer/techniques/tessellation/patterns/pattern_meshes.h"
#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

/// Patches that share a pattern, put together on the GPU, with an indirect draw for each pattern that there
/// may be (SC-67). Patterns: of all tuples of powers of two, or uniform ones of each power of two.
class PatternBatches {
 public:
  PatternBatches(frame::Frame& frame, const PatchBuffers& patches, PatternMeshes& meshes, int most,
                 bool adapted);
  /// Ends with barriers for draws. Nothing is read back.
  void run(const FactorPass& factors) const;

  const gl::Buffer& instances() const { return instances_; }
  const gl::Buffer& commands() const { return commands_; }
  int commandCount() const { return patternCount_; }
  int64_t bytes() const {
    return instances_.bytes() + commands_.bytes() + counts_.bytes() + offsets_.bytes() + scan_.bytes();
  }

 private:
  const PatchBuffers& patches_;
  bool adapted_;
  int levels_, rectanglePatterns_, patternCount_;
  const gl::Program &countProgram_, &placeProgram_, &commandsProgram_;
  gl::Buffer counts_, offsets_, instances_, commands_;
  compute::PrefixSum scan_;
};

}  // namespace limen::techniques
