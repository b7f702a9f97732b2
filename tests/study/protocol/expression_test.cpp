// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/base/error.h"

namespace limen::study {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const Variables kVariables = {{"distance", 4},       {"speed", 2.0}, {"kind", "wood"}, {"zero", 0},
                              {"entry", {{"a", 1}}}, {"tile_2", 7},  {"flag", true}};

json valueOf(const std::string& text) { return evaluate({nullptr, text, {3, 14}}, kVariables, "p.yaml"); }

std::string refused(const std::string& text) {
  try {
    return "gave " + valueOf(text).dump();
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Expression, GivesWhatOneCalculatesByHand) {
  const std::pair<const char*, double> kCases[] = {{" 1 + 2 * 3", 7},
                                                   {"(1 + 2) * 3", 9},
                                                   {"7 - 4 - 2", 1},
                                                   {"8 / 4 / 2", 1},
                                                   {"-2 * -3", 6},
                                                   {"- (2 + 3)", -5},
                                                   {"2 - -3", 5},
                                                   {"+4", 4},
                                                   {"distance + 2.25 * speed", 8.5},
                                                   {"(distance-1)/speed", 1.5},
                                                   {"1e-3 * 1000", 1},
                                                   {".5 * tile_2", 3.5},
                                                   {"((((2))))", 2}};
  for (const auto& [text, expected] : kCases) EXPECT_DOUBLE_EQ(valueOf(text).get<double>(), expected) << text;
}

TEST(Expression, ANameAloneMayHoldAnything) {
  EXPECT_EQ(valueOf(" kind"), "wood");
  EXPECT_EQ(valueOf("entry"), json({{"a", 1}}));
  EXPECT_EQ(valueOf("flag"), true);
  EXPECT_EQ(valueOf("distance"), 4);
}

TEST(Expression, ZeroHasNoSign) {
  EXPECT_FALSE(std::signbit(valueOf("-1 * zero").get<double>()));
  EXPECT_FALSE(std::signbit(valueOf("-(zero)").get<double>()));
}

TEST(Expression, RefusalsSayPlaceAndReason) {
  EXPECT_THAT(refused("distnace + 1"),
              HasSubstr("p.yaml:3:14: no variable 'distnace'; did you mean 'distance'?"));
  EXPECT_THAT(refused("1 + kind"), HasSubstr("p.yaml:3:14: in '=1 + kind' \"wood\" is not a number"));
  EXPECT_THAT(refused("1 + flag"), HasSubstr("true is not a number"));
  EXPECT_THAT(refused("-kind"), HasSubstr("is not a number"));
  EXPECT_THAT(refused("1 / zero"), HasSubstr("divided by 0"));
  EXPECT_THAT(refused("1 / (distance - 4)"), HasSubstr("divided by 0"));
  EXPECT_THAT(refused(""), HasSubstr("something is missing at the end"));
  EXPECT_THAT(refused("1 +"), HasSubstr("something is missing at the end"));
  EXPECT_THAT(refused("(1 + 2"), HasSubstr("a bracket is not closed"));
  EXPECT_THAT(refused("1 2"), HasSubstr("'2' is unexpected"));
  EXPECT_THAT(refused("1)"), HasSubstr("')' is unexpected"));
  EXPECT_THAT(refused("2 ^ 3"), HasSubstr("'^ 3' is unexpected"));
  EXPECT_THAT(refused("* 3"), HasSubstr("'*' where a number or a name is expected"));
  EXPECT_THAT(refused("1e308 * 10"), HasSubstr("not a finite number"));
  EXPECT_THAT(refused("."), HasSubstr("does not start a number"));
  EXPECT_THAT(refused(std::string(100000, '(')), HasSubstr("nested too deeply"));
}

TEST(Expression, KnowsItsNames) {
  EXPECT_EQ(namesIn("distance + 2e3 * speed - x1/(x1)"), (std::set<std::string>{"distance", "speed", "x1"}));
  EXPECT_EQ(namesIn("1.5e-3"), std::set<std::string>{});
}

TEST(Expression, TreesAndJsonAreTheSame) {
  const YamlNode tree = parseYaml(R"({a: [1, 2.5, "3", true, "true", x, -1e-3], b: {c: ~}})", "t.yaml");
  const json expected = {{"a", {1, 2.5, "3", true, "true", "x", -0.001}}, {"b", {{"c", nullptr}}}};
  EXPECT_EQ(toJson(tree), expected);
  EXPECT_EQ(toJson(toYaml(expected, {1, 1})), expected);
}

}  // namespace
}  // namespace limen::study
