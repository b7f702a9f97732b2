// SPDX-License-Identifier: BSD-3-Clause
// limen analyse correlate on tables. Expected numbers are those of statistics/reference/relations.R and .py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/analysis/expect_near.h"
#include "tests/analysis/result_rows.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kRates =
    "a,b,c,rate,seen\n1.2,3,0.1,0.25,0\n0.8,1,0.3,0.25,0\n2.5,4,0.2,0.5,1\n2.5,1,0.5,0.75,1\n3.1,5,0.9,1,1\n"
    "0.4,9,0.2,0,0\n1.9,2,0.6,0.5,0\n4.0,6,0.7,1,1\n2.5,5,0.8,0.75,1\n3.3,3,0.4,0.5,0\n0.4,5,0.3,0.25,1\n1.2,"
    "8,"
    "0.1,0,0\n";

/// Eight participants of three rows each, every row `times` times.
std::string clusteredTable(int times) {
  const double x[] = {2.1, 2.3, 1.9, 3.6, 3.3, 3.9, 0.8, 1.1, 0.7, 4.4, 4.7, 4.1,
                      2.9, 2.6, 3.0, 1.5, 1.2, 1.8, 3.8, 3.5, 4.0, 2.2, 2.4, 2.0};
  const double z[] = {1.0, 1.3, 0.9, 2.1, 2.4, 2.2, 1.6, 1.5, 1.8, 2.9, 2.6, 3.1,
                      0.7, 1.1, 0.8, 1.4, 1.2, 1.3, 2.0, 1.8, 2.3, 1.9, 1.7, 2.1};
  std::string out = "who,row,x,z,seen\n";
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < times; ++k)
      out += "p" + std::to_string(i / 3) + "," + std::to_string(i) + "," + std::to_string(x[i]) + "," +
             std::to_string(z[i]) + "," + (z[i] > 1.65 ? "1" : "0") + "\n";
  return out;
}

/// Of one pair of columns, by name.
json coefficientsOf(const json& section, const std::string& x) {
  json out;
  for (const json& row : rowsWith(section.at("coefficients"), {{"x", x}})) out[row.at("coefficient")] = row;
  return out;
}

class CorrelateProgram : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path(name)) << text;
    return folder_.path(name);
  }
  json call(const std::string& arguments) {
    const ProgramRun run = runProgram("limen-analyse correlate --json " + arguments);
    EXPECT_EQ(run.code, 0) << run.text;
    return run.code == 0 ? json::parse(run.text) : json();
  }
  void expectRefused(const std::string& arguments, const std::vector<std::string>& words) {
    const ProgramRun run = runProgram("limen-analyse correlate " + arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    for (const std::string& word : words) EXPECT_THAT(run.text, HasSubstr(word)) << arguments;
  }
  const TemporaryFolder folder_;
};

