// SPDX-License-Identifier: BSD-3-Clause
// What the statistics of groups refuse in a table, with its line and column.
#include <gtest/gtest.h>

#include "analysis/answer_tables/choice.h"
#include "analysis/observer_statistics/anova.h"
#include "analysis/observer_statistics/mixed.h"
#include "analysis/observer_statistics/sensitivity.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

const std::string kHead = "who,lod,group,k,n,right,t\n";
const std::string kRows = kHead + "a,1,x,3,4,1,0.5\na,2,x,1,4,0,1\nb,1,y,2,4,1,2\nb,2,y,1,4,1,2.5\n";

void refusesAnova(const std::string& text, const AnovaColumns& columns, const std::string& part) {
  expectError([&] { tableAnova(Table::parse(text, "t.csv"), columns, {}); }, part);
}

TEST(AnovaTable, RefusesWhatItCannotAnalyse) {
  const AnovaColumns counts{"who", {"lod"}, {"", "k", "n", ""}};
  EXPECT_TRUE(tableAnova(Table::parse(kRows, "t.csv"), counts, {}).result);
  refusesAnova(kRows, {"whom", {"lod"}, counts.answers}, "no column 'whom' (--subject); did you mean 'who'");
  refusesAnova(kRows, {"who", {"lad"}, counts.answers}, "no column 'lad' (--within); did you mean 'lod'");
  refusesAnova(kRows, {"", {"lod"}, counts.answers}, "give --subject");
  refusesAnova(kRows, {"who", {}, counts.answers}, "give --within");
  refusesAnova(kRows, {"who", {"lod"}, {}}, "--outcome, or --k and --n, or --value");
  refusesAnova(kRows, {"who", {"lod"}, {"", "k", "", ""}}, "--n");
  refusesAnova(kRows, {"who", {"lod"}, {"", "k", "n", "t"}}, "one kind");
  refusesAnova(kRows, {"who", {"lod", "lod"}, counts.answers}, "'lod' is named twice");
  refusesAnova(kRows, {"who", {"who"}, counts.answers}, "'who' is named twice");
  refusesAnova(kRows, {"who", {"group"}, counts.answers}, "no subject has more than one level of 'group'");
  refusesAnova(kRows, {"who", {"lod"}, {"k", "", "", ""}}, "t.csv:2, column 'k': '3' is neither 0 nor 1");
  refusesAnova(kHead + "a,1,x,1,4,1,1\nb,1,x,1,4,1,1\n", counts, "column 'lod' has one level, '1'");
  refusesAnova(kHead + "a,1,x,1,4,1,1\na,2,x,1,4,1,1\n", counts, "column 'who' has one subject, 'a'");
  refusesAnova(kRows + "a,1,x,5,4,1,1\n", counts, "t.csv:6, column 'k': 5 of 4 trials");
  refusesAnova(kRows + "a,1,x,-1,4,1,1\n", counts, "t.csv:6, column 'k': '-1' is negative");
  refusesAnova(kRows + "a,1,x,0,0,1,1\n", counts, "t.csv:6, column 'n': no trials");
  refusesAnova(kRows + "a,1,x,1.5,4,1,1\n", counts, "t.csv:6, column 'k': '1.5' is not a whole number");
  refusesAnova(kRows + ",1,x,1,4,1,1\n", counts, "t.csv:6, column 'who': is empty");
  refusesAnova(kRows + "a,,x,1,4,1,1\n", counts, "t.csv:6, column 'lod': is empty");
  refusesAnova(kRows + "a,1,x,1,4,1,nan\n", {"who", {"lod"}, {"", "", "", "t"}},
               "t.csv:6, column 't': 'nan' is not a finite number");
}

void refusesSdt(const SensitivityColumns& columns, const std::string& part) {
  const Table table =
      Table::parse("who,yes,there,h,s,f,n\na,1,1,3,4,1,4\na,0,0,2,4,5,4\nb,1,2,1,4,1,4\n", "t.csv");
  expectError([&] { tableSensitivity(table, columns); }, part);
}

