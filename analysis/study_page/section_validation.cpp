// SPDX-License-Identifier: BSD-3-Clause
// Rates against predictors, the link, calibration and receiver operating characteristics.
// How well stored predictions fit the answers: tables; the figures are in validation_figures.cpp.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/gnuplot.h"
#include "experiments/base/text.h"

namespace limen::analysis {

namespace {

constexpr size_t kCurves = 6;     // of ROC figures
constexpr int kCurveSteps = 120;  // of a fitted link

/// Scenarios by how they were presented; static first, as in tables.
std::map<std::string, std::vector<const Scenario*>> kindsOf(const PartValidation& part) {
  std::map<std::string, std::vector<const Scenario*>> out;
  for (const Scenario& scenario : part.scenarios)
    out[scenario.presentation.empty() ? "all" : scenario.presentation].push_back(&scenario);
  return out;
}

/// Points of one predictor with their rates and Wilson's intervals; adds a plot for each kind of scenario.
/// Returns the least and the largest prediction; nothing is added without any.
std::optional<Interval> addScenarios(Figure& figure, const PartValidation& part,
                                     const std::string& predictor) {
  std::optional<Interval> range;
  size_t number = 0;
  for (const auto& [kind, scenarios] : kindsOf(part)) {
    std::vector<std::vector<double>> rows;
    for (const Scenario* scenario : scenarios) {
      const auto value = scenario->predictors.find(predictor);
      if (value == scenario->predictors.end() || !std::isfinite(value->second)) continue;
      const Interval wilson = wilsonInterval(scenario->yes, scenario->trials);
      rows.push_back({value->second, 100.0 * scenario->rate, 100.0 * wilson.low, 100.0 * wilson.high});
      range = range ? Interval{std::min(range->low, value->second), std::max(range->high, value->second)}
                    : Interval{value->second, value->second};
    }
    if (!rows.empty()) {
      const std::string block = addBlock(figure, kind + ": prediction, rate in %, interval from, to", rows);
      figure.plots.push_back(block + " using 1:2:3:4 with yerrorbars notitle pt 0 lw 1 " +
                             seriesColour(number));
      figure.plots.push_back(block + " using 1:2 with points title " + gnuplotQuoted(kind) + " " +
                             seriesColour(number) + (number == 0 ? " pt 7 ps 0.7" : " pt 4 ps 0.9 lw 1.5"));
    }
    ++number;
  }
  return range;
}

/// 1, 2 or 5 times a power of ten, so that a range has four to ten steps.
double roundStep(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 4.0)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= range / 4.0) return digit * power;
  return power;
}

/// Few enough tics for long numbers.
std::string rangeSettings(const Interval& range) {
  const bool wide = range.high > range.low;
  const double margin = wide ? 0.06 * (range.high - range.low) : std::max(1.0, std::abs(range.low)) * 0.1;
  const double low = range.low - margin, high = range.high + margin;
  return fmt::format("set xrange [{}:{}]\nset xtics {}\nset yrange [0:100]\n", shortestNumber(low),
                     shortestNumber(high), shortestNumber(2.0 * roundStep(0.5 * (high - low))));
}

void addScatter(const StudyPage& page, const PartValidation& part, const std::string& predictor,
                const std::string& meaning, PageWriter& out) {
  Figure figure;
  figure.name = "rate_by_" + predictor + "_" + page.stem(part.part);
  figure.xTitle = predictor;
  figure.yTitle = "reported a change (%)";
  figure.widthPx = 360;
  figure.heightPx = 290;
  figure.description = "Detection rate against " + predictor + ", part " + part.part;
  const std::optional<Interval> range = addScenarios(figure, part, predictor);
  if (!range) return;
  figure.settings = rangeSettings(*range);
  out.figure(std::move(figure), fmt::format("Part {}: rates against {}, {}.", part.part, predictor, meaning));
}

void addLink(const StudyPage& page, const PartValidation& part, PageWriter& out) {
  Figure figure;
  figure.name = "link_" + page.stem(part.part);
  figure.widthPx = 360;
  figure.xTitle = "rating R";
  figure.yTitle = "reported a change (%)";
  figure.description = "Detection rate against the rating, with the fitted link, part " + part.part;
  const std::optional<Interval> range = addScenarios(figure, part, "rating");
  if (!range) return;
  figure.settings = rangeSettings(*range);
  if (part.link.refit) {
    std::vector<std::vector<double>> curve;
    const double margin = 0.06 * (range->high - range->low);
    for (int i = 0; i <= kCurveSteps; ++i) {
      const double rating = range->low - margin + (range->high - range->low + 2.0 * margin) * i / kCurveSteps;
      curve.push_back({rating, 100.0 * part.link.refit->probability(rating)});
    }
    figure.plots.push_back(addBlock(figure, "fitted link: rating, probability in %", curve) +
                           " using 1:2 with lines title 'fitted' " + seriesColour(2) + " lw 1.5");
  }
  std::set<std::pair<double, double>> predicted;
  for (const Scenario& scenario : part.scenarios) {
    const auto rating = scenario.predictors.find("rating"),
               probability = scenario.predictors.find("detection_probability");
    if (rating != scenario.predictors.end() && probability != scenario.predictors.end())
      predicted.insert({rating->second, 100.0 * probability->second});
  }
  if (!predicted.empty()) {
    std::vector<std::vector<double>> rows;
    for (const auto& [rating, probability] : predicted) rows.push_back({rating, probability});
    figure.plots.push_back(addBlock(figure, "as predicted: rating, probability in %", rows) +
                           " using 1:2 with lines title 'as predicted' " + kReferenceLook);
  }
  out.figure(
      std::move(figure),
      fmt::format(
          "Part {}: the link from rating to detection, fitted to these answers, and as the prediction was "
          "made with. Bars as above.",
          part.part));
}

