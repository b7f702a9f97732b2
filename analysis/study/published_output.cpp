// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study/published_comparison.h"

namespace limen::analysis {
namespace {

/// "67.71 % (sd 12.01 %)", "F(1,7) = 98.926, p < 0.0001", "tau_c 0.933, r 0.915", "8".
std::string valuesText(const ComparedStatistic& statistic, bool ours) {
  const std::vector<ComparedValue>& values = statistic.values;
  const auto text = [&](size_t i) { return ours ? values[i].oursText : values[i].published; };
  if (values.size() == 1) return text(0);
  if (values[0].quantity == "mean") return fmt::format("{} (sd {})", text(0), text(1));
  if (values[0].quantity != "F")
    return fmt::format("{} {}, {} {}", values[0].quantity, text(0), values[1].quantity, text(1));
  if (ours && !values[1].ours) return "-";
  const std::string p = text(3);
  const bool derived = !ours && text(0).find("derived") != std::string::npos;
  return fmt::format("{}p {}{}", derived ? "" : fmt::format("F({},{}) = {}, ", text(1), text(2), text(0)),
                     p[0] == '<' ? "" : "= ", p);
}

/// JSON and CSV hold no infinite F.
std::optional<double> finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> differenceOf(const ComparedValue& value) {
  const std::optional<double> ours = finite(value.ours);
  if (!ours || !value.printed) return {};
  return *ours - *value.printed;
}

}  // namespace

std::string toText(const std::vector<PublishedComparison>& comparisons) {
  std::string out;
  for (const PublishedComparison& one : comparisons) {
    out += fmt::format("\n{}: what was published, and {} observers here ({})\n", one.protocol, one.observers,
                       one.data);
    std::vector<std::vector<std::string>> table = {{"part", "statistic", "published", "ours"}};
    std::vector<std::string> remarks;
    for (const ComparedStatistic& statistic : one.statistics) {
      std::string ours = valuesText(statistic, true);
      if (!statistic.note.empty()) {
        // A reason that many statistics share stands once.
        auto known = std::find(remarks.begin(), remarks.end(), statistic.note);
        if (known == remarks.end()) known = remarks.insert(remarks.end(), statistic.note);
        ours += fmt::format(" [{}]", known - remarks.begin() + 1);
      }
      table.push_back({statistic.part, statistic.statistic, valuesText(statistic, false), ours});
    }
    out += alignedText(table, {0, 1, 2, 3});
    for (size_t i = 0; i < remarks.size(); ++i) out += fmt::format("  [{}] {}\n", i + 1, remarks[i]);
    if (!one.statistics.empty()) out += "  published: " + one.statistics.front().source + "\n";
    for (const std::string& note : one.notes) out += "  " + note + "\n";
  }
  return out;
}

nlohmann::json toJson(const std::vector<PublishedComparison>& comparisons) {
  nlohmann::json out = nlohmann::json::array();
  for (const PublishedComparison& one : comparisons) {
    nlohmann::json statistics = nlohmann::json::array();
    for (const ComparedStatistic& statistic : one.statistics) {
      nlohmann::json values = nlohmann::json::array();
      for (const ComparedValue& value : statistic.values)
        values.push_back({{"quantity", value.quantity},
                          {"published", value.published},
                          {"published_value", numberJson(value.printed)},
                          {"ours", numberJson(finite(value.ours))},
                          {"ours_text", value.oursText},
                          {"difference", numberJson(differenceOf(value))}});
      statistics.push_back({{"part", statistic.part},
                            {"statistic", statistic.statistic},
                            {"values", values},
                            {"note", statistic.note},
                            {"source", statistic.source}});
    }
    out.push_back({{"protocol", one.protocol},
                   {"observers", one.observers},
                   {"simulated", one.simulated},
                   {"data", one.data},
                   {"statistics", statistics},
                   {"notes", one.notes}});
  }
  return out;
}

std::string toCsv(const std::vector<PublishedComparison>& comparisons) {
  std::string out = csvLine({"protocol", "part", "statistic", "quantity", "published", "published_value",
                             "ours", "difference", "data", "note", "source"});
  for (const PublishedComparison& one : comparisons)
    for (const ComparedStatistic& statistic : one.statistics)
      for (const ComparedValue& value : statistic.values)
        out += csvLine({one.protocol, statistic.part, statistic.statistic, value.quantity, value.published,
                        cellText(value.printed), cellText(finite(value.ours)), cellText(differenceOf(value)),
                        one.data, statistic.note, statistic.source});
  return out;
}

}  // namespace limen::analysis
