// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace limen::experiments {
namespace {

// Sizes of the checklists that the ids come from: soft shadows, curved surfaces, perception (Schwarz 2009);
// visibility fields, diffuse illumination, voxelization, incremental voxelization, baselines, measuring
// (Gaitatzes 2012); Holländer 2013; Roger 2008.
const std::map<std::string, int> kFamilySizes = {{"SS", 47}, {"SC", 79},  {"SP", 76}, {"VF", 23},
                                                 {"GI", 14}, {"VX", 15},  {"IV", 16}, {"BL", 10},
                                                 {"MT", 3},  {"HOL", 60}, {"R", 61}};

std::vector<Feature> allFeatures() {
  return readFeatures(std::string(LIMEN_SOURCE_DIR) + "/experiments/features.yaml");
}

TEST(Features, EveryFamilyIsCompleteAndNumberedWithoutGaps) {
  std::map<std::string, std::set<int>> numbers;
  for (const Feature& feature : allFeatures())
    EXPECT_TRUE(
        numbers[feature.family()].insert(std::stoi(feature.id.substr(feature.id.find('-') + 1))).second)
        << feature.id << " is given twice";
  EXPECT_EQ(numbers.size(), kFamilySizes.size());
  for (const auto& [family, size] : kFamilySizes) {
    EXPECT_EQ(numbers[family].size(), static_cast<size_t>(size)) << family;
    EXPECT_EQ(*numbers[family].begin(), 1) << family;
    EXPECT_EQ(*numbers[family].rbegin(), size) << family;
  }
}

TEST(Features, WhatIsOnlySurveyedSaysWhyItIsNotBuilt) {
  int surveyed = 0;
  std::set<std::string> withParts;
  for (const Feature& feature : allFeatures())
    for (const NotBuilt& one : feature.notBuilt) {
      EXPECT_GE(one.method.size(), 10U) << one.method;
      EXPECT_GE(one.reason.size(), 20U) << one.method;
      if (feature.id == "SS-47") {
        ++surveyed;
        EXPECT_TRUE(one.section.starts_with("3.2.")) << one.method << ": " << one.section;
      } else {
        withParts.insert(feature.id);
      }
    }
  // The terrain's tiles are no quadtree; of the patches with common tangent planes one kind is built.
  EXPECT_EQ(withParts, (std::set<std::string>{"SC-24", "SP-55"}));
  // Three early fakes, two kinds of layers, wedges, three kinds of attached geometry, the occlusion camera,
  // spheres and height fields.
  EXPECT_EQ(surveyed, 12);
}

TEST(Features, SurveyedOnlyIsListedApartFromWhatIsMissing) {
  Coverage coverage;
  coverage.features = {{"AA-01", "first", "somewhere", "1", "comparator"},
                       {"AA-02", "second", "somewhere", "1", "background", {{"a method", "1.2", "too slow"}}},
                       {"AA-03", "third", "somewhere", "1", "background", {{"another", "1.3", "too dark"}}}};
  coverage.descriptors["AA-03"] = {"experiments/descriptors/a.yaml"};
  const std::string text = describe(coverage);
  const size_t surveyed = text.find("surveyed only, not built:"), missing = text.find("not covered:");
  ASSERT_NE(surveyed, std::string::npos) << text;
  EXPECT_GT(text.find("a method (section 1.2): too slow"), surveyed);
  EXPECT_LT(text.find("a method (section 1.2): too slow"), missing);
  EXPECT_GT(text.find("AA-01"), missing);
  EXPECT_LT(text.find("AA-03"), surveyed) << "a descriptor covers it";
  const std::vector<nlohmann::json> lines = toJsonLines(coverage);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[1]["not_built"][0]["reason"], "too slow");
  EXPECT_EQ(lines[3]["surveyed_only"], nlohmann::json::array({"AA-02"}));
  EXPECT_EQ(lines[3]["uncovered"], nlohmann::json::array({"AA-01"}));
}

TEST(Features, EachSaysWhatItIsAndWhereItStands) {
  const std::set<std::string> theses = {"Schwarz 2009", "Gaitatzes 2012", "Holländer 2013", "Roger 2008"};
  std::set<std::string> names;
  for (const Feature& feature : allFeatures()) {
    EXPECT_GE(feature.name.size(), 8U) << feature.id;
    EXPECT_TRUE(names.insert(feature.name).second) << feature.id << " repeats the name of another";
    EXPECT_TRUE(theses.count(feature.source)) << feature.id << ": " << feature.source;
    EXPECT_FALSE(feature.section.empty()) << feature.id;
    EXPECT_TRUE(feature.section[0] >= '1' && feature.section[0] <= '9')
        << feature.id << ": " << feature.section;
  }
}

}  // namespace
}  // namespace limen::experiments
