// SPDX-License-Identifier: BSD-3-Clause
// limen analyse mixed on tables and on a store.
#include <map>

#include "tests/analysis/observer_statistics/group_program.h"
#include "tests/analysis/result_rows.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kIterated = 1e-4;

class MixedProgram : public GroupProgram {
 protected:
  static std::string textures(const std::string& more) {
    return "mixed " + reference("textures.csv") + " --group observer --k seen --n shown " + more;
  }
  static void expectEffect(const json& fixed, size_t at, const char* name, double estimate, double error) {
    const json& effect = fixed.at(at);
    EXPECT_EQ(effect.at("name"), name);
    expectRelative(effect.at("estimate"), estimate, kIterated);
    expectRelative(effect.at("standard_error"), error, kIterated);
    expectRelative(effect.at("z"), estimate / error, 2.0 * kIterated);
    expectRelative(effect.at("odds_ratio"), std::exp(estimate), 2.0 * kIterated);
    expectRelative(effect.at("odds_ratio_high"), std::exp(estimate + 1.959963984540054 * error), 5e-4);
  }
  static void expectRelative(const json& value, double expected, double tolerance) {
    ASSERT_TRUE(value.is_number());
    EXPECT_NEAR(value.get<double>(), expected, tolerance * std::abs(expected));
  }
};

TEST_F(MixedProgram, FactorTimesNumberIsThatOfLme4) {
  const json model =
      analyse(textures("--fixed texture,size,texture:size --log size --center size")).at("sections").at(0);
  const json fixed = model.at("fixed");
  ASSERT_EQ(fixed.size(), 6U);
  expectEffect(fixed, 0, "intercept", -0.3468463786, 0.2122750631);
  expectEffect(fixed, 1, "texture=brick", 0.7539090426, 0.1621536047);
  expectEffect(fixed, 2, "texture=noise", -1.2389555012, 0.1810966374);
  expectEffect(fixed, 3, "ln(size)", 0.5302435686, 0.1468503052);
  expectEffect(fixed, 4, "texture=brick:ln(size)", 0.3387752694, 0.2126973583);
  expectEffect(fixed, 5, "texture=noise:ln(size)", -0.1840243516, 0.2333667413);
  expectNear(fixed.at(4).at("p"), 1.112146483e-01, 1e-4);
  expectRelative(rowWith(model.at("random"), {{"name", "intercept_sd"}}).at("estimate"), 0.5398265831,
                 kIterated);
  expectNear(model.at("log_likelihood"), -205.850948985, 1e-8);
  expectNear(model.at("aic"), 425.70189797, 1e-8);
  EXPECT_EQ(model.at("columns").at(0).at("reference"), "wood");
  // The mean of ln(0.5), ln(1), ln(2), ln(4).
  expectNear(model.at("columns").at(1).at("centre"), 0.5 * std::log(2.0));
  EXPECT_EQ(model.at("groups").size(), 9U);
  EXPECT_FALSE(model.at("singular").get<bool>());
}

TEST_F(MixedProgram, RandomSlopeIsThatOfLme4) {
  const json model =
      analyse(textures("--fixed texture,size --log size --center size --slope size")).at("sections").at(0);
  expectEffect(model.at("fixed"), 3, "ln(size)", 0.6286994816, 0.2248047740);
  expectEffect(model.at("fixed"), 2, "texture=noise", -1.3577714504, 0.1894306422);
  expectRelative(rowWith(model.at("random"), {{"name", "intercept_sd"}}).at("estimate"), 0.5527624594,
                 kIterated);
  expectRelative(rowWith(model.at("random"), {{"name", "slope_sd"}}).at("estimate"), 0.6102101570, kIterated);
  expectRelative(rowWith(model.at("random"), {{"name", "correlation"}}).at("estimate"), 0.7396503918,
                 kIterated);
  expectNear(model.at("log_likelihood"), -194.561984482, 1e-8);
  const ProgramRun text =
      runProgram("limen-analyse " + textures("--fixed texture,size --log size --center size --slope size"));
  EXPECT_THAT(text.text, HasSubstr("wood is 0"));
  EXPECT_THAT(text.text, HasSubstr("Laplace"));
}

TEST_F(MixedProgram, SingleTrialsAreThoseOfLme4) {
  const json model =
      analyse("mixed " + reference("yes_no.csv") + " --outcome answer --group observer --fixed light,change")
          .at("sections")
          .at(0);
  EXPECT_EQ(model.at("trials"), 160);
  expectEffect(model.at("fixed"), 0, "intercept", -2.6171286994, 0.6731971326);
  expectEffect(model.at("fixed"), 1, "light=bright", 0.4247679349, 0.4149692205);
  expectEffect(model.at("fixed"), 2, "change", 3.3442759723, 0.5358881277);
  expectRelative(rowWith(model.at("random"), {{"name", "intercept_sd"}}).at("estimate"), 0.8851234419,
                 kIterated);
  expectNear(model.at("log_likelihood"), -75.9273427252, 1e-8);
}

