// SPDX-License-Identifier: BSD-3-Clause
// limen analyse scale on tables. Expected numbers are those of statistics/reference/relations.R.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/analysis/expect_near.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kPairs =
    "won,lost,times\np,q,14\np,r,18\np,s,25\nq,p,16\nq,r,17\nq,s,21\nr,p,12\nr,q,13\nr,s,19\ns,p,5\ns,q,9\ns,"
    "r,11\n";
const std::string kColumns = " --winner won --loser lost --n times ";

class ScaleProgram : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path(name)) << text;
    return folder_.path(name);
  }
  json scale(const std::string& arguments) {
    const ProgramRun run = runProgram("limen-analyse scale --json " + arguments);
    EXPECT_EQ(run.code, 0) << run.text;
    return run.code == 0 ? json::parse(run.text) : json();
  }
  void expectRefused(const std::string& arguments, const std::vector<std::string>& words) {
    const ProgramRun run = runProgram("limen-analyse scale " + arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    for (const std::string& word : words) EXPECT_THAT(run.text, HasSubstr(word)) << arguments;
  }
  const TemporaryFolder folder_;
};

TEST_F(ScaleProgram, ValuesErrorsAndStepsAreThoseOfR) {
  struct Expected {
    const char* model;
    double values[3], errors[3], preferred[3], steps[3], stepErrors[3], p[3], holm[3], goodness[2];
  };
  const Expected all[] = {{"bradley-terry",
                           {1.153158515491488, 1.045269442477837, 0.693359462612564},
                           {0.286544941288779, 0.283727464952722, 0.277584032154551},
                           {0.760087359731308, 0.739865468148364, 0.666713838786995},
                           {0.107889073013650, 0.351909979865274, 0.693359462612564},
                           {0.268370322361944, 0.267068960349303, 0.277584032154551},
                           {0.6876724992942265, 0.1876126079428138, 0.0124953892498373},
                           {0.6876724992942265, 0.3752252158856277, 0.0374861677495118},
                           {1.85451817478486, 1.79091075628589}},
                          {"thurstone",
                           {0.715506314078192, 0.644123470592049, 0.427260999410552},
                           {0.173430706829940, 0.170428600394417, 0.168407130330632},
                           {0.762851879654956, 0.740252314105788, 0.665405382000771},
                           {0.071382843486143, 0.216862471181497, 0.427260999410552},
                           {0.165675863791990, 0.164529325858503, 0.168407130330632},
                           {0.6665713071158903, 0.1874775659277987, 0.0111783990765287},
                           {0.666571307115890, 0.374955131855597, 0.033535197229586},
                           {1.79977186383726, 1.74302990583443}}};
  const std::string file = write("pairs.csv", kPairs);
  for (const Expected& one : all) {
    const json group =
        scale(file + kColumns + "--reference s --samples 0 --model " + one.model).at("sections").at(0);
    const char* names[] = {"p", "q", "r", "s"};
    for (size_t i = 0; i < 3; ++i) {
      const json &item = group.at("items")[i], &step = group.at("steps")[i];
      EXPECT_EQ(item.at("item"), names[i]);
      expectNear(item.at("estimate"), one.values[i], 1e-6);
      expectNear(item.at("standard_error"), one.errors[i], 1e-5);  // R differentiates numerically
      expectNear(item.at("preferred"), one.preferred[i], 1e-6);
      expectNear(item.at("low"), one.values[i] - 1.959963984540054 * one.errors[i], 2e-5);
      EXPECT_EQ(step.at("upper"), names[i]);
      EXPECT_EQ(step.at("lower"), names[i + 1]);
      expectNear(step.at("estimate"), one.steps[i], 1e-6);
      expectNear(step.at("standard_error"), one.stepErrors[i], 1e-5);
      expectNear(step.at("p"), one.p[i], 1e-5);
      expectNear(step.at("p_holm"), one.holm[i], 1e-5);
    }
    EXPECT_EQ(group.at("items")[3].at("estimate"), 0.0);
    EXPECT_TRUE(group.at("items")[3].at("low").is_null()) << "the reference has no error";
    EXPECT_EQ(group.at("judgements"), 180);
    EXPECT_EQ(group.at("df"), 3);
    expectNear(group.at("deviance"), one.goodness[0], 1e-6);
    expectNear(group.at("pearson"), one.goodness[1], 1e-6);
    EXPECT_FALSE(group.contains("bootstrap_over"));
    EXPECT_TRUE(group.at("items")[0].at("bootstrap_low").is_null());
  }
  const json squares =
      scale(file + kColumns + "--reference s --samples 0 --model thurstone-ls").at("sections").at(0);
  expectNear(squares.at("items")[0].at("estimate"), 0.742408460306977, 1e-9);
  expectNear(squares.at("items")[2].at("estimate"), 0.437992656265357, 1e-9);
}

