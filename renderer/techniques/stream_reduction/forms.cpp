// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction in all its forms (Roger 2008, chapter 4): the library of renderer/compute, one technique a
// form. Differences from the thesis:
// - The stream lies in a buffer rather than in a texture, and blocks are scanned and searched in shared
// memory, in one
//   dispatch in place of a pass for each step; texture passes would measure the machine of 2007.
// - Sums over blocks are made by compute/prefix_sum.h.
// - Blocks drawn as lines are copied to a buffer afterwards, which is timed with them.
#include "renderer/compute/prefix_sum.h"
#include "renderer/compute/stream_reduction.h"
#include "renderer/techniques/stream_reduction/stream_technique.h"

namespace limen::techniques {
namespace {

using compute::BlockJoin;
using compute::ItemSearch;
using compute::ReducedCount;
using compute::ReductionForm;
using compute::ReductionSettings;
using compute::ScanAlgorithm;
using compute::ScanForm;
using compute::StreamReduction;

constexpr const char* kSearchText = "How a place of the output finds its item";
constexpr const char* kBlockText = "Items of a block";

struct ScatterReductionSettings {
  StreamItemSettings items;
  ScanForm scan = ScanForm::Auto;
  static const SettingsTable<ScatterReductionSettings>& table() {
    using S = ScatterReductionSettings;
    static const SettingsTable<S> kTable = {included(&S::items),
                                            {&S::scan, "scan",
                                             "Sums in one dispatch, where each tile looks back at those "
                                             "before it, or in two beside the one that scatters"}};
    return kTable;
  }
  ReductionSettings reduction() const {
    switch (scan) {
      case ScanForm::LookBack:
        return {.form = ReductionForm::LookBack};
      case ScanForm::ReduceThenScan:
        return {.form = ReductionForm::ScanScatter};
      default:
        return {.form = ReductionForm::Scatter};
    }
  }
};

struct BlockReductionSettings {
  StreamItemSettings items;
  int blockSize = 64;
  static const SettingsTable<BlockReductionSettings>& table() {
    using S = BlockReductionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::items),
        {&S::blockSize, "block_size", oneOf({8, 16, 32, 64, 128, 256, 512}), "items", kBlockText,
         "Roger 2008, 4.4"}};
    return kTable;
  }
  ReductionSettings reduction() const {
    return {.form = ReductionForm::BlockSequential, .blockSize = blockSize};
  }
};

template <ReductionForm kForm>
struct PlainReductionSettings {
  StreamItemSettings items;
  static const SettingsTable<PlainReductionSettings>& table() {
    static const SettingsTable<PlainReductionSettings> kTable = {included(&PlainReductionSettings::items)};
    return kTable;
  }
  ReductionSettings reduction() const { return {.form = kForm}; }
};

template <ReductionForm kForm>
struct SearchReductionSettings {
  StreamItemSettings items;
  ItemSearch search = ItemSearch::Improved;
  static const SettingsTable<SearchReductionSettings>& table() {
    using S = SearchReductionSettings;
    static const SettingsTable<S> kTable = {included(&S::items),
                                            {&S::search, "search", kSearchText, "Roger 2008, 4.3.2"}};
    return kTable;
  }
  ReductionSettings reduction() const { return {.form = kForm, .search = search}; }
};

struct HierarchicalReductionSettings {
  StreamItemSettings items;
  int blockSize = 64, rowWidth = 2048;
  ScanAlgorithm blockScan = ScanAlgorithm::HillisSteele;
  ItemSearch search = ItemSearch::Improved;
  BlockJoin join = BlockJoin::Compute;
  static const SettingsTable<HierarchicalReductionSettings>& table() {
    using S = HierarchicalReductionSettings;
    static const SettingsTable<S> kTable = {
        included(&S::items),
        {&S::blockSize, "block_size", oneOf({8, 16, 32, 64, 128, 256, 512}), "items", kBlockText,
         "Roger 2008, 4.4"},
        {&S::blockScan, "block_scan", "How a block is summed", "Roger 2008, 4.4"},
        {&S::search, "search", kSearchText, "Roger 2008, 4.3.2"},
        {&S::join, "join", "How reduced blocks are joined: items moved, or blocks drawn as lines",
         "Roger 2008, 4.3.3"},
        {&S::rowWidth, "row_width", oneOf({64, 128, 256, 512, 1024, 2048, 4096}), "px",
         "Width of the texture that lines are drawn into"}};
    return kTable;
  }
  void check() const {
    if (join != BlockJoin::Compute && rowWidth < blockSize)
      throw Error("a block of " + std::to_string(blockSize) + " items is longer than a row", "row_width",
                  "use rows of at least block_size texels");
  }
  ReductionSettings reduction() const {
    return {.form = ReductionForm::Hierarchical,
            .blockSize = blockSize,
            .blockScan = blockScan,
            .search = search,
            .join = join,
            .rowWidth = std::max(rowWidth, blockSize)};
  }
};

