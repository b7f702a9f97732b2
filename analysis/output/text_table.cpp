// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limen::analysis {

size_t textWidth(const std::string& text) {
  return static_cast<size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string alignedText(const std::vector<std::vector<std::string>>& rows, const std::vector<size_t>& left,
                        const std::string& indent) {
  std::vector<size_t> widths;
  for (const auto& row : rows)
    for (size_t i = 0; i < row.size(); ++i) {
      if (widths.size() <= i) widths.push_back(0);
      widths[i] = std::max(widths[i], textWidth(row[i]));
    }
  std::string out;
  for (const auto& row : rows) {
    std::string line = indent;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - textWidth(row[i]), ' ');
      const bool isLeft = std::find(left.begin(), left.end(), i) != left.end();
      line += (i > 0 ? "  " : "") + (isLeft ? row[i] + blanks : blanks + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string percentText(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string intervalText(const std::optional<Interval>& interval, bool percent) {
  if (!interval || interval->low == interval->high) return "-";
  return percent ? fmt::format("{:.1f} to {:.1f} %", 100.0 * interval->low, 100.0 * interval->high)
                 : fmt::format("{:.3f} to {:.3f}", interval->low, interval->high);
}

std::string fixedText(const std::optional<double>& value, int digits) {
  if (!value || std::isnan(*value)) return "-";
  if (std::isinf(*value)) return *value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.{}f}", *value, digits);
}

std::string pText(const std::optional<double>& p) {
  if (!p) return "-";
  return *p < 0.0001 ? "< 0.0001" : fmt::format("{:.4f}", *p);
}

}  // namespace limen::analysis