TEST_F(ScaleProgram, BothWaysOfWritingAnswersMeanTheSame) {
  const std::string results = write("a.csv", "w,l,n\nu,v,3\nv,u,2\nu,x,4\nx,u,1\nv,x,3\nx,v,2\n");
  const std::string shown =
      write("b.csv",
            "left,right,choice,n\nu,v,u,3\nv,u,v,2\nx,u,u,4\nu,x,x,1\nv,x,v,2\nx,v,v,1\n"
            "v,x,x,2\n");
  json a = scale(results + " --winner w --loser l --n n --samples 0").at("sections").at(0);
  json b =
      scale(shown + " --first left --second right --chosen choice --n n --samples 0").at("sections").at(0);
  // Shown first and chosen: 3 + 2 + 1's none + ... = u,v,u 3; v,u,v 2; v,x,v 2 of 15.
  EXPECT_EQ(b.at("first_chosen"), 7);
  EXPECT_EQ(b.at("first_judged"), 15);
  EXPECT_EQ(a.at("items"), b.at("items"));
  EXPECT_EQ(a.at("steps"), b.at("steps"));
}

TEST_F(ScaleProgram, BootstrapOverSubjectsSeesThatTheyDiffer) {
  // Ten subjects who all say the same of each pair twenty times, or who differ strongly: the same counts, and
  // so the same error, in both tables.
  std::string alike = "who,w,l,n\n", apart = alike;
  for (int i = 0; i < 10; ++i) {
    const std::string who = "s" + std::to_string(i) + ",";
    alike += who + "u,v,12\n" + who + "v,u,8\n";
    apart += who + (i < 6 ? "u,v,20\n" : "v,u,20\n");
  }
  const auto value = [&](const std::string& name, const std::string& table) {
    return scale(write(name, table) + " --winner w --loser l --n n --subject who --reference v")
        .at("sections")[0]
        .at("items")[0];
  };
  const json same = value("alike.csv", alike), differ = value("apart.csv", apart);
  EXPECT_EQ(same.at("item"), "u");
  expectNear(same.at("estimate"), std::log(12.0 / 8.0), 1e-9);
  EXPECT_EQ(same.at("low"), differ.at("low"));
  EXPECT_EQ(same.at("high"), differ.at("high"));
  expectNear(same.at("bootstrap_low"), std::log(1.5), 1e-9);
  expectNear(same.at("bootstrap_high"), std::log(1.5), 1e-9);
  // Of ten draws with chance 0.6, 3 or fewer have probability 0.055 and 2 or fewer 0.012; 9 or more 0.046,
  // all ten 0.006: the quantiles are the logits of 3 and of 9 in ten.
  expectNear(differ.at("bootstrap_low"), std::log(3.0 / 7.0), 1e-6);
  expectNear(differ.at("bootstrap_high"), std::log(9.0), 1e-6);
}

TEST_F(ScaleProgram, CountsCircularTriads) {
  // u over v over w over u, and x below all: one circular triad, of at most two with four items (zeta 1/2).
  // The other subject goes round nowhere; the third left a pair out.
  const std::string file = write("t.csv",
                                 "who,w,l\na,u,v\na,v,w\na,w,u\na,u,x\na,v,x\na,w,x\n"
                                 "b,u,v\nb,u,w\nb,u,x\nb,v,w\nb,v,x\nb,x,w\nc,u,v\nc,x,u\n");
  const json group = scale(file + " --winner w --loser l --subject who").at("sections")[0];
  const json& out = group.at("consistency");
  ASSERT_EQ(out.size(), 3U);
  EXPECT_EQ(out[0].at("circular_triads"), 1.0);
  EXPECT_EQ(out[0].at("consistency"), 0.5);
  EXPECT_EQ(out[1].at("circular_triads"), 0.0);
  EXPECT_EQ(out[1].at("consistency"), 1.0);
  EXPECT_EQ(out[2].at("rounds"), 0);
  EXPECT_TRUE(out[2].at("consistency").is_null());
}

