// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/grid.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"

namespace limen::psychometrics {
namespace {

using nlohmann::json;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

std::string axisRefusal(const json& axis) {
  try {
    readAxis(axis, "x", "threshold");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Grid, RangesHaveExactEnds) {
  EXPECT_THAT(readAxis({{"from", 0.8}, {"to", 1.6}, {"step", 0.2}}, "x", "x").values,
              ElementsAre(0.8, DoubleEq(1.0), DoubleEq(1.2), DoubleEq(1.4), 1.6));
  EXPECT_THAT(readAxis({{"from", 0}, {"to", 0.04}, {"count", 5}}, "x", "x").values,
              ElementsAre(0.0, DoubleEq(0.01), DoubleEq(0.02), DoubleEq(0.03), 0.04));
  const GridAxis db = readAxis({{"from", -40}, {"to", 0}, {"step", 1}, {"unit", "dB"}}, "x", "x");
  ASSERT_EQ(db.size(), 41u);
  for (int i = 0; i <= 40; ++i) EXPECT_EQ(db.values[static_cast<size_t>(i)], i - 40.0);
  EXPECT_EQ(db.unit, "dB");
  EXPECT_EQ(linearValues(0.1, 0.7, 1001).back(), 0.7);
}

TEST(Grid, LogarithmicRangesHaveEqualRatios) {
  const GridAxis axis = readAxis({{"from", 0.01}, {"to", 10}, {"step", 0.5}, {"spacing", "log"}}, "x", "x");
  ASSERT_EQ(axis.size(), 7u);
  EXPECT_TRUE(axis.logarithmic);
  EXPECT_EQ(axis.values.front(), 0.01);
  EXPECT_EQ(axis.values.back(), 10);
  EXPECT_NEAR(axis.values[2], 0.1, 1e-15);
  EXPECT_NEAR(axis.values[5] / axis.values[4], 3.1622776601683795, 1e-13);
}

TEST(Grid, ListsAndSingleNumbersAreAxesToo) {
  EXPECT_THAT(readAxis(3.5, "x", "x").values, ElementsAre(3.5));
  EXPECT_THAT(readAxis({1, 2, 4}, "x", "x").values, ElementsAre(1, 2, 4));
  EXPECT_THAT(readAxis({{"values", {1, 2}}, {"unit", "px"}}, "x", "x").values, ElementsAre(1, 2));
}

TEST(Grid, WhatIsWrittenReadsBackTheSame) {
  const GridAxis axis = readAxis({{"from", 0.01}, {"to", 10}, {"count", 9}, {"spacing", "log"}}, "x", "x");
  const GridAxis again = readAxis(json::parse(toJson(axis).dump()), "x", "x");
  EXPECT_EQ(again.values, axis.values);
  EXPECT_EQ(again.logarithmic, axis.logarithmic);
}

TEST(Grid, SlipsAreRefusedWithTheirPlaceAndTheMend) {
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}, {"step", 0.3}}), HasSubstr("threshold.step"));
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}, {"step", 0.3}}), HasSubstr("0.333"));
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}, {"stepp", 0.5}}), HasSubstr("'step'"));
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}}), HasSubstr("'step' and 'count'"));
  EXPECT_THAT(axisRefusal({{"from", 2}, {"to", 1}, {"count", 5}}), HasSubstr("below"));
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}, {"count", 5}, {"spacing", "log"}}), HasSubstr("above 0"));
  EXPECT_THAT(axisRefusal({{"from", 0}, {"to", 1}, {"count", 1}}), HasSubstr("from 2"));
  EXPECT_THAT(axisRefusal({1, 1}), HasSubstr("ascending"));
  EXPECT_THAT(axisRefusal(json::array()), HasSubstr("empty"));
  EXPECT_THAT(axisRefusal("high"), HasSubstr("give a number"));
  EXPECT_THAT(axisRefusal({1, nullptr}), HasSubstr("not a number"));
}

TEST(Grid, TheLastAxisOfAProductRunsFastest) {
  const ProductGrid grid({{"a", "", {1, 2}}, {"b", "", {10, 20, 30}}});
  ASSERT_EQ(grid.size(), 6u);
  EXPECT_THAT(grid.valuesOf(0), ElementsAre(1, 10));
  EXPECT_THAT(grid.valuesOf(1), ElementsAre(1, 20));
  EXPECT_THAT(grid.valuesOf(3), ElementsAre(2, 10));
  EXPECT_EQ(grid.find({2, 30}), 5u);
  EXPECT_EQ(grid.find({2, 31}), 6u);
}

}  // namespace
}  // namespace limen::psychometrics
