// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "experiments/viewer/export_descriptor.h"
#include "experiments/viewer/mailbox.h"

namespace limen::viewer {
namespace {

using testing::HasSubstr;
using Values = std::map<std::string, ParameterValue>;

constexpr const char* kAlternatives = "test/alternatives";

TEST(ViewSetup, HoldsOnlyWhatIsNotAtItsDefault) {
  Entry entry{"soft_shadows/ray_traced", {}};
  const std::vector<Parameter>& declared = techniqueParameters(entry.name);
  const Parameter* samples = findDeclaration(declared, entry, "samples");
  ASSERT_TRUE(samples);
  setParameter(entry, declared, "samples", int64_t{64});
  EXPECT_EQ(entry.given.size(), 1U);
  EXPECT_EQ(valueAt(entry, "samples", *samples), ParameterValue(int64_t{64}));
  setParameter(entry, declared, "samples", samples->defaultValue);
  EXPECT_TRUE(entry.given.empty());
  EXPECT_THROW(setParameter(entry, declared, "samples", int64_t{-3}), Error);
  EXPECT_TRUE(entry.given.empty());
}

TEST(ViewSetup, AnotherAlternativeDropsTheParametersOfThePreviousOne) {
  const std::vector<Parameter>& declared = techniqueParameters(kAlternatives);
  Entry entry{kAlternatives, {}};
  setParameter(entry, declared, "source.level", 0.25);
  setParameter(entry, declared, "gain.factor", 2.0);
  setParameter(entry, declared, "source", "stepped");
  EXPECT_EQ(entry.given, (Values{{"source", "stepped"}, {"gain.factor", 2.0}}));
  EXPECT_NO_THROW(completeTechnique(entry));
  setParameter(entry, declared, "source.steps", int64_t{8});
  setParameter(entry, declared, "source", "fixed");
  EXPECT_EQ(entry.given, (Values{{"gain.factor", 2.0}}));
}

TEST(ViewSetup, AParameterOfAnotherAlternativeIsRefusedWithWhereItExists) {
  const std::vector<Parameter>& declared = techniqueParameters(kAlternatives);
  Entry entry{kAlternatives, {}};
  EXPECT_EQ(findDeclaration(declared, entry, "source.steps"), nullptr);
  EXPECT_EQ(findDeclaration(declared, entry, "gain"), nullptr) << "a group has no value";
  try {
    setParameter(entry, declared, "source.steps", int64_t{8});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("source: stepped"));
  }
  EXPECT_THROW(setParameter(entry, declared, "source.lvel", 0.5), Error);
  EXPECT_THROW(setParameter(entry, declared, "gain", 0.5), Error);
  EXPECT_TRUE(entry.given.empty());
}

TEST(ViewSetup, AnAlternativeChosenAgainHasTheValuesItHad) {
  const std::vector<Parameter>& declared = techniqueParameters(kAlternatives);
  Entry entry{kAlternatives, {}};
  ParameterMemory memory;
  memory.set(entry, declared, "source", "stepped");
  memory.set(entry, declared, "source.steps", int64_t{8});
  memory.set(entry, declared, "source", "dark");
  EXPECT_EQ(entry.given, (Values{{"source", "dark"}}));
  memory.set(entry, declared, "source", "stepped");
  EXPECT_EQ(entry.given, (Values{{"source", "stepped"}, {"source.steps", int64_t{8}}}));
  EXPECT_THROW(memory.set(entry, declared, "source", "bright"), Error);
  EXPECT_EQ(entry.given, (Values{{"source", "stepped"}, {"source.steps", int64_t{8}}}));
}

TEST(ViewSetup, APresetGivesDefaultsAndDropsWhatItDoesNotHave) {
  const std::string contrast = "predictor.sensitivity.contrast";
  Entry entry{"popping/lod_switch", {}};
  const auto set = [&](const std::string& path, const ParameterValue& value) {
    setParameter(entry, techniqueParameters(entry), path, value);
  };
  const auto shown = [&] {
    const std::vector<Parameter> declared = techniqueParameters(entry);
    const Parameter* parameter = findDeclaration(declared, entry, contrast);
    return parameter ? toText(valueAt(entry, contrast, *parameter)) : "";
  };
  EXPECT_EQ(shown(), "dkl");
  set("predictor.model", "schwarz_2009");
  EXPECT_EQ(shown(), "cones");
  set(contrast + ".divide_grey_gain", false);
  set("predictor.model", "limen_2026");
  dropAbsent(entry, techniqueParameters(entry));
  EXPECT_EQ(shown(), "dkl");
  EXPECT_TRUE(entry.given.empty());
  EXPECT_NO_THROW(completeTechnique(entry));
}

TEST(ViewSetup, AnExportedDescriptorNestsAlternatives) {
  ViewSetup setup;
  setup.scene.name = "sphere_grid";
  setup.technique = {kAlternatives,
                     {{"source", "stepped"}, {"source.steps", int64_t{8}}, {"gain.factor", 1.5}}};
  EXPECT_THAT(descriptorOf(setup), HasSubstr("- {name: test/alternatives, source: {kind: stepped, steps: 8}, "
                                             "gain: {factor: 1.5}}\n"));
}

TEST(ViewSetup, ReferencesGoFromCoarseToFineByValidSteps) {
  const std::vector<Entry> steps = fromCoarseToFine({"soft_shadows/ray_traced", {}});
  ASSERT_GE(steps.size(), 3U);
  int64_t before = 0;
  for (const Entry& step : steps) {
    const int64_t samples = std::get<int64_t>(*completeTechnique(step).values.find("samples"));
    EXPECT_GT(samples, before);
    before = samples;
  }
  EXPECT_EQ(before, 1024);
  EXPECT_EQ(fromCoarseToFine({"soft_shadows/exact_union", {}}).size(), 1U);
}

TEST(ViewSetup, AUsualReferenceMakesTheSameKindOfProduct) {
  for (const char* name :
       {"soft_shadows/bitmask", "lod/blend", "soft_shadows/bitmask_coloured", "perception/threshold_map"}) {
    const auto reference = usualReference(name);
    ASSERT_TRUE(reference) << name;
    const std::vector<std::string> names = comparable(name);
    EXPECT_NE(std::find(names.begin(), names.end(), reference->name), names.end()) << name;
  }
  // Not rays against the mesh, which approximates the patches itself.
  EXPECT_EQ(usualReference("tessellation/compute")->name, "ray_casting/exact");
  EXPECT_EQ(usualReference("soft_shadows/bitmask")->name, "soft_shadows/ray_traced");
  // Of its own family: not occlusion for mirrors, nor samples of a cone for what has none.
  EXPECT_EQ(usualReference("reflections/ray_hierarchy")->name, "reflections/reference");
  EXPECT_EQ(usualReference("ambient_occlusion/separable")->name, "ambient_occlusion/ray_traced");
  EXPECT_EQ(usualReference("antialiasing/adaptive")->name, "antialiasing/ray_traced");
}

TEST(Mailbox, HandsOverOnlyTheNewest) {
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
