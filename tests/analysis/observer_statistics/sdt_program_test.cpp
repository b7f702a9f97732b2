// SPDX-License-Identifier: BSD-3-Clause
// limen analyse sdt on tables and on a store.
#include "tests/analysis/observer_statistics/group_program.h"
#include "tests/analysis/result_rows.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SdtProgram : public GroupProgram {
 protected:
  static std::string trials(const std::string& more) {
    return "sdt " + reference("yes_no.csv") + " --outcome answer --signal change " + more;
  }
};

TEST_F(SdtProgram, ObserversAreThoseOfR) {
  const json part = analyse(trials("--subject observer")).at("sections").at(0);
  ASSERT_EQ(part.at("rows").size(), 5U);
  EXPECT_TRUE(part.at("rows").at(4).at("observer").is_null());  // all together
  EXPECT_EQ(part.at("rows").at(4).at("signal_trials"), 96);
  const json ann = part.at("rows").at(0), dee = part.at("rows").at(3);
  EXPECT_EQ(ann.at("observer"), "ann");
  EXPECT_EQ(ann.at("hits"), 11);
  EXPECT_EQ(ann.at("false_alarms"), 1);
  EXPECT_EQ(ann.at("noise_trials"), 16);
  expectNear(ann.at("d_prime"), 1.2512685194192);
  expectNear(ann.at("d_prime_low"), 0.2479196108123);
  expectNear(ann.at("criterion"), 0.7260679802211);
  expectNear(ann.at("criterion_high"), 1.2277424345245);
  expectNear(ann.at("ln_beta"), 0.9085060066089);
  expectNear(ann.at("beta"), 2.4806137430825);
  // Of beta: e to the bounds of ln beta.
  expectNear(ann.at("beta_high"), std::exp(ann.at("ln_beta_high").get<double>()));
  expectNear(ann.at("a_prime"), 0.8039815196766);
  // R's derivatives are differences.
  expectNear(ann.at("a_prime_low"), 0.8039815196766 - 1.959963984540054 * 0.0631473356408, 1e-7);
  expectNear(dee.at("criterion"), -0.225707561591);
  expectNear(dee.at("a_prime_high"), 0.875450615595 + 1.959963984540054 * 0.049619939051, 1e-7);

  expectNear(rowWith(part.at("means"), {{"parameter", "d_prime"}}).at("estimate"), 1.736362030818);
  expectNear(rowWith(part.at("means"), {{"parameter", "d_prime"}}).at("low"), 0.734847382937);
  expectNear(rowWith(part.at("means"), {{"parameter", "criterion"}}).at("estimate"), 0.302821718947);
  expectNear(rowWith(part.at("means"), {{"parameter", "ln_beta"}}).at("sd"), 0.641128341673);
  expectNear(rowWith(part.at("means"), {{"parameter", "a_prime"}}).at("high"), 0.9655997109799);
}

TEST_F(SdtProgram, ConditionsArePartsWithSubjectsAndRowsWithout) {
  const json parts = analyse(trials("--subject observer --by light")).at("sections");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts.at(1).at("part"), "bright");
  expectNear(rowWith(parts.at(1).at("means"), {{"parameter", "d_prime"}}).at("estimate"), 1.883949925106);
  expectNear(rowWith(parts.at(1).at("means"), {{"parameter", "d_prime"}}).at("high"), 3.076168661977);
  const json rows = analyse(trials("--by observer,light")).at("sections");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows.at(0).at("rows").at(1).at("observer"), "ann / bright");
  EXPECT_EQ(rowWith(rows.at(0).at("means"), {{"parameter", "d_prime"}}).at("observers"), 8);
  const ProgramRun text = runProgram("limen-analyse " + trials("--by observer,light"));
  EXPECT_THAT(text.text, HasSubstr("means over rows"));
  EXPECT_THAT(text.text, HasSubstr("(k + 1/2) / (n + 1)"));
}

