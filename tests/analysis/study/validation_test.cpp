// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/validation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/analysis/statistics/expect.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using nlohmann::json;

TEST(StudyScores, TableTenPointOne) {
  // Schwarz 2009, Table 10.1, column by column: tiny, small, large, huge; very low to very high.
  const std::vector<std::vector<int>> columns = {{1, 1, 2, 3}, {1, 2, 3, 3}, {2, 3, 4, 5}, {2, 3, 5, 5}};
  for (int coverage = 1; coverage <= 4; ++coverage)
    for (int rating = 1; rating <= 4; ++rating)
      EXPECT_EQ(detectionScore(rating, coverage),
                columns[static_cast<size_t>(coverage - 1)][static_cast<size_t>(rating - 1)])
          << rating << " " << coverage;
}

TEST(StudyScores, LevelsBeginAtTheirEdges) {
  EXPECT_EQ(coverageLevel(0.0), 1);
  EXPECT_EQ(coverageLevel(0.0099), 1);
  EXPECT_EQ(coverageLevel(0.01), 2);
  EXPECT_EQ(coverageLevel(0.05), 3);
  EXPECT_EQ(coverageLevel(0.2), 4);
  EXPECT_EQ(ratingLevel(-1.4), 1);
  EXPECT_EQ(ratingLevel(1.0), 2);
  EXPECT_EQ(ratingLevel(2.999), 3);
  EXPECT_EQ(ratingLevel(3.0), 4);
  EXPECT_EQ(ratingLevel(1.2, {{0.1, 0.2, 0.3}, {0.0, 0.5, 1.5}, 1}), 3);
  expectError([] { checkScoreBins({{0.1, 0.1, 0.3}, {1, 2, 3}, 1}); }, "--coverage-edges");
  expectError([] { checkScoreBins({{0.1, 0.2, 0.3}, {1, 2, 3}, 0}); }, "--top-regions");
}

TEST(StudyScores, MeanOfTheMostHighlyRated) {
  EXPECT_DOUBLE_EQ(ratingScore({1.0, 4.0, 2.0, 3.0}, 0.0, 3), 3.0);
  EXPECT_DOUBLE_EQ(ratingScore({1.0, 4.0}, 0.0, 3), 2.5);
  EXPECT_DOUBLE_EQ(ratingScore({}, -1.5, 3), -1.5);
  const auto values = predictorValues(json::parse(
      R"({"rating": 4, "regions": [{"rating": 4}, {"rating": 2}], "coverage_of_object": 0.03, "ssim": 0.75})"));
  EXPECT_EQ(values.at("rating_score"), 3.0);
  EXPECT_EQ(values.at("rating_level"), 4.0);    // very high
  EXPECT_EQ(values.at("coverage_score"), 2.0);  // small
  EXPECT_EQ(values.at("detection_score"), 3.0);
  EXPECT_EQ(values.at("one_minus_ssim"), 0.25);
  EXPECT_EQ(values.at("region_count"), 2.0);
  EXPECT_EQ(values.count("flip"), 0U);
}

TEST(StudyScores, AreOfWhatTheCueAskedAbout) {
  // The only region at the cue is rated 2, those away from it 4 and 3.
  const json cued = json::parse(
      R"({"rating": 2, "rest_rating": 4, "coverage_of_object": 0.03, "regions": [{"rating": 4, "at_cue": false},
          {"rating": 3, "at_cue": false}, {"rating": 2, "at_cue": true}]})");
  const auto values = predictorValues(cued);
  EXPECT_EQ(values.at("rating"), 2.0);
  EXPECT_EQ(values.at("rest_rating"), 4.0);
  EXPECT_EQ(values.at("rating_score"), 2.0);
  EXPECT_EQ(values.at("region_count"), 3.0);
  // Predictions of before say nothing of cues: all their regions count.
  json older = cued;
  for (json& region : older["regions"]) region.erase("at_cue");
  older.erase("rest_rating");
  EXPECT_EQ(predictorValues(older).at("rating_score"), 3.0);
  EXPECT_EQ(predictorValues(older).count("rest_rating"), 0U);
}

