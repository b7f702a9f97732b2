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
