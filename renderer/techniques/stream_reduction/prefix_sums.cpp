// SPDX-License-Identifier: BSD-3-Clause
// The scan that other techniques share, alone: how many valid items come before each one. Beside it a plain
// copy of as many bytes, which no scan can beat: it reads each number once and writes one for each (Merrill
// and Garland 2016, section 4).
#include <epoxy/gl.h>

#include "renderer/compute/prefix_sum.h"
#include "renderer/techniques/stream_reduction/stream_bindings.h"
#include "renderer/techniques/stream_reduction/stream_technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kBytesText = "Bytes that a frame must move at least";

std::vector<Quantity> sumQuantities() {
  return {{"items", "Items", "items", Direction::Neither},
          {"bytes_moved", kBytesText, "bytes", Direction::LowerIsBetter}};
}

/// Valid items before each of a stream's, one by one.
std::vector<uint32_t> sumsOf(const scene::ItemStream& stream) {
  std::vector<uint32_t> out;
  out.reserve(stream.items.size() + 4);
  uint32_t sum = 0;
  for (const uint32_t item : stream.items) {
    out.push_back(sum);
    sum += item == scene::ItemStream::kInvalid ? 0 : 1;
  }
  return out;
}

struct PrefixSumSettings {
  compute::ScanForm scan = compute::ScanForm::Auto;
  static const SettingsTable<PrefixSumSettings>& table() {
    using S = PrefixSumSettings;
    static const SettingsTable<S> kTable = {
        {&S::scan, "scan", "Sums in one dispatch, where each tile looks back at those before it, or in three",
         "Merrill and Garland 2016"}};
    return kTable;
  }
};

class PrefixSumTechnique : public StreamTechnique {
 public:
  using Settings = PrefixSumSettings;
  explicit PrefixSumTechnique(const Settings& settings) : settings_(settings) {}

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    sum_->run(*flags_, output(), itemCount());
  }

  /// Sums of tiles add less than a hundredth.
  std::vector<Counter> count(frame::Frame&) override {
    const bool once = sum_->form() == compute::ScanForm::LookBack;
    return {{"items", double(itemCount())}, {"bytes_moved", (once ? 8.0 : 12.0) * itemCount()}};
  }

 protected:
  int64_t prepareForm(frame::Frame& frame) override {
    sum_.emplace(frame.context(), itemCount(), 1, settings_.scan);
    std::vector<uint32_t> valid;
    for (const uint32_t item : frame.scene().items->items)
      valid.push_back(item == scene::ItemStream::kInvalid ? 0 : 1);
    valid.resize(static_cast<size_t>(compute::PrefixSum::bytesFor(itemCount(), 1) / 4));
    flags_.emplace(valid);
    const uint32_t count = itemCount();
    counts().write(0, 4, &count);
    return sum_->bytes() + flags_->bytes();
  }
  int64_t outputBytes(uint32_t items) const override { return compute::PrefixSum::bytesFor(items, 1); }
  uint32_t countAt() const override { return 0; }

 private:
  Settings settings_;
  std::optional<compute::PrefixSum> sum_;
  std::optional<gl::Buffer> flags_;
};

enum class Copier { Compute, Driver };
constexpr EnumNames<Copier, 2> enumNames(Copier) {
  return {{{{Copier::Compute, "compute"}, {Copier::Driver, "driver"}}}};
}

struct CopySettings {
  Copier by = Copier::Compute;
  static const SettingsTable<CopySettings>& table() {
    static const SettingsTable<CopySettings> kTable = {
        {&CopySettings::by, "by", "Who copies: a compute shader, 16 bytes an invocation, or the driver"}};
    return kTable;
  }
};

