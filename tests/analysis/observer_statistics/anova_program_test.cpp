// SPDX-License-Identifier: BSD-3-Clause
// limen analyse anova on tables and on a store.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "tests/analysis/observer_statistics/group_program.h"
#include "tests/analysis/result_rows.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class AnovaProgram : public GroupProgram {
 protected:
  static std::string rates(const std::string& more = {}) {
    return "anova " + reference("rates.csv") +
           " --subject subject --within presentation,distance --k seen --n shown " + more;
  }
};

TEST_F(AnovaProgram, EffectsAreThoseOfR) {
  const json answer = analyse(rates());
  EXPECT_EQ(answer.at("rows"), 42);
  EXPECT_EQ(answer.at("sha256").get<std::string>().size(), 64U);
  const json part = answer.at("sections").at(0);
  EXPECT_EQ(part.at("observers"), 7);
  EXPECT_EQ(part.at("measure"), "rate of 'seen' in 'shown'");
  EXPECT_EQ(part.at("transform"), "none");
  EXPECT_TRUE(part.at("unequal_replicates").get<bool>());
  // Texts as they come, numbers growing.
  EXPECT_EQ(part.at("factors").at(0).at("levels"), json({"still", "moving"}));
  EXPECT_EQ(part.at("factors").at(1).at("levels"), json({"4", "10", "25"}));

  const json effects = part.at("effects");
  ASSERT_EQ(effects.size(), 3U);
  EXPECT_EQ(effects.at(0).at("effect"), "presentation");
  expectNear(effects.at(0).at("f"), 18.593114241);
  expectNear(effects.at(0).at("p"), 0.00502657002702);
  EXPECT_EQ(effects.at(0).at("df"), 1);
  EXPECT_EQ(effects.at(0).at("df_error"), 6);
  // SS / (SS + error SS), and SS / (SS + SS of subjects and all errors); the former of R's sums.
  expectNear(effects.at(0).at("partial_eta_squared"), 0.2182723398001 / (0.2182723398001 + 0.0704365079365));
  EXPECT_TRUE(effects.at(0).at("mauchly_w").is_null());
  expectNear(effects.at(1).at("f"), 53.9573333333);
  EXPECT_NEAR(effects.at(1).at("p").get<double>(), 1.0042773061e-06, 1e-15);
  expectNear(effects.at(1).at("mauchly_w"), 0.649755428571);
  expectNear(effects.at(1).at("mauchly_p"), 0.340310063123);
  expectNear(effects.at(1).at("greenhouse_geisser"), 0.740606569477);
  expectNear(effects.at(1).at("huynh_feldt"), 0.925966662071);
  EXPECT_NEAR(effects.at(1).at("p_greenhouse_geisser").get<double>(), 1.98319953791e-05, 1e-14);
  EXPECT_NEAR(effects.at(1).at("p_huynh_feldt").get<double>(), 2.34656253036e-06, 1e-15);
  EXPECT_EQ(effects.at(2).at("effect"), "presentation x distance");
  expectNear(effects.at(2).at("f"), 3.2591611479);
  expectNear(effects.at(2).at("p_greenhouse_geisser"), 0.104802430785);
  expectNear(effects.at(2).at("mauchly_w"), 0.455090566203);
}

