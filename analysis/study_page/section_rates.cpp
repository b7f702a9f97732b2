// SPDX-License-Identifier: BSD-3-Clause
// Detection rates by condition: the factor with the most numeric levels along the axis, all others as series.
// How often a change was reported: figure and tables of each part, catch trials, published values beside.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {

namespace {

// Shares of the room between two levels: what series stand apart, and what all of them take at most.
constexpr double kApart = 0.2, kMostSpread = 0.5;

bool isNumeric(const StudyFactor& factor) {
  return factor.levels.size() > 1 &&
         std::all_of(factor.levels.begin(), factor.levels.end(),
                     [](const std::string& level) { return finiteNumber(level).has_value(); });
}

size_t axisFactor(const std::vector<StudyFactor>& factors) {
  size_t best = 0;
  const auto rank = [&](size_t i) { return std::make_pair(isNumeric(factors[i]), factors[i].levels.size()); };
  for (size_t i = 1; i < factors.size(); ++i)
    if (rank(i) > rank(best)) best = i;
  return best;
}

/// Where the levels of the axis' factor stand.
struct RateAxis {
  bool numeric = false, logarithmic = false;
  std::vector<double> places;

  /// `shift`: share of the room between two levels.
  double shifted(size_t level, double shift) const {
    double room = 1e300;
    for (size_t i = 0; i + 1 < places.size(); ++i) {
      const double a = std::min(places[i], places[i + 1]), b = std::max(places[i], places[i + 1]);
      room = std::min(room, logarithmic ? std::log(b / a) : b - a);
    }
    if (places.size() < 2) room = 1.0;
    return logarithmic ? places[level] * std::exp(shift * room) : places[level] + shift * room;
  }
};

RateAxis axisOf(const StudyFactor& factor) {
  RateAxis out;
  out.numeric = isNumeric(factor);
  for (size_t i = 0; i < factor.levels.size(); ++i)
    out.places.push_back(out.numeric ? *finiteNumber(factor.levels[i]) : static_cast<double>(i + 1));
  if (!out.numeric) return out;
  std::vector<double> sorted = out.places;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    // Two ways to write one number cannot share a place.
    out.numeric = false;
    for (size_t i = 0; i < out.places.size(); ++i) out.places[i] = static_cast<double>(i + 1);
    return out;
  }
  if (sorted.size() < 3 || sorted.front() <= 0.0) return out;
  // Logarithmic if steps are more alike in the logarithm than as they are.
  double least = 1e300, most = 0.0, leastLog = 1e300, mostLog = 0.0;
  for (size_t i = 0; i + 1 < sorted.size(); ++i) {
    const double step = sorted[i + 1] - sorted[i], ratio = std::log(sorted[i + 1] / sorted[i]);
    least = std::min(least, step), most = std::max(most, step);
    leastLog = std::min(leastLog, ratio), mostLog = std::max(mostLog, ratio);
  }
  out.logarithmic = mostLog / leastLog < most / least;
  return out;
}

void setAxis(Figure& figure, const RateAxis& axis, const StudyFactor& factor) {
  std::vector<std::pair<double, std::string>> labels;
  size_t longest = 0;
  for (size_t i = 0; i < factor.levels.size(); ++i) {
    labels.emplace_back(axis.places[i], levelTitle(factor.levels[i]));
    longest = std::max(longest, factor.levels[i].size());
  }
  const bool turned = longest * factor.levels.size() > 44;
  figure.settings += namedTics("x", labels, turned);
  if (axis.logarithmic) figure.settings += "set logscale x\n";
  const auto [low, high] = std::minmax_element(axis.places.begin(), axis.places.end());
  const auto lowAt = static_cast<size_t>(low - axis.places.begin()),
             highAt = static_cast<size_t>(high - axis.places.begin());
  figure.settings +=
      fmt::format("set xrange [{}:{}]\nset yrange [0:100]\nset ytics 20\n",
                  shortestNumber(axis.shifted(lowAt, -0.6)), shortestNumber(axis.shifted(highAt, 0.6)));
  if (turned) figure.heightPx += 30 + static_cast<int>(std::min<size_t>(longest, 24)) * 3;
}

}  // namespace