TEST(SensitivityTable, RefusesWhatItCannotAnalyse) {
  SensitivityColumns trials;
  trials.subject = "who";
  trials.answers.outcome = "yes";
  trials.signal = "there";
  refusesSdt(trials, "t.csv:4, column 'there': '2' is neither 0 nor 1");
  SensitivityColumns changed = trials;
  changed.signal = "";
  refusesSdt(changed, "--signal");
  changed = trials;
  changed.subject = "";
  refusesSdt(changed, "--subject, --by");
  changed = trials;
  changed.hits = "h";
  refusesSdt(changed, "not both");
  changed = trials;
  changed.task = "mafc:1";
  refusesSdt(changed, "write mafc:4");
  changed.task = "3afc";
  refusesSdt(changed, "no task '3afc'");
  changed.task = "2afc";
  refusesSdt(changed, "do not fit");
  SensitivityColumns counts;
  counts.subject = "who";
  counts.hits = "h";
  counts.signals = "s";
  refusesSdt(counts, "four columns");
  counts.falseAlarms = "f";
  counts.noises = "n";
  refusesSdt(counts, "t.csv:3, column 'f': 5 of 4 trials");
  SensitivityColumns alternatives;
  alternatives.subject = "who";
  alternatives.answers = {"", "h", "s", ""};
  refusesSdt(alternatives, "--task mafc:M");
  expectError([] { readChoice<RateCorrection>("some", "--correction"); }, "--correction");
}

const std::string kModel =
    "who,x,y,c,k,n\na,1,0.5,red,1,4\na,2,0.7,blue,3,4\nb,1,0.1,red,2,4\nb,2,0,blue,3,4\nc,1,0.4,red,0,4\n"
    "c,2,1,blue,2,4\n";

void refusesMixed(const std::string& text, const MixedTerms& terms, const std::string& part) {
  const Table table = Table::parse(text, "t.csv");
  expectError([&] { fitMixedModel(readMixedRows(table, "who", {"", "k", "n", ""}), terms); }, part);
}

MixedTerms fixed(const std::vector<std::string>& terms) {
  MixedTerms out;
  out.fixed = terms;
  return out;
}

TEST(MixedTable, RefusesWhatItCannotFit) {
  refusesMixed(kModel, {}, "no effect is named");
  refusesMixed(kModel, fixed({"z"}), "no column 'z'");
  refusesMixed(kModel, fixed({"x", "x"}), "'x' is named twice");
  refusesMixed(kModel, fixed({"x", "c", "x:c", "c:x"}), "'c:x' is named twice");
  refusesMixed(kModel, fixed({"x", "x:c"}), "interaction 'x:c' has no 'c' beside it");
  refusesMixed(kModel, fixed({"x", "x:x"}), "has 'x' twice");
  refusesMixed(kModel, fixed({"x", "c"}), "follows from those before it");
  MixedTerms terms = fixed({"y"});
  terms.log = {"y"};
  refusesMixed(kModel, terms, "t.csv:5, column 'y': '0' has no logarithm");
  terms.fixed = {"x"};
  refusesMixed(kModel, terms, "'y' is not in the model");
  terms = fixed({"c"});
  terms.centre = {"c"};
  refusesMixed(kModel, terms, "--center: column 'c' does not hold numbers");
  terms = fixed({"c"});
  terms.references = {"c=green"};
  refusesMixed(kModel, terms, "no level 'green'");
  terms.references = {"c"};
  refusesMixed(kModel, terms, "COLUMN=LEVEL");
  terms = fixed({"x"});
  terms.references = {"x=1"};
  refusesMixed(kModel, terms, "--categorical x");
  terms = fixed({"x"});
  terms.slope = "y";
  refusesMixed(kModel, terms, "--slope: column 'y' is not in the model");
  refusesMixed(kModel + "d,1,1,red,5,4\n", fixed({"x"}), "t.csv:8, column 'k': 5 of 4");
  refusesMixed(kModel + "d,l,1,red,3,4\n", fixed({"x"}), "t.csv:8, column 'x': 'l' is no number");
  refusesMixed(kModel + "d,,1,red,3,4\n", fixed({"x"}), "t.csv:8, column 'x': is empty");
  refusesMixed(kModel + ",1,1,red,3,4\n", fixed({"x"}), "t.csv:8, column 'who': is empty");
  refusesMixed("who,x,k,n\na,1,1,4\na,2,2,4\n", fixed({"x"}), "all rows are of one who, 'a'");
  refusesMixed("who,c,k,n\na,red,1,4\nb,red,2,4\n", fixed({"c"}), "one level, 'red'");
  refusesMixed("who,x,k,n\na,1,1,4\nb,1,2,4\n", fixed({"x"}), "the same in all rows");
  // All right at x = 2, all wrong at 1.
  refusesMixed("who,x,k,n\na,1,0,4\na,2,4,4\nb,1,0,4\nb,2,4,4\n", fixed({"x"}), "separates");
  terms = fixed({"c"});
  terms.slope = "c";
  refusesMixed("who,c,k,n\na,r,1,4\na,g,2,4\na,b,3,4\nb,r,1,4\nb,g,3,4\nb,b,2,4\n", terms,
               "more than two levels");
}

}  // namespace
}  // namespace limen::analysis