TEST(PoppingLink, IsTheHighestPointOfALongRidge) {
  // Answers that hardly depend on the rating: midpoint, scale and lapse rate trade against one another.
  std::vector<LinkPoint> points;
  for (int i = 0; i < 28; ++i) points.push_back({-1.0 + 0.15 * i, 6 + i / 5 + i * 7 % 5 - 2, 24});
  const auto link = fitLink(points, {0.049, {}});
  ASSERT_TRUE(link);
  const auto logLikelihood = [&](const Link& at) {
    double sum = 0.0;
    for (const LinkPoint& point : points) {
      const double p = at.probability(point.rating);
      sum += static_cast<double>(point.yes) * std::log(p) +
             static_cast<double>(point.trials - point.yes) * std::log(1.0 - p);
    }
    return sum;
  };
  EXPECT_NEAR(logLikelihood(*link), link->logLikelihood, 1e-9);
  for (const double size : {0.001, 0.01, 0.1})
    for (int way = 0; way < 27; ++way) {
      Link near = *link;
      near.midpointR += size * (way % 3 - 1);
      near.scaleR *= std::exp(size * (way / 3 % 3 - 1));
      near.lapse = std::clamp(near.lapse + 0.1 * size * (way / 9 - 1), 0.0, 0.2);
      EXPECT_LE(logLikelihood(near), link->logLikelihood + 1e-6) << size << " " << way;
    }
}

TEST(PoppingLink, TwoRatingsInClosedForm) {
  // 1/5 at R = 1, 4/5 at R = 3: logits -+ln 4, so m = 2 and s = 1 / ln 4.
  const auto link = fitLink({{1.0, 20, 100}, {3.0, 80, 100}}, {0.0, 0.0});
  ASSERT_TRUE(link);
  EXPECT_NEAR(link->midpointR, 2.0, 1e-6);
  EXPECT_NEAR(link->scaleR, 1.0 / std::log(4.0), 1e-6);
  EXPECT_NEAR(link->logLikelihood, 2.0 * (20.0 * std::log(0.2) + 80.0 * std::log(0.8)), 1e-9);
  EXPECT_TRUE(link->note.empty()) << link->note;
}

