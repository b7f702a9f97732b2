// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/observer_statistics/sensitivity.h"

#include <charconv>
#include <functional>
#include <map>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// 0 for yes/no.
int alternativesOf(const std::string& task) {
  if (task == "yesno") return 0;
  if (task == "2afc") return 2;
  int out = 0;
  if (task.rfind("mafc:", 0) == 0) {
    const auto [end, error] = std::from_chars(task.data() + 5, task.data() + task.size(), out);
    if (error == std::errc() && end == task.data() + task.size() && out >= 2 && out <= 1000) return out;
    throw Error("'" + task + "' has no number of alternatives from 2 to 1000", "--task", "write mafc:4");
  }
  throw Error("no task '" + task + "'", "--task", suggest(task, {"yesno", "2afc", "mafc:M"}));
}

/// Adds the answers of a row.
using Count = std::function<void(SensitivityRow&, size_t)>;

Count yesNoTrials(const Table& table, const SensitivityColumns& columns) {
  if (columns.answers.outcome.empty() || columns.signal.empty())
    throw Error("the columns with the answers are not named", table.name(),
                "give --outcome and --signal, or --hits, --signals, --false-alarms and --noises");
  const size_t outcome = table.column(columns.answers.outcome, "--outcome"),
               signal = table.column(columns.signal, "--signal");
  return [&table, outcome, signal](SensitivityRow& row, size_t at) {
    const int64_t yes = readBinary(table, at, outcome, "1 is yes, 0 is no");
    const bool there = readBinary(table, at, signal, "1 where there was something to see, 0 elsewhere") == 1;
    (there ? row.counts.hits : row.counts.falseAlarms) += yes;
    ++(there ? row.counts.signalTrials : row.counts.noiseTrials);
    row.correct += yes;
    ++row.trials;
  };
}

Count yesNoCounts(const Table& table, const SensitivityColumns& columns) {
  if (columns.hits.empty() || columns.signals.empty() || columns.falseAlarms.empty() ||
      columns.noises.empty())
    throw Error("counts of yes/no are four columns", table.name(),
                "give --hits, --signals, --false-alarms and --noises");
  const size_t hits = table.column(columns.hits, "--hits"),
               signals = table.column(columns.signals, "--signals"),
               falseAlarms = table.column(columns.falseAlarms, "--false-alarms"),
               noises = table.column(columns.noises, "--noises");
  return [&table, hits, signals, falseAlarms, noises](SensitivityRow& row, size_t at) {
    const AnswerCount seen = readCounts(table, at, hits, signals),
                      alarms = readCounts(table, at, falseAlarms, noises);
    row.counts.hits += seen.correct;
    row.counts.signalTrials += seen.trials;
    row.counts.falseAlarms += alarms.correct;
    row.counts.noiseTrials += alarms.trials;
    row.correct += seen.correct + alarms.correct;
    row.trials += seen.trials + alarms.trials;
  };
}

Count counterOf(const Table& table, const SensitivityColumns& columns, bool yesNo) {
  const bool yesNoCounted = !columns.hits.empty() || !columns.signals.empty() ||
                            !columns.falseAlarms.empty() || !columns.noises.empty();
  if (yesNo) {
    if (!columns.answers.correct.empty() || !columns.answers.trials.empty())
      throw Error("are for tasks with alternatives", "--k, --n", "give --task mafc:M or 2afc");
    if (yesNoCounted && (!columns.answers.outcome.empty() || !columns.signal.empty()))
      throw Error("rows are single trials or counts, not both", "--outcome, --signal",
                  "drop them, or the columns of counts");
    return yesNoCounted ? yesNoCounts(table, columns) : yesNoTrials(table, columns);
  }
  if (yesNoCounted || !columns.signal.empty())
    throw Error("columns of yes/no answers do not fit it", "--task " + columns.task,
                "give --outcome, or --k and --n");
  const AnswerReader answers(table, columns.answers);
  return [answers](SensitivityRow& row, size_t at) {
    const AnswerCount count = answers.count(at);
    row.correct += count.correct;
    row.trials += count.trials;
  };
}

/// Of a row's columns.
std::vector<std::string> labelsOf(const Table& table, size_t row, const std::vector<size_t>& columns) {
  std::vector<std::string> out;
  for (const size_t column : columns) out.push_back(readLabel(table, row, column));
  return out;
}

std::string conditionTitle(const Table& table, size_t row, const std::vector<size_t>& columns) {
  std::vector<std::string> out;
  for (const size_t column : columns) out.push_back(table.header()[column] + "=" + table.text(row, column));
  return join(out);
}

}  // namespace

std::vector<PartSensitivity> tableSensitivity(const Table& table, const SensitivityColumns& columns) {
  const int alternatives = alternativesOf(columns.task);
  const Count count = counterOf(table, columns, alternatives == 0);
  if (columns.by.empty() && columns.subject.empty())
    throw Error("the columns that tell answers apart are not named", table.name(),
                "give --subject, --by with columns of conditions, or both");
  const std::vector<size_t> by = table.columns(columns.by, "--by");
  const bool subjects = !columns.subject.empty();
  const std::vector<size_t> own =
      subjects ? std::vector<size_t>{table.column(columns.subject, "--subject")} : by;

  std::vector<PartSensitivity> out;
  std::map<std::vector<std::string>, size_t> parts;
  std::map<std::pair<size_t, std::vector<std::string>>, size_t> rows;
  std::vector<SensitivityRow> together;
  for (size_t at = 0; at < table.rows(); ++at) {
    const auto [part, fresh] =
        parts.emplace(labelsOf(table, at, subjects ? by : std::vector<size_t>{}), out.size());
    if (fresh) {
      out.emplace_back();
      PartSensitivity& added = out.back();
      added.part = join(part->first, " / ");
      added.title = part->first.empty()
                        ? "signal detection by " + (subjects ? columns.subject : join(columns.by))
                        : conditionTitle(table, at, by);
      added.yesNo = alternatives == 0;
      if (alternatives > 0) added.alternatives = alternatives;
      added.correction = columns.correction;
      added.subjects = subjects;
      together.emplace_back();
      together.back().part = added.part;
    }
    PartSensitivity& target = out[part->second];
    const auto [row, first] =
        rows.emplace(std::pair(part->second, labelsOf(table, at, own)), target.rows.size());
    if (first) {
      target.rows.emplace_back();
      target.rows.back().part = target.part;
      target.rows.back().observer = join(row->first.second, " / ");
    }
    count(target.rows[row->second], at);
    count(together[part->second], at);
  }
  for (size_t i = 0; i < out.size(); ++i) {
    if (out[i].rows.size() > 1) out[i].rows.push_back(together[i]);
    analyseSensitivity(out[i]);
    if (!out[i].dPrime) out[i].note = "no row has trials both with and without a signal";
  }
  return out;
}

}  // namespace limen::analysis
