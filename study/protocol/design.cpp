// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/design.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "perception/psychometrics/random.h"
#include "study/protocol/blocks.h"
#include "study/protocol/conditions.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;
using psychometrics::Random;

/// Rows of Latin squares. A second square takes its next row when the first has gone through all of its own,
/// so that the orders of parts, blocks and trials are crossed.
class Rows {
 public:
  explicit Rows(int participantNumber) : number_(participantNumber), left_(participantNumber) {}

  /// Positions 0 ... n - 1 in the order of `kind`.
  std::vector<size_t> order(OrderKind kind, size_t n, uint64_t seed) {
    std::vector<size_t> out(n);
    std::iota(out.begin(), out.end(), size_t{0});
    if (kind == OrderKind::Shuffle) Random(seed).shuffle(out);
    if ((kind != OrderKind::Latin && kind != OrderKind::Williams) || n == 0) return out;
    const auto treatments = static_cast<int>(n);
    const bool williams = kind == OrderKind::Williams;
    const int period = williams && treatments % 2 == 1 ? 2 * treatments : treatments;
    const std::vector<int> row =
        williams ? williamsRow(treatments, left_ % period) : latinRow(treatments, left_ % period);
    left_ /= period;
    // All that is asked for is its parity and whether a participant may be beyond it.
    period_ = std::min<int64_t>(period_ * period, int64_t{1} << 40);
    return {row.begin(), row.end()};
  }

  /// Alternates from participant to participant, and comes with each combination of rows once each way: where
  /// these have come up an even number of times, the next round begins the other way.
  bool mirrored() const {
    const int64_t round = period_ % 2 == 0 ? number_ / period_ : 0;
    return (number_ + round) % 2 == 1;
  }

 private:
  int number_, left_;
  int64_t period_ = 1;  ///< participants after which all rows of the squares so far come again
};

template <class T>
std::vector<T> arranged(const std::vector<T>& items, const std::vector<size_t>& order) {
  std::vector<T> out;
  for (const size_t i : order) out.push_back(items[i]);
  return out;
}

/// Order of an adaptive block: one catch trial in each of as many equal segments, so that they are spread
/// over the block and unpredictable.
std::vector<size_t> spread(const std::vector<PlannedTrial>& trials, Random& random) {
  std::vector<size_t> adaptive, catches, out;
  for (size_t i = 0; i < trials.size(); ++i) (trials[i].change ? adaptive : catches).push_back(i);
  random.shuffle(adaptive);
  random.shuffle(catches);
  // Segment k has the positions from n k / c to n (k + 1) / c.
  const size_t n = trials.size(), c = catches.size();
  size_t next = 0;
  for (size_t k = 0; k < c; ++k) {
    const size_t begin = n * k / c, end = n * (k + 1) / c, place = begin + random.below(end - begin);
    while (out.size() < end) out.push_back(out.size() == place ? catches[k] : adaptive[next++]);
  }
  while (next < adaptive.size()) out.push_back(adaptive[next++]);
  return out;
}

std::vector<size_t> shuffled(const Part& part, const std::vector<PlannedTrial>& trials, uint64_t seed) {
  Random random(seed);
  const std::vector<RunLimit> limits = runLimits(part, trials);
  constexpr int kAttempts = 300;
  for (int i = 0; part.procedure && i < kAttempts; ++i) {
    std::vector<size_t> order = spread(trials, random);
    if (keepsLimits(order, limits)) return order;
  }
  return limitedShuffle(trials.size(), limits, random);
}

std::string seedText(const char* what, const std::string& name) { return std::string(what) + "/" + name; }

/// A part's blocks, in order, without practice.
std::vector<PlannedBlock> planPart(const Part& part, int number, int firstProcedure, uint64_t seed,
                                   Rows& rows) {
  std::vector<PlannedBlock> blocks = unorderedBlocks(part, number, firstProcedure);
  const std::vector<size_t> blockOrder =
      rows.order(part.blockOrder.kind, blocks.size(), childSeed(seed, seedText("blocks", part.name)));
  for (PlannedBlock& block : blocks) {
    setTargets(part, block.trials, childSeed(seed, seedText("targets", block.name)));
    setUnchanged(part, block.trials, childSeed(seed, seedText("unchanged", block.name)));
    const uint64_t orderSeed = childSeed(seed, seedText("order", block.name));
    const OrderKind kind = part.trialOrder.kind;
    block.trials =
        arranged(block.trials, kind == OrderKind::Shuffle ? shuffled(part, block.trials, orderSeed)
                                                          : rows.order(kind, block.trials.size(), orderSeed));
  }
  return arranged(blocks, blockOrder);
}

/// What practice draws from: conditions, and the pairs of each if items are compared.
std::vector<PlannedTrial> practiceCells(const Part& part, int number) {
  std::vector<PlannedTrial> out;
  for (const Condition& condition : conditionsOf(part)) {
    PlannedTrial trial;
    trial.part = number;
    trial.practice = true;
    trial.condition = condition.levels;
    trial.variables = condition.variables;
    const Factor* items = itemsOf(part);
    if (!items) out.push_back(trial);
    if (items)
      for (const auto& [a, b] : pairsOf(*items)) {
        trial.condition["item_a"] = items->levels[a].name;
        trial.condition["item_b"] = items->levels[b].name;
        out.push_back(trial);
      }
  }
  return out;
}

