// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/pair_scales/pair_table.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

TEST(CircularTriads, CountedOneByOneInAllTournaments) {
  for (int items = 3; items <= 5; ++items) {
    const int pairs = items * (items - 1) / 2;
    int64_t most = 0, sum = 0;
    for (int way = 0; way < 1 << pairs; ++way) {
      // over[i][j]: i was chosen over j.
      bool over[5][5] = {};
      std::vector<int64_t> chosen(static_cast<size_t>(items));
      for (int i = 0, pair = 0; i < items; ++i)
        for (int j = i + 1; j < items; ++j, ++pair) {
          over[i][j] = way >> pair & 1;
          over[j][i] = !over[i][j];
          ++chosen[static_cast<size_t>(over[i][j] ? i : j)];
        }
      int64_t triads = 0;
      for (int a = 0; a < items; ++a)
        for (int b = a + 1; b < items; ++b)
          for (int c = b + 1; c < items; ++c)
            triads += over[a][b] == over[b][c] && over[b][c] == over[c][a] ? 1 : 0;
      EXPECT_EQ(circularTriads(chosen), triads);
      most = std::max(most, triads);
      sum += triads;
    }
    EXPECT_EQ(mostCircularTriads(items), most) << items;
    EXPECT_DOUBLE_EQ(expectedCircularTriads(items), static_cast<double>(sum) / (1 << pairs)) << items;
  }
  EXPECT_THROW(circularTriads({3, 0, 0}), Error);
  EXPECT_THROW(circularTriads({1, 1, 0}), Error);
}

TEST(ClusterBootstrap, MeanOfClusterSumsHasItsBinomialQuantiles) {
  // 20 clusters, 8 of them 1 and the others 0: a resample's share is binomial(20, 0.4) / 20, whose 2.5 %
  // and 97.5 % quantiles are 4 and 12 of 20 (cumulative 0.016 below 4 and 0.051 at it; 0.979 at 12 and 0.943
  // below).
  std::vector<size_t> clusters;
  std::vector<double> values;
  for (size_t i = 0; i < 20; ++i)
    for (int k = 0; k < 3; ++k) {
      clusters.push_back(i);
      values.push_back(i < 8 ? 1.0 : 0.0);
    }
  const auto mean = [&](const std::vector<size_t>& rows) -> std::vector<std::optional<double>> {
    double sum = 0.0;
    for (const size_t row : rows) sum += values[row];
    const double share = sum / static_cast<double>(rows.size());
    return {share, share > 0.4 ? std::optional<double>(share) : std::nullopt};
  };
  const auto found = resampleClusters(clusters, 2, mean, {40000, 3, 0.95});
  ASSERT_TRUE(found[0].interval);
  EXPECT_NEAR(found[0].interval->low, 4.0 / 20.0, 1e-12);
  EXPECT_NEAR(found[0].interval->high, 12.0 / 20.0, 1e-12);
  EXPECT_EQ(found[0].undefined, 0U);
  // P(more than 8 of 20) = 0.404: mostly undefined, so no interval. 5 standard errors of 40,000 samples are
  // 0.013.
  EXPECT_FALSE(found[1].interval);
  EXPECT_NEAR(static_cast<double>(found[1].undefined) / 40000.0, 0.596, 0.013);

  EXPECT_FALSE(resampleClusters({0, 1, 1}, 2, mean, {40000, 3, 0.95})[0].interval) << "two clusters";
}

}  // namespace
}  // namespace limen::analysis