TEST_F(AnovaProgram, PairsAndRanksAreThoseOfR) {
  const json part = analyse(rates("--ranks")).at("sections").at(0), distance = {{"factor", "distance"}};
  const json levels = rowsWith(part.at("levels"), distance), pairs = rowsWith(part.at("pairs"), distance),
             rankPairs = rowsWith(part.at("rank_pairs"), distance);
  expectNear(levels.at(1).at("estimate"), 0.791666666667);
  expectNear(levels.at(1).at("sd"), 0.157747454050);
  // R's mean and sd of seven subjects; t of 6 degrees of freedom is 2.446911851145, the interval one of the
  // logit.
  const double rate = 0.791666666667,
               reach = 2.446911851145 * 0.157747454050 / std::sqrt(7.0) / (rate * (1.0 - rate));
  expectNear(levels.at(1).at("low"), 1.0 / (1.0 + std::exp(reach) * (1.0 - rate) / rate));
  struct {
    const char *first, *second;
    double difference, low, high, t, p, dz, holm, v, rankP, rankHolm;
  } const kPairs[] = {
      {"4", "10", 0.1130952380952, -0.0160874795874, 0.2422779557778, 2.1421911798081, 0.0759203255365,
       0.8096721603612, 7.59203255365e-02, 19.5, 0.0731397996589, 0.0731397996589},
      {"4", "25", 5.75396825397e-01, 4.63205722742e-01, 6.87587928052e-01, 1.25495273498e+01,
       1.56637029593e-05, 4.74327549129, 4.69911088779e-05, 28, 0.015625, 0.046875},
      {"10", "25", 0.4623015873016, 0.2817510114190, 0.6428521631842, 6.2653427010215, 0.0007676988266,
       2.3680769522138, 1.53539765320e-03, 28, 0.0222541248231, 0.046875}};
  for (size_t i = 0; i < 3; ++i) {
    const json pair = pairs.at(i), ranks = rankPairs.at(i);
    EXPECT_EQ(pair.at("first"), kPairs[i].first);
    EXPECT_EQ(ranks.at("second"), kPairs[i].second);
    expectNear(pair.at("estimate"), kPairs[i].difference);
    expectNear(pair.at("low"), kPairs[i].low);
    expectNear(pair.at("high"), kPairs[i].high);
    expectNear(pair.at("t"), kPairs[i].t);
    expectNear(pair.at("p"), kPairs[i].p);
    expectNear(pair.at("d_z"), kPairs[i].dz);
    expectNear(pair.at("p_holm"), kPairs[i].holm);
    expectNear(ranks.at("v"), kPairs[i].v);
    expectNear(ranks.at("p"), kPairs[i].rankP);
    expectNear(ranks.at("p_holm"), kPairs[i].rankHolm);
  }
  EXPECT_FALSE(rankPairs.at(0).at("exact").get<bool>());
  EXPECT_TRUE(rankPairs.at(1).at("exact").get<bool>());
  const json friedman = rowWith(part.at("friedman"), distance);
  expectNear(friedman.at("chi_squared"), 12.07407407407407);
  expectNear(friedman.at("p"), 0.00238862584884);
  expectNear(levels.at(0).at("mean_rank"), 2.78571428571);
  EXPECT_FALSE(analyse(rates()).at("sections").at(0).contains("friedman"));
}

TEST_F(AnovaProgram, TransformsRatesAndSaysSo) {
  const json effects = analyse(rates("--transform arcsine")).at("sections").at(0).at("effects");
  expectNear(effects.at(0).at("f"), 20.6324824115);
  expectNear(effects.at(1).at("f"), 35.3358483492);
  expectNear(effects.at(2).at("p"), 0.111947452585);
  EXPECT_THAT(runProgram("limen-analyse " + rates("--transform arcsine")).text, HasSubstr("asin(sqrt(p))"));
  EXPECT_THAT(runProgram("limen-analyse " + rates()).text, HasSubstr("rates are not transformed"));
}

