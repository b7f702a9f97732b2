// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/settings_table.h"

#include <gmock/gmock.h>

#include "experiments/base/chosen_entry.h"
#include "experiments/base/error.h"
#include "experiments/base/parameter_list.h"
#include "tests/experiments/base/declare.h"

namespace limen::settings_table_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

enum class Raster { Auto, Compute, Hardware };
constexpr EnumNames<Raster, 3> enumNames(Raster) {
  return {{{{Raster::Auto, "auto"}, {Raster::Compute, "compute"}, {Raster::Hardware, "hardware"}}}};
}

struct Map {
  int resolution = 1024;
  Raster raster = Raster::Auto;
  static const SettingsTable<Map>& table() {
    static const SettingsTable<Map> kTable = {
        {&Map::resolution, "resolution", oneOf({512, 1024, 2048}), "texel", "Side of the map"},
        {&Map::raster, "raster", "How it is rasterised"}};
    return kTable;
  }
};

struct Uniform {
  static constexpr const char *kKind = "uniform", *kSummary = "the same everywhere";
  int limit = 256;
  static const SettingsTable<Uniform>& table() {
    static const SettingsTable<Uniform> kTable = {
        {&Uniform::limit, "limit", {0, 1 << 24}, "", "Micro-occluders allowed"}};
    return kTable;
  }
};

struct Radial {
  static constexpr const char *kKind = "radial", *kSummary = "falling towards the rim";
  int centre = 256, rim = 25;
  static const SettingsTable<Radial>& table() {
    static const SettingsTable<Radial> kTable = {
        {&Radial::centre, "centre", {1, 1 << 24}, "", "In the middle"},
        {&Radial::rim, "rim", {1, 1 << 24}, "", "At the rim"}};
    return kTable;
  }
  void check() const {
    if (rim > centre) throw Error("the rim is above the centre", "rim", "give a smaller one");
  }
};

struct Unlimited {
  static constexpr const char *kKind = "unlimited", *kSummary = "no limit";
};

struct SearchSettings {
  Map map;
  Map second{.resolution = 512};
  double bias = 1e-4;
  bool grows = true;
  FilePath file;
  std::string note;
  std::variant<Uniform, Radial, Unlimited> budget;
  static const SettingsTable<SearchSettings>& table() {
    using S = SearchSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        {&S::second, "second", "Another map"},
        {&S::bias, "bias", {0, 0.1}, "m", "Depth bias", "Section 4"},
        {&S::grows, "grows", "Grow"},
        {&S::file, "file", FileIs::Optional, "A picture"},
        {&S::note, "note", "Any text"},
        Binding(&S::budget, "budget", "Micro-occluders").shorthand("limit")};
    return kTable;
  }
};

ParameterValues values(const std::map<std::string, ParameterValue>& given) {
  return {SearchSettings::table().parameters(), given};
}

TEST(SettingsTable, DeclaresMembersWithTheirInitialValues) {
  std::vector<std::string> paths;
  for (const DeclaredAt& at : flatten(SearchSettings::table().parameters())) paths.push_back(at.path);
  EXPECT_THAT(paths,
              ElementsAre("resolution", "raster", "second.resolution", "second.raster", "bias", "grows",
                          "file", "note", "budget", "budget.limit", "budget.centre", "budget.rim"));
  const std::vector<Parameter> declared = SearchSettings::table().parameters();
  EXPECT_EQ(declared[0].defaultValue, ParameterValue(int64_t{1024}));
  EXPECT_EQ(declared[2].alternatives[0].parameters[0].defaultValue, ParameterValue(int64_t{512}));
  EXPECT_EQ(declared[1].defaultValue, ParameterValue("auto"));
  EXPECT_THAT(declared[1].choices, ElementsAre("auto", "compute", "hardware"));
  EXPECT_EQ(declared[3].unit, "m");
  EXPECT_EQ(declared[3].source, "Section 4");
  EXPECT_EQ(describeRange(declared[0]), "one of 512, 1024, 2048 (texel)");
}

TEST(SettingsTable, OtherDefaultsComeFromAnObject) {
  SearchSettings defaults;
  defaults.budget = Radial{.rim = 9};
  const ParameterValues read(SearchSettings::table().parameters(defaults), {});
  EXPECT_EQ(*read.find("budget"), ParameterValue("radial"));
  EXPECT_EQ(*read.find("budget.rim"), ParameterValue(int64_t{9}));
  EXPECT_EQ(read.find("budget.limit"), nullptr);
}

