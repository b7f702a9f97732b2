// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/entry_reader.h"

#include <gmock/gmock.h>

#include "experiments/base/error.h"

namespace limen::entry_reader_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

struct Hsm {
  static constexpr const char *kKind = "hsm", *kSummary = "hierarchical shadow map";
};
struct Ysm {
  static constexpr const char *kKind = "ysm", *kSummary = "Y shadow map";
  int base = 256;
  bool growth = true;
  static const SettingsTable<Ysm>& table() {
    static const SettingsTable<Ysm> kTable = {
        Binding(&Ysm::base, "base", oneOf({64, 128, 256}), "texel", "Side of the layers")
            .formerly({"ysm_base"}),
        {&Ysm::growth, "growth", "Grow"}};
    return kTable;
  }
};
struct Uniform {
  static constexpr const char *kKind = "uniform", *kSummary = "everywhere the same";
  int limit = 256;
  static const SettingsTable<Uniform>& table() {
    static const SettingsTable<Uniform> kTable = {
        Binding(&Uniform::limit, "limit", Range{0, 1 << 24}, "", "Allowed").formerly({"old_count"})};
    return kTable;
  }
};
struct Radial {
  static constexpr const char *kKind = "radial", *kSummary = "falling outwards";
  int centre = 256, rim = 25;
  static const SettingsTable<Radial>& table() {
    static const SettingsTable<Radial> kTable = {
        Binding(&Radial::centre, "centre", Range{1, 1 << 24}, "", "In the middle").formerly({"old_count"}),
        {&Radial::rim, "rim", {1, 1 << 24}, "", "At the rim"}};
    return kTable;
  }
};
struct Bias {
  double constant = 1e-4, slope = 1.0;
  static const SettingsTable<Bias>& table() {
    static const SettingsTable<Bias> kTable = {{&Bias::constant, "constant", {0, 0.1}, "", "Share"},
                                               {&Bias::slope, "slope", {0, 16}, "texel", "By slope"}};
    return kTable;
  }
};
struct Search {
  std::variant<Hsm, Ysm> structure;
  std::variant<Uniform, Radial> budget;
  Bias bias;
  int radius = 4;
  static const SettingsTable<Search>& table() {
    using S = Search;
    static const SettingsTable<S> kTable = {
        {&S::structure, "structure", "Acceleration structure"},
        Binding(&S::budget, "budget", "Micro-occluders").shorthand("limit"),
        Binding(&S::bias, "bias", "Depth bias").shorthand("constant"),
        {&S::radius, "radius", {1, 64}, "px", "Half-width"}};
    return kTable;
  }
};

/// Axes of an entry, or the text of all problems.
struct Reading {
  explicit Reading(const std::string& text, const std::string& listHint = {})
      : problems("d.yaml"), files("d.yaml") {
    NodeReader reader(problems, files);
    axes = EntryReader(reader, listHint)
               .axes(parseYaml(text, "d.yaml"), Search::table().parameters(), "technique 'search'");
    try {
      problems.throwIfAny();
    } catch (const Error& error) {
      message = error.what();
    }
  }
  Problems problems;
  FileFinder files;
  std::vector<Axis> axes;
  std::string message;
};

TEST(EntryReader, AChoiceIsTextOrAMapOfItsOwnParameters) {
  const Reading plain("{name: x, structure: ysm}");
  EXPECT_EQ(plain.message, "");
  EXPECT_THAT(combine(plain.axes), ElementsAre(ElementsAre(Pair("structure", ParameterValue("ysm")))));
  const Reading map("{structure: {kind: ysm, base: 128}}");
  EXPECT_THAT(combine(map.axes), ElementsAre(UnorderedElementsAre(Pair("structure", ParameterValue("ysm")),
                                                                  Pair("structure.base", int64_t{128}))));
  // Without its kind, a map speaks of the default one.
  EXPECT_THAT(combine(Reading("{budget: {limit: 9}}").axes),
              ElementsAre(UnorderedElementsAre(Pair("budget", ParameterValue("uniform")),
                                               Pair("budget.limit", int64_t{9}))));
}

TEST(EntryReader, AListInsideAChoiceIsAnAxisWithItsPath) {
  const Reading read("{budget: {kind: radial, centre: 256, rim: [25, 50]}, radius: [1, 2, 3]}");
  ASSERT_EQ(read.message, "");
  std::vector<std::pair<std::string, size_t>> sizes;
  for (const Axis& axis : read.axes) sizes.emplace_back(axis.name, axis.points.size());
  EXPECT_THAT(sizes, ElementsAre(Pair("budget", 1U), Pair("budget.centre", 1U), Pair("budget.rim", 2U),
                                 Pair("radius", 3U)));
  EXPECT_EQ(combine(read.axes).size(), 6U);
}

TEST(EntryReader, AListOfChoicesIsOneAxis) {
  const Reading read("{structure: [hsm, {kind: ysm, base: [128, 256]}]}");
  ASSERT_EQ(read.message, "");
  ASSERT_EQ(read.axes.size(), 1U);
  EXPECT_EQ(read.axes[0].name, "structure");
  ASSERT_EQ(read.axes[0].points.size(), 3U);
  EXPECT_EQ(read.axes[0].points[2].at("structure.base"), ParameterValue(int64_t{256}));
}