TEST_F(CorrelateProgram, CoefficientsAreThoseOfR) {
  const json out = call(write("rates.csv", kRates) + " --x a,b,c --y rate --clamp");
  EXPECT_EQ(out.at("rows"), 12);
  const json& section = out.at("sections").at(0);
  ASSERT_EQ(section.at("coefficients").size(), 3U * 6U);
  const char* columns[] = {"a", "b", "c"};
  const double tau[] = {0.729232658585723, -0.101753394221264, 0.750939261482638},
               tauP[] = {0.00220694872467456, 0.66930784511220454, 0.00145239206795003},
               tauHolm[] = {0.00441389744934912, 0.66930784511220454, 0.00435717620385008},
               rho[] = {0.850484964784608, -0.178385617613721, 0.863888072606427},
               rhoHolm[] = {0.000910533268726726, 0.579104709938388806, 0.000874377129345840},
               r[] = {0.865555612968779, -0.277443901346465, 0.873964555764662},
               rP[] = {0.000274841352454156, 0.382623818308765018, 0.000201945507189443},
               rHolm[] = {0.000605836521568329, 0.382623818308765018, 0.000605836521568329};
  for (size_t i = 0; i < 3; ++i) {
    const json c = coefficientsOf(section, columns[i]);
    expectNear(c.at("kendall_tau_b").at("estimate"), tau[i]);
    expectNear(c.at("kendall_tau_b").at("p"), tauP[i]);
    expectNear(c.at("kendall_tau_b").at("p_holm"), tauHolm[i]);
    expectNear(c.at("spearman").at("estimate"), rho[i]);
    expectNear(c.at("spearman").at("p_holm"), rhoHolm[i]);
    expectNear(c.at("pearson").at("estimate"), r[i]);
    expectNear(c.at("pearson").at("p"), rP[i]);
    expectNear(c.at("pearson").at("p_holm"), rHolm[i]);
    EXPECT_EQ(c.at("pearson").at("p_exact"), false);
    EXPECT_TRUE(c.at("pearson").at("bootstrap_low").is_null());
  }
  expectNear(coefficientsOf(section, "a").at("kendall_tau_c").at("estimate"), 0.7465277777777778);
  // 43 pairs more agree than not (tau_c n^2 (m - 1) / 2m with m = 5 rates), of 66.
  expectNear(coefficientsOf(section, "a").at("kendall_tau_a").at("estimate"), 43.0 / 66.0);
  const json clamped = coefficientsOf(section, "a").at("pearson_clamped"), clamp = section.at("clamps").at(0);
  expectNear(clamp.at("clamp"), 3.1);
  EXPECT_EQ(clamp.at("clamped"), 2);
  expectNear(clamped.at("estimate"), 0.861017338782782748);
  expectNear(clamped.at("p"), 0.000321890251619144);
  expectNear(clamped.at("low"), 0.567578563467702968);
  expectNear(clamped.at("high"), 0.960364947587392548);

  const json wide = call(write("rates.csv", kRates) + " --x a --y rate --confidence 0.9");
  const json pearson = coefficientsOf(wide.at("sections").at(0), "a").at("pearson");
  expectNear(pearson.at("low"), 0.645063243268151);
  expectNear(pearson.at("high"), 0.952988906916823);
}

TEST_F(CorrelateProgram, ExactWithFewRowsWithoutTies) {
  // Five rows in perfect order: 2 of 120 orders are as extreme, for Kendall and Spearman alike.
  const json out = call(write("few.csv", "x,y\n1,2\n2,3\n3,5\n4,8\n5,9\n") + " --x x --y y");
  const json c = coefficientsOf(out.at("sections").at(0), "x");
  for (const char* name : {"kendall_tau_b", "spearman"}) {
    EXPECT_EQ(c.at(name).at("p_exact"), true);
    expectNear(c.at(name).at("p"), 2.0 / 120.0);
    EXPECT_TRUE(c.at(name).at("p_holm").is_null()) << "a single pair is not adjusted";
  }
}

TEST_F(CorrelateProgram, GroupsAreWhatTheirRowsAloneGive) {
  const std::string both =
      write("both.csv", "scene,x,y\nu,1,2\nv,3,1\nu,2,5\nv,1,4\nu,3,3\nv,2,2\nu,4,8\nv,5,0\nu,5,6\nv,4,7\n");
  const std::string alone = write("u.csv", "x,y\n1,2\n2,5\n3,3\n4,8\n5,6\n");
  const json groups = call(both + " --x x --y y --by scene").at("sections");
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].at("group"), "scene=u");
  EXPECT_EQ(groups[0].at("coefficients"), call(alone + " --x x --y y").at("sections")[0].at("coefficients"));
}