std::optional<Figure> rateFigure(const StudyPage& page, const StudyPart& part) {
  if (part.factors.empty()) return {};
  const size_t main = axisFactor(part.factors);
  const StudyFactor& factor = part.factors[main];
  const RateAxis axis = axisOf(factor);
  // By the levels of the other factors, in the protocol's order.
  std::map<std::vector<size_t>, std::vector<std::pair<size_t, const RateRow*>>> series;
  const RateScope scope = part.factors.size() > 1 ? RateScope::Condition : RateScope::Level;
  for (const RateRow& row : page.rates.rows) {
    if (row.part != part.name || row.scope != scope || !row.change || !row.condition.count(factor.name))
      continue;
    std::vector<size_t> others = levelsOf(part, row.condition);
    const size_t level = others[main];
    if (level >= factor.levels.size()) continue;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(main));
    series[others].emplace_back(level, &row);
  }
  if (series.empty()) return {};
  Figure figure;
  figure.name = "rates_" + page.stem(part.name);
  figure.xTitle = part.titleOf(factor.name);
  figure.yTitle = part.asksYesNo() ? "reported a change (%)" : "right answers (%)";
  figure.description = figure.yTitle + " against " + figure.xTitle + ", part " + part.name;
  figure.heightPx += static_cast<int>((series.size() + 1) / 2) * 18;
  setAxis(figure, axis, factor);
  const auto last = static_cast<double>(series.size() - 1);
  const double apart = std::min(kApart, kMostSpread / std::max(last, 1.0));
  size_t number = 0;
  int64_t least = std::numeric_limits<int64_t>::max(), most = 0;
  for (auto& [others, rows] : series) {
    std::sort(rows.begin(), rows.end(),
              [&](const auto& a, const auto& b) { return axis.places[a.first] < axis.places[b.first]; });
    std::vector<std::string> words;
    for (const auto& [name, level] : rows.front().second->condition)
      if (name != factor.name) words.push_back(levelTitle(level));
    const double shift = (static_cast<double>(number) - 0.5 * last) * apart;
    std::vector<std::vector<double>> data;
    for (const auto& [level, row] : rows) {
      const MeanOverSubjects& mean = row->overObservers;
      const Interval interval = mean.interval.value_or(Interval{mean.mean, mean.mean});
      data.push_back({axis.shifted(level, shift), 100.0 * mean.mean, 100.0 * interval.low,
                      100.0 * interval.high, axis.places[level], static_cast<double>(row->pooled.trials)});
      least = std::min(least, row->pooled.trials), most = std::max(most, row->pooled.trials);
    }
    const std::string block =
        addBlock(figure, join(words) + ": drawn at, mean in %, interval from, to, level, trials", data);
    figure.plots.push_back(block + " using 1:2:3:4 with yerrorbars notitle pt 0 lw 1.2 " +
                           seriesColour(number));
    figure.plots.push_back(
        block + (axis.numeric ? " using 1:2 with linespoints " : " using 1:2 with points ") +
        (words.empty() ? "notitle" : "title " + gnuplotQuoted(join(words))) + " " + seriesLook(number));
    ++number;
  }
  figure.xTitle += ", " + (least == most ? std::to_string(most) : fmt::format("{} to {}", least, most)) +
                   " trials a point";
  const auto [low, high] = std::minmax_element(axis.places.begin(), axis.places.end());
  for (const RateRow& row : page.rates.rows)
    if (row.part == part.name && row.scope == RateScope::Part && !row.change) {
      const double rate = 100.0 * row.overObservers.mean;
      figure.plots.push_back(addBlock(figure, "no change: level, mean in %", {{*low, rate}, {*high, rate}}) +
                             " using 1:2 with lines title " + gnuplotQuoted("no change") + " " +
                             kReferenceLook);
    }
  if (!part.asksYesNo() && part.alternatives > 1) {
    const double chance = 100.0 / part.alternatives;
    figure.plots.push_back(addBlock(figure, "chance: level, %", {{*low, chance}, {*high, chance}}) +
                           " using 1:2 with lines title 'chance' " + kReferenceLook);
  }
  return figure;
}

namespace {

/// The rows of one scope; catch trials only of the whole part and by what they showed.
ResultTable rowsOf(const ResultTable& rates, const std::string& scope) {
  ResultTable out = rates;
  for (Column& column : out.columns) column.cells.clear();
  for (size_t row = 0; row < rates.rows(); ++row) {
    std::string own;
    bool change = true, byCatch = false;
    for (const Column& column : rates.columns) {
      if (column.name == "catch_shows") byCatch = !column.cells[row].empty();
      if (column.name == "scope") own = cellText(column, column.cells[row]);
      if (column.name == "change") change = std::get<bool>(column.cells[row].value());
    }
    if (own != scope || !(change || byCatch || scope == "part")) continue;
    for (size_t i = 0; i < out.columns.size(); ++i)
      out.columns[i].cells.push_back(rates.columns[i].cells[row]);
  }
  return out;
}

void addTables(const std::string& part, const Section& section, PageWriter& out) {
  const ResultTable& rates = section.table("rates");
  for (const auto& [scope, what] : {std::pair{"part", ", with and without a change."},
                                    std::pair{"level", " by level of one factor, all others together."},
                                    std::pair{"condition", " by condition."}})
    out.table(rowsOf(rates, scope), "Detection rates of part " + part + what, "tables/rates.csv");
}

}  // namespace

void addRates(const StudyPage& page, PageWriter& out) {
  if (page.rates.rows.empty() && page.rates.notes.empty()) return;
  out.openSection("rates", "Detection rates");
  out.list(page.rates.notes);
  const Result result = resultOf(page.rates);
  for (const StudyPart& part : page.study.plan.parts) {
    if (std::none_of(page.rates.rows.begin(), page.rates.rows.end(),
                     [&](const RateRow& row) { return row.part == part.name; }))
      continue;
    if (page.study.plan.parts.size() > 1) out.heading("Part " + part.name);
    if (std::optional<Figure> figure = rateFigure(page, part)) {
      const std::string caption = fmt::format(
          "Part {}: {} by {}. Mean over {} of their own rates; bars are 95 % intervals over observers.",
          part.name, part.asksYesNo() ? "reported changes" : "right answers",
          part.titleOf(part.factors[axisFactor(part.factors)].name),
          counted(page.study.observers.size(), "observer"));
      out.figure(std::move(*figure), caption);
    }
    const auto section = std::find_if(result.sections.begin(), result.sections.end(),
                                      [&](const Section& one) { return one.title == "part " + part.name; });
    addTables(part.name, *section, out);
  }
  if (!page.rates.rows.empty()) {
    out.paragraph(
        "Mean, SD and 95 % interval are over observers, of their own rates; intervals are t intervals on the "
        "logit "
        "scale, which stay between 0 and 100 %. Those within observers (Cousineau-Morey) are for comparing "
        "levels or "
        "conditions and say nothing of the mean itself; next to 0 and 100 % they may be the wider ones. "
        "Pooled trials of one observer are not independent, "
        "so that the interval of "
        "pooled trials is too narrow. A dash: cannot be told, or of no width, which is no certainty.");
    out.file("tables/rates.csv", toCsv(result.sections),
             "detection rates by part, level, condition and observer");
  }
  out.closeSection();
}

}  // namespace limen::analysis
