// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction as Roger 2008, section 4.6, suggests for machines that scatter: an invocation reduces a
// block item by item; no search and no lines. A block is read twice instead of being kept in between.
#include "renderer/compute/prefix_sum.h"
#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

class BlockSequentialForm : public StreamReduction::BackEnd {
 public:
  BlockSequentialForm(gl::Context& context, uint32_t most, const ReductionSettings& settings)
      : size_(static_cast<uint32_t>(settings.blockSize)),
        scan_(context, blocksOf(most, size_)),
        counts_(PrefixSum::bytesFor(blocksOf(most, size_), 1), nullptr),
        sums_(counts_.bytes(), nullptr) {
    const auto program = [&](const char* stage) {
      gl::ShaderDefines defines = reductionDefines(settings);
      defines[stage] = "1";
      defines["BLOCK"] = std::to_string(size_);
      return &context.programs().compute("renderer/compute/reduction_blocks.comp.glsl", defines);
    };
    count_ = program("COUNT"), scatter_ = program("SCATTER");
  }

  void run(const StreamInput& in, const StreamOutput& out) const override {
    const uint32_t blocks = blocksOf(in.most, size_);
    const auto dispatch = [&](const gl::Program& program, const gl::Buffer& sums) {
      bindStream(in, out);
      sums.bindStorage(kReductionSumsBuffer);
      program.use();
      setStream(program, in, out);
      program.set("blocks", blocks);
      dispatchGroups((blocks + kBlockGroup - 1) / kBlockGroup);
    };
    dispatch(*count_, counts_);
    scan_.run(counts_, sums_, blocks);
    dispatch(*scatter_, sums_);
  }

  int64_t bytes() const override { return scan_.bytes() + counts_.bytes() + sums_.bytes(); }

 private:
  uint32_t size_;
  PrefixSum scan_;
  gl::Buffer counts_, sums_;
  const gl::Program *count_ = nullptr, *scatter_ = nullptr;
};

}  // namespace

std::unique_ptr<StreamReduction::BackEnd> makeBlockSequentialForm(gl::Context& context, uint32_t most,
                                                                  const ReductionSettings& settings) {
  return std::make_unique<BlockSequentialForm>(context, most, settings);
}

}  // namespace limen::compute
