// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/printed_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;
using Verdict = PrintedTable::Verdict;

/// Runs of 1, 2 and 4 samples in two scenes that take `ms` each.
class PrintedTables : public testing::Test {
 protected:
  std::vector<PrintedTable> compare(const std::vector<double>& first, const std::vector<double>& second,
                                    const nlohmann::json& printed) {
    std::vector<store::Run> runs;
    nlohmann::json rows = nlohmann::json::array();
    for (size_t i = 0; i < first.size(); ++i) {
      const int samples = 1 << i;
      runs.push_back(makeRun("a", "s", samples, {first[i]}, 0.1));
      runs.push_back(makeRun("a", "r", samples, {second[i]}, 0.1));
      rows.push_back({{"name", std::to_string(samples)},
                      {"values", printed.at(i)},
                      {"relative_to", "1"},
                      {"passes", nlohmann::json::array()},
                      {"runs", {runs[2 * i].key, runs[2 * i + 1].key}}});
    }
    store::Store store(folder_.path("s.sqlite"), store::Access::ReadWrite);
    store::Experiment experiment;
    experiment.title = "t";
    experiment.report["published"] = nlohmann::json::array({{{"title", "Table <1>"},
                                                             {"source", "Test 2024"},
                                                             {"device", "Old GPU"},
                                                             {"note", ""},
                                                             {"unit", "ms"},
                                                             {"columns", {"one", "two"}},
                                                             {"measure", "gpu_ms"},
                                                             {"rows", rows}}});
    writeExperiment(store, experiment, std::move(runs));
    return comparePrinted(loadSweep(store, store.experiments().at(0)));
  }
  TemporaryFolder folder_;
};

TEST_F(PrintedTables, PutsRatiosBesideRatios) {
  const auto tables = compare({10, 20, 5}, {4, 12, 8}, {{1, 2}, {3, 5}, {0.5, nullptr}});
  ASSERT_EQ(tables.size(), 1U);
  const PrintedTable& table = tables[0];
  ASSERT_EQ(table.ownColumns.size(), 2U);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].verdict, Verdict::None);
  EXPECT_THAT(table.rows[1].ours, ElementsAre(Optional(20.0), Optional(12.0)));
  EXPECT_THAT(table.rows[1].ourRatios, ElementsAre(Optional(2.0), Optional(3.0)));
  EXPECT_THAT(table.rows[1].printedRatios, ElementsAre(Optional(3.0), Optional(2.5)));
  EXPECT_EQ(table.rows[1].verdict, Verdict::Agrees);
  // 5 / 10 gains as printed, 8 / 4 loses.
  EXPECT_THAT(table.rows[2].printedRatios, ElementsAre(Optional(0.5), std::nullopt));
  EXPECT_EQ(table.rows[2].verdict, Verdict::Partly);
}

TEST_F(PrintedTables, AnotherWayIsCalledSo) {
  const auto tables = compare({10, 9, 10.4}, {10, 9.4, 9.6}, {{1, 1}, {2, 2}, {0.5, 3}});
  EXPECT_EQ(tables[0].rows[1].verdict, Verdict::Differs);
  // Within 5 % of the base is neither a gain nor a loss.
  EXPECT_EQ(tables[0].rows[2].verdict, Verdict::Faint);
}

TEST_F(PrintedTables, SaysWhatIsPrintedAndWhatIsMeasured) {
  const auto tables = compare({10, 20}, {4, 12}, {{1, 2}, {3, 5}});
  const std::string html = renderPrinted(tables);
  EXPECT_THAT(html, HasSubstr("Table &lt;1&gt;"));
  EXPECT_THAT(html, HasSubstr("Printed: Test 2024, Old GPU; values in ms; here GPU time (ms)."));
  EXPECT_THAT(html, HasSubstr("20 <small>×2</small>"));
  EXPECT_THAT(printedCsv(tables), HasSubstr("Table <1>,2,1,printed,two,5,2.5,ms"));
  EXPECT_THAT(renderPrinted({}), "");
}

}  // namespace
}  // namespace limen::analysis
