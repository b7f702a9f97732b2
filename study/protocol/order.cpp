// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/order.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

namespace limen::study {
namespace {

using psychometrics::Random;

constexpr int kShuffles = 300;
constexpr size_t kRepairSteps = 20'000'000;
constexpr long kSearchSteps = 200'000;
constexpr uint64_t kPlainSeed = 0;

/// Positions of an order that continue a run beyond its limit.
size_t violations(const std::vector<size_t>& order, const std::vector<RunLimit>& limits) {
  size_t out = 0;
  for (const RunLimit& limit : limits) {
    int run = 0;
    for (size_t i = 0; i < order.size(); ++i) {
      run = i > 0 && limit.values[order[i]] == limit.values[order[i - 1]] ? run + 1 : 1;
      if (run > limit.atMost) ++out;
    }
  }
  return out;
}

/// Swaps that do not make an order worse, a bounded number of them.
bool repair(std::vector<size_t>& order, const std::vector<RunLimit>& limits, Random& random) {
  size_t worst = violations(order, limits);
  // Each attempt takes time proportional to the order's length.
  const size_t attempts = std::min(30 * order.size(), kRepairSteps / (order.size() + 1));
  for (size_t attempt = 0; worst > 0 && attempt < attempts; ++attempt) {
    const size_t i = random.below(order.size()), j = random.below(order.size());
    std::swap(order[i], order[j]);
    const size_t now = violations(order, limits);
    if (now > worst)
      std::swap(order[i], order[j]);
    else
      worst = now;
  }
  return worst == 0;
}

/// Depth-first search over kinds: items that agree in every limited value are of one kind. It never enters a
/// state from which some single limit cannot be met; with one limit it therefore never backtracks.
class Search {
 public:
  Search(size_t items, const std::vector<RunLimit>& limits) : limits_(limits), items_(items) {
    std::map<std::vector<int>, size_t> numbers;
    for (size_t item = 0; item < items; ++item) {
      std::vector<int> kind;
      for (const RunLimit& limit : limits) kind.push_back(limit.values[item]);
      const auto [known, fresh] = numbers.emplace(kind, numbers.size());
      if (fresh) kinds_.push_back({kind, {}});
      kinds_[known->second].items.push_back(item);
    }
    left_.resize(limits.size());
    last_.assign(limits.size(), {0, 0});
    for (size_t k = 0; k < limits.size(); ++k)
      for (const int value : limits[k].values) ++left_[k][value];
  }

  /// Nothing if there is no order, or if the search was given up (`exhausted` is then false).
  std::optional<std::vector<size_t>> run(Random& way, Random& items, bool& exhausted) {
    steps_ = kSearchSteps + 50 * static_cast<long>(items_);
    const bool found = completable() && fill(way);
    exhausted = steps_ > 0;
    if (!found) return std::nullopt;
    // Items of a kind are interchangeable.
    for (KindOfItem& kind : kinds_) items.shuffle(kind.items);
    std::vector<size_t> out, used(kinds_.size());
    for (const size_t kind : sequence_) out.push_back(kinds_[kind].items[used[kind]++]);
    return out;
  }

 private:
  struct KindOfItem {
    std::vector<int> values;
    std::vector<size_t> items;
    size_t placed = 0;
    size_t left() const { return items.size() - placed; }
  };
  struct Run {
    int value, length;
  };

  /// Whether each limit alone can still be met: the others of a value make one gap more than they are, each
  /// of which takes `atMost` of it, the first less if the value is running.
  bool completable() const {
    const long left = static_cast<long>(items_ - sequence_.size());
    for (size_t k = 0; k < limits_.size(); ++k)
      for (const auto& [value, count] : left_[k]) {
        const long atMost = limits_[k].atMost, others = left - count;
        const long first = last_[k].length > 0 && last_[k].value == value ? atMost - last_[k].length : atMost;
        if (count > first + atMost * others) return false;
      }
    return true;
  }

