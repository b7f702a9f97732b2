// SPDX-License-Identifier: BSD-3-Clause
// Tables of answers, of measured sensitivities and of a display's readings.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/answer_tables/table.h"
#include "experiments/base/error.h"
#include "perception/vision/csf_data.h"
#include "study/presentation/calibration.h"
#include "tests/fuzz/rounds.h"

namespace limen::fuzz {
namespace {

void requireFinite(double value, const std::string& what) {
  if (!std::isfinite(value)) throw Violation{what + " is " + std::to_string(value)};
}

std::vector<std::string> answerTables() {
  std::vector<std::string> out = shippedFiles("tests/analysis", ".csv");
  out.push_back("observer,level,correct,trials\na,1,2,20\na,2,9,20\n\"b, c\",1,4,20\nb,2,\"19\",20\n");
  return out;
}

TEST(Fuzz, AnswerTables) {
  expectRobust({.name = "answers",
                .extension = ".csv",
                .corpus = answerTables(),
                .mutate = mutateCsv,
                .read =
                    [](const std::string& path) {
                      const analysis::Table table = analysis::Table::read(path);
                      bool numbers = false;
                      for (size_t column = 0; column < table.header().size(); ++column)
                        for (size_t row = 0; row < table.rows(); ++row) try {
                            requireFinite(table.number(row, column), table.place(row, column));
                            numbers = true;
                            if (table.count(row, column) < 0) throw Violation{"a negative count"};
                          } catch (const Error& error) {
                            if (std::string(error.what()).find(path) == std::string::npos) throw;
                          }
                      if (!numbers) throw Error("no numbers", path);
                    },
                .rounds = 2000});
}

TEST(Fuzz, AnswerColumns) {
  expectRobust({.name = "columns",
                .extension = ".csv",
                .corpus = {answerTables().back()},
                .mutate = mutateCsv,
                .read =
                    [](const std::string& path) {
                      const analysis::Table table = analysis::Table::read(path);
                      analysis::AnswerColumns columns;
                      columns.correct = "correct";
                      columns.trials = "trials";
                      const analysis::AnswerReader reader(table, columns);
                      for (size_t row = 0; row < table.rows(); ++row) {
                        const analysis::AnswerCount count = reader.count(row);
                        if (count.correct < 0 || count.correct > count.trials || count.trials < 1)
                          throw Violation{"impossible counts"};
                        requireFinite(reader.value(row), "a rate");
                      }
                    },
                .rounds = 2000});
}

TEST(Fuzz, Sensitivities) {
  expectRobust({.name = "sensitivities",
                .extension = ".csv",
                .corpus = shippedFiles("tests/perception/reference", ".csv"),
                .mutate = mutateCsv,
                .read =
                    [](const std::string& path) {
                      const auto data = perception::readCsfData(path);
                      const perception::CsfInfo& info = perception::CsfRegistry::instance().get("stelacsf");
                      const auto error = perception::csfError(info, *perception::makeCsf("stelacsf"), data);
                      for (const double value : {error.gainDb, error.rmsDb, error.largestDb})
                        requireFinite(value, "an error of a model");
                    },
                .rounds = 2000});
}

TEST(Fuzz, Readings) {
  expectRobust({.name = "readings",
                .extension = ".csv",
                .corpus = {"level,cd/m2\n0,0.3\n0.25,12.1\n0.5,54.6\n# noon\n0.75,133\n1,250\n"},
                .mutate = mutateCsv,
                .read =
                    [](const std::string& path) {
                      const auto readings = study::readReadings(path);
                      study::TransferFit fit;
                      try {
                        fit = study::fitTransfer(readings);
                      } catch (const Error&) {  // which is about numbers, not about the file
                        throw Error("refused", path);
                      }
                      for (const double value :
                           {fit.gamma, fit.blackCdM2, fit.peakCdM2, fit.rmsCdM2, fit.largestShare})
                        requireFinite(value, "a fitted value");
                    },
                .rounds = 2000});
}

}  // namespace
}  // namespace limen::fuzz