TEST_F(ScaleProgram, GroupsHaveAScaleEach) {
  const std::string file = write("g.csv", "scene,w,l,n\n1,u,v,3\n1,v,u,1\n2,u,v,1\n2,v,u,3\n");
  const json groups = scale(file + " --winner w --loser l --n n --by scene").at("sections");
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].at("group"), "scene=1");
  EXPECT_EQ(groups[0].at("items")[0].at("item"), "u");
  EXPECT_EQ(groups[1].at("items")[0].at("item"), "v");
  // Two items: the difference is the logit of the share.
  expectNear(groups[1].at("steps")[0].at("estimate"), std::log(3.0), 1e-9);
  EXPECT_TRUE(groups[0].at("deviance_p").is_null()) << "as many values as pairs";
}

TEST_F(ScaleProgram, RefusesWhatIsWrongAndNamesItems) {
  const std::string file = write("pairs.csv", kPairs);
  expectRefused(file + " --winner wom --loser lost", {"pairs.csv", "no column 'wom'", "--winner"});
  expectRefused(file + " --winner won", {"--winner, --loser"});
  expectRefused(file, {"--winner", "--first"});
  expectRefused(file + " --winner won --loser lost --first won", {"two ways"});
  expectRefused(file + kColumns + "--reference t", {"--reference", "no item 't'"});
  expectRefused(file + kColumns + "--model elo", {"--model"});
  expectRefused(file + kColumns + "--prior-sd 0", {"--prior-sd"});
  expectRefused(file + kColumns + "--samples 3", {"--samples"});
  expectRefused(file + kColumns + "--confidence 1", {"--confidence"});
  expectRefused(file + kColumns + "--unfinished", {"--unfinished"});
  const std::string counts = " --winner w --loser l --n n";
  expectRefused(write("self.csv", "w,l,n\nu,v,1\nu,u,1\n") + counts,
                {"self.csv:3, column 'l'", "'u'", "itself"});
  expectRefused(write("minus.csv", "w,l,n\nu,v,-1\n") + counts, {"minus.csv:2, column 'n'", "negative"});
  expectRefused(write("half.csv", "w,l,n\nu,v,1.5\n") + counts, {"half.csv:2, column 'n'", "whole"});
  expectRefused(write("gap.csv", "w,l,n\nu,,1\n") + counts, {"gap.csv:2, column 'l'", "is empty"});
  expectRefused(write("third.csv", "a,b,c\nu,v,w\n") + " --first a --second b --chosen c",
                {"third.csv:2, column 'c'", "'w' is neither 'u' nor 'v'"});
  expectRefused(write("parts.csv", "w,l,n\nu,v,1\nv,u,1\nx,y,1\ny,x,1\n") + counts,
                {"'u'", "'x'", "not connected"});
  const std::string always = write("always.csv", "w,l,n\nu,v,5\nv,x,3\nx,v,2\n");
  expectRefused(always + counts, {"'u'", "infinitely far", "penalised"});
  const json held = scale(always + counts + " --unbounded penalise --samples 0").at("sections")[0];
  EXPECT_EQ(held.at("penalised"), true);
  EXPECT_THAT(held.at("note").get<std::string>(), HasSubstr("standard deviation 2"));
  EXPECT_TRUE(held.at("steps")[0].at("p").is_null()) << "it would depend on the penalty";
}

TEST_F(ScaleProgram, WritesTablesAndPictures) {
  const std::string file = write("pairs.csv", kPairs), csv = folder_.path("out.csv");
  const ProgramRun run = runProgram("limen-analyse scale " + file + kColumns + "--csv " + csv + " --plot " +
                                    folder_.path("scale.pdf"));
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text,
              testing::ContainsRegex("pairs judged +6\n +deviance +1.855\n +Pearson's X² +1.791\n +df +3"));
  std::ifstream stream(csv);
  const std::string table{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(table, HasSubstr("table,group,item,chosen,judged,estimate,low,high,"));
  EXPECT_THAT(table, HasSubstr(",r,s,"));
  EXPECT_GT(std::filesystem::file_size(folder_.path("scale.pdf")), 1000U);
}

}  // namespace
}  // namespace limen::analysis