  bool mayFollow(const KindOfItem& kind) const {
    if (kind.left() == 0) return false;
    for (size_t k = 0; k < limits_.size(); ++k)
      if (last_[k].length >= limits_[k].atMost && last_[k].value == kind.values[k]) return false;
    return true;
  }

  /// One position of the order: kinds not tried there yet, the current one, the runs before it.
  struct Place {
    std::vector<size_t> open;
    std::vector<Run> before;
  };

  Place nextPlace() const {
    Place out{{}, last_};
    for (size_t kind = 0; kind < kinds_.size(); ++kind)
      if (mayFollow(kinds_[kind])) out.open.push_back(kind);
    return out;
  }

  bool fill(Random& random) {
    if (items_ == 0) return true;
    std::vector<Place> places = {nextPlace()};
    while (!places.empty()) {
      if (sequence_.size() == places.size()) takeBack(places.back());  // what follows it has failed
      Place& place = places.back();
      if (place.open.empty()) {
        places.pop_back();
        continue;
      }
      if (--steps_ <= 0) return false;
      add(drawn(place.open, random));
      if (!completable()) continue;
      if (sequence_.size() == items_) return true;
      places.push_back(nextPlace());
    }
    return false;
  }

  /// Takes one from `open`, with the probability of drawing one of the remaining items.
  size_t drawn(std::vector<size_t>& open, Random& random) const {
    size_t sum = 0;
    for (const size_t kind : open) sum += kinds_[kind].left();
    size_t draw = random.below(sum), choice = 0;
    while (draw >= kinds_[open[choice]].left()) draw -= kinds_[open[choice++]].left();
    const size_t kind = open[choice];
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(choice));
    return kind;
  }

  void add(size_t kind) {
    put(kind, 1);
    for (size_t k = 0; k < limits_.size(); ++k) {
      const int value = kinds_[kind].values[k];
      last_[k] = {value, last_[k].length > 0 && last_[k].value == value ? last_[k].length + 1 : 1};
    }
    sequence_.push_back(kind);
  }

  void takeBack(const Place& place) {
    put(sequence_.back(), -1);
    sequence_.pop_back();
    last_ = place.before;
  }

  void put(size_t kind, int sign) {
    kinds_[kind].placed += static_cast<size_t>(sign);
    for (size_t k = 0; k < limits_.size(); ++k) left_[k][kinds_[kind].values[k]] -= sign;
  }

  const std::vector<RunLimit>& limits_;
  size_t items_;
  std::vector<KindOfItem> kinds_;
  std::vector<std::map<int, long>> left_;
  std::vector<Run> last_;
  std::vector<size_t> sequence_;
  long steps_ = 0;
};

}  // namespace

bool keepsLimits(const std::vector<size_t>& order, const std::vector<RunLimit>& limits) {
  return violations(order, limits) == 0;
}

Feasibility feasibility(size_t items, const std::vector<RunLimit>& limits) {
  Random random(kPlainSeed);
  bool exhausted = false;
  if (Search(items, limits).run(random, random, exhausted)) return Feasibility::Possible;
  return exhausted ? Feasibility::Impossible : Feasibility::NotFound;
}

std::vector<size_t> limitedShuffle(size_t items, const std::vector<RunLimit>& limits, Random& random) {
  std::vector<size_t> order(items);
  std::iota(order.begin(), order.end(), size_t{0});
  random.shuffle(order);
  for (int i = 0; i < kShuffles && !keepsLimits(order, limits); ++i) random.shuffle(order);
  if (repair(order, limits, random)) return order;
  bool exhausted = false;
  if (auto found = Search(items, limits).run(random, random, exhausted)) return *found;
  // The order found by feasibility(), which is the same every time except for the items within a kind.
  Random plain(kPlainSeed);
  const auto found = Search(items, limits).run(plain, random, exhausted);
  assert(found && "limits that cannot be kept are refused when a protocol is read");
  return *found;
}

}  // namespace limen::study