TEST_F(AnovaProgram, CountsSingleTrialsAndValuesAgree) {
  // The same answers as single trials, with counts in two rows, and as rates in cells of equal size.
  std::ifstream in(reference("rates.csv"));
  std::string line, single = "subject,presentation,distance,seen\n",
                    split = "subject,presentation,distance,k,n\n", values = single;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const size_t second = line.rfind(','), first = line.rfind(',', second - 1);
    const std::string cell = line.substr(0, first);
    const int k = std::stoi(line.substr(first + 1)), n = std::stoi(line.substr(second + 1));
    for (int i = 0; i < n; ++i) single += cell + (i < k ? ",1\n" : ",0\n");
    const int part = std::min(k, 5);
    split += cell + "," + std::to_string(part) + ",5\n" + cell + "," + std::to_string(k - part) + "," +
             std::to_string(n - 5) + "\n";
    // Two values whose mean is the rate.
    const double rate = static_cast<double>(k) / n;
    for (const double value : {rate - 0.25, rate + 0.25}) values += cell + "," + std::to_string(value) + "\n";
  }
  const std::string design = " --subject subject --within presentation,distance ";
  const json expected = analyse(rates()).at("sections").at(0).at("effects");
  const json ofSingle = analyse("anova " + write(single, "single.csv") + design + "--outcome seen");
  const json ofSplit = analyse("anova " + write(split, "split.csv") + design + "--k k --n n");
  const json ofValues = analyse("anova " + write(values, "values.csv") + design + "--value seen");
  for (size_t i = 0; i < 3; ++i) {
    const double f = expected.at(i).at("f");
    expectNear(ofSingle.at("sections").at(0).at("effects").at(i).at("f"), f, 1e-12);
    expectNear(ofSplit.at("sections").at(0).at("effects").at(i).at("f"), f, 1e-12);
    expectNear(ofValues.at("sections").at(0).at("effects").at(i).at("f"), f, 1e-4);  // 6 digits in the table
  }
  EXPECT_EQ(ofValues.at("sections").at(0).at("measure"), "mean of 'seen'");
  refuses("anova " + folder_.path("values.csv") + design + "--value seen --transform arcsine",
          {"values.csv:", "column 'seen'", "is no rate"});
}

TEST_F(AnovaProgram, StoreAndItsExportAgree) {
  const std::string store = folder_.path("s.sqlite");
  const std::string trials = exportedStudy(store, "--observers 8 --seed 3");
  const json ofStore = analyse("anova --ranks --no-exclusions " + store).at("sections").at(0);
  const json ofTable =
      analyse(
          "anova --ranks " + trials +
          " --subject subject --within condition_lod_change,condition_switch_distance,condition_presentation"
          " --outcome outcome --where counts=1 --where practice=0 --where change=1")
          .at("sections")
          .at(0);
  ASSERT_EQ(ofStore.at("effects").size(), 7U);
  // Factors may come in another order: effects are found by what takes part in them.
  std::map<std::set<std::string>, json> byFactors;
  const auto factorsOf = [](std::string name) {
    std::set<std::string> out;
    for (size_t at = 0; at != std::string::npos;) {
      const size_t end = name.find(" x ", at);
      std::string factor = name.substr(at, end == std::string::npos ? end : end - at);
      if (factor.rfind("condition_", 0) == 0) factor = factor.substr(10);
      out.insert(factor);
      at = end == std::string::npos ? end : end + 3;
    }
    return out;
  };
  for (const json& effect : ofTable.at("effects")) byFactors[factorsOf(effect.at("effect"))] = effect;
  for (const json& effect : ofStore.at("effects")) {
    const json& other = byFactors.at(factorsOf(effect.at("effect")));
    expectNear(other.at("f"), effect.at("f"), 1e-12);
    expectNear(other.at("p"), effect.at("p"), 1e-12);
    expectNear(other.at("generalised_eta_squared"), effect.at("generalised_eta_squared"), 1e-12);
  }
  ASSERT_EQ(ofStore.at("friedman").size(), 3U);
  for (const json& one : ofStore.at("friedman")) {
    const json column = {{"factor", "condition_" + one.at("factor").get<std::string>()}};
    expectNear(rowWith(ofTable.at("friedman"), column).at("chi_squared"), one.at("chi_squared"), 1e-12);
    EXPECT_EQ(rowsWith(ofTable.at("pairs"), column).size(),
              rowsWith(ofStore.at("pairs"), {{"factor", one.at("factor")}}).size());
  }
  // The text has the published values beside one's own.
  const ProgramRun text = runProgram("limen-analyse anova --no-exclusions " + store);
  EXPECT_THAT(text.text, HasSubstr("F(6,42) = 30.226"));
  refuses("anova " + store + " --subject subject", {"--subject", "a result store has none"});
}

