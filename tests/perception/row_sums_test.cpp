// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/row_sums.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "perception/metrics/quantile.h"

namespace limen::perception {
namespace {

// A plain sum in double gives 0.
TEST(CompensatedSum, KeepsWhatCancellationWouldLose) {
  CompensatedSum sum;
  for (const double value : {1.0, 1e100, 1.0, -1e100}) sum.add(value);
  EXPECT_EQ(sum.value(), 2.0);
}

TEST(ForEachRow, VisitsEveryRowOnce) {
  for (const int rows : {0, 1, 7, 1000}) {
    std::vector<std::atomic<int>> visits(static_cast<size_t>(rows));
    forEachRow(rows, 100000, [&](int row) { ++visits[static_cast<size_t>(row)]; });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST(ForEachRow, HandsOnARowsException) {
  EXPECT_THROW(forEachRow(500, 100000,
                          [](int row) {
                            if (row == 77) throw std::runtime_error("row");
                          }),
               std::runtime_error);
}

TEST(SumRows, AddsInRowOrder) {
  EXPECT_EQ(sumRows(100, 1 << 20, [](int row) { return double(row); }), 4950.0);
  EXPECT_EQ(sumRows(0, 10, [](int) { return 1.0; }), 0.0);
}

TEST(NearestRank, TakesAnElementOfTheSet) {
  std::vector<double> values = {5.0, 1.0, 4.0, 2.0, 3.0};
  EXPECT_EQ(nearestRank(values, 0.4), 2.0);
  EXPECT_EQ(nearestRank(values, 0.41), 3.0);
  EXPECT_EQ(nearestRank(values, 1.0), 5.0);
  EXPECT_EQ(nearestRank(values, 0.0), 1.0);
  std::vector<double> none;
  EXPECT_EQ(nearestRank(none, 0.5), 0.0);
}

}  // namespace
}  // namespace limen::perception
