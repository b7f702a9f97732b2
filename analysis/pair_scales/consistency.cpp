// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/pair_scales/pair_table.h"

#include <fmt/format.h>

#include <optional>

#include <algorithm>
#include <map>
#include <numeric>

#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

/// How often each item was chosen, if every pair was judged exactly once.
std::optional<std::vector<int64_t>> completeRound(const std::vector<const PairJudgement*>& judgements,
                                                  size_t items) {
  std::vector<int64_t> seen(items * items), chosen(items);
  int64_t pairs = 0;
  for (const PairJudgement* one : judgements) {
    if (one->count == 0) continue;
    int64_t& times = seen[std::min(one->winner, one->loser) * items + std::max(one->winner, one->loser)];
    times += one->count;
    if (times > 1) return {};
    ++pairs;
    ++chosen[one->winner];
  }
  if (pairs != static_cast<int64_t>(items * (items - 1) / 2)) return {};
  return chosen;
}

}  // namespace

int64_t circularTriads(const std::vector<int64_t>& chosen) {
  const auto n = static_cast<int64_t>(chosen.size());
  int64_t squares = 0;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] < 0 || chosen[i] >= n)
      throw Error(fmt::format("{} choices of {} pairs", chosen[i], n - 1), fmt::format("chosen[{}]", i));
    squares += chosen[i] * chosen[i];
  }
  const int64_t sum = std::accumulate(chosen.begin(), chosen.end(), int64_t{0});
  if (sum != n * (n - 1) / 2)
    throw Error(fmt::format("{} choices, and {} items have {} pairs", sum, n, n * (n - 1) / 2), "chosen");
  return (n * (n - 1) * (2 * n - 1) - 6 * squares) / 12;
}

int64_t mostCircularTriads(int64_t items) {
  return (items * items * items - (items % 2 == 1 ? 1 : 4) * items) / 24;
}

double expectedCircularTriads(int64_t items) {
  const auto n = static_cast<double>(items);
  return n * (n - 1.0) * (n - 2.0) / 24.0;
}

std::vector<SubjectConsistency> subjectConsistencies(const PairGroup& group) {
  if (group.items.size() < 3) return {};
  std::vector<std::map<size_t, std::vector<const PairJudgement*>>> rounds(group.subjects.size());
  for (const PairJudgement& one : group.judgements)
    if (one.subject < rounds.size()) rounds[one.subject][one.round].push_back(&one);
  const auto most = static_cast<double>(mostCircularTriads(static_cast<int64_t>(group.items.size())));
  std::vector<SubjectConsistency> out;
  for (size_t i = 0; i < rounds.size(); ++i) {
    SubjectConsistency own{group.subjects[i], 0, 0.0, 0.0};
    double triads = 0.0;
    for (const auto& [number, judgements] : rounds[i])
      if (const auto chosen = completeRound(judgements, group.items.size())) {
        ++own.rounds;
        triads += static_cast<double>(circularTriads(*chosen));
      }
    if (own.rounds > 0) {
      own.triads = triads / static_cast<double>(own.rounds);
      own.coefficient = 1.0 - own.triads / most;
    }
    out.push_back(own);
  }
  return out;
}

}  // namespace limen::analysis
