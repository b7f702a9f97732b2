// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/value_writer.h"

#include <gmock/gmock.h>

#include "experiments/base/entry_reader.h"
#include "experiments/base/error.h"
#include "experiments/base/settings_table.h"

namespace limen::value_writer_test {
namespace {

using Values = std::map<std::string, ParameterValue>;

struct Grid {
  static constexpr const char *kKind = "grid", *kSummary = "cells";
  int side = 8;
  static const SettingsTable<Grid>& table() {
    static const SettingsTable<Grid> kTable = {{&Grid::side, "side", {1, 64}, "", "Cells along a side"}};
    return kTable;
  }
};
struct Nothing {
  static constexpr const char *kKind = "nothing", *kSummary = "no structure";
};
struct Tree {
  static constexpr const char *kKind = "tree", *kSummary = "nodes";
  int side = 2;
  std::variant<Nothing, Grid> leaves;
  static const SettingsTable<Tree>& table();
};
const SettingsTable<Tree>& Tree::table() {
  static const SettingsTable<Tree> kTable = {{&Tree::side, "side", {2, 8}, "", "Children along a side"},
                                             {&Tree::leaves, "leaves", "What a leaf holds"}};
  return kTable;
}
struct Bias {
  double constant = 1e-4, slope = 1.0;
  static const SettingsTable<Bias>& table() {
    static const SettingsTable<Bias> kTable = {{&Bias::constant, "constant", {0, 0.1}, "m", "Share"},
                                               {&Bias::slope, "slope", {0, 16}, "texel", "By slope"}};
    return kTable;
  }
};
struct Search {
  std::variant<Grid, Tree, Nothing> structure;
  Bias bias;
  double scale = 1.0;
  bool grows = true;
  std::string note;
  static const SettingsTable<Search>& table() {
    using S = Search;
    static const SettingsTable<S> kTable = {
        {&S::structure, "structure", "Acceleration structure"},
        {&S::bias, "bias", "Depth bias"},
        {&S::scale, "scale", {-1e9, 1e9}, "", "Any number"},
        {&S::grows, "grows", "Grow"},
        {&S::note, "note", "Any text"}};
    return kTable;
  }
};

std::string written(const Values& values) { return toYaml(Search::table().parameters(), values); }

/// Complete values as a descriptor's reader finds them in `text`.
Values readBack(const std::string& text) {
  Problems problems("d.yaml");
  FileFinder files("d.yaml");
  NodeReader reader(problems, files);
  const std::vector<Parameter> declared = Search::table().parameters();
  Values given;
  for (const Axis& axis :
       EntryReader(reader).axes(parseYaml("{" + text + "}", "d.yaml"), declared, "technique 'search'")) {
    EXPECT_EQ(axis.points.size(), 1U) << text;
    given.insert(axis.points.at(0).begin(), axis.points.at(0).end());
  }
  problems.throwIfAny();
  return ParameterValues(declared, given).all();
}

TEST(ValueWriter, WritesOnlyWhatDiffersFromItsDefault) {
  EXPECT_EQ(written({}), "");
  EXPECT_EQ(written(ParameterValues(Search::table().parameters(), {}).all()), "");
  EXPECT_EQ(written({{"grows", false}, {"scale", 1.0}}), "grows: false");
}

TEST(ValueWriter, NestsAlternativesAndGroups) {
  EXPECT_EQ(written({{"structure", "nothing"}}), "structure: nothing");
  EXPECT_EQ(written({{"structure.side", int64_t{9}}}), "structure: {side: 9}");
  EXPECT_EQ(written({{"structure", "tree"}, {"structure.side", int64_t{4}}}),
            "structure: {kind: tree, side: 4}");
  EXPECT_EQ(written({{"structure", "tree"}, {"structure.leaves", "grid"}, {"structure.leaves.side", int64_t{3}}}),
            "structure: {kind: tree, leaves: {kind: grid, side: 3}}");
  EXPECT_EQ(written({{"bias.slope", 2.5}, {"grows", false}}), "bias: {slope: 2.5}, grows: false");
}

TEST(ValueWriter, LeavesOutWhatDoesNotExistUnderTheAlternativesChosen) {
  EXPECT_EQ(written({{"structure", "nothing"}, {"structure.side", int64_t{9}}}), "structure: nothing");
  EXPECT_EQ(withoutDefaults(Search::table().parameters(), {{"structure.leaves", "grid"}}), Values{});
  // What is the default of one alternative's parameter is not that of another's.
  EXPECT_EQ(written({{"structure", "tree"}, {"structure.side", int64_t{8}}}),
            "structure: {kind: tree, side: 8}");
}

TEST(ValueWriter, QuotesWhatIsNoPlainName) {
  EXPECT_EQ(toYaml(ParameterValue("regular_8")), "regular_8");
  EXPECT_EQ(toYaml(ParameterValue("yes")), "\"yes\"");
  EXPECT_EQ(toYaml(ParameterValue("512")), "\"512\"");
  EXPECT_EQ(toYaml(ParameterValue("a\\b \"c\"")), "\"a\\\\b \\\"c\\\"\"");
}

TEST(ValueWriter, WhatItWritesReadsBackToTheSameValues) {
  const std::vector<Values> kinds = {{},
                                     {{"structure.side", int64_t{64}}},
                                     {{"structure", "nothing"}},
                                     {{"structure", "tree"}},
                                     {{"structure", "tree"}, {"structure.leaves", "grid"}},
                                     {{"structure", "tree"},
                                      {"structure.side", int64_t{8}},
                                      {"structure.leaves", "grid"},
                                      {"structure.leaves.side", int64_t{1}}}};
  const std::vector<Values> others = {{},
                                      {{"bias.constant", 0.1}},
                                      {{"bias.constant", 1.0 / 30.0}, {"bias.slope", 0.0}},
                                      {{"scale", -1e9}, {"grows", false}},
                                      {{"scale", 1.0 / 3.0}},
                                      {{"scale", 5e-324}}};
  const std::vector<std::string> texts = {"plain",    "true", "null", "12",       "1e3",       "~",
                                          "a: b",     "[x]",  "{y}",  "#z",       "quote \" q", "back\\slash",
                                          "two\nlines", "\ttab", " space ", "a, b", "- x", "grün, \xE2\x82\xAC"};
  for (const Values& kind : kinds)
    for (const Values& other : others)
      for (const std::string& text : texts) {
        Values given = kind;
        given.insert(other.begin(), other.end());
        given["note"] = text;
        const Values complete = ParameterValues(Search::table().parameters(), given).all();
        EXPECT_EQ(readBack(written(given)), complete) << written(given);
        EXPECT_EQ(readBack(written(complete)), complete) << written(complete);
      }
}

}  // namespace
}  // namespace limen::value_writer_test