TEST(EntryReader, ANumberStandsForTheShorthand) {
  const Reading read("{budget: [64, 256], bias: 0.01}");
  ASSERT_EQ(read.message, "");
  EXPECT_EQ(read.axes[0].name, "budget.limit");
  EXPECT_EQ(combine(read.axes).size(), 2U);
  EXPECT_EQ(combine(read.axes)[1].at("budget.limit"), ParameterValue(int64_t{256}));
  EXPECT_EQ(combine(read.axes)[1].at("bias.constant"), ParameterValue(0.01));
  EXPECT_THAT(Reading("{structure: 3}").message, HasSubstr("allowed: one of hsm, ysm"));
}

TEST(EntryReader, WhatIsReadMakesTheSettings) {
  const Reading read("{budget: {kind: radial, rim: 30}, structure: ysm, bias: {slope: 2}}");
  ASSERT_EQ(read.message, "");
  const Search search =
      Search::table().read(ParameterValues(Search::table().parameters(), combine(read.axes).at(0)));
  EXPECT_EQ(std::get<Radial>(search.budget).rim, 30);
  EXPECT_EQ(std::get<Ysm>(search.structure).base, 256);
  EXPECT_EQ(search.bias.slope, 2.0);
}

TEST(EntryReader, AFormerNameIsAnsweredWithThePresentForm) {
  EXPECT_THAT(
      Reading("{old_count: 64}").message,
      HasSubstr(
          "it is now written budget: {kind: uniform, limit: ...}, or budget: {kind: radial, centre: ...}"));
  EXPECT_THAT(Reading("{ysm_base: 64}").message,
              HasSubstr("it is now written structure: {kind: ysm, base: ...}"));
}

TEST(EntryReader, AParameterOfAnotherAlternativeIsRefusedWithItsPlace) {
  EXPECT_THAT(Reading("{budget: {rim: 25}}").message,
              testing::AllOf(HasSubstr("d.yaml:1:11"),
                             HasSubstr("'budget: uniform' of technique 'search' has no parameter 'rim'"),
                             HasSubstr("did you mean budget: {kind: radial, rim: ...}?")));
  EXPECT_THAT(Reading("{rim: 25}").message, HasSubstr("did you mean budget: {kind: radial, rim: ...}?"));
  EXPECT_THAT(Reading("{budget: {kind: radial, rum: 25}}").message, HasSubstr("did you mean 'rim'?"));
}

// Finding them takes long, and nobody reads thousands.
TEST(EntryReader, UnknownKeysGetHintsWhileThereAreFewProblems) {
  const auto messageAfter = [](int earlier, const auto& read) {
    Problems problems("d.yaml");
    FileFinder files("d.yaml");
    NodeReader reader(problems, files);
    for (int i = 0; i < earlier; ++i) problems.add({100 + i, 1}, "earlier");
    read(reader, parseYaml("{radios: 1}", "d.yaml"));
    EXPECT_EQ(problems.size(), static_cast<size_t>(earlier) + 1);
    try {
      problems.throwIfAny();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto entry = [](NodeReader& reader, const YamlNode& map) {
    EntryReader(reader, "").axes(map, Search::table().parameters(), "technique 'search'");
  };
  const auto keys = [](NodeReader& reader, const YamlNode& map) {
    reader.checkKeys(map, "a search", {"radius"});
  };
  for (const std::string& few : {messageAfter(10, entry), messageAfter(10, keys)})
    EXPECT_THAT(few, testing::AllOf(HasSubstr("radios"), HasSubstr("did you mean 'radius'")));
  for (const std::string& many : {messageAfter(10'000, entry), messageAfter(10'000, keys)})
    EXPECT_THAT(many, testing::AllOf(HasSubstr("radios"), testing::Not(HasSubstr("did you mean"))));
}

TEST(EntryReader, BadFormsAreProblemsWithPlaces) {
  EXPECT_THAT(Reading("{budget: {kind: rdial}}").message, HasSubstr("did you mean 'radial'?"));
  EXPECT_THAT(Reading("{budget: {kind: [uniform, radial]}}").message,
              HasSubstr("write budget: [{kind: ...}"));
  EXPECT_THAT(Reading("{bias: steep}").message, HasSubstr("write it as a map of: constant, slope"));
  EXPECT_THAT(Reading("{structure: []}").message, HasSubstr("is empty"));
  EXPECT_THAT(Reading("{structure: [hsm, hsm]}").message, HasSubstr("lists the same twice"));
  EXPECT_THAT(Reading("{structure: [[hsm]]}").message, HasSubstr("an entry of 'structure' is a list"));
  EXPECT_THAT(Reading("{budget: {limit: {a: 1}}}").message, HasSubstr("'limit' is a map"));
  EXPECT_THAT(Reading("{radius: [1, 2]}", "give one").message, HasSubstr("is a list; give one"));
  EXPECT_THAT(Reading("{budget: {kind: radial, rim: [1, 2]}}", "give one").message,
              HasSubstr("is a list; give one"));
}

TEST(EntryReader, AGridBeyondReasonIsRefusedBeforeItIsMade) {
  std::string list = "[1";
  for (int i = 2; i <= 2000; ++i) list += ", " + std::to_string(i);
  list += "]";
  EXPECT_THAT(Reading("{budget: [{kind: radial, centre: " + list + ", rim: " + list + "}]}").message,
              HasSubstr("stands for 4000000 combinations"));
}

TEST(Spell, WritesThePathAsADescriptorDoes) {
  EXPECT_EQ(spell({"occluders.mask.size", nullptr, {{"occluders", "quads"}, {"occluders.mask", "table"}}}),
            "occluders: {kind: quads, mask: {kind: table, size: ...}}");
}

}  // namespace
}  // namespace limen::entry_reader_test