void addCalibration(const StudyPage& page, const PartValidation& part, PageWriter& out) {
  if (!part.calibration) return;
  Figure figure;
  figure.name = "calibration_" + page.stem(part.part);
  figure.xTitle = "predicted probability (%)";
  figure.yTitle = "reported a change (%)";
  figure.key = false;
  figure.widthPx = 360;
  figure.description = "Observed share of reports against the predicted probability, part " + part.part;
  figure.settings = "set xrange [0:100]\nset yrange [0:100]\n";
  std::vector<std::vector<double>> rows;
  for (const CalibrationBin& bin : part.calibration->bins)
    if (bin.trials > 0 && bin.wilson)
      rows.push_back({100.0 * bin.meanPrediction, 100.0 * bin.observed, 100.0 * bin.wilson->low,
                      100.0 * bin.wilson->high});
  if (rows.empty()) return;
  figure.plots.push_back(addBlock(figure, "perfect calibration", {{0.0, 0.0}, {100.0, 100.0}}) +
                         std::string(" using 1:2 with lines ") + kReferenceLook);
  const std::string block = addBlock(figure, "mean prediction in %, observed in %, interval from, to", rows);
  figure.plots.push_back(block + " using 1:2:3:4 with yerrorbars pt 0 lw 1.2 " + seriesColour(0));
  figure.plots.push_back(block + " using 1:2 with linespoints " + seriesLook(0));
  out.figure(std::move(figure), fmt::format("Part {}: calibration of detection_probability in bins of 10 %, "
                                            "with Wilson's 95 % intervals. On the "
                                            "dashed line predictions hold.",
                                            part.part));
}

void addRoc(const StudyPage& page, const PartValidation& part, PageWriter& out) {
  if (part.areas.empty()) return;
  // The rating and those of the others that tell trials apart best.
  std::vector<const TrialArea*> shown;
  for (const TrialArea& area : part.areas) shown.push_back(&area);
  std::stable_sort(shown.begin(), shown.end(), [](const TrialArea* a, const TrialArea* b) {
    const bool ratingA = a->predictor == "rating", ratingB = b->predictor == "rating";
    return ratingA != ratingB ? ratingA : a->area.area > b->area.area;
  });
  if (shown.size() > kCurves) shown.resize(kCurves);
  Figure figure;
  figure.name = "roc_" + page.stem(part.part);
  figure.xTitle = "not reported, above the threshold (%)";
  figure.yTitle = "reported, above it (%)";
  figure.widthPx = 360;
  figure.heightPx = 340 + static_cast<int>(shown.size()) * 18;  // a key of one column
  figure.description = "Receiver operating characteristics of predictors, part " + part.part;
  figure.settings = "set key maxcols 1\nset xrange [0:100]\nset yrange [0:100]\n";
  size_t number = 0;
  for (const TrialArea* area : shown) {
    std::vector<double> scores;
    std::vector<int> outcomes;
    for (const Scenario& scenario : part.scenarios)
      for (int64_t i = 0; i < scenario.trials; ++i) {
        scores.push_back(scenario.predictors.at(area->predictor));
        outcomes.push_back(i < scenario.yes ? 1 : 0);
      }
    std::vector<std::vector<double>> rows;
    for (const RocPoint& point : rocPoints(scores, outcomes))
      rows.push_back({100.0 * point.falseAlarmRate, 100.0 * point.hitRate});
    figure.plots.push_back(addBlock(figure, area->predictor + ": false alarms in %, hits in %", rows) +
                           " using 1:2 with lines title " + gnuplotQuoted(area->predictor) + " " +
                           seriesColour(number++) + " lw 1.5");
  }
  figure.plots.push_back(addBlock(figure, "chance", {{0.0, 0.0}, {100.0, 100.0}}) +
                         std::string(" using 1:2 with lines notitle ") + kReferenceLook);
  out.figure(
      std::move(figure),
      fmt::format(
          "Part {}: how well predictors tell single trials with a change that were reported from those that "
          "were not. The rating{}.",
          part.part,
          shown.size() > 1 ? fmt::format(" and the {} others of largest area", shown.size() - 1) : ""));
}

}  // namespace

