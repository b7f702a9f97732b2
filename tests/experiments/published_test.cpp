// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/published.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/base/error.h"
#include "experiments/plan.h"
#include "tests/experiments/base/declare.h"
#include "tests/experiments/fake_bench.h"

namespace limen::experiments {
namespace {

using testing::HasSubstr;

std::string withTable(const std::string& rows, const std::string& head = "measure: gpu_ms") {
  return validDescriptor() +
         "published:\n  - {title: Table 1, source: Test 2024, unit: ms, columns: [one, two], " + head +
         ", rows: [" + rows + "]}\n";
}

Plan printedPlan(const std::string& text) {
  const Catalogue catalogue = fakeCatalogue();
  return makePlan(parseDescriptor(text, "d.yaml", catalogue, {}), catalogue);
}

std::string printedError(const std::string& text) {
  try {
    printedPlan(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

constexpr const char* kPrintedRow = "{name: eight, values: [2, null], of: soft/bitmask, where: {samples: 8}}";

TEST(Published, ARowMeansOneRunOfEachScene) {
  const Plan plan = printedPlan(withTable(
      std::string(kPrintedRow) +
      ", {name: sixteen, values: [4, 5], of: soft/bitmask, where: {samples: 16}, relative_to: eight}"));
  ASSERT_EQ(plan.published.size(), 1U);
  const nlohmann::json& rows = plan.published[0].at("rows");
  std::vector<std::string> wanted;
  for (const PlannedRun& run : plan.runs)
    if (run.technique.name == "soft/bitmask" && integerOf(run.technique.values, "samples") == 8)
      wanted.push_back(run.key);
  ASSERT_EQ(wanted.size(), plan.groups.size());
  EXPECT_EQ(rows[0].at("runs").get<std::vector<std::string>>(), wanted);
  EXPECT_EQ(rows[0].at("values")[0], 2.0);
  EXPECT_TRUE(rows[0].at("values")[1].is_null());
  EXPECT_EQ(rows[1].at("relative_to"), "eight");
  EXPECT_NE(rows[1].at("runs"), rows[0].at("runs"));
}

TEST(Published, NothingIsSaidOfKeysOfRuns) {
  const Plan with = printedPlan(withTable(kPrintedRow)), without = printedPlan(validDescriptor());
  ASSERT_EQ(with.runs.size(), without.runs.size());
  for (size_t i = 0; i < with.runs.size(); ++i) EXPECT_EQ(with.runs[i].key, without.runs[i].key);
}

TEST(Published, RefusesWhatCannotBeCompared) {
  EXPECT_THAT(printedError(withTable("{name: a, values: [1, 2], of: soft/bitmask}")),
              HasSubstr("matches several runs of one scene"));
  EXPECT_THAT(printedError(withTable("{name: a, values: [1, 2], of: soft/bitmask, where: {samples: 9}}")),
              HasSubstr("no planned run matches the row 'a'"));
  EXPECT_THAT(printedError(withTable("{name: a, values: [1], of: soft/bitmask, where: {samples: 8}}")),
              HasSubstr("1 values for 2 columns"));
  EXPECT_THAT(printedError(withTable(std::string(kPrintedRow) + ", " + kPrintedRow)),
              HasSubstr("row 'eight' is given twice"));
  EXPECT_THAT(printedError(withTable("{name: a, values: [1, 2], of: soft/bitmask, where: {samples: 8}, "
                                     "relative_to: b}")),
              HasSubstr("'relative_to' names no row: 'b'"));
  EXPECT_THAT(printedError(withTable(kPrintedRow, "measure: gpu_mss")),
              HasSubstr("'gpu_mss' is not a measurement"));
  EXPECT_THAT(printedError(withTable(kPrintedRow, "note: none")),
              HasSubstr("needs either 'measure' or 'passes'"));
  EXPECT_THAT(printedError(withTable(kPrintedRow, "measure: gpu_ms, passes: [a]")),
              HasSubstr("needs either 'measure' or 'passes'"));
  EXPECT_THAT(printedError(withTable(kPrintedRow, "measure: gpu_ms, colums: [a]")),
              HasSubstr("unknown key 'colums'"));
}

}  // namespace
}  // namespace limen::experiments
