// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by gathering alone, over the whole stream: after Horn 2005, and after Sengupta et al. 2006
// with Blelloch's scan (Roger 2008, section 4.2).
#include "renderer/compute/reduction_forms.h"
#include "renderer/compute/scan.h"

namespace limen::compute {
namespace {

class SearchForm : public StreamReduction::BackEnd {
 public:
  SearchForm(gl::Context& context, uint32_t most, const ReductionSettings& settings)
      : scan_(context, most,
              {.algorithm = settings.form == ReductionForm::Horn ? ScanAlgorithm::HillisSteele
                                                                 : ScanAlgorithm::Blelloch}),
        marks_(int64_t{most} * 4, nullptr),
        sums_(int64_t{most} * 4, nullptr),
        fetches_(4, nullptr) {
    const auto program = [&](const char* stage) {
      gl::ShaderDefines defines = reductionDefines(settings);
      defines[stage] = "1";
      return &context.programs().compute("renderer/compute/reduction_search.comp.glsl", defines);
    };
    mark_ = program("MARK"), search_ = program("SEARCH");
    fetches_.clearUint(0);
  }

  void run(const StreamInput& in, const StreamOutput& out) const override {
    bindStream(in, out);
    marks_.bindStorage(kReductionSumsBuffer);
    const uint32_t groups = std::max((in.most + kBlockGroup - 1) / kBlockGroup, 1U);
    mark_->use();
    setStream(*mark_, in, out);
    dispatchGroups(groups);
    scan_.run(marks_, sums_, in.most);
    clearFetches(fetches_);
    bindStream(in, out);
    sums_.bindStorage(kReductionSumsBuffer);
    fetches_.bindStorage(kReductionFetchesBuffer);
    search_->use();
    setStream(*search_, in, out);
    dispatchGroups(groups);
  }

  const gl::Buffer* fetches() const override { return &fetches_; }
  int64_t bytes() const override { return scan_.bytes() + marks_.bytes() + sums_.bytes(); }

 private:
  Scan scan_;
  gl::Buffer marks_, sums_, fetches_;
  const gl::Program *mark_ = nullptr, *search_ = nullptr;
};

}  // namespace

std::unique_ptr<StreamReduction::BackEnd> makeSearchForm(gl::Context& context, uint32_t most,
                                                         const ReductionSettings& settings) {
  return std::make_unique<SearchForm>(context, most, settings);
}

}  // namespace limen::compute
