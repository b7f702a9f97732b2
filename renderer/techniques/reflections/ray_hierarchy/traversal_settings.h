// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"
#include "renderer/compute/stream_reduction.h"
#include "renderer/techniques/reflections/ray_hierarchy/cone_sphere.h"

namespace limen::techniques {

constexpr EnumNames<BundleMerge, 2> enumNames(BundleMerge) {
  return {{{{BundleMerge::Mean, "mean"}, {BundleMerge::Pairwise, "pairwise"}}}};
}
constexpr EnumNames<BundleTest, 3> enumNames(BundleTest) {
  return {{{{BundleTest::Tight, "tight"}, {BundleTest::Robust, "robust"}, {BundleTest::Printed, "printed"}}}};
}

/// What happens to pairs that find no room. Whatever is chosen, those that still find none are followed to
/// the rays at once, one group each time: slower, but no frame loses any, and none waits for the CPU.
struct HalvedBatches {
  static constexpr const char *kKind = "halved_batches",
                              *kSummary = "halve batches of triangles that overflowed, from a later frame on";
  int mostBatches = 256;
  static const SettingsTable<HalvedBatches>& table();
};
struct SpilledPairs {
  static constexpr const char *kKind = "spilled_pairs",
                              *kSummary = "pairs without room wait in the CPU's memory for later batches";
  int room = 4194304;
  static const SettingsTable<SpilledPairs>& table();
};
struct FixedBatches {
  static constexpr const char *kKind = "fixed_batches", *kSummary = "batches of a fixed number of triangles";
  int triangles = 1048576;
  static const SettingsTable<FixedBatches>& table();
};
using Overflow = std::variant<HalvedBatches, SpilledPairs, FixedBatches>;

/// How the pairs that remain are packed.
struct FusedReduction {
  static constexpr const char *kKind = "fused",
                              *kSummary = "by the group that tests them, which asks for room once";
  static const SettingsTable<FusedReduction>& table();
};
struct SeparateReduction {
  static constexpr const char *kKind = "separate",
                              *kSummary = "four places for each pair, then a reduction of the stream";
  compute::ReductionForm form = compute::ReductionForm::Scatter;
  static const SettingsTable<SeparateReduction>& table();
};
using PairReduction = std::variant<FusedReduction, SeparateReduction>;

struct TraversalSettings {
  BundleMerge merge = BundleMerge::Pairwise;
  BundleTest test = BundleTest::Tight;
  int startNodes = 256;
  int leafSide = 1;
  int capacity = 4194304;
  PairReduction reduction = FusedReduction{};
  Overflow overflow = HalvedBatches{};
  void check() const;
  static const SettingsTable<TraversalSettings>& table();
};

}  // namespace limen::techniques
