// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "experiments/viewer/mailbox.h"

namespace limen::viewer {
namespace {

Parameter parameterOf(const std::string& technique, const std::string& name) {
  for (const Parameter& parameter : techniqueParameters(technique))
    if (parameter.name == name) return parameter;
  ADD_FAILURE() << technique << " has no " << name;
  return {};
}

TEST(Setup, HoldsOnlyWhatIsNotAtItsDefault) {
  Entry chosen{"soft_shadows/ray_traced", {}};
  const Parameter samples = parameterOf(chosen.name, "samples");
  give(chosen, samples, int64_t{64});
  EXPECT_EQ(chosen.given.size(), 1U);
  EXPECT_EQ(shown(chosen, samples), ParameterValue(int64_t{64}));
  give(chosen, samples, samples.defaultValue);
  EXPECT_TRUE(chosen.given.empty());
  EXPECT_THROW(give(chosen, samples, int64_t{-3}), Error);
  EXPECT_TRUE(chosen.given.empty());
}

TEST(Setup, ReferencesGoFromCoarseToFineByValidSteps) {
  const std::vector<Entry> steps = fromCoarseToFine({"soft_shadows/ray_traced", {}});
  ASSERT_GE(steps.size(), 3U);
  int64_t before = 0;
  for (const Entry& step : steps) {
    const int64_t samples = completeTechnique(step).values.integer("samples");
    EXPECT_GT(samples, before);
    before = samples;
  }
  EXPECT_EQ(before, 1024);
  EXPECT_EQ(fromCoarseToFine({"soft_shadows/exact_union", {}}).size(), 1U);
}

TEST(Setup, AUsualReferenceMakesTheSameKindOfProduct) {
  for (const char* name :
       {"soft_shadows/bitmask", "lod/blend", "soft_shadows/bitmask_coloured", "perception/threshold_map"}) {
    const auto reference = usualReference(name);
    ASSERT_TRUE(reference) << name;
    const std::vector<std::string> names = comparable(name);
    EXPECT_NE(std::find(names.begin(), names.end(), reference->name), names.end()) << name;
  }
}

TEST(Mailbox, KeepsTheNewestAlone) {
  Mailbox<int> box;
  EXPECT_FALSE(box.take());
  box.put(1);
  box.put(2);
  EXPECT_EQ(box.take(), 2);
  EXPECT_FALSE(box.take());
  box.putBack(2);
  EXPECT_EQ(box.take(), 2);
  box.put(3);
  box.putBack(2);
  EXPECT_EQ(box.take(), 3);
  EXPECT_FALSE(box.wait(std::chrono::milliseconds(1)));
  box.close();
  EXPECT_TRUE(box.wait(std::chrono::hours(1)));
}

}  // namespace
}  // namespace limen::viewer
