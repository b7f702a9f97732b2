// SPDX-License-Identifier: BSD-3-Clause
// Sparse streams (Roger 2008, section 4.4). What is rendered of such a scene is a plate that stands for it.
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

enum class ValidItems { Random, Runs, OneBlock, Alternating };
constexpr EnumNames<ValidItems, 4> enumNames(ValidItems) {
  return {{{{ValidItems::Random, "random"},
            {ValidItems::Runs, "runs"},
            {ValidItems::OneBlock, "one_block"},
            {ValidItems::Alternating, "alternating"}}}};
}

struct StreamSettings {
  int elements = 262144;
  double validShare = 0.6;
  ValidItems distribution = ValidItems::Random;
  int runLength = 64, buckets = 9, seed = 1;
  static const SettingsTable<StreamSettings>& table() {
    using S = StreamSettings;
    static const SettingsTable<S> kTable = {
        // Item numbers stay below 2^24, so that 32-bit floats hold them exactly.
        {&S::elements, "elements", {0, 16777216}, "items", "Length of the stream", "Roger 2008, 4.4"},
        {&S::validShare, "valid_share", {0, 1}, "", "Share of valid items", "Roger 2008, 4.4"},
        {&S::distribution, "distribution",
         "Where the valid items are: anywhere, in runs, all in one block in the middle, or spread evenly"},
        {&S::runLength, "run_length", {1, 65536}, "items", "Mean length of a run, where they come in runs"},
        {&S::buckets,
         "buckets",
         {1, 16},
         "buckets",
         "Values of the keys that a bucket sort goes by",
         "Roger 2008, 4.5"},
        {&S::seed, "seed", {0, 1e9}, "", "Of the random numbers"}};
    return kTable;
  }
};

/// Runs of valid items and gaps have geometric lengths, whose means give the share.
class Runs {
 public:
  Runs(double share, double length) {
    const double gap = share > 0.0 ? length * (1.0 - share) / share : 1.0;
    // No gap is shorter than an item: then runs are longer.
    toInvalid_ = gap >= 1.0 ? 1.0 / length : (1.0 - share) / share;
    toValid_ = share > 0.0 ? std::min(1.0 / gap, 1.0) : 0.0;
  }
  bool next(Random& random) {
    valid_ = random.uniform(0.0, 1.0) < (valid_ ? 1.0 - toInvalid_ : toValid_);
    return valid_;
  }
  void start(bool valid) { valid_ = valid; }

 private:
  double toInvalid_, toValid_;
  bool valid_ = false;
};

ItemStream itemStream(const StreamSettings& settings) {
  const auto count = static_cast<uint32_t>(settings.elements);
  const double share = settings.validShare;
  Random random(settings.seed);
  Runs runs(share, settings.runLength);
  runs.start(random.uniform(0.0, 1.0) < share);
  const auto kept = static_cast<uint32_t>(std::llround(share * count));
  const uint32_t blockStart = (count - kept) / 2;
  ItemStream out;
  out.items.reserve(count), out.keys.reserve(count);
  out.buckets = static_cast<uint32_t>(settings.buckets);
  for (uint32_t i = 0; i < count; ++i) {
    bool valid = false;
    switch (settings.distribution) {
      case ValidItems::Random:
        valid = random.uniform(0.0, 1.0) < share;
        break;
      case ValidItems::Runs:
        valid = share == 1.0 || runs.next(random);
        break;
      case ValidItems::OneBlock:
        valid = i >= blockStart && i < blockStart + kept;
        break;
      case ValidItems::Alternating:
        valid = std::floor((i + 1) * share) > std::floor(i * share);
        break;
    }
    out.items.push_back(valid ? i : ItemStream::kInvalid);
    out.keys.push_back(static_cast<uint32_t>(random.uniform(0.0, settings.buckets)));
  }
  return out;
}

Scene buildStream(const StreamSettings& settings) {
  Scene scene;
  addGround(scene, 4.0);
  addPart(scene, "plate", box({-0.5, 0.0, -0.1}, {0.5, 1.0, 0.1}), {0.6F, 0.6F, 0.6F});
  frameStanding(scene, 1.0, 0.5);
  scene.items = itemStream(settings);
  return scene;
}

const RegisteredScene<StreamSettings> kStreamRegistered{
    {.name = "stream",
     .version = 1,
     .summary = "A sparse stream of items, most of whose length may be invalid",
     .source = "Roger 2008, section 4.4"},
    buildStream};

}  // namespace
}  // namespace limen::scene