template <class S>
class ReductionTechnique : public StreamTechnique {
 public:
  using Settings = S;
  explicit ReductionTechnique(const S& settings)
      : StreamTechnique(settings.items), reduction_(settings.reduction()) {
    reduction_.lanes = settings.items.payload;
    reduction_.flagged = settings.items.flagged;
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    run(*form_);
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    const ReducedCount reduced = counts().template read<ReducedCount>(0, 1)[0];
    std::vector<Counter> out{{"items", double(itemCount())},
                             {"valid_items", double(reduced.valid)},
                             {"lost_items", double(reduced.lost)}};
    if (searches()) {
      ReductionSettings counted = reduction_;
      counted.countFetches = true;
      const StreamReduction counting(frame.context(), itemCount(), counted);
      run(counting);
      out.push_back({"search_fetches_per_item", counting.fetches() / std::max(double(reduced.valid), 1.0)});
    }
    return out;
  }

  static std::vector<Quantity> quantities() {
    return {{"items", "Items", "items", Direction::Neither},
            {"valid_items", "Valid items", "items", Direction::Neither},
            {"lost_items", "Items lost for want of room", "items", Direction::LowerIsBetter},
            {"search_fetches_per_item", "Fetches of searches for each valid item", "fetches",
             Direction::LowerIsBetter}};
  }

 protected:
  int64_t prepareForm(frame::Frame& frame) override {
    form_.emplace(frame.context(), itemCount(), reduction_);
    return form_->bytes();
  }
  uint32_t countAt() const override { return offsetof(ReducedCount, written) / 4; }

 private:
  void run(const StreamReduction& reduction) const {
    reduction.run({items(), itemCount(), flags()}, {output(), itemCount(), counts()});
  }
  bool searches() const {
    return reduction_.form == ReductionForm::Horn || reduction_.form == ReductionForm::GlobalSearch ||
           reduction_.form == ReductionForm::Hierarchical;
  }

  ReductionSettings reduction_;
  std::optional<StreamReduction> form_;
};

template <class S>
using RegisteredReduction = RegisteredTechnique<ReductionTechnique<S>>;

TechniqueInfo reductionInfo(const std::string& name, const std::string& summary, const std::string& source) {
  return {.name = "stream_reduction/" + name,
          .version = 1,
          .summary = summary,
          .source = source,
          .product = ProductKind::Stream,
          .needs = {"item_stream"},
          .counters = ReductionTechnique<ScatterReductionSettings>::quantities()};
}

const RegisteredReduction<ScatterReductionSettings> kScatterReduction{
    reductionInfo("scatter", "Valid items packed by sums and scatter, each read once on a GPU",
                  "Sengupta et al. 2006; Merrill and Garland 2016; Roger 2008, section 4.2.2 (R-34)")};
const RegisteredReduction<BlockReductionSettings> kBlockReduction{
    reductionInfo("block_sequential", "Valid items packed block by block, each block one by one",
                  "Roger 2008, discussion of chapter 4 (R-34)")};
const RegisteredReduction<PlainReductionSettings<ReductionForm::Append>> kAppendReduction{
    reductionInfo("append", "Valid items appended by atomic additions, in no particular order",
                  "Roger 2008, section 4.2.2 (R-34)")};
const RegisteredReduction<SearchReductionSettings<ReductionForm::Horn>> kHornReduction{reductionInfo(
    "horn", "Valid items packed by a scan of Hillis and Steele and a search in the whole stream",
    "Horn 2005; Roger 2008, section 4.2.1 (R-28)")};
const RegisteredReduction<SearchReductionSettings<ReductionForm::GlobalSearch>> kBlellochReduction{
    reductionInfo("blelloch", "Valid items packed by Blelloch's scan and a search in the whole stream",
                  "Sengupta et al. 2006; Roger 2008, section 4.2.1 (R-29)")};
const RegisteredReduction<HierarchicalReductionSettings> kHierarchicalReduction{
    reductionInfo("hierarchical", "Valid items packed within blocks, which are then joined",
                  "Roger 2008, section 4.3 (R-30, R-31, R-32)")};
const RegisteredReduction<PlainReductionSettings<ReductionForm::GeometryShader>> kGeometryShaderReduction{
    reductionInfo("geometry_shader", "Valid items passed on by a geometry shader and captured",
                  "Roger 2008, section 4.2.2 (R-33)")};

}  // namespace
}  // namespace limen::techniques
