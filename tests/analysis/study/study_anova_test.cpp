// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "analysis/statistics/distributions.h"
#include "analysis/study/analyses.h"
#include "tests/analysis/study/hand_made.h"
#include "tests/analysis/synthetic_store.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;

TEST(StudyAnova, TableByHand) {
  // Rates of three observers at three distances, two trials each:
  //   1, 1/2, 0;  1, 1, 0;  1/2, 1/2, 1/2. Grand mean 5/9, means of distances 5/6, 2/3, 1/6, of observers
  //   1/2, 2/3, 1/2.
  // SS: distance 3 (25 + 4 + 49) / 324 = 13/18; observers 1/18; total 11/9; error 4/9.
  // F = (13/36) / (1/9) = 3.25 with 2 and 4 degrees; P(F_2,4 > f) = (4 / (4 + 2 f))^2 = (8/21)^2.
  const TemporaryFolder folder;
  const std::string store = folder.path("s.sqlite"),
                    protocol = "task: {type: yes_no}\nfactors:\n  distance: [a, b, c]\n";
  const int yes[3][3] = {{2, 1, 0}, {2, 2, 0}, {1, 1, 1}};
  for (int observer = 0; observer < 3; ++observer) {
    std::vector<HandMadeTrial> own = trials({{"distance", "a"}}, 2, 2, false);  // catch trials play no part
    for (int level = 0; level < 3; ++level)
      own = own +
            trials({{"distance", std::string(1, static_cast<char>('a' + level))}}, yes[observer][level], 2);
    addHandMadeSession(store, "p" + std::to_string(observer), protocol, own);
  }
  // Misses a distance, and so cannot take part.
  addHandMadeSession(store, "p3", protocol,
                     trials({{"distance", "a"}}, 1, 2) + trials({{"distance", "b"}}, 1, 2));
  StudyChoice choice;
  choice.codes = true;
  choice.store = store;
  const std::vector<PartAnova> parts = studyAnova(readStudyAnswers(choice));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_THAT(parts[0].incomplete, ElementsAre("p3"));
  ASSERT_TRUE(parts[0].result) << parts[0].note;
  EXPECT_EQ(parts[0].result->subjects, 3U);
  EXPECT_NEAR(parts[0].result->grandMean, 5.0 / 9.0, 1e-12);
  ASSERT_EQ(parts[0].result->effects.size(), 1U);
  const AnovaEffect& effect = parts[0].result->effects[0];
  EXPECT_EQ(effect.name, "distance");
  EXPECT_NEAR(*effect.f, 3.25, 1e-9);
  EXPECT_EQ(effect.df, 2);
  EXPECT_EQ(effect.dfError, 4);
  EXPECT_NEAR(*effect.p, 64.0 / 441.0, 1e-9);
  EXPECT_NEAR(*effect.partialEtaSquared, 13.0 / 21.0, 1e-9);
  EXPECT_FALSE(parts[0].published[0]);
}

TEST(StudyAnova, PublishedValuesAgreeWithOneAnother) {
  const auto p = [](const PublishedEffect& e) { return fUpper(e.f, e.df, e.dfError); };
  const auto both = publishedEffect("experiment_1", "main", {"switch_distance", "lod_change"});
  ASSERT_TRUE(both);
  EXPECT_NEAR(p(*both), 0.012, 0.0005);
  EXPECT_LT(p(*publishedEffect("experiment_1", "main", {"lod_change"})), 1e-4);
  EXPECT_LT(p(*publishedEffect("experiment_1", "main", {"switch_distance"})), 1e-4);
  EXPECT_LT(p(*publishedEffect("experiment_1", "main", {"presentation"})), 1e-3);
  EXPECT_NEAR(p(*publishedEffect("experiment_2", "object", {"presentation"})), 0.041, 0.0005);
  EXPECT_LT(p(*publishedEffect("experiment_2", "object", {"scenario"})), 1e-4);
  EXPECT_NEAR(p(*publishedEffect("experiment_2", "terrain", {"scenario"})), 0.170, 0.002);
  // The one that does not, and says so.
  const auto odd = publishedEffect("experiment_2", "terrain", {"presentation"});
  EXPECT_GT(p(*odd), 0.04);
  EXPECT_EQ(odd->p, "0.004");
  EXPECT_FALSE(odd->remark.empty());
  EXPECT_FALSE(publishedEffect("experiment_1", "main", {"lod_change", "presentation"}));
}

}  // namespace
}  // namespace limen::analysis
