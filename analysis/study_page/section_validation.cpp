// SPDX-License-Identifier: BSD-3-Clause
// How well stored predictions fit the answers: tables; the figures are in validation_figures.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenValidationRows = 16;

void addAgreements(const std::vector<Agreement>& agreements, const std::string& what, bool clamp,
                   PageWriter& out) {
  PageTable table;
  table.file = "tables/agreement.csv";
  const bool published = std::any_of(agreements.begin(), agreements.end(),
                                     [](const Agreement& one) { return one.published.has_value(); });
  table.columns = {
      {"predictor", false}, {"scenarios", false}, {"n"}, {"τ_c"}, {"95 %"}, {"p"}, {"r"}, {"95 %"}, {"p"}};
  if (clamp) table.columns.insert(table.columns.end(), {{"r clamped"}, {"clamped"}});
  if (published) table.columns.push_back({"published", false});
  std::string source;
  for (const Agreement& one : agreements) {
    std::vector<std::string> row = {one.predictor,
                                    one.set,
                                    std::to_string(one.scenarios),
                                    fixedText(valueOf(one.kendall.tauC)),
                                    intervalText(intervalOf(one.kendall.tauC)),
                                    pText(one.kendall.p),
                                    fixedText(valueOf(one.pearson)),
                                    intervalText(intervalOf(one.pearson)),
                                    pText(pOf(one.pearson))};
    if (clamp) {
      row.push_back(fixedText(valueOf(one.clamped.correlation)));
      row.push_back(one.clamped.clamp ? fmt::format("{} at {:.3g}", one.clamped.clamped, *one.clamped.clamp)
                                      : "-");
    }
    if (one.published) source = one.published->source;
    if (published)
      row.push_back(one.published
                        ? fmt::format("τ_c\u00a0{:.3f}, r\u00a0{:.3f}{}", one.published->tauC,
                                      one.published->r, one.published->clamped ? "\u00a0clamped" : "")
                        : "");
    table.rows.push_back(std::move(row));
  }
  table.caption =
      "Agreement of predictions with " + what +
      ": Stuart's τ_c and Pearson's r with 95 % intervals; p of no "
      "correlation." +
      (clamp ? " Clamped: predictions above the least that everybody noticed are lowered to it." : "") +
      (source.empty() ? "" : " Published: " + source + ".");
  table.folded = table.rows.size() > 3 * kOpenValidationRows;
  out.table(table);
}

std::string agreementCsv(const StudyValidation& validation) {
  std::string out =
      csvLine({"part", "with", "scenarios", "predictor", "n", "tau_c", "tau_c_low", "tau_c_high", "p_tau",
               "r", "r_low", "r_high", "p_r", "r_clamped", "clamp", "published_tau_c", "published_r"});
  for (const PartValidation& part : validation.parts)
    for (const bool severity : {false, true})
      for (const Agreement& one : severity ? part.severity : part.agreements) {
        const auto low = [](const std::optional<Interval>& i) { return i ? cellText(i->low) : ""; };
        const auto high = [](const std::optional<Interval>& i) { return i ? cellText(i->high) : ""; };
        const auto tau = intervalOf(one.kendall.tauC), r = intervalOf(one.pearson);
        out += csvLine({part.part, severity ? "severity" : "rate", one.set, one.predictor,
                        std::to_string(one.scenarios), cellText(valueOf(one.kendall.tauC)), low(tau),
                        high(tau), cellText(one.kendall.p), cellText(valueOf(one.pearson)), low(r), high(r),
                        cellText(pOf(one.pearson)), cellText(valueOf(one.clamped.correlation)),
                        cellText(one.clamped.clamp), one.published ? cellText(one.published->tauC) : "",
                        one.published ? cellText(one.published->r) : ""});
      }
  return out;
}

void addAreas(const PartValidation& part, PageWriter& out) {
  PageTable table;
  table.caption =
      "Area under the ROC curve of single trials with a change, and its difference from the rating's, with "
      "95 % intervals and p "
      "after DeLong, DeLong and Clarke-Pearson. Trials of one observer are taken as independent: intervals "
      "are too narrow.";
  table.columns = {{"predictor", false}, {"area"}, {"95 %"}, {"minus rating"}, {"95 %"}, {"p"}};
  for (const TrialArea& one : part.areas) {
    const auto& against = one.againstRating;
    table.rows.push_back({one.predictor, fixedText(one.area.area), intervalText(one.area.interval),
                          against ? fixedText(against->difference) : "-",
                          against ? intervalText(against->interval) : "-",
                          against ? pText(against->p) : "-"});
  }
  out.table(table);
}

