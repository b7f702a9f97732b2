// SPDX-License-Identifier: BSD-3-Clause
// Stores of sweeps and of studies, damaged in the file and in its values.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "analysis/study/answers.h"
#include "analysis/study/rates.h"
#include "analysis/sweep/report.h"
#include "analysis/sweep/sweep.h"
#include "experiments/base/error.h"
#include "experiments/store/predictions.h"
#include "experiments/store/sessions.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/fuzz/damaged_store.h"
#include "tests/fuzz/rounds.h"
#include "tests/run_program.h"

namespace limen::fuzz {
namespace {

namespace fs = std::filesystem;

void requireFinite(std::optional<double> value, const std::string& what) {
  if (value && !std::isfinite(*value)) throw Violation{what + " is " + std::to_string(*value)};
}

/// Removes what SQLite may have left beside an earlier input.
void putStore(const std::string& from, const std::string& to) {
  for (const char* const suffix : {"-wal", "-shm", "-journal"}) fs::remove(to + suffix);
  fs::copy_file(from, to, fs::copy_options::overwrite_existing);
}

TEST(Fuzz, StoresOfSweeps) {
  const analysis::TemporaryFolder folder;
  const std::string sound = folder.path("sound.sqlite");
  {
    store::Store store(sound, store::Access::ReadWrite);
    std::vector<store::Run> runs;
    for (int i = 0; i < 6; ++i)
      runs.push_back(analysis::makeRun(i % 2 == 0 ? "a" : "b", i < 3 ? "s" : "t", i + 1, {1.0 + i, 2.0, 3.0},
                                       0.1 / (i + 1)));
    store::Experiment experiment;
    experiment.hash = "h";
    experiment.path = "d.yaml";
    experiment.title = "Title";
    experiment.question = "Question?";
    experiment.report = {{"x", "gpu_ms"}, {"y", "rmse"}, {"series", "technique"}, {"panels", "scene"}};
    analysis::writeExperiment(store, experiment, runs, {{"missing", "a", "s", "never run"}});
  }
  mergeJournal(sound);
  expectRobust({.name = "sweep_store",
                .extension = ".sqlite",
                .corpus = {},
                .read =
                    [](const std::string& path) {
                      const store::Store store(path, store::Access::ReadOnly);
                      store.allRuns(true);
                      store.environments();
                      for (const store::Experiment& experiment : store.experiments()) {
                        const analysis::Sweep sweep = analysis::loadSweep(store, experiment);
                        for (const analysis::Cell& cell : sweep.cells) {
                          requireFinite(cell.x, "x of a cell");
                          for (const analysis::PassTime& pass : cell.passes)
                            requireFinite(pass.ms.median, "a median");
                        }
                        analysis::exportTables(sweep, path + "_tables");
                      }
                    },
                .rounds = 300,
                .make =
                    [&](Random& random, const std::string& path) {
                      putStore(sound, path);
                      damageStore(random, path);
                    }});
}

TEST(Fuzz, StoresOfStudies) {
  const analysis::TemporaryFolder folder;
  const std::string sound = folder.path("sound.sqlite");
  const ProgramRun made = runProgram("limen-study simulate quick --observers 2 --quiet --store " + sound);
  ASSERT_EQ(made.code, 0) << made.text;
  mergeJournal(sound);
  expectRobust({.name = "study_store",
                .extension = ".sqlite",
                .corpus = {},
                .read =
                    [](const std::string& path) {
                      const store::SessionReader reader(path);
                      for (const store::StudySession& session : reader.sessions()) {
                        for (const store::StudyTrial& trial : reader.trials(session.id, true))
                          for (const double value : trial.procedureStimulus)
                            requireFinite(value, "a stimulus");
                        reader.blocks(session.id);
                        reader.events(session.id);
                        reader.notes(session.id);
                        reader.protocol(session.protocol);
                        reader.display(session.display);
                      }
                      store::readPredictions(path);
                      analysis::StudyChoice choice;
                      choice.store = path;
                      const analysis::StudyAnswers answers = analysis::readStudyAnswers(choice);
                      for (const analysis::StudyAnswer& answer : answers.answers)
                        requireFinite(answer.reactionTimeS, "a reaction time");
                      analysis::resultOf(analysis::studyRates(answers));
                    },
                .rounds = 600,
                .make =
                    [&](Random& random, const std::string& path) {
                      putStore(sound, path);
                      damageStore(random, path);
                    }});
}

}  // namespace
}  // namespace limen::fuzz
