// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/pair_scales/pair_table.h"

#include "analysis/answer_tables/answer_columns.h"
#include "analysis/correlations/relation_table.h"
#include "analysis/output/text_output.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

/// Which of both ways the columns are named.
bool isOrdered(const PairColumns& columns) {
  const bool results = !columns.winner.empty() || !columns.loser.empty();
  const bool shown = !columns.first.empty() || !columns.second.empty() || !columns.chosen.empty();
  const char* both = "--winner, --loser, --first, --second, --chosen";
  if (results && shown)
    throw Error("the columns are named in two ways", both, "give --winner and --loser, or the other three");
  if (results && (columns.winner.empty() || columns.loser.empty()))
    throw Error("one of both is missing", "--winner, --loser");
  if (shown && (columns.first.empty() || columns.second.empty() || columns.chosen.empty()))
    throw Error("one of the three is missing", "--first, --second, --chosen");
  if (!results && !shown)
    throw Error("the columns with the pairs are not named", both,
                "give --winner and --loser, or the other three");
  return shown;
}

}  // namespace

std::vector<PairGroup> readPairs(const Table& table, const PairColumns& columns) {
  const bool ordered = isOrdered(columns);
  const size_t first =
      ordered ? table.column(columns.first, "--first") : table.column(columns.winner, "--winner");
  const size_t second =
      ordered ? table.column(columns.second, "--second") : table.column(columns.loser, "--loser");
  const auto chosen = table.optionalColumn(columns.chosen, "--chosen");
  const auto count = table.optionalColumn(columns.count, "--n");
  const auto subject = table.optionalColumn(columns.subject, "--subject");
  const auto round = table.optionalColumn(columns.round, "--round");
  const RowGroups groups = groupRows(table, columns.by, "--by");

  std::vector<PairGroup> out(groups.names.size());
  std::vector<std::vector<std::string>> rounds(out.size());
  for (size_t i = 0; i < out.size(); ++i) {
    out[i].name = groups.names[i];
    out[i].ordered = ordered;
  }
  for (size_t row = 0; row < table.rows(); ++row) {
    PairGroup& group = out[groups.of[row]];
    const std::string &a = readLabel(table, row, first), &b = readLabel(table, row, second);
    if (a == b)
      throw Error("'" + a + "' is compared with itself", table.place(row, second), "leave the row out");
    const size_t itemA = indexIn(group.items, a), itemB = indexIn(group.items, b);
    PairJudgement one{itemA, itemB, 1, 0, 0};
    if (chosen) {
      const std::string& choice = readLabel(table, row, *chosen);
      if (choice != a && choice != b)
        throw Error("'" + choice + "' is neither '" + a + "' nor '" + b + "'", table.place(row, *chosen),
                    "write the chosen item's name; ties are not taken");
      if (choice == b) std::swap(one.winner, one.loser);
    }
    if (count) one.count = table.count(row, *count);
    if (subject) one.subject = indexIn(group.subjects, readLabel(table, row, *subject));
    if (round) one.round = indexIn(rounds[groups.of[row]], readLabel(table, row, *round));
    group.judged += one.count;
    if (ordered && one.winner == itemA) group.firstChosen += one.count;
    group.judgements.push_back(one);
  }
  return out;
}

}  // namespace limen::analysis
