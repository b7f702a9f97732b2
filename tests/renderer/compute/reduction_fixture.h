// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "renderer/compute/stream_reduction.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::compute {

/// Streams, and their reduction by a loop on the CPU.
class ReductionTest : public gl::GlTest {
 protected:
  struct Items {
    uint32_t count = 0;
    std::vector<uint32_t> words;  ///< lanes words an item
    std::vector<uint32_t> flags;  ///< empty: invalid items are kInvalidItem
  };

  static Items itemsOf(const std::vector<bool>& valid, const ReductionSettings& settings) {
    Items out;
    out.count = static_cast<uint32_t>(valid.size());
    for (uint32_t i = 0; i < out.count; ++i) {
      // Where flags decide, an item may well hold the word that otherwise marks invalid ones.
      const bool marked = settings.flagged ? i % 5 == 0 : !valid[i];
      out.words.push_back(marked ? kInvalidItem : i);
      // Nor does the second word decide.
      if (settings.lanes == 2) out.words.push_back(i % 7 == 0 ? kInvalidItem : 3 * i + 1);
      if (settings.flagged) out.flags.push_back(valid[i] ? 1 + i : 0);
    }
    return out;
  }
  static Items randomItems(uint32_t count, double share, const ReductionSettings& settings) {
    std::mt19937 random(count + 1);
    std::bernoulli_distribution isValid(share);
    std::vector<bool> valid(count);
    for (uint32_t i = 0; i < count; ++i) valid[i] = isValid(random);
    return itemsOf(valid, settings);
  }

  static std::vector<uint32_t> sequentially(const Items& in, const ReductionSettings& settings) {
    std::vector<uint32_t> out;
    const auto lanes = static_cast<uint32_t>(settings.lanes);
    for (uint32_t i = 0; i < in.count; ++i) {
      if (settings.flagged ? in.flags[i] == 0 : in.words[size_t{i} * lanes] == kInvalidItem) continue;
      for (uint32_t lane = 0; lane < lanes; ++lane) out.push_back(in.words[size_t{i} * lanes + lane]);
    }
    return settings.form == ReductionForm::Append ? sorted(out, settings.lanes) : out;
  }

  struct Result {
    std::vector<uint32_t> words;  ///< the whole output buffer
    ReducedCount count;
  };
  static constexpr uint32_t kUntouched = 55555;

  static Result run(const StreamReduction& reduction, const ReductionSettings& settings, const Items& in,
                    uint32_t capacity, const gl::Buffer* countIn = nullptr, uint32_t most = 0) {
    const uint32_t held = std::max(in.count, most);
    // What follows the items must not count, though it is valid.
    const gl::Buffer items(padded(in.words, held, settings.lanes)), flags(padded(in.flags, held, 1));
    // Room beyond the capacity shows whether anything is written there.
    const gl::Buffer out(padded({}, capacity + 1000, settings.lanes, kUntouched));
    const gl::Buffer count(std::vector<uint32_t>(8, kUntouched));
    reduction.run({items, countIn ? most : in.count, settings.flagged ? &flags : nullptr, countIn, 4},
                  {out, capacity, count, 64});
    return {out.read<uint32_t>(), count.read<ReducedCount>()[0]};
  }
  /// The valid items; those of an unordered form sorted.
  static std::vector<uint32_t> reduced(const StreamReduction& reduction, const ReductionSettings& settings,
                                       const Items& in) {
    Result result = run(reduction, settings, in, in.count);
    EXPECT_EQ(result.count.lost, 0U);
    EXPECT_EQ(result.count.written, result.count.valid);
    const size_t words = size_t{result.count.written} * static_cast<size_t>(settings.lanes);
    if (words > result.words.size()) return {};
    result.words.resize(words);
    return reduction.ordered() ? result.words : sorted(result.words, settings.lanes);
  }

  static std::vector<uint32_t> sorted(const std::vector<uint32_t>& words, int lanes) {
    std::vector<std::vector<uint32_t>> items;
    for (size_t i = 0; i < words.size(); i += static_cast<size_t>(lanes))
      items.emplace_back(words.begin() + static_cast<long>(i), words.begin() + static_cast<long>(i) + lanes);
    std::sort(items.begin(), items.end());
    std::vector<uint32_t> out;
    for (const auto& item : items) out.insert(out.end(), item.begin(), item.end());
    return out;
  }

  static std::vector<ReductionSettings> settingsOfAllForms();
  static std::string describe(const ReductionSettings& settings) {
    return std::string(toText(settings.form)) + ", " + std::to_string(settings.lanes) + " words" +
           (settings.flagged ? ", flagged" : "") + ", blocks of " + std::to_string(settings.blockSize) +
           ", " + toText(settings.blockScan) + ", " + toText(settings.search) + ", " + toText(settings.join) +
           ", rows of " + std::to_string(settings.rowWidth);
  }
  /// Around multiples of blocks, of groups and of tiles.
  static std::vector<uint32_t> counts() {
    return {0, 1, 2, 3, 5, 7, 8, 9, 63, 64, 65, 511, 512, 513, 2047, 2049, 4095, 4096, 4097, 12345, 100003};
  }

 private:
  static std::vector<uint32_t> padded(std::vector<uint32_t> words, uint32_t count, int lanes,
                                      uint32_t with = 77777) {
    words.resize(static_cast<size_t>(StreamReduction::bytesFor(count, lanes) / 4), with);
    return words;
  }
};

inline std::vector<ReductionSettings> ReductionTest::settingsOfAllForms() {
  std::vector<ReductionSettings> out;
  const auto add = [&](ReductionSettings settings) {
    for (const int lanes : {1, 2})
      for (const bool flagged : {false, true}) {
        settings.lanes = lanes, settings.flagged = flagged;
        out.push_back(settings);
      }
  };
  for (const ReductionForm form : {ReductionForm::LookBack, ReductionForm::ScanScatter, ReductionForm::Append,
                                   ReductionForm::GeometryShader})
    add({.form = form});
  // As devices with subgroups have them: a group of 32 stands for one.
  for (const ReductionForm form :
       {ReductionForm::LookBack, ReductionForm::ScanScatter, ReductionForm::Append})
    for (const int rows : {2, 8})
      add({.form = form, .group = 32, .rows = rows, .tickets = rows == 2, .emulateSubgroups = true});
  for (const int blockSize : {8, 64, 512})
    add({.form = ReductionForm::BlockSequential, .blockSize = blockSize});
  for (const ItemSearch search : {ItemSearch::Fixed, ItemSearch::Improved}) {
    for (const ReductionForm form : {ReductionForm::Horn, ReductionForm::GlobalSearch})
      add({.form = form, .search = search});
    for (const int blockSize : {8, 64, 512})
      for (const ScanAlgorithm scan : {ScanAlgorithm::HillisSteele, ScanAlgorithm::Blelloch})
        add({.form = ReductionForm::Hierarchical,
             .blockSize = blockSize,
             .blockScan = scan,
             .search = search});
  }
  // Rows so short that most blocks wrap, and longer ones.
  for (const BlockJoin join : {BlockJoin::LinesTwice, BlockJoin::LinesSplit}) {
    add({.form = ReductionForm::Hierarchical, .blockSize = 64, .join = join, .rowWidth = 64});
    add({.form = ReductionForm::Hierarchical, .blockSize = 8, .join = join, .rowWidth = 1024});
  }
  return out;
}

}  // namespace limen::compute
