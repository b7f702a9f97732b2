// SPDX-License-Identifier: BSD-3-Clause
// Streams packed and distributed one item after another on the CPU (Roger 2008, section 4.2; R-27): what the
// others are compared with. Their product is written when it is asked for, outside the timed frames.
#include "renderer/techniques/stream_reduction/stream_technique.h"

namespace limen::techniques {
namespace {

struct NoSequentialSettings {
  static const SettingsTable<NoSequentialSettings>& table() {
    static const SettingsTable<NoSequentialSettings> kTable = {};
    return kTable;
  }
};

class SequentialStream : public Technique {
 public:
  using Settings = NoSequentialSettings;

  void prepare(frame::Frame& frame) override {
    stream_ = &*frame.scene().items;
    kept_.resize(stream_->items.size());
    product_.emplace(gl::Format::R32F, streamSizePx(frame));
    frame.passes().setBytesHeld("stream_reduction/reduce", 0);
  }

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    count_ = pack(*stream_, kept_);
  }

  const gl::Texture& product() const override {
    Image out(product_->sizePx().x, product_->sizePx().y, 1);
    std::fill(out.data.begin(), out.data.end(), kStreamEnd);
    std::copy(kept_.begin(), kept_.begin() + static_cast<long>(count_), out.data.begin());
    product_->write(out);
    return *product_;
  }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"items", double(stream_->items.size())}, {"valid_items", double(count_)}};
  }

  static TechniqueInfo info(const std::string& name, const std::string& summary, const std::string& source) {
    return {.name = name,
            .version = 1,
            .summary = summary,
            .source = source,
            .product = ProductKind::Stream,
            .needs = {"item_stream"},
            .reference = true,
            .onCpu = true,
            .counters = {{"items", "Items", "items", Direction::Neither},
                         {"valid_items", "Valid items", "items", Direction::Neither}}};
  }

 protected:
  /// Writes the items to `kept`, which has room for all, and returns how many they are.
  virtual size_t pack(const scene::ItemStream& stream, std::vector<uint32_t>& kept) = 0;

 private:
  const scene::ItemStream* stream_ = nullptr;
  std::vector<uint32_t> kept_;
  size_t count_ = 0;
  std::optional<gl::Texture> product_;
};

class SequentialReduction : public SequentialStream {
 public:
  explicit SequentialReduction(const Settings&) {}

 protected:
  size_t pack(const scene::ItemStream& stream, std::vector<uint32_t>& kept) override {
    size_t count = 0;
    for (const uint32_t item : stream.items)
      if (item != scene::ItemStream::kInvalid) kept[count++] = item;
    return count;
  }
};

class SequentialDistribution : public SequentialStream {
 public:
  explicit SequentialDistribution(const Settings&) {}

 protected:
  size_t pack(const scene::ItemStream& stream, std::vector<uint32_t>& kept) override {
    std::array<size_t, 17> next{};  // where each bucket goes on
    for (size_t i = 0; i < stream.items.size(); ++i)
      if (stream.items[i] != scene::ItemStream::kInvalid) ++next.at(stream.keys[i] + 1);
    for (size_t bucket = 1; bucket < next.size(); ++bucket) next[bucket] += next[bucket - 1];
    const size_t count = next.back();
    for (size_t i = 0; i < stream.items.size(); ++i)
      if (stream.items[i] != scene::ItemStream::kInvalid) kept[next[stream.keys[i]]++] = stream.items[i];
    return count;
  }
};

const RegisteredTechnique<SequentialReduction> kSequentialReduction{
    SequentialStream::info("stream_reduction/sequential", "Valid items packed one by one on the CPU",
                           "Roger 2008, section 4.2 (R-27)")};
const RegisteredTechnique<SequentialDistribution> kSequentialDistribution{SequentialStream::info(
    "stream_reduction/sequential_distribution", "Valid items distributed to buckets one by one on the CPU",
    "Roger 2008, section 4.5 (R-36)")};

}  // namespace
}  // namespace limen::techniques
