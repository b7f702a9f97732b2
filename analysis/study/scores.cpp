// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/answer_tables/table.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr const char* kOption = "--scores";
constexpr const char* kClip = "clip";
constexpr const char* kStimulus = "stimulus_hash";

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

ClipScores readClipScores(const std::string& file, const std::vector<std::string>& quality) {
  const Table table = Table::read(file);
  ClipScores out;
  out.file = file;
  out.hash = sha256File(file);
  const std::vector<std::string>& header = table.header();
  if (has(header, kClip) == has(header, kStimulus))
    throw Error(fmt::format("has {} columns that name clips", has(header, kClip) ? "two" : "no"), file,
                "name clips in column 'clip' (limen study export --clips) or in column 'stimulus_hash'");
  out.byClip = has(header, kClip);
  const size_t id = table.column(out.byClip ? kClip : kStimulus, kOption);
  std::vector<size_t> columns;
  for (size_t column = 0; column < header.size(); ++column) {
    if (column == id) continue;
    const std::string& name = header[column];
    for (const PredictorName& own : studyPredictors())
      if (own.name == name)
        throw Error("column '" + name + "' has the name of one of Limen's own predictors", file,
                    "give it another name, such as 'my_" + name + "'");
    columns.push_back(column);
    out.names.push_back(name);
  }
  if (columns.empty()) throw Error("has no column of scores", file, "add one column for each predictor");
  for (const std::string& name : quality)
    if (!has(out.names, name)) throw Error("no column '" + name + "'", "--quality", suggest(name, out.names));
  for (size_t row = 0; row < table.rows(); ++row) {
    const std::string& clip = table.text(row, id);
    if (clip.empty()) throw Error("the clip has no name", table.place(row, id), "name it, or remove the row");
    std::map<std::string, double> scores;
    for (const size_t column : columns) {
      const double value = table.number(row, column);
      scores[header[column]] = has(quality, header[column]) ? -value : value;
    }
    if (!out.values.emplace(clip, std::move(scores)).second)
      throw Error("'" + clip + "' is there twice", table.place(row, id), "give each clip one row");
  }
  return out;
}

size_t addClipScores(const ClipScores& scores, const StudyPlan& plan,
                     std::map<PredictionKey, std::map<std::string, double>>& values) {
  std::set<std::string> used;
  std::vector<std::string> missing;
  for (auto& [key, predictors] : values) {
    const std::string name =
        scores.byClip ? store::clipName(key.first, key.second, plan.widthPx, plan.heightPx) : key.first;
    const auto found = scores.values.find(name);
    if (found == scores.values.end()) {
      missing.push_back(name);
      continue;
    }
    used.insert(name);
    for (const auto& [score, value] : found->second) predictors[score] = value;
  }
  if (!missing.empty())
    throw Error(fmt::format("{} of {} clips with a change have no score, '{}' among them", missing.size(),
                            values.size(), missing.front()),
                scores.file,
                used.empty()
                    ? "its clips are not those of this study: name them as limen study export --clips does"
                    : "add a row for each of them");
  return scores.values.size() - used.size();
}

}  // namespace limen::analysis
