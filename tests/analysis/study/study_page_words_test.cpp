// SPDX-License-Identifier: BSD-3-Clause
// What the page of a study made by hand says of it.
#include <gmock/gmock.h>

#include "tests/analysis/study/study_page_fixture.h"

namespace limen::analysis {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST_F(StudyPageTest, SaysWhatTheDataAreAndWhatWasLeftOut) {
  addStudy();
  const std::string page = write();
  EXPECT_THAT(page, Not(HasSubstr("imulated observer")));
  EXPECT_THAT(page, HasSubstr("catch_rate_above"));
  EXPECT_THAT(page, HasSubstr("guesser</th><td>catch_rate_above</td><td class=\"num\">36</td><td>yes in 12 "
                              "of 12 catch trials</td>"));
  EXPECT_THAT(page, HasSubstr("<td>reaction_time_below_s</td><td class=\"num\">1</td>"));
  EXPECT_THAT(page, HasSubstr("<td>no</td><td class=\"num\">–</td><td class=\"num\">–</td><td>this program "
                              "does not know it</td>"));
  // Nothing excluded: five observers, the guesser's rates among them.
  const Moments own = momentsOf(ratesOf([](const AnswerRow& row) { return !row.change; }));
  const double all = (4.0 * own.mean + 1.0) / 5.0;
  EXPECT_THAT(page, HasSubstr("<td class=\"num\">5</td><td class=\"num\">" + percent(all)));
  EXPECT_THAT(page, HasSubstr("2026-01-31"));
  EXPECT_THAT(page, Not(HasSubstr("12:00"))) << "no time of day";

  StudyPageOptions everything = options();
  everything.choice.exclusions = false;
  const std::string other = readFileBytes(writeStudyPages(everything).at(0).page);
  EXPECT_THAT(other, HasSubstr("exclusion rules are not applied"));
  EXPECT_THAT(other, HasSubstr("<td>--no-exclusions</td>"));
}

TEST_F(StudyPageTest, SimulatedObserversAreNoPeople) {
  addStudy({{"simulated", true}, {"observer", {{"kind", "lapsing"}}}});
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("They say nothing about people."));
  EXPECT_THAT(page, HasSubstr("5 simulated observers (kind: lapsing), not of people"));
  EXPECT_TRUE(results_[0].simulated);
  EXPECT_THAT(page, Not(HasSubstr("2026-01-31"))) << "their clock is not the world's";
  EXPECT_THAT(page, Not(HasSubstr("took part")));
}

TEST_F(StudyPageTest, MethodsHoldWhatIsStored) {
  addStudy(
      {{"gpu", "Card X"}, {"opengl", "4.6"}, {"lab_ready", false}, {"lab_doubts", {"a timer paces <it>"}}});
  const std::string page = write();
  const std::string methods = file("methods.txt");
  // 600 mm away, 0.254 mm a pixel: 2 x 600 x tan(0.5 deg) / 0.254 = 41.23 pixels.
  for (const char* words :
       {"5 observers took part, in 5 sessions.",
        "“Your age” was not recorded.",
        "1600 × 1200 pixels",
        "40.6 cm × 30.5 cm",
        "60 Hz",
        "41.2 pixels per degree",
        "0.5 to 250 cd/m²",
        "How its profile was measured was not recorded.",
        "window of 1024 × 768 pixels",
        "rendered by gpu, OpenGL 4.6",
        "In 5 of 5 sessions",
        "distance (3 levels) and presentation (2 levels)",
        "asked “Seen a <change>?”",
        "“yes” and “no”",
        "After a yes they graded severity in 3 steps",
        "36 to 37 answers",
        "4 to 5 with a change in each of 6 conditions",
        "2 without one",
        "shuffled for each session, within blocks by presentation, in the order dynamic, static",
        "0 to 1 practice trials",
        "with feedback",
        "1 showing was disturbed",
        "more than 25.0 % of their trials without a change (1 observer, 36 answers)",
        "less than 0.15 s after the question (1 answer)",
        "what the rule blinks_above (7) names was declared and not applied (this program does not know it)",
        "144 answers of 4 observers remain.",
        "Greenhouse and Geisser",
        "after Holm",
        "Hautus 1995",
        "Ceres ",
        "Boost ",
        "SQLite "})
    EXPECT_THAT(methods, HasSubstr(words));
  EXPECT_THAT(page, HasSubstr("5 of 5 sessions began although the machine&#39;s timing was not ready for a "
                              "laboratory: a timer paces &lt;it&gt;."));
}

TEST_F(StudyPageTest, HostileTextsStayTexts) {
  addStudy();
  addPredictions();
  const std::string page = write();
  EXPECT_THAT(page, HasSubstr("<h1>&lt;b&gt;&quot;O&#39;Neil&quot; &amp; co&lt;/b&gt;</h1>"));
  for (const char* raw : {"<b>\"", "<i>this", "<change>", "<u>so", "a<b>", "<much>"})
    EXPECT_THAT(page, Not(HasSubstr(raw)));
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&amp;&quot;c"));
  // In a figure, gnuplot writes the participant's code into XML.
  EXPECT_THAT(file("figures/d_prime_main.svg"), HasSubstr("<text>a&lt;b>&amp;\"c</text>"));
}

}  // namespace
}  // namespace limen::analysis
