// SPDX-License-Identifier: BSD-3-Clause
// Bucket sort by as many reductions as buckets, whose sums are made at once (Roger 2008, section 4.5; R-36).
// Items are scattered rather than searched for.
#include "renderer/compute/bucket_sort.h"

#include "renderer/techniques/stream_reduction/stream_technique.h"

namespace limen::techniques {
namespace {

struct BucketSortSettings {
  static const SettingsTable<BucketSortSettings>& table() {
    static const SettingsTable<BucketSortSettings> kTable = {};
    return kTable;
  }
};

class BucketSortTechnique : public StreamTechnique {
 public:
  using Settings = BucketSortSettings;
  explicit BucketSortTechnique(const BucketSortSettings&) {}

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    sort_->run(items(), *keys_, itemCount(), output(), counts());
  }

  std::vector<Counter> count(frame::Frame&) override {
    const std::vector<uint32_t> starts = counts().read<uint32_t>(0, buckets_ + 1);
    uint32_t largest = 0;
    for (size_t i = 1; i < starts.size(); ++i) largest = std::max(largest, starts[i] - starts[i - 1]);
    return {{"items", double(itemCount())},
            {"valid_items", double(starts.back())},
            {"largest_bucket", double(largest)}};
  }

  static std::vector<Quantity> quantities() {
    return {{"items", "Items", "items", Direction::Neither},
            {"valid_items", "Valid items", "items", Direction::Neither},
            {"largest_bucket", "Items in the largest bucket", "items", Direction::Neither}};
  }

 protected:
  int64_t prepareForm(frame::Frame& frame) override {
    const scene::ItemStream& stream = *frame.scene().items;
    buckets_ = static_cast<int>(stream.buckets);
    keys_.emplace(stream.keys);
    sort_.emplace(frame.context(), itemCount(), buckets_);
    return keys_->bytes() + sort_->bytes();
  }
  uint32_t countAt() const override { return static_cast<uint32_t>(buckets_); }

 private:
  int buckets_ = 1;
  std::optional<gl::Buffer> keys_;
  std::optional<compute::BucketSort> sort_;
};

const RegisteredTechnique<BucketSortTechnique> kBucketSortRegistered{
    {.name = "stream_reduction/bucket_sort",
     .version = 1,
     .summary = "Valid items distributed to buckets in their order, by a reduction for each bucket at once",
     .source = "Roger 2008, section 4.5 (R-36)",
     .product = ProductKind::Stream,
     .needs = {"item_stream"},
     .counters = BucketSortTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
