// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/table.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "study/export/pseudonyms.h"
#include "study/export/trial_table.h"

namespace limen::study {
namespace {

Table sample() {
  Table table;
  table.columns = {{"a", "First", "s", {}}, {"b", "Second", "", {{"0", "no"}, {"1", "yes"}}}};
  table.add({"1", "x,\"y\"\nz"});
  table.add({std::nullopt, "tab\there"});
  return table;
}

TEST(ExportTable, CsvIsQuotedAsRfc4180Says) {
  EXPECT_EQ(toCsv(sample()), "a,b\n1,\"x,\"\"y\"\"\nz\"\n,tab\there\n");
}

TEST(ExportTable, TsvMarksWhatIsMissingAndKeepsItsColumns) {
  EXPECT_EQ(toTsv(sample()), "a\tb\n1\tx,\"y\" z\nn/a\ttab here\n");
}

TEST(ExportTable, DictionaryTellsUnitsAndLevels) {
  EXPECT_EQ(dictionary(sample().columns),
            nlohmann::json::parse(R"({"a": {"Description": "First", "Units": "s"},
                                      "b": {"Description": "Second", "Levels": {"0": "no", "1": "yes"}}})"));
}

TEST(ExportTable, NumbersReadBackToTheSameValue) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, 123456789.123456789, -0.0})
    EXPECT_EQ(std::stod(toText(value)), value);
}

TEST(ExportTable, AgesGoIntoBins) {
  EXPECT_EQ(ageBin("17"), "under 18");
  EXPECT_EQ(ageBin("18"), "18-19");
  EXPECT_EQ(ageBin("20"), "20-29");
  EXPECT_EQ(ageBin("29"), "20-29");
  EXPECT_EQ(ageBin("79"), "70-79");
  EXPECT_EQ(ageBin("93"), "80 or more");
  EXPECT_EQ(ageBin("30 to 39"), "30 to 39");
}

TEST(ExportTable, LabelsHaveLettersAndDigitsOnly) {
  EXPECT_EQ(label("experiment_1"), "experiment1");
  EXPECT_EQ(label("__"), "x");
}

store::StudyEvent event(int number, const std::string& kind, const std::string& utc, int64_t monotonicNs) {
  store::StudyEvent out;
  out.number = number;
  out.kind = kind;
  out.utc = utc;
  out.monotonicNs = monotonicNs;
  return out;
}

// The wall clock is set back an hour between the first two events, which the steady clock does not see; the
// machine is then started anew, 90.5 s later by the wall clock.
TEST(ExportTable, TimesGoOnOverAClockThatIsSetAndAMachineThatStartsAnew) {
  const std::vector<double> times =
      eventTimesS({event(0, "started", "2026-03-01T12:00:00.000Z", 5'000'000'000),
                   event(1, "screen_done", "2026-03-01T11:00:02.000Z", 7'000'000'000),
                   event(2, "continued", "2026-03-01T11:01:32.500Z", 1'000'000),
                   event(3, "answered", "2026-03-01T11:01:34.000Z", 1'501'000'000)});
  EXPECT_THAT(times, testing::ElementsAre(0.0, 2.0, 92.5, 94.0));
}

}  // namespace
}  // namespace limen::study