void addValidationFigures(const StudyPage& page, const PartValidation& part, PageWriter& out) {
  out.html("<div class=\"figures\">\n");
  for (const PredictorName& predictor : studyPredictors())
    addScatter(page, part, predictor.name, predictor.meaning, out);
  out.html("</div>\n");
  out.paragraph(
      "Bars are Wilson's 95 % intervals of the pooled answers, which take trials of one observer as "
      "independent.");
  out.html("<div class=\"figures\">\n");
  addLink(page, part, out);
  addCalibration(page, part, out);
  addRoc(page, part, out);
  out.html("</div>\n");
}

namespace {

constexpr size_t kOpenAgreements = 48;
constexpr const char* kAgreementFile = "tables/validation.csv";

void addTables(const StudyPage& page, const PartValidation& part, const Section& section, PageWriter& out) {
  for (const ResultTable& table : section.tables)
    if (table.name == "agreement")
      out.table(
          table,
          fmt::format(
              "Agreement of predictions {}, {} with a change, part {}: Stuart's τ_c and Pearson's r with "
              "95 % intervals; p of no correlation. Clamped: predictions above the least that "
              "everybody noticed are lowered to it.",
              table.title, counted(part.scenarios.size(), "scenario"), part.part),
          kAgreementFile, kOpenAgreements);
  addValidationFigures(page, part, out);
  out.table(section.table("areas"),
            "Area under the ROC curve of single trials with a change, and its difference from the rating's, "
            "with 95 % "
            "intervals and p after DeLong, DeLong and Clarke-Pearson. Trials of one observer are taken as "
            "independent: intervals are too narrow.",
            kAgreementFile);
  out.table(
      section.table("link"),
      "Link P(R) = g + (1 − g − l) / (1 + exp(−(R − m) / s)) from rating to detection, fitted by maximum "
      "likelihood.",
      kAgreementFile);
  out.table(
      section.table("link_errors"),
      "Errors of predicted probabilities: log loss and Brier score a trial, RMS difference of rates over "
      "scenarios. The fitted link predicts each scenario without its own answers.",
      kAgreementFile);
  if (!part.calibration) return;
  out.table(
      section.table("calibration"),
      "Calibration of detection_probability: Brier score = reliability − resolution + uncertainty + within "
      "variance − within covariance.",
      kAgreementFile);
  out.table(section.table("bins"), "Predicted and observed shares. Intervals: 95 %, Wilson.", kAgreementFile);
}

/// Table 10.1 of the thesis with the edges that were used.
void addScoreRules(const ScoreBins& bins, PageWriter& out) {
  const std::vector<int> levels = {1, 2, 3, 4};
  TableOf table("scores", "", levels);
  table.add(text("rating_score"), [](int rating) {
    return std::array{"very low", "low", "high", "very high"}[size_t(rating) - 1];
  });
  for (const int coverage : levels)
    table.add(integer(std::array{"tiny", "small", "large", "huge"}[size_t(coverage) - 1]),
              [coverage](int rating) { return detectionScore(rating, coverage); });
  out.table(
      table,
      fmt::format(
          "Detection score by rating score and coverage (Schwarz 2009, Table 10.1). Edges are choices of "
          "this analysis: coverage of the object is small from {:g} on, large from {:g}, huge from {:g}; "
          "a rating is low from {:g} on, high from {:g}, very high from {:g}; the rating score is the "
          "mean R of the {} most highly rated regions.",
          bins.coverage[0], bins.coverage[1], bins.coverage[2], bins.rating[0], bins.rating[1],
          bins.rating[2], bins.topRegions),
      "", 0);
}

}  // namespace

void addValidation(const StudyPage& page, PageWriter& out) {
  if (!page.validation && page.validationNote.empty()) return;
  out.openSection("validation", "Predictions and answers");
  if (!page.validation) {
    out.paragraph("Predictions are stored, but cannot be set beside the answers: " + page.validationNote +
                  ".");
    out.closeSection();
    return;
  }
  const StudyValidation& validation = *page.validation;
  out.paragraph(fmt::format("Predictions of {}, settings {}, for {}.", validation.programVersion,
                            validation.settingsHash.substr(0, 12), join(validation.displays)));
  out.list(validation.notes);
  const Result result = resultOf(validation);
  for (size_t i = 0; i < validation.parts.size(); ++i) {
    if (validation.parts.size() > 1) out.heading("Part " + validation.parts[i].part);
    out.list(result.sections[i].notes);
    addTables(page, validation.parts[i], result.sections[i], out);
  }
  const bool scored =
      std::any_of(validation.parts.begin(), validation.parts.end(), [](const PartValidation& part) {
        return std::any_of(part.agreements.begin(), part.agreements.end(),
                           [](const Agreement& one) { return one.predictor == "detection_score"; });
      });
  if (scored) addScoreRules(page.validationSetting.bins, out);
  out.file(kAgreementFile, toCsv(result.sections),
           "rates and predictors of each scenario, agreement, areas, calibration, link");
  out.closeSection();
}

}  // namespace limen::analysis
