// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <algorithm>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/output/chart_file.h"
#include "analysis/output/text_output.h"
#include "analysis/pair_scales/scale.h"
#include "experiments/base/error.h"
#include "experiments/base/gnuplot.h"

namespace limen::analysis {

namespace {

std::string modelText(const ScaleSetting& setting) {
  std::string out = "Bradley and Terry's model: P(i over j) = 1 / (1 + exp(s_j - s_i)), maximum likelihood";
  if (setting.model != PairwiseModel::kBradleyTerry)
    out = std::string("Thurstone's case V: P(i over j) = Phi(s_i - s_j), ") +
          (setting.model == PairwiseModel::kThurstoneLeastSquares ? "least squares (Mosteller 1951)"
                                                                  : "maximum likelihood");
  return out + "; " + (setting.reference.empty() ? "values sum to 0" : "'" + setting.reference + "' is 0") +
         "; 1 apart: " + percentText(predictPreference(setting.model, 1.0)) + " prefer the upper";
}

ResultTable itemTable(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  return TableOf("items", "", scale.items)
      .add(text("item"), &ScaledItem::name)
      .add(count("chosen", "judged"), countOf(&ScaledItem::chosen, &ScaledItem::judged))
      .add(number("estimate", "value"), &ScaledItem::value)
      .add(interval("", level), &ScaledItem::interval)
      .add(number("standard_error", "error"), &ScaledItem::standardError)
      .add(ifAny(interval("bootstrap", level + " bootstrap")),
           at(&ScaledItem::bootstrap, &ResampledInterval::interval))
      .add(ifAny(share("preferred", "over " + setting.reference)), &ScaledItem::preferred)
      .add(ifAny(shareInterval("preferred",
                               scale.bootstrap == ScaleBootstrap::None ? level : level + " bootstrap")),
           &ScaledItem::preferredInterval);
}

ResultTable stepTable(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  return TableOf("steps", "neighbours on the scale", scale.steps)
      .add(text("upper"), &ItemStep::upper)
      .add(text("lower", "minus"), &ItemStep::lower)
      .add(number("estimate", "difference"), &ItemStep::difference)
      .add(interval("", level), &ItemStep::interval)
      .add(number("standard_error", "error"), &ItemStep::standardError)
      .add(number("z", "", 2), &ItemStep::z)
      .add(probability(), &ItemStep::p)
      .add(ifAny(probability("p_holm", "p (Holm)")), &ItemStep::holm)
      .add(share("preferred"), &ItemStep::preferred)
      .add(ifAny(count("chosen", "judged")), countOf(&ItemStep::chosen, &ItemStep::judged))
      .add(ifAny(interval("bootstrap", level + " bootstrap")),
           at(&ItemStep::bootstrap, &ResampledInterval::interval));
}

ResultTable consistencyTable(const ItemScale& scale) {
  const auto items = static_cast<int64_t>(scale.items.size());
  const auto ifJudged = [](auto member) { return when(&SubjectConsistency::rounds, member); };
  return TableOf(
             "consistency",
             scale.consistency.empty()
                 ? ""
                 : fmt::format("circular triads (Kendall and Babington Smith 1940): at most {}, {:.4g} of "
                               "answers at random",
                               mostCircularTriads(items), expectedCircularTriads(items)),
             scale.consistency)
      .add(text("subject"), &SubjectConsistency::subject)
      .add(integer("rounds"), &SubjectConsistency::rounds)
      .add(significant("circular_triads"), ifJudged(&SubjectConsistency::triads))
      .add(number("consistency"), ifJudged(&SubjectConsistency::coefficient));
}

void addNotes(const ItemScale& scale, Section& out) {
  if (!scale.fit.note.empty()) out.notes.push_back("penalised: " + scale.fit.note);
  if (scale.penalised > 0)
    out.notes.push_back(
        fmt::format("{} samples of the bootstrap were unbounded, and penalised", scale.penalised));
  if (scale.skipped > 0)
    out.notes.push_back(fmt::format(
        "{} samples of the bootstrap did not connect all items, and were left out", scale.skipped));
  if (scale.fit.df == 0) out.notes.push_back("as many values as pairs: no goodness of fit");
  if (!scale.consistency.empty() &&
      std::none_of(scale.consistency.begin(), scale.consistency.end(),
                   [](const SubjectConsistency& one) { return one.rounds > 0; }))
    out.notes.push_back("nobody judged each pair exactly once: no circular triads");
  out.notes.insert(out.notes.end(), scale.notes.begin(), scale.notes.end());
}

/// What the bars are.
std::string barsText(const ItemScale& scale, const ScaleSetting& setting) {
  const std::string level = levelText(setting.bootstrap.level);
  switch (scale.bootstrap) {
    case ScaleBootstrap::Subjects:
      return level + " bootstrap over subjects";
    case ScaleBootstrap::Judgements:
      return level + " bootstrap over judgements";
    case ScaleBootstrap::None:
      break;
  }
  return level + ", value +- z error";
}

}  // namespace

Section sectionOf(const ItemScale& scale, const ScaleSetting& setting) {
  Section out;
  out.title = scale.name;
  const PairwiseScale& fit = scale.fit;
  const bool drawn = scale.bootstrap != ScaleBootstrap::None;
  out.fact(key(text("group")), scale.name);
  out.fact(integer("judgements"), scale.judgements);
  out.fact(integer("subjects"), scale.subjects);
  out.fact(integer("pairs_judged"), fit.pairsJudged);
  out.fact(number("deviance"), fit.deviance);
  out.fact(number("pearson", "Pearson's X²"), fit.pearson);
  out.fact(integer("df"), fit.df);
  out.fact(ifAny(probability("deviance_p", "p (deviance)")), fit.devianceP);
  out.fact(ifAny(probability("pearson_p", "p (Pearson)")), fit.pearsonP);
  out.fact(forData(number("log_likelihood")), fit.logLikelihood);
  out.fact(forData(flag("penalised")), fit.penalised);
  out.fact(forData(text("note")), fit.note);
  if (drawn) {
    out.fact(text("bootstrap_over"), scale.bootstrap == ScaleBootstrap::Subjects ? "subjects" : "judgements");
    out.fact(integer("samples"), setting.bootstrap.samples);
    out.fact(integer("seed"), setting.bootstrap.seed);
    out.fact(forData(integer("samples_penalised")), scale.penalised);
    out.fact(forData(integer("samples_skipped")), scale.skipped);
  }
  if (const std::optional<Rate>& first = scale.firstChosen) {
    out.fact(count("first_chosen", "first_judged", "shown first and chosen"),
             CountOf{first->successes, first->trials});
    out.fact(forPeople(share("", "share")), first->rate);
    out.fact(shareInterval("first_chosen", "95 % (Wilson)"), first->wilson);
  }
  out.add(itemTable(scale, setting));
  out.add(stepTable(scale, setting));
  out.add(consistencyTable(scale));
  addNotes(scale, out);
  return out;
}

Result resultOf(const Scales& scales) {
  const ScaleSetting& setting = scales.setting;
  Result out;
  out.command = "scale";
  out.head.fact(forData(text("model")), toText(setting.model));
  out.head.fact(forData(number("level")), setting.bootstrap.level);
  out.head.fact(forData(text("reference")),
                setting.reference.empty() ? ResultCell() : ResultCell(setting.reference));
  for (const ItemScale& scale : scales.groups) out.sections.push_back(sectionOf(scale, setting));
  out.notes.push_back(modelText(setting));
  out.notes.insert(out.notes.end(), scales.notes.begin(), scales.notes.end());
  out.notes.push_back(
      levelText(setting.bootstrap.level) +
      " beside an error: value +- z error, from the inverse Hessian (least squares: delta "
      "method), which takes judgements as independent. Those of one subject are not: a bootstrap "
      "over subjects is the one to report then");
  out.notes.push_back(
      "p (Holm): adjusted for the neighbours of a scale, whose order comes of the same judgements");
  out.notes.push_back(kDashNote);
  return out;
}

void drawScales(const Scales& scales, const std::string& path) {
  const ChartFile file(path);
  if (scales.groups.empty()) throw Error("there is nothing to draw", path);
  const ScaleSetting& setting = scales.setting;
  const PanelGrid grid = arrangePanels(scales.groups.size());
  size_t most = 0;
  double low = 0.0, high = 0.0;
  for (const ItemScale& scale : scales.groups) {
    most = std::max(most, scale.items.size());
    for (const ScaledItem& item : scale.items) {
      const auto bar = item.bootstrap && item.bootstrap->interval ? item.bootstrap->interval : item.interval;
      low = std::min({low, item.value, bar ? bar->low : item.value});
      high = std::max({high, item.value, bar ? bar->high : item.value});
    }
  }
  const double margin = high > low ? 0.05 * (high - low) : 1.0;
  const double height = std::max(0.5, 0.25 + 0.07 * static_cast<double>(most));
  const bool single = scales.groups.size() == 1;
  std::string script =
      file.head((single ? 1.0 : 0.85) * static_cast<double>(grid.columns),
                height * static_cast<double>(grid.rows)) +
      fmt::format(
          "set xrange [{}:{}]\nset key off\nset grid ytics lc rgb '#DDDDDD' dt 1\nset tics noenhanced\n"
          "set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#999999'\n",
          low - margin, high + margin);
  const std::string zero = setting.reference.empty() ? "values sum to 0" : setting.reference + " is 0";
  const std::string kind = fmt::format("{}; {}", toText(setting.model), zero);
  if (!single)
    script += fmt::format("set multiplot layout {},{} title {} noenhanced\n", grid.rows, grid.columns,
                          gnuplotQuoted(kind));
  std::string data;
  size_t block = 0;
  for (const ItemScale& scale : scales.groups) {
    std::string names;
    for (size_t i = 0; i < scale.items.size(); ++i) {
      const ScaledItem& item = scale.items[i];
      const auto drawn = boundsOf(item.bootstrap);
      const Interval bar = drawn ? *drawn : item.interval.value_or(Interval{item.value, item.value});
      const size_t row = scale.items.size() - i;
      data += fmt::format("{} {} {} {}\n", item.value, row, bar.low, bar.high);
      names += fmt::format("{}{} {}", i ? ", " : "", gnuplotTick(item.name), row);
    }
    data += "\n\n";
    const std::string bars = barsText(scale, setting);
    script += "set title " + gnuplotQuoted(single ? "" : scale.name + " (" + bars + ")") +
              " noenhanced\nset xlabel " +
              gnuplotQuoted(single ? "scale value (" + kind + "; " + bars + ")" : "scale value") +
              " noenhanced\nset ytics (" + names + ")\n" +
              fmt::format(
                  "set yrange [0.4:{}.6]\nplot {} index {} using 1:2:3:4 with xerrorbars pt 7 ps 0.9 lw "
                  "1.5 lc rgb '{}'\n",
                  scale.items.size(), file.data(), block++, kChartColours[0]);
  }
  if (!single) script += "unset multiplot\n";
  file.draw(script, data);
}

}  // namespace limen::analysis