TEST(SettingsTable, WhatIsReadIsWhatWasWritten) {
  SearchSettings settings;
  settings.map = {2048, Raster::Hardware};
  settings.bias = 0.05;
  settings.file.path = "/a/b";
  settings.budget = Radial{300, 30};
  const SearchSettings read = SearchSettings::table().read(values(SearchSettings::table().write(settings)));
  EXPECT_EQ(read.map.resolution, 2048);
  EXPECT_EQ(read.map.raster, Raster::Hardware);
  EXPECT_EQ(read.second.resolution, 512);
  EXPECT_EQ(read.bias, 0.05);
  EXPECT_EQ(read.file.path, "/a/b");
  ASSERT_TRUE(std::holds_alternative<Radial>(read.budget));
  EXPECT_EQ(std::get<Radial>(read.budget).rim, 30);
}

TEST(SettingsTable, AParameterOfAnotherAlternativeIsRefused) {
  try {
    values({{"budget.rim", int64_t{30}}});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'budget.rim' belongs to another choice"));
    EXPECT_THAT(error.what(), HasSubstr("it exists with budget: radial"));
  }
  EXPECT_NO_THROW(values({{"budget", "radial"}, {"budget.rim", int64_t{30}}}));
  EXPECT_THROW(values({{"budget", "unlimited"}, {"budget.limit", int64_t{30}}}), Error);
  EXPECT_THROW(values({{"resolution", int64_t{1000}}}), Error);
  EXPECT_THROW(values({{"budget.rum", int64_t{30}}}), Error);
}

TEST(SettingsTable, AChecksPlaceIsAPath) {
  try {
    SearchSettings::table().read(values({{"budget", "radial"}, {"budget.rim", int64_t{300}}}));
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "budget.rim");
  }
}

TEST(EnumNames, ShadersGetTheNumbersOfAllNames) {
  std::map<std::string, std::string> defines;
  defineEnum(defines, "RASTER", Raster::Hardware);
  EXPECT_EQ(defines,
            (std::map<std::string, std::string>{
                {"RASTER", "2"}, {"RASTER_AUTO", "0"}, {"RASTER_COMPUTE", "1"}, {"RASTER_HARDWARE", "2"}}));
}

struct ToolInfo {
  static constexpr const char* kKind = "tool";
  std::string name;
  ParameterList parameters;
  std::function<void(const ParameterValues&)> check = {};
};
void refuseFive(const ParameterValues& values) {
  if (*values.find("weight") == ParameterValue(int64_t{5})) throw Error("not five", "weight", "give another");
}
const Registered<ToolInfo> kHammer{
    {"tools/hammer", {integerParameter("weight", 2, 1, 9, "kg", "How heavy")}, &refuseFive}};
const Registered<ToolInfo> kSaw{{"tools/saw", {integerParameter("teeth", 40, 1, 99, "", "How many")}}};

struct WrapSettings {
  ChosenEntry inner{"tools/hammer", {}};
  static const SettingsTable<WrapSettings>& table() {
    static const SettingsTable<WrapSettings> kTable = {registeredChoice<ToolInfo>(
        &WrapSettings::inner, "inner", {"tools/hammer", "tools/saw"}, "What is wrapped")};
    return kTable;
  }
};

TEST(ChosenEntry, BringsTheSettingsOfTheEntry) {
  const std::vector<Parameter> declared = WrapSettings::table().parameters();
  EXPECT_EQ(*ParameterValues(declared, {}).find("inner.weight"), ParameterValue(int64_t{2}));
  const ParameterValues given(declared, {{"inner", "saw"}, {"inner.teeth", int64_t{12}}});
  const WrapSettings read = WrapSettings::table().read(given);
  EXPECT_EQ(read.inner.name, "tools/saw");
  EXPECT_EQ(*read.inner.values.find("teeth"), ParameterValue(int64_t{12}));
  EXPECT_EQ(WrapSettings::table().write(read), given.all());
  EXPECT_EQ(WrapSettings::table().write(WrapSettings{}).at("inner.weight"), ParameterValue(int64_t{2}));
}

TEST(ChosenEntry, IsCheckedAsItsRegistrationSays) {
  try {
    WrapSettings::table().read({WrapSettings::table().parameters(), {{"inner.weight", int64_t{5}}}});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "inner.weight");
    EXPECT_EQ(error.message(), "not five");
  }
}

}  // namespace
}  // namespace limen::settings_table_test