TEST_F(SdtProgram, CountsAgreeWithTrials) {
  // The counts of observers in yes_no.csv.
  const std::string table = write(
      "who,h,s,f,n\nann,11,24,1,16\nbob,12,24,1,16\ncid,10,10,0,6\ncid,12,14,1,10\n"
      "dee,21,24,4,16\n");
  const std::string call = "sdt " + table + " --hits h --signals s --false-alarms f --noises n --subject who";
  const json counts = analyse(call).at("sections").at(0),
             trial = analyse(trials("--subject observer")).at("sections").at(0);
  for (size_t i = 0; i < 5; ++i)
    expectNear(counts.at("rows").at(i).at("d_prime"), trial.at("rows").at(i).at("d_prime"), 1e-14);
  // Without correction: 11 of 24 and 1 of 16, qnorm(11/24) - qnorm(1/16).
  const json plain = analyse(call + " --correction none").at("sections").at(0);
  EXPECT_EQ(plain.at("correction"), "none");
  expectNear(plain.at("rows").at(0).at("d_prime"), -0.10463345561407539 + 1.5341205443525459);
  refuses("sdt " + write("who,h,s,f,n\na,4,4,1,4\nb,3,4,1,4\n") +
              " --hits h --signals s --false-alarms f --noises n --subject who --correction none",
          {"'a', hits", "a rate of 1 makes d' infinite"});
}

TEST_F(SdtProgram, AlternativesAreThoseOfR) {
  // reference/rates.R of the statistics: 60 of 80 in 4 alternatives.
  const std::string table = write("who,k,n\na,60,80\nb,80,80\n");
  const json part =
      analyse("sdt " + table + " --task mafc:4 --k k --n n --subject who --correction none --where who=a")
          .at("sections")
          .at(0);
  expectNear(part.at("rows").at(0).at("d_prime"), 1.682195195203338);
  expectNear(part.at("rows").at(0).at("d_prime_low"), 1.302230262139593);
  expectNear(part.at("rows").at(0).at("d_prime_high"), 2.045328129533326);
  const json open = analyse("sdt " + table + " --task mafc:4 --k k --n n --by who").at("sections").at(0);
  EXPECT_TRUE(open.at("rows").at(1).at("d_prime_high").is_null());
  // Of two alternatives d' is sqrt(2) z(p), here of 4 of 6 trials, corrected to 4.5 / 7.
  const json two = analyse("sdt " + write("who,right\na,1\na,1\na,0\na,1\na,1\na,0\n") +
                           " --task 2afc --outcome right --subject who")
                       .at("sections")
                       .at(0);
  expectNear(two.at("rows").at(0).at("d_prime"), std::sqrt(2.0) * 0.36610635680056963);
}

TEST_F(SdtProgram, StoreAndItsExportAgree) {
  const std::string store = folder_.path("s.sqlite");
  const std::string trials = exportedStudy(store, "--observers 4 --seed 5");
  const json part = analyse("sdt --no-exclusions " + store).at("sections").at(0);
  EXPECT_EQ(part.at("rows").size(), 5U);
  EXPECT_TRUE(part.at("rows").at(0).contains("a_prime_low"));
  const json table =
      analyse("sdt " + trials +
              " --outcome outcome --signal change --where counts=1 --where practice=0 --subject subject")
          .at("sections")
          .at(0);
  for (size_t i = 0; i < 5; ++i)
    expectNear(table.at("rows").at(i).at("d_prime"), part.at("rows").at(i).at("d_prime"), 1e-14);
  expectNear(rowWith(table.at("means"), {{"parameter", "criterion"}}).at("estimate"),
             rowWith(part.at("means"), {{"parameter", "criterion"}}).at("estimate"), 1e-14);
  refuses("sdt " + store + " --hits h", {"--hits"});
  refuses("sdt " + store + " --task 2afc", {"--task", "protocol"});
}

}  // namespace
}  // namespace limen::analysis
