// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "analysis/study/published_comparison.h"

namespace limen::analysis {
namespace {

struct ValueRow {
  const ComparedStatistic* statistic;
  const ComparedValue* value;
};

}  // namespace

Result resultOf(const std::vector<PublishedComparison>& comparisons) {
  Result out;
  out.command = "published";
  for (const PublishedComparison& one : comparisons) {
    Section own;
    own.title = fmt::format("{}: what was published, and {} observers here ({})", one.protocol, one.observers,
                            one.data);
    own.fact(key(text("protocol")), one.protocol);
    own.fact(forData(integer("observers")), one.observers);
    own.fact(forData(flag("simulated")), one.simulated);
    own.fact(key(text("data")), one.data);
    std::vector<ValueRow> rows;
    for (const ComparedStatistic& statistic : one.statistics)
      for (const ComparedValue& value : statistic.values) rows.push_back({&statistic, &value});
    const auto of = [](auto member) {
      return [member](const ValueRow& row) { return row.statistic->*member; };
    };
    const auto value = [](auto member) {
      return [member](const ValueRow& row) { return row.value->*member; };
    };
    own.add(TableOf("statistics", "", rows)
                .add(text("part"), of(&ComparedStatistic::part))
                .add(text("statistic"), of(&ComparedStatistic::statistic))
                .add(text("quantity"), value(&ComparedValue::quantity))
                .add(text("published"), value(&ComparedValue::published))
                .add(forData(number("published_estimate")), value(&ComparedValue::printed))
                .add(text("estimate_text", "ours"), value(&ComparedValue::oursText))
                .add(forData(number("estimate")), value(&ComparedValue::ours))
                .add(forData(number("difference")),
                     [](const ValueRow& row) -> ResultCell {
                       if (!row.value->ours || !row.value->printed) return {};
                       return *row.value->ours - *row.value->printed;
                     })
                .add(ifAny(text("note")), of(&ComparedStatistic::note))
                .add(forData(text("source")), of(&ComparedStatistic::source)));
    if (!one.statistics.empty()) own.notes.push_back("published: " + one.statistics.front().source);
    own.notes.insert(own.notes.end(), one.notes.begin(), one.notes.end());
    out.sections.push_back(std::move(own));
  }
  return out;
}

}  // namespace limen::analysis
