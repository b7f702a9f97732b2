// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical stream reduction (Roger 2008, sections 4.3 and 4.4): scan and search within blocks, sums over
// blocks, and the blocks joined. Blocks are scanned and searched in shared memory, in one dispatch in place
// of log2 s passes.
#include <optional>

#include "renderer/compute/block_lines.h"
#include "renderer/compute/prefix_sum.h"
#include "renderer/compute/reduction_forms.h"

namespace limen::compute {
namespace {

class HierarchicalForm : public StreamReduction::BackEnd {
 public:
  HierarchicalForm(gl::Context& context, uint32_t most, const ReductionSettings& settings)
      : size_(static_cast<uint32_t>(settings.blockSize)),
        scan_(context, blocksOf(most, size_)),
        gathered_(int64_t{blocksOf(most, size_)} * size_ * settings.lanes * 4, nullptr),
        invalid_(PrefixSum::bytesFor(blocksOf(most, size_), 1), nullptr),
        sums_(invalid_.bytes(), nullptr),
        fetches_(4, nullptr) {
    const auto program = [&](const char* stage) {
      gl::ShaderDefines defines = reductionDefines(settings);
      defines[stage] = "1";
      defines["BLOCK"] = std::to_string(size_);
      if (settings.blockScan == ScanAlgorithm::Blelloch) defines["BLELLOCH"] = "1";
      return &context.programs().compute("renderer/compute/reduction_hierarchical.comp.glsl", defines);
    };
    reduce_ = program("REDUCE");
    join_ = program(settings.join == BlockJoin::Compute ? "JOIN" : "FINISH");
    if (settings.join != BlockJoin::Compute) lines_.emplace(context, most, settings);
    fetches_.clearUint(0);
  }

  void run(const StreamInput& in, const StreamOutput& out) const override {
    const uint32_t blocks = blocksOf(in.most, size_);
    const uint32_t perGroup = std::max(size_, uint32_t{kBlockGroup}) / size_;
    const uint32_t groups = (blocks + perGroup - 1) / perGroup;
    clearFetches(fetches_);
    bind(in, out, invalid_);
    dispatch(*reduce_, in, out, blocks, groups);
    scan_.run(invalid_, sums_, blocks);
    bind(in, out, sums_);
    dispatch(*join_, in, out, blocks, lines_ ? 1 : groups);
    if (lines_) lines_->draw(gathered_, sums_, blocks, out.items, out.capacity);
  }

  const gl::Buffer* fetches() const override { return &fetches_; }
  int64_t bytes() const override {
    return scan_.bytes() + gathered_.bytes() + invalid_.bytes() + sums_.bytes() +
           (lines_ ? lines_->bytes() : 0);
  }

 private:
  void bind(const StreamInput& in, const StreamOutput& out, const gl::Buffer& sums) const {
    bindStream(in, out);
    gathered_.bindStorage(kReductionStateBuffer);
    sums.bindStorage(kReductionSumsBuffer);
    fetches_.bindStorage(kReductionFetchesBuffer);
  }
  static void dispatch(const gl::Program& program, const StreamInput& in, const StreamOutput& out,
                       uint32_t blocks, uint32_t groups) {
    program.use();
    setStream(program, in, out);
    program.set("blocks", blocks);
    dispatchGroups(groups);
  }

  uint32_t size_;
  PrefixSum scan_;
  gl::Buffer gathered_, invalid_, sums_, fetches_;
  const gl::Program *reduce_ = nullptr, *join_ = nullptr;
  std::optional<BlockLines> lines_;
};

}  // namespace

std::unique_ptr<StreamReduction::BackEnd> makeHierarchicalForm(gl::Context& context, uint32_t most,
                                                               const ReductionSettings& settings) {
  return std::make_unique<HierarchicalForm>(context, most, settings);
}

}  // namespace limen::compute