TEST(PoppingLink, FindsWhatMadeTheAnswers) {
  Link truth;
  truth.guess = 0.06, truth.lapse = 0.03, truth.midpointR = 1.7, truth.scaleR = 0.4;
  std::vector<LinkPoint> points = {{-std::numeric_limits<double>::infinity(), 60'000, 1'000'000}};
  for (double rating = 0.0; rating < 4.1; rating += 0.25)
    points.push_back({rating, std::llround(1e6 * truth.probability(rating)), 1'000'000});
  const auto link = fitLink(points, {});
  ASSERT_TRUE(link);
  EXPECT_NEAR(link->guess, truth.guess, 1e-4);
  EXPECT_NEAR(link->lapse, truth.lapse, 1e-4);
  EXPECT_NEAR(link->midpointR, truth.midpointR, 1e-4);
  EXPECT_NEAR(link->scaleR, truth.scaleR, 1e-4);
  // Counts without noise: each is told by the others.
  const auto left = leaveOneOut(points, {});
  ASSERT_TRUE(left);
  ASSERT_EQ(left->size(), points.size() - 1);
  for (size_t i = 0; i < left->size(); ++i)
    EXPECT_NEAR((*left)[i], truth.probability(points[i + 1].rating), 1e-3);
}

TEST(PoppingLink, SaysWhatItCannotTell) {
  EXPECT_FALSE(fitLink({{1.0, 2, 4}, {1.0, 3, 4}}, {0.0, 0.0}));
  EXPECT_FALSE(fitLink({{1.0, 4, 4}, {2.0, 4, 4}}, {0.0, 0.0}));
  const auto parted = fitLink({{1.0, 0, 9}, {2.0, 9, 9}}, {0.0, 0.0});
  ASSERT_TRUE(parted);
  EXPECT_FALSE(parted->note.empty());
}

TEST(PoppingLink, ErrorsByHand) {
  const LinkError error = linkError({{1.0, 3, 4}, {2.0, 1, 4}}, {0.5, 0.5});
  EXPECT_NEAR(error.logLoss, std::log(2.0), 1e-12);
  EXPECT_NEAR(error.brier, 0.25, 1e-12);
  EXPECT_NEAR(error.rmsRate, 0.25, 1e-12);
  EXPECT_EQ(linkError({{1.0, 4, 4}}, {1.0}).logLoss, 0.0);
  EXPECT_TRUE(std::isinf(linkError({{1.0, 3, 4}}, {1.0}).logLoss));
}

// Three observers answer to R = 1 and 3. Of the 27 equally likely samples one is of the first alone and one
// of the last alone, and these have the least and the largest midpoint; as each has a share of 1/27 > 0.025,
// the interval runs from one to the other. Midpoint and scale follow from the two logits.
TEST(PoppingLink, IntervalsAreOverObservers) {
  const int yes[3][2] = {{4, 18}, {6, 14}, {2, 12}};
  const auto logit = [](double p) { return std::log(p / (1.0 - p)); };
  const auto midpoint = [&](int a, int b, int c) {
    double low = 0.0, high = 0.0;
    for (const int i : {a, b, c}) low += yes[i][0] / 60.0, high += yes[i][1] / 60.0;
    return 1.0 - logit(low) * 2.0 / (logit(high) - logit(low));
  };
  LinkData data{{1.0, 3.0}, {0.5, 0.5}, {{}, {}}, {}};
  for (size_t observer = 0; observer < 3; ++observer)
    for (size_t scenario = 0; scenario < 2; ++scenario)
      data.answers[scenario][observer] = {yes[observer][scenario], 20};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(midpoint(a, b, c), midpoint(0, 0, 0) - 1e-12);
        ASSERT_LE(midpoint(a, b, c), midpoint(2, 2, 2) + 1e-12);
      }
  LinkReportSetting setting{{0.0, 0.0}, false, 2000, 1};
  const LinkReport report = linkReport(data, setting, 3);
  EXPECT_NEAR(report.refit->midpointR, midpoint(0, 1, 2), 1e-6);
  ASSERT_TRUE(report.intervals && report.intervals->midpointR);
  EXPECT_NEAR(report.intervals->midpointR->low, midpoint(0, 0, 0), 1e-6);
  EXPECT_NEAR(report.intervals->midpointR->high, midpoint(2, 2, 2), 1e-6);
  EXPECT_FALSE(report.intervals->guess);  // held
  EXPECT_FALSE(report.refitError);        // one rating is left
  // Everybody at 1/2 costs (1/2)^2 in every sample.
  EXPECT_DOUBLE_EQ(report.intervals->asPredicted.brier->low, 0.25);
  EXPECT_DOUBLE_EQ(report.intervals->asPredicted.brier->high, 0.25);
  EXPECT_EQ(report.intervals->fitted, 2000U);

  // One observer is no sample of observers; none asked for, none given.
  LinkData single = data;
  for (ObserverCounts& counts : single.answers) counts.erase(1), counts.erase(2);
  EXPECT_FALSE(linkReport(single, setting, 1).intervals);
  setting.samples = 0;
  EXPECT_FALSE(linkReport(data, setting, 3).intervals);
}

// Observers who answer alike make every sample the same; the guess rate is each sample's own.
TEST(PoppingLink, ObserversAlikeLeaveNothingOpen) {
  LinkData data{{0.0, 1.0, 2.0, 3.0}, {0.1, 0.3, 0.6, 0.9}, {{}, {}, {}, {}}, {}};
  const int yes[] = {3, 8, 15, 19};
  for (size_t observer = 0; observer < 4; ++observer) {
    for (size_t scenario = 0; scenario < 4; ++scenario)
      data.answers[scenario][observer] = {yes[scenario], 20};
    data.catches[observer] = {1, 10};
  }
  const LinkReport report = linkReport(data, {{std::nullopt, 0.0}, false, 50, 1}, 4);
  ASSERT_TRUE(report.refit && report.refitError && report.intervals);
  EXPECT_DOUBLE_EQ(report.refit->guess, 0.1);
  EXPECT_DOUBLE_EQ(report.intervals->guess->low, 0.1);
  EXPECT_NEAR(report.intervals->scaleR->low, report.refit->scaleR, 1e-12);
  EXPECT_NEAR(report.intervals->scaleR->high, report.refit->scaleR, 1e-12);
  EXPECT_NEAR(report.intervals->refitError.rmsRate->high, report.refitError->rmsRate, 1e-12);
  // One of them is a guesser in catch trials: samples have 0 to 4 of that one.
  data.catches[3] = {5, 10};
  const LinkReport other = linkReport(data, {{std::nullopt, 0.0}, false, 400, 1}, 4);
  EXPECT_DOUBLE_EQ(other.guessFromCatch, 0.2);
  EXPECT_DOUBLE_EQ(other.intervals->guess->low, 0.1);   // P(not drawn) = (3/4)^4 = 0.32
  EXPECT_DOUBLE_EQ(other.intervals->guess->high, 0.4);  // P(three or four) = 13/256, P(four) = 1/256
}

class ValidationTest : public testing::Test {
 protected:
  std::string store() const { return folder_.path("s.sqlite"); }
  StudyValidation validate(const ValidationSetting& setting = {}) const {
    StudyChoice choice;
    choice.store = store();
    return validateStudy(readStudyAnswers(choice), store::readPredictions(store()),
                         {{"display_hash", "desk"}, {"other_hash", "beamer"}}, setting);
  }
  static const Agreement& agreement(const PartValidation& part, const std::string& predictor,
                                    const std::string& set = "all") {
    for (const Agreement& one : part.agreements)
      if (one.predictor == predictor && one.set == set) return one;
    throw std::runtime_error("no agreement " + predictor);
  }
  TemporaryFolder folder_;
};

TEST_F(ValidationTest, TrialsByHand) {
  // Scenario a: predicted 1/2, rating 1, noticed once in two; b: 3/4, rating 2, twice in two.
  const std::string protocol = "task: {type: yes_no}\nfactors:\n  s: [a, b]\n";
  std::vector<HandMadeTrial> a = trials({{"s", "a"}}, 1, 2), b = trials({{"s", "b"}}, 2, 2);
  a[0].severity = 3;
  b[0].severity = 1;
  b[1].severity = 2;
  addHandMadeSession(store(), "p", protocol, a + b + trials({{"s", "a"}}, 1, 4, false));
  const auto figures = [](double rating, double probability, double de94) {
    return json{{"rating", rating},
                {"detection_probability", probability},
                {"regions", {{{"rating", rating}}}},
                {"coverage_of_object", 0.1},
                {"max_de94", de94}};
  };
  addHandMadePrediction(store(), handMadeHash(a[0]), figures(9.0, 0.9, 0.0), "0");  // older: not taken
  addHandMadePrediction(store(), handMadeHash(a[0]), figures(1.0, 0.5, 7.0));
  addHandMadePrediction(store(), handMadeHash(b[0]), figures(2.0, 0.75, 3.0));

  const StudyValidation validation = validate();
  ASSERT_EQ(validation.parts.size(), 1U);
  EXPECT_EQ(validation.programVersion, "1");
  const PartValidation& part = validation.parts[0];
  ASSERT_EQ(part.scenarios.size(), 2U);
  EXPECT_EQ(part.scenarios[0].meanSeverity, 3.0);
  EXPECT_EQ(part.scenarios[1].meanSeverity, 1.5);
  // Yes at 1, 2, 2, no at 1: (1/2 + 1 + 1) / 3. For dE94 yes at 7, 3, 3, no at 7: (1/2 + 0 + 0) / 3.
  for (const TrialArea& area : part.areas) {
    if (area.predictor == "rating") {
      EXPECT_NEAR(area.area.area, 5.0 / 6.0, 1e-12);
    }
    if (area.predictor == "max_de94") {
      EXPECT_NEAR(area.area.area, 1.0 / 6.0, 1e-12);
      EXPECT_NEAR(area.againstRating->difference, -2.0 / 3.0, 1e-12);
    }
  }
  ASSERT_TRUE(part.calibration);
  EXPECT_NEAR(part.calibration->brier, (0.25 + 0.25 + 0.0625 + 0.0625) / 4.0, 1e-12);
  EXPECT_NEAR(part.link.asPredicted->brier, part.calibration->brier, 1e-12);
  EXPECT_NEAR(part.link.asPredicted->rmsRate, std::sqrt(0.0625 / 2.0), 1e-12);
  EXPECT_DOUBLE_EQ(part.link.guessFromCatch, 0.25);
  // The other scenario's rate: 1 for a, 1/2 for b.
  EXPECT_NEAR(part.link.constant->rmsRate, 0.5, 1e-12);
  ASSERT_EQ(part.severity.size(), 2U);  // rating_score and its level
  EXPECT_EQ(part.severity[0].scenarios, 2U);
  EXPECT_NEAR(part.severity[0].pearson->coefficient.value, -1.0, 1e-12);
}

TEST_F(ValidationTest, TestsAnybodysScores) {
  // Trials of TrialsByHand: a is noticed once in two, b twice in two.
  const std::string protocol = "task: {type: yes_no}\nfactors:\n  s: [a, b]\n";
  const std::vector<HandMadeTrial> a = trials({{"s", "a"}}, 1, 2), b = trials({{"s", "b"}}, 2, 2);
  addHandMadeSession(store(), "p", protocol, a + b);
  StudyChoice choice;
  choice.store = store();
  const StudyPlan plan = readStudyAnswers(choice).plan;
  const std::string clipA = store::clipName(handMadeHash(a[0]), "display_hash", plan.widthPx, plan.heightPx),
                    clipB = store::clipName(handMadeHash(b[0]), "display_hash", plan.widthPx, plan.heightPx);
  EXPECT_NE(clipA, clipB);
  const auto scores = [&](const std::string& text, const std::vector<std::string>& quality = {}) {
    std::ofstream(folder_.path("scores.csv")) << text;
    ValidationSetting setting;
    setting.scores = readClipScores(folder_.path("scores.csv"), quality);
    return validate(setting);
  };
  const std::string rows = "clip,mine,jod\n" + clipA + ",1,9\n" + clipB + ",2,8\nclip_0,5,5\n";
  // Without predictions the scores stand alone: both order a below b if the second is a quality.
  const PartValidation alone = scores(rows, {"jod"}).parts.at(0);
  ASSERT_EQ(alone.areas.size(), 2U);
  for (const TrialArea& area : alone.areas) {
    EXPECT_NEAR(area.area.area, 5.0 / 6.0, 1e-12);  // as for the rating there
    EXPECT_FALSE(area.againstRating);
  }
  ASSERT_EQ(alone.comparisons.size(), 1U);
  EXPECT_EQ(alone.comparisons[0].areas.difference, 0.0);

  const auto figures = [](double rating, double flip) { return json{{"rating", rating}, {"flip", flip}}; };
  addHandMadePrediction(store(), handMadeHash(a[0]), figures(1.0, 0.4));
  addHandMadePrediction(store(), handMadeHash(b[0]), figures(2.0, 0.3));
  const StudyValidation both = scores(rows);
  const PartValidation& part = both.parts.at(0);
  EXPECT_THAT(both.notes, testing::Contains(testing::HasSubstr("1 rows of the scores")));
  std::map<std::string, double> areas;
  for (const TrialArea& area : part.areas) areas[area.predictor] = area.area.area;
  EXPECT_NEAR(areas.at("mine"), 5.0 / 6.0, 1e-12);
  EXPECT_NEAR(areas.at("jod"), 1.0 / 6.0, 1e-12);  // taken as it is, it goes the wrong way
  EXPECT_EQ(part.comparisons.size(), 6U);          // rating, flip, mine, jod
  EXPECT_EQ(part.scenarios[0].predictors.at("mine"), 1.0);
  EXPECT_EQ(agreement(part, "mine").scenarios, 2U);
  // The same by stimulus.
  const std::string byStimulus =
      "stimulus_hash,mine\n" + handMadeHash(a[0]) + ",1\n" + handMadeHash(b[0]) + ",2\n";
  EXPECT_EQ(scores(byStimulus).parts.at(0).scenarios[1].predictors.at("mine"), 2.0);

  expectError([&] { scores("clip,mine\n" + clipA + ",1\n"); }, "1 of 2 clips with a change have no score");
  expectError([&] { scores("clip,mine\nclip_0,1\n"); }, "not those of this study");
  expectError([&] { scores("name,mine\n" + clipA + ",1\n"); }, "no columns that name clips");
  expectError([&] { scores("clip\n" + clipA + "\n"); }, "no column of scores");
  expectError([&] { scores("clip,mine\n" + clipA + ",good\n"); }, "mine");
  expectError([&] { scores("clip,mine\n" + clipA + ",1\n" + clipA + ",1\n"); }, "twice");
  expectError([&] { scores("clip,flip\n" + clipA + ",1\n"); }, "Limen's own predictors");
  expectError([&] { scores(rows, {"jnd"}); }, "no column 'jnd'");
}

TEST_F(ValidationTest, OrderAndClampAsInTheThesis) {
  // Eight scenarios, a score of four values, P - Q = 20: the thesis' tau_c of 0.833 for still objects (Table
  // 10.2). Of 28 pairs 4 are tied, 22 are in order, and two are not: rates fall from the fifth to the third
  // and fourth.
  const int score[8] = {1, 1, 2, 2, 3, 3, 4, 4}, yes[8] = {0, 1, 3, 4, 2, 8, 10, 9};
  std::vector<HandMadeTrial> all;
  for (int i = 0; i < 8; ++i)
    all = all + trials({{"s", std::string(1, static_cast<char>('a' + i))}}, yes[i], 10);
  addHandMadeSession(store(), "p", "task: {type: yes_no}\nfactors:\n  s: [a, b, c, d, e, f, g, h]\n", all);
  for (int i = 0; i < 8; ++i)
    addHandMadePrediction(store(), handMadeHash(all[static_cast<size_t>(10 * i)]),
                          {{"max_de94", score[i]}, {"flip", i == 7 ? 100.0 : yes[i] / 10.0}});
  const PartValidation part = validate().parts.at(0);
  const Agreement& order = agreement(part, "max_de94");
  EXPECT_EQ(order.kendall.concordant - order.kendall.discordant, 20);
  EXPECT_NEAR(order.kendall.tauC->value, 0.833, 0.0005);
  // All saw g, predicted 1; h is predicted 100 and lowered to 1, which leaves rates but one: yes/10 except h.
  const Agreement& clamped = agreement(part, "flip");
  EXPECT_EQ(clamped.clamped.clamp, 1.0);
  EXPECT_EQ(clamped.clamped.clamped, 1U);
  EXPECT_GT(clamped.clamped.correlation->coefficient.value, 0.99);
  EXPECT_LT(clamped.pearson->coefficient.value, 0.7);
}

TEST(PublishedAgreements, AreReachableByStuartsTauC) {
  // Each printed value is a fraction 2 m (P - Q) / (n^2 (m - 1)), rounded to three digits.
  struct Triple {
    const char *protocol, *part, *set, *predictor;
    bool severity;
    int n, m, difference;
  };
  const Triple triples[] = {{"experiment_1", "main", "static", "rating", false, 14, 8, 80},
                            {"experiment_1", "main", "static", "max_de94", false, 14, 8, 62},
                            {"experiment_1", "main", "dynamic", "rating", false, 14, 11, 72},
                            {"experiment_1", "main", "dynamic", "max_de94", false, 14, 11, 50},
                            {"experiment_1", "main", "both", "rating", false, 28, 13, 286},
                            {"experiment_1", "main", "both", "max_de94", false, 28, 13, 213},
                            {"experiment_2", "object", "static", "detection_score", false, 8, 4, 20},
                            {"experiment_2", "object", "dynamic", "detection_score", false, 8, 4, 22},
                            {"experiment_2", "object", "both", "detection_score", false, 16, 5, 85},
                            {"experiment_2", "object", "static", "coverage_score", false, 8, 4, 18},
                            {"experiment_2", "object", "dynamic", "coverage_score", false, 8, 4, 19},
                            {"experiment_2", "object", "both", "coverage_score", false, 16, 4, 72},
                            {"experiment_2", "object", "static", "rating_level", true, 8, 3, 20},
                            {"experiment_2", "object", "dynamic", "rating_level", true, 8, 3, 16},
                            {"experiment_2", "object", "both", "rating_level", true, 16, 4, 75},
                            {"experiment_2", "terrain", "dynamic", "coverage_score", false, 8, 3, 5},
                            {"experiment_2", "terrain", "dynamic", "rating_level", false, 8, 3, 16}};
  EXPECT_EQ(std::size(triples), publishedAgreements().size());
  for (const Triple& one : triples) {
    const auto published = publishedAgreement(one.protocol, one.part, one.set, one.predictor, one.severity);
    ASSERT_TRUE(published) << one.part << one.set << one.predictor;
    EXPECT_NEAR(stuartTauC(one.n, one.m, one.difference), published->tauC, 0.000501)
        << one.part << " " << one.set << " " << one.predictor;
  }
  EXPECT_FALSE(publishedAgreement("quick", "main", "static", "rating", false));
}

TEST_F(ValidationTest, StaticAndDynamicApart) {
  std::vector<HandMadeTrial> all;
  for (const char* kind : {"static", "dynamic"})
    for (const char* s : {"a", "b"}) {
      std::vector<HandMadeTrial> own = trials({{"s", s}, {"presentation", kind}}, *s == 'a' ? 1 : 2, 2);
      for (HandMadeTrial& trial : own) trial.presentation = kind;
      // Rightly ordered among still ones, wrongly among moving ones.
      addHandMadePrediction(store(), handMadeHash(own[0]),
                            {{"max_de94", (*s == 'a') == (*kind == 's') ? 1.0 : 2.0}});
      all = all + own;
    }
  addHandMadeSession(store(), "p",
                     "task: {type: yes_no}\nfactors:\n  s: [a, b]\n  presentation: [dynamic, static]\n", all);
  const PartValidation part = validate().parts.at(0);
  EXPECT_DOUBLE_EQ(agreement(part, "max_de94", "static").kendall.tauC->value, 1.0);
  EXPECT_DOUBLE_EQ(agreement(part, "max_de94", "dynamic").kendall.tauC->value, -1.0);
  EXPECT_DOUBLE_EQ(agreement(part, "max_de94", "both").kendall.tauC->value, 0.0);
}

TEST_F(ValidationTest, RefusesWhatIsNotThere) {
  const std::string protocol = "task: {type: yes_no}\nfactors:\n  s: [a, b]\n";
  const std::vector<HandMadeTrial> all = trials({{"s", "a"}}, 1, 2) + trials({{"s", "b"}}, 2, 2);
  addHandMadeSession(store(), "p", protocol, all);
  expectError([&] { validate(); }, "2 of 2 stimuli have no prediction");
  addHandMadePrediction(store(), handMadeHash(all[0]), {{"max_de94", 1}}, "1");
  // Made by another program: not to be mixed with the first.
  addHandMadePrediction(store(), handMadeHash(all[2]), {{"max_de94", 1}}, "2");
  expectError([&] { validate(); }, "1 of 2 stimuli have no prediction");
  ValidationSetting setting;
  setting.display = "beamr";
  expectError([&] { validate(setting); }, "beamer");
  setting.display = "beamer";
  expectError([&] { validate(setting); }, "2 of 2");
  setting = {};
  setting.settings = "ffff";
  expectError([&] { validate(setting); }, "--settings");
}

}  // namespace
}  // namespace limen::analysis
