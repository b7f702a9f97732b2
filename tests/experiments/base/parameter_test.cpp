// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/parameter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "experiments/base/error.h"
#include "tests/experiments/base/declare.h"

namespace limen {
namespace {

using testing::HasSubstr;

const std::vector<Parameter> kDeclared = {
    integerParameter("samples", 64, 1, 4096, "", "Light samples"),
    realParameter("bias", 0.001, 0.0, 0.1, "m", "Depth bias"),
    choiceParameter("pattern", "regular_8", {"regular_8", "jittered_16"}, "Sample pattern"),
    booleanParameter("fill", true, "Close gaps")};

std::string messageOf(const std::map<std::string, ParameterValue>& given) {
  try {
    ParameterValues values(kDeclared, given, "file.yaml:3");
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(ParameterValues, TakesDefaultsAndOverrides) {
  const ParameterValues values(kDeclared, {{"samples", int64_t{16}}, {"bias", int64_t{0}}});
  EXPECT_EQ(integerOf(values, "samples"), 16);
  EXPECT_EQ(realOf(values, "bias"), 0.0);
  EXPECT_EQ(textOf(values, "pattern"), "regular_8");
  EXPECT_TRUE(booleanOf(values, "fill"));
  EXPECT_EQ(values.toJson().dump(), R"({"bias":0.0,"fill":true,"pattern":"regular_8","samples":16})");
}

TEST(ParameterValues, NamesWhatIsWrongAndWhatIsAllowed) {
  EXPECT_THAT(messageOf({{"sampels", int64_t{1}}}), HasSubstr("did you mean 'samples'?"));
  EXPECT_THAT(messageOf({{"samples", int64_t{0}}}), HasSubstr("whole number from 1 to 4096"));
  EXPECT_THAT(messageOf({{"samples", 1.5}}), HasSubstr("'samples' is 1.5"));
  EXPECT_THAT(messageOf({{"pattern", std::string("jitered_16")}}), HasSubstr("did you mean 'jittered_16'?"));
  EXPECT_THAT(messageOf({{"fill", int64_t{1}}}), HasSubstr("true or false"));
  EXPECT_THAT(messageOf({{"bias", std::numeric_limits<double>::quiet_NaN()}}), HasSubstr("'bias' is nan"));
  EXPECT_THAT(messageOf({{"bias", 0.2}}), HasSubstr("file.yaml:3"));
}

}  // namespace
}  // namespace limen