TEST_F(MixedProgram, AnotherReferenceTurnsSignsOnly) {
  const json wood = analyse(textures("--fixed texture,size")).at("sections").at(0),
             brick = analyse(textures("--fixed texture,size --reference texture=brick")).at("sections").at(0);
  EXPECT_EQ(brick.at("fixed").at(1).at("name"), "texture=wood");
  EXPECT_EQ(brick.at("fixed").at(2).at("name"), "texture=noise");
  expectRelative(brick.at("fixed").at(1).at("estimate"), -wood.at("fixed").at(1).at("estimate").get<double>(),
                 1e-6);
  expectNear(brick.at("log_likelihood"), wood.at("log_likelihood"), 1e-10);
  // Numbers taken as names: one column for each but the smallest.
  const json levels = analyse(textures("--fixed size --categorical size")).at("sections").at(0);
  ASSERT_EQ(levels.at("fixed").size(), 4U);
  EXPECT_EQ(levels.at("fixed").at(1).at("name"), "size=1");
}

TEST_F(MixedProgram, StoreAndItsExportAgree) {
  const std::string store = folder_.path("s.sqlite");
  const std::string trials = exportedStudy(store, "--observers 8 --seed 3");
  const std::string options = " --log switch_distance --center switch_distance";
  const json ofStore =
      analyse("mixed --no-exclusions " + store +
              " --fixed lod_change,switch_distance,lod_change:switch_distance --slope switch_distance" +
              options)
          .at("sections")
          .at(0);
  const json ofTable =
      analyse("mixed " + trials +
              " --outcome outcome --group subject --where counts=1 --where practice=0 --where change=1"
              " --fixed "
              "condition_lod_change,condition_switch_distance,condition_lod_change:condition_switch_distance"
              " --slope condition_switch_distance --log condition_switch_distance"
              " --center condition_switch_distance --reference condition_lod_change=" +
              ofStore.at("columns").at(0).at("reference").get<std::string>())
          .at("sections")
          .at(0);
  EXPECT_EQ(ofStore.at("trials"), 8 * 84);
  EXPECT_EQ(ofStore.at("columns").at(0).at("reference"), "2_to_3");  // the protocol's first
  for (size_t i = 0; i < 4; ++i) {
    expectRelative(ofTable.at("fixed").at(i).at("estimate"), ofStore.at("fixed").at(i).at("estimate"), 1e-6);
    expectRelative(ofTable.at("fixed").at(i).at("standard_error"),
                   ofStore.at("fixed").at(i).at("standard_error"), 1e-6);
  }
  expectNear(ofTable.at("log_likelihood"), ofStore.at("log_likelihood"), 1e-9);
  refuses("mixed " + store + " --fixed distance", {"no column 'distance'", "switch_distance"});
  refuses("mixed " + store + " --fixed lod_change --part second", {"--part"});
  refuses("mixed " + store + " --fixed lod_change --group x", {"--group"});
}

TEST_F(MixedProgram, PartsOfAStudyAreNamed) {
  const std::string store = folder_.path("s.sqlite");
  const ProgramRun made =
      runProgram("limen-study simulate experiment_2 --observers 6 --seed 2 --quiet --store " + store);
  ASSERT_EQ(made.code, 0) << made.text;
  refuses("mixed " + store + " --fixed presentation", {"several parts: object, terrain", "--part"});
  const json model =
      analyse("mixed --no-exclusions " + store + " --part terrain --fixed presentation").at("sections").at(0);
  EXPECT_THAT(model.at("measure").get<std::string>(), HasSubstr("part terrain"));
  EXPECT_EQ(model.at("groups").size(), 6U);
  refuses("mixed " + store + " --part terain --fixed presentation", {"did you mean 'terrain'?"});
}

TEST_F(MixedProgram, RefusesWithLineAndColumnOrOption) {
  const std::string call = "mixed " + write("who,x,k,n\na,1,0,4\na,2,4,4\nb,1,0,4\nb,2,l,4\n") +
                           " --group who --k k --n n --fixed x";
  refuses(call, {"table.csv:5, column 'k': 'l' is not a number"});
  refuses(call + " --part main", {"--part", "means nothing for a table"});
}

}  // namespace
}  // namespace limen::analysis