/// Of `trials` practice trials: in proportion to the part's own, at least one of each kind if there are two.
int practiceCatches(const Part& part) {
  if (part.catchRepetitions == 0 || part.practice.trials < 2) return 0;
  double share = part.catchRepetitions;
  share /= part.procedure ? static_cast<double>(trialCount(part))
                          : static_cast<double>(part.catchRepetitions + part.changeRepetitions);
  return std::clamp(static_cast<int>(share * part.practice.trials + 0.5), 1, part.practice.trials - 1);
}

}  // namespace

PlannedBlock makePracticeRound(const Protocol& protocol, int number, uint64_t seed, int round) {
  assert(number >= 0 && round >= 0);
  const Part& part = protocol.parts.at(static_cast<size_t>(number));
  const auto count = static_cast<size_t>(part.practice.trials);
  PlannedBlock out{number, part.name + ": practice", true, {}};
  if (count == 0) return out;
  Random random(childSeed(seed, seedText("practice", part.name + "/" + std::to_string(round))));
  // Every (cells / trials)-th cell from a random start: each cell as often as any other, give or take one.
  const std::vector<PlannedTrial> cells = practiceCells(part, number);
  const double start = random.uniform();
  for (size_t i = 0; i < count; ++i) {
    const double place =
        (static_cast<double>(i) + start) * static_cast<double>(cells.size()) / static_cast<double>(count);
    out.trials.push_back(cells[std::min(static_cast<size_t>(place), cells.size() - 1)]);
    out.trials.back().repetition = round;
  }
  random.shuffle(out.trials);
  const int catches = practiceCatches(part);
  std::vector<int> targets, stimuli;
  const int alternatives = part.task.type == Task::Pairwise ? 2 : part.task.alternatives;
  for (size_t i = 0; i < count; ++i) {
    out.trials[i].change = static_cast<int>(i) >= catches;
    targets.push_back(static_cast<int>(i) % alternatives);
    stimuli.push_back(part.practice.stimuli.empty() ? 0 : static_cast<int>(i % part.practice.stimuli.size()));
  }
  random.shuffle(targets);
  const bool targeted = part.task.type != Task::YesNo && part.task.type != Task::Rating;
  for (size_t i = 0; i < count; ++i) {
    PlannedTrial& trial = out.trials[i];
    if (targeted) trial.target = targets[i];
    if (!part.practice.stimuli.empty())
      trial.variables =
          merged(std::move(trial.variables), part.practice.stimuli[static_cast<size_t>(stimuli[i])]);
  }
  random.shuffle(out.trials);
  setUnchanged(part, out.trials,
               childSeed(seed, seedText("unchanged practice", part.name + "/" + std::to_string(round))));

  // Further rounds come after everything planned, those of earlier parts first.
  int first = 0;
  if (round > 0) {
    for (size_t p = 0; p < protocol.parts.size(); ++p) {
      const Part& other = protocol.parts[p];
      first += static_cast<int>(trialCount(other)) + other.practice.trials;
      if (static_cast<int>(p) < number) first += (other.practice.rounds - 1) * other.practice.trials;
    }
    first += (round - 1) * part.practice.trials;
  }
  for (size_t i = 0; i < count; ++i) {
    out.trials[i].number = first + static_cast<int>(i);
    out.trials[i].block = -1;
  }
  return out;
}

Design makeDesign(const Protocol& protocol, uint64_t seed, int participantNumber) {
  assert(participantNumber >= 0);
  Design out;
  Rows rows(participantNumber);
  const std::vector<size_t> parts =
      rows.order(protocol.partOrder.kind, protocol.parts.size(), childSeed(seed, "parts"));
  std::vector<std::vector<PlannedBlock>> ofParts;
  for (size_t p = 0; p < protocol.parts.size(); ++p) {
    const Part& part = protocol.parts[p];
    const auto number = static_cast<int>(p);
    ofParts.push_back(planPart(part, number, static_cast<int>(out.procedures.size()), seed, rows));
    if (part.practice.trials > 0)
      ofParts.back().insert(ofParts.back().begin(), makePracticeRound(protocol, number, seed, 0));
    if (!part.procedure) continue;
    for (const Condition& condition : conditionsOf(part))
      out.procedures.push_back(
          {number, condition.levels, part.procedure->settings,
           childSeed(seed, seedText("procedure", part.name + "/" + nameOf(part, condition.levels)))});
  }
  out.answersMirrored = rows.mirrored();
  int trialNumber = 0;
  for (const size_t p : parts)
    for (PlannedBlock& block : ofParts[p]) {
      for (PlannedTrial& trial : block.trials) {
        trial.number = trialNumber++;
        trial.block = static_cast<int>(out.blocks.size());
      }
      out.blocks.push_back(std::move(block));
    }
  return out;
}

void asPlannedBefore(PlannedBlock& block, int version) {
  if (version >= 2) return;
  for (PlannedTrial& trial : block.trials) trial.unchangedShowsAfter.reset();
}

void asPlannedBefore(Design& design, int version) {
  for (PlannedBlock& block : design.blocks) asPlannedBefore(block, version);
  if (version < 2) design.answersMirrored = false;
}

std::vector<size_t> answersShown(const TaskSetting& task, bool mirrored) {
  std::vector<size_t> out(task.answers.size());
  std::iota(out.begin(), out.end(), size_t{0});
  const bool reversed = task.answerSides == AnswerSides::Reversed ||
                        (task.answerSides == AnswerSides::Counterbalanced && mirrored);
  if (reversed && task.type == Task::YesNo) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace limen::study