TEST_F(CorrelateProgram, BootstrapDrawsWholeClusters) {
  const std::string file = write("clusters.csv", clusteredTable(1));
  const auto coefficients = [&](const std::string& arguments) {
    return coefficientsOf(call(arguments).at("sections")[0], "x");
  };
  const json drawn = coefficients(file + " --x x --y z --cluster who --samples 20000");
  // The bounds' own Monte Carlo error is some 0.005 on either side.
  expectNear(drawn.at("pearson").at("bootstrap_low"), -0.132, 0.03);
  expectNear(drawn.at("pearson").at("bootstrap_high"), 0.883, 0.015);
  expectNear(drawn.at("kendall_tau_b").at("bootstrap_low"), -0.291, 0.03);
  expectNear(drawn.at("kendall_tau_b").at("bootstrap_high"), 0.682, 0.015);
  const json rows = coefficients(file + " --x x --y z --cluster row --samples 20000");
  expectNear(rows.at("pearson").at("bootstrap_low"), 0.305, 0.02);
  expectNear(rows.at("pearson").at("bootstrap_high"), 0.803, 0.01);

  // Writing every row four times adds nothing that is not there: the bootstrap stays as it is, but the other
  // interval shrinks.
  const json once = coefficients(file + " --x x --y z --cluster who");
  const json four = coefficients(write("four.csv", clusteredTable(4)) + " --x x --y z --cluster who");
  for (const char* side : {"bootstrap_low", "bootstrap_high"})
    expectNear(four.at("pearson").at(side), once.at("pearson").at(side).get<double>(), 1e-12);
  const auto width = [](const json& c) { return c.at("high").get<double>() - c.at("low").get<double>(); };
  EXPECT_LT(width(four.at("pearson")), 0.6 * width(once.at("pearson")));
  EXPECT_EQ(once, coefficients(file + " --x x --y z --cluster who --seed 1")) << "same seed";
  EXPECT_NE(once, coefficients(file + " --x x --y z --cluster who --seed 2"));
}

TEST_F(CorrelateProgram, AreasAndTheirDifferencesAreThoseOfDeLong) {
  const std::string file = write("rates.csv", kRates);
  const json group = call(file + " --x a,b,c --outcome seen").at("sections").at(0);
  const double area[] = {0.736111111111111, 0.569444444444444, 0.805555555555556},
               variance[] = {0.0309413580246914, 0.0420524691358025, 0.0172839506172839},
               difference[] = {0.1666666666666667, -0.0694444444444444, -0.2361111111111112},
               error[] = {0.302765035409749, 0.167820082966591, 0.278748304540047},
               p[] = {0.581988900057243, 0.679018427525733, 0.396972531955516};
  for (size_t i = 0; i < 3; ++i) {
    expectNear(group.at("areas")[i].at("estimate"), area[i]);
    expectNear(group.at("areas")[i].at("variance"), variance[i]);
    const json& one = group.at("differences")[i];
    expectNear(one.at("estimate"), difference[i]);
    expectNear(one.at("p"), p[i]);
    expectNear(one.at("p_holm"), 1.0);
    expectNear(one.at("high"), difference[i] + 1.959963984540054 * error[i]);
  }
  const json calibration =
      call(file + " --x c --outcome seen --probability").at("sections")[0].at("calibration")[0];
  expectNear(calibration.at("brier"), 0.1825);
  const auto term = [&](const char* name) { return calibration.at(name).get<double>(); };
  EXPECT_NEAR(term("reliability") - term("resolution") + term("uncertainty") + term("within_variance") -
                  term("within_covariance"),
              0.1825, 1e-12);

  const json drawn =
      call(write("clusters.csv", clusteredTable(1)) + " --x x --outcome seen --cluster who --samples 20000")
          .at("sections")[0]
          .at("areas")[0];
  expectNear(drawn.at("bootstrap_low"), 0.5, 0.02);
  expectNear(drawn.at("bootstrap_high"), 1.0, 0.005);
}

