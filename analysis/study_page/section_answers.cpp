// SPDX-License-Identifier: BSD-3-Clause
// Severity of what was noticed, and how long answers took.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/output/result_renderers.h"
#include "analysis/statistics/summary.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr int kBins = 24;

/// What single answers are grouped by in these figures: "change, dynamic".
std::string groupOf(const StudyAnswer& answer) {
  return std::string(answer.change ? "change" : "no change") +
         (answer.presentation.empty() ? "" : ", " + answer.presentation);
}

std::string outcomeOf(const StudyPart& part, const StudyAnswer& answer) {
  if (part.asksYesNo()) return answer.outcome == 1 ? "yes" : "no";
  if (part.isBinary()) return answer.outcome == 1 ? "right" : "wrong";
  return "all answers";
}

struct SeverityRow {
  std::string group;
  std::map<int, size_t> counts;
  double mean = 0.0;
};

/// How often each step was chosen by each group, as shares of the group.
void addSeverity(const StudyPage& page, size_t index, PageWriter& out) {
  const StudyPart& part = page.study.plan.parts[index];
  std::map<std::string, std::map<int, size_t>> groups;
  int most = 0, least = 1;
  for (const StudyAnswer& answer : page.study.answers)
    if (answer.part == index && answer.severity) {
      ++groups[groupOf(answer)][*answer.severity];
      most = std::max(most, *answer.severity);
      least = std::min(least, *answer.severity);
    }
  if (groups.empty()) return;
  const PartText* words = page.text.part(part.name);
  const std::vector<std::string> labels = words ? words->severityLabels : std::vector<std::string>{};
  most = std::max(most, static_cast<int>(labels.size()));
  const auto labelOf = [&](int step) {
    return step >= 1 && step <= static_cast<int>(labels.size()) ? labels[static_cast<size_t>(step - 1)]
                                                                : std::to_string(step);
  };
  Figure figure;
  figure.name = "severity_" + page.stem(part.name);
  figure.xTitle = "severity";
  figure.yTitle = "share of answers (%)";
  figure.description = "How often each step of severity was chosen, part " + part.name;
  figure.heightPx = 260 + static_cast<int>(groups.size() + 1) / 2 * 18;
  std::vector<std::pair<double, std::string>> tics;
  for (int step = least; step <= most; ++step) tics.emplace_back(step, labelOf(step));
  std::vector<SeverityRow> lines;
  figure.settings =
      namedTics("x", tics) + fmt::format("set xrange [{}:{}]\nset yrange [0:100]\n", least - 0.5, most + 0.5);
  const double width = 0.8 / static_cast<double>(groups.size());
  size_t series = 0;
  for (const auto& [name, counts] : groups) {
    double all = 0.0, sum = 0.0;
    for (const auto& [step, count] : counts)
      all += static_cast<double>(count), sum += step * static_cast<double>(count);
    std::vector<std::vector<double>> rows;
    lines.push_back({name, counts, sum / all});
    for (int step = least; step <= most; ++step) {
      const auto found = counts.find(step);
      const size_t count = found == counts.end() ? 0 : found->second;
      const double share = 100.0 * static_cast<double>(count) / all;
      rows.push_back({step + (static_cast<double>(series) + 0.5) * width - 0.4, share, width * 0.9,
                      static_cast<double>(count)});
    }
    figure.plots.push_back(addBlock(figure, name + ": drawn at, share in %, width, answers", rows) +
                           " using 1:2:3 with boxes fs solid 0.6 lw 1 " + seriesColour(series) + " title " +
                           gnuplotQuoted(name));
    ++series;
  }
  out.figure(
      std::move(figure),
      fmt::format(
          "Part {}: severity of what was noticed, as shares of the answers that were asked for it.{}",
          part.name,
          words && !words->severityQuestion.empty() ? " Question: “" + words->severityQuestion + "”" : ""));
  TableOf table("severity", "", lines);
  table.add(forData(text("part")), [&](const SeverityRow&) { return part.name; })
      .add(text("trials"), &SeverityRow::group);
  for (int step = least; step <= most; ++step)
    table.add(integer(fmt::format("step_{}", step), labelOf(step)), [step](const SeverityRow& row) {
      const auto found = row.counts.find(step);
      return found == row.counts.end() ? 0 : found->second;
    });
  const ResultTable made = table.add(number("estimate", "mean", 2), &SeverityRow::mean);
  const std::string file = "tables/severity_" + page.stem(part.name) + ".csv";
  out.table(made, "Severity in part " + part.name + ": numbers of answers, and the mean step.", file);
  out.file(file, toCsv(made), "how often each step of severity was chosen, part " + part.name);
}

