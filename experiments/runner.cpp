// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/runner.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <span>
#include <thread>
#include <utility>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "experiments/expectation.h"

namespace limen::experiments {
namespace {

class Runner {
 public:
  Runner(const Plan& plan, store::Store& results, Executor& executor, const nlohmann::json& hostFacts,
         const RunnerOptions& options, SweepObserver& observer)
      : plan_(plan),
        results_(results),
        executor_(executor),
        hostFacts_(hostFacts),
        options_(options),
        observer_(observer),
        device_(executor.environment().device) {}

  SweepTally run() {
    const std::vector<bool> mine = shardMask(plan_, options_.shardIndex, options_.shardCount);
    std::vector<std::vector<size_t>> groups;
    std::vector<size_t> givenUp;
    for (const auto& [begin, end] : plan_.groups) {
      std::vector<size_t>& group = groups.emplace_back();
      for (size_t i = begin; i < end; ++i) {
        if (!mine[i] || (options_.only && options_.only->count(plan_.runs[i].key) == 0)) continue;
        ++tally_.planned;
        if (results_.isDone(plan_.runs[i].key, device_))
          ++tally_.skipped;
        else if (!options_.retryDied && results_.hasDiedTwice(plan_.runs[i].key, device_))
          givenUp.push_back(i);
        else
          group.push_back(i);
      }
    }
    observer_.begin(tally_.planned, tally_.skipped);
    for (const size_t index : givenUp) giveUp(index);
    // A run that was stopped is not one that killed its process.
    const AtForcedEnd giveBack(
        [path = results_.path()] { store::Store(path, store::Access::ReadWrite).releaseClaims(); });
    try {
      std::erase_if(groups, [](const std::vector<size_t>& group) { return group.empty(); });
      std::rotate(groups.begin(),
                  groups.begin() + static_cast<long>(options_.begin * static_cast<double>(groups.size())),
                  groups.end());
      for (size_t i = 0; i < groups.size(); ++i) {
        if (i + 1 < groups.size()) announced_ = groups[i + 1].front();
        measureGroup(groups[i]);
      }
      waitForOthers();
    } catch (const Interrupted&) {
      tally_.interrupted = true;
    } catch (...) {
      // The first error says what is wrong; failing to release claims adds nothing to it.
      try {
        results_.releaseClaims();
      } catch (const Error&) {
      }
      throw;
    }
    results_.releaseClaims();
    tally_.left = tally_.planned - tally_.done - tally_.skipped - tally_.failed;
    return tally_;
  }

 private:
  bool stopped() const { return options_.failFast && tally_.failed > 0; }

  store::Run rowOf(const PlannedRun& planned) {
    if (!environment_) {
      store::Environment environment = executor_.environment();
      nlohmann::json facts = hostFacts_;
      facts.update(environment.facts);
      environment.facts = std::move(facts);
      environment_ = results_.putEnvironment(environment);
    }
    store::Run row;
    row.key = planned.key;
    row.device = device_;
    row.technique = planned.technique.name;
    row.scene = planned.scene.name;
    row.label = planned.label;
    row.parameters = planned.parameters;
    row.environment = *environment_;
    return row;
  }

  /// Counts a run as failed that its process died of twice.
  void giveUp(size_t index) {
    const PlannedRun& planned = plan_.runs[index];
    store::Run row = rowOf(planned);
    row.status = "failed";
    row.error = diedTwice(planned);
    ++tally_.failed;
    observer_.finished(planned, row);
  }

  static std::string diedTwice(const PlannedRun& planned) {
    std::string files;
    const nlohmann::json values = planned.parameters.value("scene", nlohmann::json::object());
    for (const auto& [path, value] : values.items())
      if (path == "file" || path.ends_with(".file"))
        files += " of '" + (value.is_string() ? value.get<std::string>() : value.dump()) + "'";
    return store::Store::diedTwice("it measured " + planned.technique.name + " in the scene '" +
                                   planned.scene.name + "'" + files +
                                   "; limen sweep --retry-died tries it again");
  }

  store::Store::Claim claim(size_t index) { return results_.claim(rowOf(plan_.runs[index])); }

  void countElsewhere(size_t index) {
    ++tally_.skipped;
    observer_.doneElsewhere(plan_.runs[index]);
  }

  void measureGroup(const std::vector<size_t>& group) {
    if (!options_.queue) return measureAll(group);
    for (size_t begin = 0; begin < group.size() && !stopped();) {
      throwIfInterrupted();
      const size_t end =
          std::min(group.size(), begin + static_cast<size_t>(plan_.runs[group[begin]].timing.batch));
      measureAll(taken({group.begin() + static_cast<long>(begin), group.begin() + static_cast<long>(end)}));
      begin = end;
    }
  }

  /// Those of a batch that the queue gives to this task.
  std::vector<size_t> taken(const std::vector<size_t>& batch) {
    std::vector<std::string> keys;
    for (const size_t index : batch) keys.push_back(plan_.runs[index].key);
    const std::vector<bool> mine = options_.queue->take(keys);
    std::vector<size_t> out;
    for (size_t i = 0; i < batch.size(); ++i) {
      if (mine[i]) {
        out.push_back(batch[i]);
      } else {
        --tally_.planned;
        observer_.leftToOther(plan_.runs[batch[i]]);
      }
    }
    return out;
  }