TEST_F(AnovaProgram, IncompleteSubjectsAreRefusedOrLeftOutAndNamed) {
  const std::string table = write(
      "who,lod,distance,t\na,near,1,3\na,near,2,5\na,far,1,4\na,far,2,8\nb,near,1,2\nb,near,2,6\nb,far,1,3\n"
      "b,far,2,9\nc,near,1,1\nc,far,2,4\nd,near,1,2\nd,near,2,2.5\nd,far,1,3.5\nd,far,2,6\n");
  const std::string design = "anova " + table + " --subject who --within lod,distance --value t";
  refuses(design, {"subject 'c' has no value at lod=near, distance=2 and 1 more", "--drop-incomplete"});
  const json part = analyse(design + " --drop-incomplete").at("sections").at(0);
  EXPECT_EQ(part.at("incomplete_observers"), json({"c"}));
  EXPECT_EQ(part.at("observers"), 3);
  EXPECT_THAT(runProgram("limen-analyse " + design + " --drop-incomplete").text, HasSubstr("left out: c"));
  refuses(design + " --drop-incomplete --where who=a --where who=c", {"fewer than two are left"});
  // Of these rows nobody misses any. Lists do not swallow the table behind them.
  const json some = analyse(
      "anova --subject who --value t --where lod=near --where who=a --where who=b --where who=d"
      " --within distance " +
      table);
  EXPECT_EQ(some.at("sections").at(0).at("observers"), 3);
  EXPECT_EQ(some.at("rows"), 6);
  EXPECT_EQ(some.at("rows_in_file"), 14);
}

TEST_F(AnovaProgram, WritesOneTableForAll) {
  const std::string csv = folder_.path("out.csv");
  ASSERT_EQ(runProgram("limen-analyse " + rates("--ranks --csv " + csv)).code, 0);
  std::ifstream in(csv);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(text, HasSubstr("\neffects,,,,presentation,18.59311424"));
  EXPECT_THAT(text, HasSubstr("\npairs,,"));
  EXPECT_THAT(text, HasSubstr("\nrank_pairs,,"));
  EXPECT_THAT(text, HasSubstr("\nfriedman,,"));
  size_t fields = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto own = static_cast<size_t>(std::count(line.begin(), line.end(), ','));
    if (fields == 0) fields = own;
    EXPECT_EQ(own, fields) << line;
  }
}

TEST_F(AnovaProgram, NeverPrintsWhatIsNoNumber) {
  // Every subject shows the same effect of a, none of b.
  const std::string table =
      write("s,a,b,v\n1,x,u,1\n1,y,u,2\n1,x,w,1\n1,y,w,2\n2,x,u,4\n2,y,u,5\n2,x,w,4\n2,y,w,5\n");
  const std::string call = "anova " + table + " --subject s --within a,b --value v --ranks";
  const json effects = analyse(call).at("sections").at(0).at("effects");
  EXPECT_TRUE(effects.at(0).at("f").is_null());
  EXPECT_TRUE(effects.at(0).at("f_infinite").get<bool>());
  EXPECT_TRUE(effects.at(1).at("f").is_null());
  EXPECT_FALSE(effects.at(1).at("f_infinite").get<bool>());
  const ProgramRun text = runProgram("limen-analyse " + call);
  EXPECT_THAT(text.text, HasSubstr("F is infinite"));
  EXPECT_THAT(text.text, Not(HasSubstr("nan")));
}

TEST_F(AnovaProgram, RefusesWithLineAndColumnOrOption) {
  const std::string call = "anova " + write("who,lod,k,n\na,1,3,4\na,2,5,4\nb,1,2,4\nb,2,1,4\n") +
                           " --subject who --within lod --k k --n n";
  refuses(call, {"table.csv:3, column 'k': 5 of 4 trials"});
  refuses(call + " --where who=z", {"no row has who=z"});
  refuses(call + " --protocol x", {"--protocol", "means nothing for a table"});
  refuses("anova " + folder_.path("none.csv"), {"no such file"});
}

}  // namespace
}  // namespace limen::analysis