struct TimesRow {
  std::string answer;
  std::vector<double> times;
};

void addReactionTimes(const StudyPage& page, size_t index, PageWriter& out) {
  const StudyPart& part = page.study.plan.parts[index];
  std::map<std::string, std::vector<double>> groups;
  double least = 1e300, most = 0.0;
  for (const StudyAnswer& answer : page.study.answers) {
    if (answer.part != index || !(answer.reactionTimeS > 0.0) || !std::isfinite(answer.reactionTimeS))
      continue;
    groups[outcomeOf(part, answer)].push_back(answer.reactionTimeS);
    least = std::min(least, answer.reactionTimeS);
    most = std::max(most, answer.reactionTimeS);
  }
  if (groups.empty()) return;
  if (most < 1.01 * least) least *= 0.5, most *= 2.0;
  Figure figure;
  figure.name = "reaction_times_" + page.stem(part.name);
  figure.xTitle = "time from question to answer (s)";
  figure.yTitle = "answers";
  figure.heightPx = 260 + 18;
  figure.description = "Distribution of reaction times, part " + part.name;
  figure.settings =
      "set logscale x\nset yrange [0:*]\nset xtics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, "
      "1000)\n" +
      fmt::format("set xrange [{}:{}]\n", shortestNumber(least * 0.9), shortestNumber(most * 1.1));
  std::vector<TimesRow> lines;
  size_t series = 0;
  for (const auto& [name, times] : groups) {
    std::vector<std::vector<double>> rows;
    const double step = std::log(most / least) / kBins;
    std::vector<size_t> counts(kBins);
    for (const double time : times)
      ++counts[static_cast<size_t>(
          std::clamp(static_cast<int>(std::log(time / least) / step), 0, kBins - 1))];
    for (int bin = 0; bin < kBins; ++bin)
      for (const int end : {bin, bin + 1})
        rows.push_back({least * std::exp(end * step), static_cast<double>(counts[static_cast<size_t>(bin)])});
    figure.plots.push_back(addBlock(figure, name + ": time in s, answers in its bin", rows) +
                           " using 1:2 with lines title " + gnuplotQuoted(name) + " " +
                           seriesColour(series++) + " lw 1.5");
    lines.push_back({name, times});
  }
  out.figure(std::move(figure),
             fmt::format("Part {}: time from question to answer, in {} bins that are even in the logarithm.",
                         part.name, kBins));
  const auto at = [](double p) { return [p](const TimesRow& row) { return quantile(row.times, p); }; };
  const ResultTable made =
      TableOf("reaction_times", "", lines)
          .add(forData(text("part")), [&](const TimesRow&) { return part.name; })
          .add(text("answer"), &TimesRow::answer)
          .add(integer("answers"), [](const TimesRow& row) { return row.times.size(); })
          .add(number("median_s", "median", 2),
               [](const TimesRow& row) { return summarise(row.times).median; })
          .add(number("quartile_1_s", "25 %", 2), at(0.25))
          .add(number("quartile_3_s", "75 %", 2), at(0.75))
          .add(number("p95_s", "95 %", 2), [](const TimesRow& row) { return summarise(row.times).p95; })
          .add(number("mean_s", "mean", 2), [](const TimesRow& row) { return summarise(row.times).mean; });
  const std::string file = "tables/reaction_times_" + page.stem(part.name) + ".csv";
  out.table(made, "Time from question to answer in part " + part.name + ", in seconds.", file);
  out.file(file, toCsv(made), "reaction times by answer, part " + part.name);
}

}  // namespace

void addAnswers(const StudyPage& page, PageWriter& out) {
  const bool graded = std::any_of(page.study.answers.begin(), page.study.answers.end(),
                                  [](const StudyAnswer& answer) { return answer.severity.has_value(); });
  out.openSection("answers", graded ? "Severity and reaction times" : "Reaction times");
  for (size_t part = 0; part < page.study.plan.parts.size(); ++part) addSeverity(page, part, out);
  for (size_t part = 0; part < page.study.plan.parts.size(); ++part) addReactionTimes(page, part, out);
  out.closeSection();
}

}  // namespace limen::analysis