void addLinkTable(const PartValidation& part, PageWriter& out) {
  const LinkReport& link = part.link;
  if (link.refit) {
    const Link& fit = *link.refit;
    PageTable table;
    table.caption = "Link P(R) = g + (1 − g − l) / (1 + exp(−(R − m) / s)), fitted by maximum likelihood" +
                    std::string(fit.note.empty() ? "." : ": " + fit.note + ".");
    table.columns = {{"", false}, {"guess g"}, {"lapse l"}, {"midpoint m"}, {"scale s"}, {"ln likelihood"}};
    table.rows.push_back({"fitted", fmt::format("{:.4f}{}", fit.guess, fit.guessFitted ? "" : " (fixed)"),
                          fmt::format("{:.4f}{}", fit.lapse, fit.lapseFitted ? "" : " (fixed)"),
                          fixedText(fit.midpointR), fixedText(fit.scaleR), fixedText(fit.logLikelihood, 2)});
    out.table(table);
  }
  PageTable table;
  table.caption =
      "Errors of predicted probabilities: log loss and Brier score a trial, RMS difference of rates over "
      "scenarios. The fitted link "
      "predicts each scenario without its own answers.";
  table.columns = {{"", false}, {"log loss"}, {"Brier"}, {"RMS of rates"}};
  const auto add = [&](const std::string& name, const std::optional<LinkError>& error) {
    if (error)
      table.rows.push_back(
          {name, fixedText(error->logLoss, 4), fixedText(error->brier, 4), fixedText(error->rmsRate, 4)});
  };
  add("fitted, each scenario left out once", link.refitError);
  add("as predicted", link.asPredicted);
  add("mean rate of the other scenarios", link.constant);
  out.table(table);
}

void addCalibrationTable(const PartValidation& part, PageWriter& out) {
  if (!part.calibration) return;
  const Calibration& c = *part.calibration;
  const double within = c.withinVariance - c.withinCovariance;
  PageTable table;
  table.caption = fmt::format(
      "Calibration of detection_probability. Brier score {:.4f} = reliability {:.4f} − resolution {:.4f} + "
      "uncertainty {:.4f} {} within bins {:.4f}. Intervals: 95 %, Wilson.",
      c.brier, c.reliability, c.resolution, c.uncertainty, within < 0.0 ? "−" : "+", std::abs(within));
  table.columns = {{"predicted", false}, {"trials"}, {"mean"}, {"observed"}, {"95 %"}};
  for (const CalibrationBin& bin : c.bins)
    if (bin.trials > 0)
      table.rows.push_back({fmt::format("{:.1f} to {:.1f}", bin.low, bin.high), std::to_string(bin.trials),
                            fixedText(bin.meanPrediction), fixedText(bin.observed),
                            intervalText(bin.wilson)});
  out.table(table);
}

/// Table 10.1 of the thesis with the edges that were used.
void addScoreRules(const ScoreBins& bins, PageWriter& out) {
  PageTable table;
  table.caption = fmt::format(
      "Detection score by rating score and coverage (Schwarz 2009, Table 10.1). Edges are choices of this "
      "analysis: coverage "
      "of the object is small from {:g} on, large from {:g}, huge from {:g}; a rating is low from {:g} on, "
      "high from {:g}, very high from "
      "{:g}; the rating score is the mean R of the {} most highly rated regions.",
      bins.coverage[0], bins.coverage[1], bins.coverage[2], bins.rating[0], bins.rating[1], bins.rating[2],
      bins.topRegions);
  table.columns = {{"rating score", false}, {"tiny"}, {"small"}, {"large"}, {"huge"}};
  const char* kRatings[] = {"very low", "low", "high", "very high"};
  for (int rating = 1; rating <= 4; ++rating) {
    table.rows.push_back({kRatings[rating - 1]});
    for (int coverage = 1; coverage <= 4; ++coverage)
      table.rows.back().push_back(std::to_string(detectionScore(rating, coverage)));
  }
  table.folded = true;
  out.table(table);
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
  for (const PartValidation& part : validation.parts) {
    if (validation.parts.size() > 1) out.heading("Part " + part.part);
    out.list(part.notes);
    addAgreements(part.agreements,
                  fmt::format("detection rates of {} with a change, part {}",
                              counted(part.scenarios.size(), "scenario"), part.part),
                  true, out);
    if (!part.severity.empty())
      addAgreements(part.severity, "mean severity of what was noticed, part " + part.part, false, out);
    addValidationFigures(page, part, out);
    if (!part.areas.empty()) addAreas(part, out);
    addLinkTable(part, out);
    addCalibrationTable(part, out);
  }
  const bool scored =
      std::any_of(validation.parts.begin(), validation.parts.end(), [](const PartValidation& part) {
        return std::any_of(part.agreements.begin(), part.agreements.end(),
                           [](const Agreement& one) { return one.predictor == "detection_score"; });
      });
  if (scored) addScoreRules(page.validationSetting.bins, out);
  out.file("tables/scenarios.csv", toCsv(validation), "rates and predictors of each scenario");
  out.file("tables/agreement.csv", agreementCsv(validation),
           "agreement of predictors with rates and severity");
  out.closeSection();
}

}  // namespace limen::analysis
