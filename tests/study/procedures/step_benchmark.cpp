// SPDX-License-Identifier: BSD-3-Clause
// Time of one QUEST+ trial (choosing the stimulus and taking the answer) on the grids of Watson's (2017)
// example of threshold, slope and lapse: 41 stimuli, 820 parameter points. Not a test: times depend on the
// machine.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/base/program.h"
#include "perception/psychometrics/random.h"
#include "study/procedures/procedure.h"

namespace {

int measureSteps() {
  using Clock = std::chrono::steady_clock;
  const auto milliseconds = [](Clock::time_point from) {
    return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
  };
  for (const char* nuisance : {"[]", R"(["slope", "lapse"])"}) {
    nlohmann::json settings = nlohmann::json::parse(R"({
        "type": "quest_plus", "stimulus": {"from": -40, "to": 0, "step": 1}, "stop": {"trials": 300},
        "parameters": {"threshold": {"from": -40, "to": 0, "step": 1}, "slope": [2, 3, 4, 5],
                       "lapse": {"from": 0, "to": 0.04, "step": 0.01}}})");
    settings["nuisance"] = nlohmann::json::parse(nuisance);
    Clock::time_point start = Clock::now();
    const limen::study::ProcedureSettings read = limen::study::readProcedure(settings, "");
    const double tables = milliseconds(start);
    const auto procedure = limen::study::makeProcedure(read, 1);
    limen::psychometrics::Random random(1);
    std::vector<double> choices, updates;
    while (true) {
      start = Clock::now();
      const auto next = procedure->next();
      if (!next) break;
      choices.push_back(milliseconds(start));
      start = Clock::now();
      procedure->update(*next, random.chance(0.8) ? 1 : 0);
      updates.push_back(milliseconds(start));
    }
    std::sort(choices.begin(), choices.end());
    std::sort(updates.begin(), updates.end());
    const size_t n = choices.size();
    fmt::print(
        "41 stimuli x 820 points, nuisance {}: tables {:.1f} ms; a trial's choice {:.3f} ms, answer {:.3f} "
        "ms "
        "(medians of {}; worst {:.3f} and {:.3f} ms)\n",
        nuisance, tables, choices[n / 2], updates[n / 2], n, choices.back(), updates.back());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Time of one QUEST+ trial: choosing the stimulus and taking the answer.",
               "procedures_benchmark");
  int exitCode = 0;
  app.callback([&] { exitCode = measureSteps(); });
  return limen::runProgram(app, argc, argv, exitCode);
}
