// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/sweep/sweep.h"

namespace limen::analysis {

/// A printed table beside what this sweep measured of the same settings (`published` of the descriptor).
struct PrintedTable {
  /// How ratios to the base row compare. Ratios within 5 % of 1 count as 1.
  enum class Verdict {
    None,     ///< no base row, or one of the two has no ratio
    Agrees,   ///< all of ours go a way that a printed one goes: up, down or neither
    Partly,   ///< some of ours do
    Faint,    ///< none does, but one side hardly goes any way
    Differs,  ///< none does
  };
  struct Row {
    std::string name;
    std::string base;                                           ///< name of the base row; "": none
    std::vector<std::optional<double>> printed, printedRatios;  ///< by column
    std::vector<std::optional<double>> ours, ourRatios;         ///< by own column
    Verdict verdict = Verdict::None;
  };
  std::string title, source, device, note, unit, quantity;
  std::vector<std::string> columns;     ///< of the printed table
  std::vector<std::string> ownColumns;  ///< scenes with image size, and devices where there are several
  std::vector<Row> rows;
};

/// The tables of the sweep's experiment; cells that are missing leave gaps.
std::vector<PrintedTable> comparePrinted(const Sweep& sweep);
/// HTML section; "" if there is nothing to compare.
std::string renderPrinted(const std::vector<PrintedTable>& tables);
/// The same as CSV, long form: table, row, source (printed or measured), column, value, ratio.
std::string printedCsv(const std::vector<PrintedTable>& tables);

}  // namespace limen::analysis