TEST_F(CorrelateProgram, SaysWhyThereIsNoCoefficient) {
  const std::string file = write("flat.csv", "x,y,z,seen,g\n1,5,2,1,u\n1,4,3,1,u\n1,3,9,1,v\n1,2,4,1,u\n");
  const ProgramRun text = runProgram("limen-analyse correlate " + file + " --x x,z --y y --by g");
  EXPECT_EQ(text.code, 0) << text.text;
  EXPECT_THAT(text.text, HasSubstr("no coefficients: x does not vary"));
  EXPECT_THAT(text.text, HasSubstr("no coefficients: 1 of 3 that are needed at least"));
  EXPECT_THAT(text.text, testing::Not(HasSubstr("nan")));
  const json c = coefficientsOf(call(file + " --x x --y y").at("sections")[0], "x");
  for (const auto& [name, one] : c.items()) {
    EXPECT_TRUE(one.at("estimate").is_null()) << name;
    EXPECT_TRUE(one.at("p").is_null()) << name;
    EXPECT_EQ(one.at("reason"), "x does not vary") << name;
  }
  const json areas = call(file + " --x z --outcome seen").at("sections")[0];
  EXPECT_TRUE(areas.at("areas").empty());
  EXPECT_EQ(areas.at("notes")[0], "seen is 1 in every row: no area");
}

TEST_F(CorrelateProgram, RefusesWhatIsWrongAndSaysWhere) {
  const std::string file = write("rates.csv", kRates);
  expectRefused(file + " --x aa --y rate", {"rates.csv", "no column 'aa'", "--x", "did you mean 'a'"});
  expectRefused(file + " --x a,a --y rate", {"--x", "'a'"});
  expectRefused(file + " --x rate --y rate", {"against itself"});
  expectRefused(file + " --x a", {"--y, --outcome"});
  expectRefused(file + " --x a --y rate --outcome seen", {"--y, --outcome"});
  expectRefused(file + " --y rate", {"--x"});
  expectRefused(file + " --x a --outcome rate", {"rates.csv:2, column 'rate'", "neither 0 nor 1"});
  expectRefused(file + " --x rate --y a --clamp", {"rates.csv:2, column 'a'", "no rate"});
  expectRefused(file + " --x b --outcome seen --probability", {"rates.csv:2, column 'b'", "no probability"});
  expectRefused(file + " --x a --y rate --probability", {"--probability", "--outcome"});
  expectRefused(file + " --x a --y rate --samples 500", {"--samples", "--cluster"});
  expectRefused(file + " --x a --y rate --cluster seen --samples 5", {"--samples"});
  expectRefused(file + " --x a --y rate --confidence 95", {"--confidence"});
  expectRefused(file + " --x a --y rate --protocol p", {"--protocol"});
  expectRefused(write("word.csv", "x,y\n1,2\n2,no\n3,4\n") + " --x x --y y",
                {"word.csv:3, column 'y'", "'no'"});
  expectRefused(write("gap.csv", "x,y\n1,2\n,3\n3,4\n") + " --x x --y y",
                {"gap.csv:3, column 'x'", "is empty"});
  expectRefused(write("two.csv", "x,y\n1,2\n2,3\n") + " --x x --y y", {"two.csv", "2 row(s)"});
  expectRefused(file + " --x a --y rate --plot a.gif", {".gif"});
  expectRefused(folder_.path("none.csv") + " --x a --y rate", {"none.csv"});
}

TEST_F(CorrelateProgram, WritesTablesAndPictures) {
  const std::string file = write("rates.csv", kRates), csv = folder_.path("out.csv");
  const ProgramRun run = runProgram("limen-analyse correlate " + file + " --x a,b --y rate --csv " + csv +
                                    " --plot " + folder_.path("a.svg"));
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("Kendall tau_b"));
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("table,group,x,y,n,coefficient,estimate,low,high,"));
  EXPECT_THAT(table, HasSubstr("\ncoefficients,,a,rate,12,kendall_tau_b,0.7292326585857"));
  for (const char* name : {"a.svg", "a.gp", "a.dat"})
    EXPECT_GT(std::filesystem::file_size(folder_.path(name)), 100U);
  ASSERT_EQ(runProgram("limen-analyse correlate " + file + " --x c --outcome seen --probability --plot " +
                       folder_.path("roc.png"))
                .code,
            0);
  EXPECT_GT(std::filesystem::file_size(folder_.path("roc.png")), 1000U);
}

}  // namespace
}  // namespace limen::analysis
