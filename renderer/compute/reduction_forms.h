// SPDX-License-Identifier: BSD-3-Clause
// Inside of stream reduction: what each form implements.
#pragma once

#include <epoxy/gl.h>

#include "renderer/compute/stream_reduction.h"
#include "renderer/gl/program.h"

namespace limen::compute {

class StreamReduction::BackEnd {
 public:
  virtual ~BackEnd() = default;
  virtual void run(const StreamInput& in, const StreamOutput& out) const = 0;
  /// Where a form that searches counts its fetches; null: it does not search.
  virtual const gl::Buffer* fetches() const { return nullptr; }
  virtual int64_t bytes() const = 0;
};

std::unique_ptr<StreamReduction::BackEnd> makeScatterForm(gl::Context& context, uint32_t most,
                                                          const ReductionSettings& settings,
                                                          ReductionForm form);
std::unique_ptr<StreamReduction::BackEnd> makeBlockSequentialForm(gl::Context& context, uint32_t most,
                                                                  const ReductionSettings& settings);
std::unique_ptr<StreamReduction::BackEnd> makeSearchForm(gl::Context& context, uint32_t most,
                                                         const ReductionSettings& settings);
std::unique_ptr<StreamReduction::BackEnd> makeHierarchicalForm(gl::Context& context, uint32_t most,
                                                               const ReductionSettings& settings);
std::unique_ptr<StreamReduction::BackEnd> makeGeometryShaderForm(gl::Context& context, uint32_t most,
                                                                 const ReductionSettings& settings);

/// LANES, FLAGGED, IMPROVED and COUNT_FETCHES, as the shaders take them.
inline gl::ShaderDefines reductionDefines(const ReductionSettings& settings) {
  gl::ShaderDefines out{{"LANES", std::to_string(settings.lanes)}};
  if (settings.flagged) out["FLAGGED"] = "1";
  if (settings.search == ItemSearch::Improved) out["IMPROVED"] = "1";
  if (settings.countFetches) out["COUNT_FETCHES"] = "1";
  return out;
}

/// Binds the stream, the output and their counts as reduction_items.glsl reads them.
inline void bindStream(const StreamInput& in, const StreamOutput& out) {
  in.items.bindStorage(kReductionItemsBuffer);
  if (in.flags) in.flags->bindStorage(kReductionFlagsBuffer);
  out.items.bindStorage(kReductionOutBuffer);
  if (in.count) in.count->bindStorage(kReductionCountInBuffer);
  out.count.bindStorage(kReductionCountBuffer);
}

inline void setStream(const gl::Program& program, const StreamInput& in, const StreamOutput& out) {
  program.set("most", in.most);
  program.set("countAt", in.count ? static_cast<int>(in.countOffset / 4) : -1);
  program.set("capacity", out.capacity);
  program.set("groupSize", out.groupSize);
}

/// Rows of groups, as no dimension has more than 65,535. Shaders number them by groupNumber(). `barrier`:
/// after them; 0: none.
inline void dispatchGroups(uint32_t groups, GLbitfield barrier = GL_SHADER_STORAGE_BARRIER_BIT) {
  if (groups == 0) return;
  const uint32_t rows = (groups + 65534) / 65535;
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  if (barrier != 0) glMemoryBarrier(barrier);
}

inline uint32_t blocksOf(uint32_t items, uint32_t size) { return items == 0 ? 1 : (items - 1) / size + 1; }

inline void clearFetches(const gl::Buffer& fetches) {
  fetches.clearUint(0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace limen::compute