  void measureAll(const std::vector<size_t>& group) {
    std::vector<size_t> batch;
    for (size_t position = 0; position < group.size() && !stopped(); ++position) {
      throwIfInterrupted();
      const size_t index = group[position];
      switch (claim(index)) {
        case store::Store::Claim::Claimed:
          if (const int deaths = results_.deaths(plan_.runs[index].key, device_); deaths == 0) {
            batch.push_back(index);
          } else if (deaths == 1 || options_.retryDied) {
            // Alone, so that no run is blamed for another's death.
            if (!batch.empty()) measure(std::exchange(batch, {}));
            announced_.reset();
            measure({index});
          } else {
            RunOutcome outcome;
            outcome.error = diedTwice(plan_.runs[index]);
            commit(plan_.runs[index], std::move(outcome));
          }
          break;
        case store::Store::Claim::AlreadyDone:
          countElsewhere(index);
          break;
        case store::Store::Claim::HeldByOther:
          held_.push_back(index);
          break;
      }
      const auto full = static_cast<size_t>(plan_.runs[index].timing.batch);
      if (batch.size() == full || (position + 1 == group.size() && !batch.empty())) {
        measure(batch);
        batch.clear();
      }
    }
  }

  void measure(const std::vector<size_t>& batch) {
    std::vector<PlannedRun> runs;
    for (const size_t index : batch) runs.push_back(plan_.runs[index]);
    observer_.measuring(runs.front(), runs.size());
    std::vector<bool> reported(runs.size(), false);
    if (announced_) executor_.announce(plan_.runs[*announced_]);
    announced_.reset();
    executor_.execute(runs, [&](size_t index, RunOutcome outcome) {
      reported.at(index) = true;
      commit(runs[index], std::move(outcome));
    });
    results_.sync();
    if (std::find(reported.begin(), reported.end(), false) != reported.end()) {
      throwIfInterrupted();
      throw Error("the executor left a run without an outcome");
    }
  }

  void commit(const PlannedRun& planned, RunOutcome outcome) {
    store::Run row = rowOf(planned);
    row.status = outcome.error.empty() ? "done" : "failed";
    row.error = std::move(outcome.error);
    row.sceneFacts = std::move(outcome.sceneFacts);
    row.measurements = std::move(outcome.measurements);
    row.frameTimes = std::move(outcome.frameTimes);
    row.passes = std::move(outcome.passes);
    row.artefacts = std::move(outcome.artefacts);
    results_.finish(row);
    ++(row.status == "done" ? tally_.done : tally_.failed);
    observer_.finished(planned, row);
  }

  void waitForOthers() {
    while (!held_.empty() && !stopped()) {
      observer_.waiting(held_.size());
      const std::vector<size_t> group = std::exchange(held_, {});
      // Released runs may differ in scene or size, which runs of a batch must not.
      for (size_t begin = 0; begin < group.size() && !stopped();) {
        size_t end = begin + 1;
        while (end < group.size() && groupOf(group[end]) == groupOf(group[begin])) ++end;
        measureGroup({group.begin() + static_cast<long>(begin), group.begin() + static_cast<long>(end)});
        begin = end;
      }
      if (held_.empty()) break;
      throwIfInterrupted();
      std::this_thread::sleep_for(std::chrono::duration<double>(options_.pollSeconds));
    }
  }

  size_t groupOf(size_t index) const {
    const auto after = std::upper_bound(plan_.groups.begin(), plan_.groups.end(), index,
                                        [](size_t value, const auto& group) { return value < group.first; });
    return static_cast<size_t>(after - plan_.groups.begin());
  }

  const Plan& plan_;
  store::Store& results_;
  Executor& executor_;
  const nlohmann::json& hostFacts_;
  const RunnerOptions& options_;
  SweepObserver& observer_;
  const std::string device_;
  std::optional<int64_t> environment_;
  std::vector<size_t> held_;
  std::optional<size_t> announced_;  ///< first run of the next group
  SweepTally tally_;
};

}  // namespace

SweepTally runSweep(const Plan& plan, store::Store& results, Executor& executor,
                    const nlohmann::json& hostFacts, const RunnerOptions& options, SweepObserver& observer) {
  return Runner(plan, results, executor, hostFacts, options, observer).run();
}

int64_t enterExperiment(const Descriptor& descriptor, const Plan& plan, store::Store& results,
                        const std::unordered_set<std::string>* only) {
  store::Experiment experiment;
  experiment.hash = descriptor.hash;
  experiment.path = descriptor.path;
  experiment.title = descriptor.title;
  experiment.question = descriptor.question;
  experiment.source = descriptor.source;
  experiment.descriptor = descriptor.text;
  experiment.features = descriptor.features;
  experiment.report = descriptor.report;
  if (!plan.published.empty()) experiment.report["published"] = plan.published;
  std::vector<store::PlanEntry> entries;
  for (const PlannedRun& run : plan.runs)
    if (!only || only->count(run.key) > 0)
      entries.push_back({run.key, run.technique.name, run.scene.name, run.label});
  return results.putExperiment(experiment, entries, plan.descriptions);
}

std::vector<store::Expectation> evaluateExpectations(const Descriptor& descriptor, const Plan& plan,
                                                     int64_t experiment, const std::string& device,
                                                     store::Store& results) {
  Problems problems(descriptor.path);
  const auto resolved = resolve(descriptor.expectations, plan.runs, problems);
  const std::vector<store::Run> rows = results.runs(experiment);
  std::map<std::string, const store::Run*> measured;
  for (const store::Run& row : rows) {
    if (!device.empty() && row.device != device) continue;
    const store::Run*& best = measured[row.key];
    const auto rank = [](const store::Run& one) { return std::pair(one.status == "done", one.finished); };
    if (!best || rank(*best) < rank(row)) best = &row;
  }
  std::vector<store::Expectation> evaluated = evaluate(resolved, plan.runs, measured);
  results.putExpectations(experiment, evaluated);
  return evaluated;
}

}  // namespace limen::experiments