/// What it copies are the sums, so that its product is that of a scan.
class CopyTechnique : public StreamTechnique {
 public:
  using Settings = CopySettings;
  explicit CopyTechnique(const Settings& settings) : settings_(settings) {}

  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    if (settings_.by == Copier::Driver) {
      glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
      glCopyNamedBufferSubData(sums_->id(), output().id(), 0, 0, sums_->bytes());
      return;
    }
    const auto quads = static_cast<uint32_t>(sums_->bytes() / 16);
    sums_->bindStorage(kStreamItemsBuffer);
    output().bindStorage(kStreamCopyBuffer);
    copy_->set("quads", quads);
    copy_->use();
    // Rows of groups, as no dimension has more than 65,535.
    const uint32_t groups = (quads + uint32_t(kStreamCopyGroup) - 1) / uint32_t(kStreamCopyGroup),
                   rows = std::max((groups + 65534) / 65535, 1U);
    glDispatchCompute((groups + rows - 1) / rows, rows, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }

  std::vector<Counter> count(frame::Frame&) override {
    return {{"items", double(itemCount())}, {"bytes_moved", 8.0 * itemCount()}};
  }

 protected:
  int64_t prepareForm(frame::Frame& frame) override {
    copy_ = &frame.context().programs().compute("renderer/techniques/stream_reduction/stream_copy.comp.glsl");
    std::vector<uint32_t> sums = sumsOf(*frame.scene().items);
    sums.resize(static_cast<size_t>(outputBytes(itemCount()) / 4));
    sums_.emplace(sums);
    const uint32_t count = itemCount();
    counts().write(0, 4, &count);
    return sums_->bytes();
  }
  int64_t outputBytes(uint32_t items) const override { return compute::PrefixSum::bytesFor(items, 1); }
  uint32_t countAt() const override { return 0; }

 private:
  Settings settings_;
  const gl::Program* copy_ = nullptr;
  std::optional<gl::Buffer> sums_;
};

struct NoSumSettings {
  static const SettingsTable<NoSumSettings>& table() {
    static const SettingsTable<NoSumSettings> kTable = {};
    return kTable;
  }
};

/// The reference.
class SequentialSums : public Technique {
 public:
  using Settings = NoSumSettings;
  explicit SequentialSums(const Settings&) {}

  void prepare(frame::Frame& frame) override {
    stream_ = &*frame.scene().items;
    product_.emplace(gl::Format::R32F, streamSizePx(frame));
    frame.passes().setBytesHeld("stream_reduction/reduce", 0);
  }
  void render(frame::Frame& frame) override {
    const auto scope = frame.passes().open("stream_reduction/reduce");
    sums_ = sumsOf(*stream_);
  }
  const gl::Texture& product() const override {
    Image out(product_->sizePx().x, product_->sizePx().y, 1);
    std::fill(out.data.begin(), out.data.end(), kStreamEnd);
    std::copy(sums_.begin(), sums_.end(), out.data.begin());
    product_->write(out);
    return *product_;
  }
  std::vector<Counter> count(frame::Frame&) override {
    return {{"items", double(sums_.size())}, {"bytes_moved", 8.0 * double(sums_.size())}};
  }

 private:
  const scene::ItemStream* stream_ = nullptr;
  std::vector<uint32_t> sums_;
  std::optional<gl::Texture> product_;
};

TechniqueInfo sumInfo(const std::string& name, const std::string& summary, const std::string& source) {
  return {.name = "stream_reduction/" + name,
          .version = 1,
          .summary = summary,
          .source = source,
          .product = ProductKind::Stream,
          .needs = {"item_stream"},
          .counters = sumQuantities()};
}
TechniqueInfo sequentialSumInfo() {
  TechniqueInfo info =
      sumInfo("sequential_sums", "Valid items before each one, counted one by one on the CPU", "bench");
  info.reference = info.onCpu = true;
  return info;
}

const RegisteredTechnique<PrefixSumTechnique> kPrefixSumRegistered{
    sumInfo("prefix_sum", "Valid items before each one, by the scan that techniques share",
            "Merrill and Garland 2016; Schwarz 2009, section 7.6.1 (SC-70)")};
const RegisteredTechnique<CopyTechnique> kCopyRegistered{
    sumInfo("copy", "A plain copy of as many bytes as a scan moves at least",
            "bench; the bound of Merrill and Garland 2016, section 4")};
const RegisteredTechnique<SequentialSums> kSequentialSumsRegistered{sequentialSumInfo()};

}  // namespace
}  // namespace limen::techniques
