// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/expectation.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/base/text.h"
#include "experiments/plan.h"
#include "experiments/selection.h"

namespace limen::experiments {
namespace {

using Relation = ExpectationStatement::Relation;
using Baseline = ExpectationStatement::Baseline;

/// Equal in every parameter common to both, apart from those in `except`.
bool agree(const ParameterValues& a, const ParameterValues& b, const Selection& except) {
  return std::all_of(a.all().begin(), a.all().end(), [&](const auto& entry) {
    return except.count(entry.first) || !b.has(entry.first) || b.all().at(entry.first) == entry.second;
  });
}

/// Runs that `evaluated` may be compared with: same scene and size except for what either side fixes. Another
/// technique may differ in its parameters; if it is planned several times, the runs that share the evaluated
/// run's values are meant.
std::vector<size_t> baselinesOf(const PlannedRun& evaluated, const std::vector<PlannedRun>& runs,
                                const ExpectationStatement& statement) {
  const Baseline& baseline = *statement.relativeTo;
  const std::string& technique = baseline.technique.empty() ? evaluated.technique.name : baseline.technique;
  const std::string& scene = baseline.scene.empty() ? evaluated.scene.name : baseline.scene;
  Selection pinned = baseline.where;
  pinned.insert(statement.where.begin(), statement.where.end());
  std::vector<size_t> loose, close;
  for (size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& candidate = runs[i];
    const bool sameSize = (pinned.count("width") || candidate.widthPx == evaluated.widthPx) &&
                          (pinned.count("height") || candidate.heightPx == evaluated.heightPx);
    if (!sameSize || !matches(candidate, technique, scene, baseline.where) ||
        !agree(evaluated.scene.values, candidate.scene.values, pinned))
      continue;
    loose.push_back(i);
    if (agree(evaluated.technique.values, candidate.technique.values, pinned)) close.push_back(i);
  }
  const bool strict = technique == evaluated.technique.name || (loose.size() > 1 && !close.empty());
  return strict ? close : loose;
}

/// Planned values of a parameter: for the message when `where` asks for another.
std::string plannedValues(const std::vector<PlannedRun>& runs, const ExpectationStatement& statement,
                          const std::string& name) {
  std::vector<std::string> shown;
  std::set<std::string> seen;
  for (const PlannedRun& run : runs)
    if (matches(run, statement.technique, statement.scene, {}))
      if (const auto value = lookUp(run, name); value && seen.insert(toText(*value)).second)
        shown.push_back(toText(*value));
  if (shown.size() > 12) shown.resize(12), shown.emplace_back("...");
  return join(shown);
}

std::string explainNoRun(const std::vector<PlannedRun>& runs, const ExpectationStatement& statement) {
  for (const auto& [name, value] : statement.where)
    if (std::none_of(runs.begin(), runs.end(), [&, one = Selection{{name, value}}](const PlannedRun& run) {
          return matches(run, statement.technique, statement.scene, one);
        }))
      return fmt::format("planned values of '{}': {}", name, plannedValues(runs, statement, name));
  return "its conditions contradict each other";
}

std::string number(std::optional<double> value) {
  return value ? fmt::format("{:.6g}", *value) : "not a number";
}

/// The measured value, or the reason why there is none.
struct Reading {
  std::optional<double> value;
  std::string problem;
};

Reading read(const PlannedRun& run, const std::string& metric,
             const std::map<std::string, const store::Run*>& measured) {
  const auto entry = measured.find(run.key);
  if (entry == measured.end()) return {{}, "was not run"};
  if (entry->second->status == "failed") return {{}, "failed: " + entry->second->error};
  if (entry->second->status != "done") return {{}, "is not finished"};
  for (const store::Measurement& measurement : entry->second->measurements)
    if (measurement.name == metric)
      return measurement.value ? Reading{measurement.value, ""} : Reading{{}, metric + " is not a number"};
  return {{}, "has no " + metric};
}

bool holds(Relation relation, double value, double bound) {
  switch (relation) {
    case Relation::Below:
      return value < bound;
    case Relation::Above:
      return value > bound;
    case Relation::Equals:
      return value == bound;
  }
  return false;
}

/// "" if the case holds, otherwise why not.
std::string evaluateCase(const ExpectationStatement& statement, const ResolvedExpectation::Case& one,
                         const std::vector<PlannedRun>& runs,
                         const std::map<std::string, const store::Run*>& measured) {
  const PlannedRun& run = runs[one.run];
  const Reading own = read(run, statement.metric, measured);
  if (!own.value) return describe(run) + " " + own.problem;
  double bound = statement.bound;
  std::string against;
  if (one.baseline) {
    const PlannedRun& other = runs[*one.baseline];
    const Reading base = read(other, statement.metric, measured);
    if (!base.value) return describe(other) + " " + base.problem;
    // The bound is multiplied rather than the value divided, so that a baseline of 0 needs no special case.
    bound *= *base.value;
    against =
        fmt::format(" ({} x {} of {})", shortestNumber(statement.bound), number(base.value), describe(other));
  }
  if (holds(statement.relation, *own.value, bound)) return {};
  const char* relation = statement.relation == Relation::Below   ? "not below"
                         : statement.relation == Relation::Above ? "not above"
                                                                 : "not equal to";
  return fmt::format("{}: {} is {}, {} {}{}", describe(run), statement.metric, number(own.value), relation,
                     number(bound), against);
}

}  // namespace

std::vector<ResolvedExpectation> resolve(const std::vector<ExpectationStatement>& statements,
                                         const std::vector<PlannedRun>& runs, Problems& problems) {
  std::vector<ResolvedExpectation> out;
  for (const ExpectationStatement& statement : statements) {
    ResolvedExpectation resolved{&statement, {}};
    for (size_t i = 0; i < runs.size(); ++i) {
      if (!matches(runs[i], statement.technique, statement.scene, statement.where)) continue;
      ResolvedExpectation::Case one{i, {}};
      if (statement.relativeTo) {
        const std::vector<size_t> candidates = baselinesOf(runs[i], runs, statement);
        // Without its own selection the statement covers its baseline too; a run is not compared with itself.
        if (candidates.size() == 1 && candidates[0] == i) continue;
        if (candidates.size() != 1) {
          problems.add(
              statement.mark,
              fmt::format("'relative_to' matches {} runs for {}", candidates.size(), describe(runs[i])),
              candidates.empty() ? "name a technique and values that are planned"
                                 : "add 'where' until it matches one: " + describe(runs[candidates[0]]) +
                                       " or " + describe(runs[candidates[1]]));
          break;
        }
        one.baseline = candidates[0];
      }
      resolved.cases.push_back(one);
    }
    if (resolved.cases.empty() && problems.empty())
      problems.add(statement.mark, "no planned run matches the expectation '" + statement.text + "'",
                   explainNoRun(runs, statement));
    out.push_back(std::move(resolved));
  }
  return out;
}

std::vector<store::Expectation> evaluate(const std::vector<ResolvedExpectation>& expectations,
                                         const std::vector<PlannedRun>& runs,
                                         const std::map<std::string, const store::Run*>& measured) {
  std::vector<store::Expectation> out;
  for (const ResolvedExpectation& expectation : expectations) {
    size_t broken = 0;
    std::string first;
    for (const ResolvedExpectation::Case& one : expectation.cases) {
      const std::string problem = evaluateCase(*expectation.statement, one, runs, measured);
      if (problem.empty()) continue;
      if (broken++ == 0) first = problem;
    }
    if (broken > 1) first += fmt::format(" (and {} more of {} runs)", broken - 1, expectation.cases.size());
    if (broken == 0)
      first = fmt::format("holds for {} run{}", expectation.cases.size(),
                          expectation.cases.size() == 1 ? "" : "s");
    out.push_back({expectation.statement->text, broken == 0, first});
  }
  return out;
}

}  // namespace limen::experiments
