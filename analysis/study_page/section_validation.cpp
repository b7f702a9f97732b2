// SPDX-License-Identifier: BSD-3-Clause
// How well stored predictions fit the answers: tables; the figures are in validation_figures.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/output/result_data.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr size_t kOpenAgreements = 48;
constexpr const char* kAgreementFile = "tables/validation.csv";

void addTables(const StudyPage& page, const PartValidation& part, const Section& section, PageWriter& out) {
  for (const ResultTable& table : section.tables)
    if (table.name == "agreement")
      out.table(table,
                fmt::format("Agreement of predictions {}, {} with a change, part {}: Stuart's τ_c and Pearson's r with "
                            "95 % intervals; p of no correlation. Clamped: predictions above the least that "
                            "everybody noticed are lowered to it.",
                            table.title, counted(part.scenarios.size(), "scenario"), part.part),
                kAgreementFile, kOpenAgreements);
  addValidationFigures(page, part, out);
  out.table(section.table("areas"),
            "Area under the ROC curve of single trials with a change, and its difference from the rating's, with 95 % "
            "intervals and p after DeLong, DeLong and Clarke-Pearson. Trials of one observer are taken as "
            "independent: intervals are too narrow.",
            kAgreementFile);
  out.table(section.table("link"),
            "Link P(R) = g + (1 − g − l) / (1 + exp(−(R − m) / s)) from rating to detection, fitted by maximum "
            "likelihood.",
            kAgreementFile);
  out.table(section.table("link_errors"),
            "Errors of predicted probabilities: log loss and Brier score a trial, RMS difference of rates over "
            "scenarios. The fitted link predicts each scenario without its own answers.",
            kAgreementFile);
  if (!part.calibration) return;
  out.table(section.table("calibration"),
            "Calibration of detection_probability: Brier score = reliability − resolution + uncertainty + within "
            "variance − within covariance.",
            kAgreementFile);
  out.table(section.table("bins"), "Predicted and observed shares. Intervals: 95 %, Wilson.", kAgreementFile);
}

/// Table 10.1 of the thesis with the edges that were used.
void addScoreRules(const ScoreBins& bins, PageWriter& out) {
  const std::vector<int> levels = {1, 2, 3, 4};
  TableOf table("scores", "", levels);
  table.add(text("rating_score"),
            [](int rating) { return std::array{"very low", "low", "high", "very high"}[size_t(rating) - 1]; });
  for (const int coverage : levels)
    table.add(integer(std::array{"tiny", "small", "large", "huge"}[size_t(coverage) - 1]),
              [coverage](int rating) { return detectionScore(rating, coverage); });
  out.table(table,
            fmt::format("Detection score by rating score and coverage (Schwarz 2009, Table 10.1). Edges are choices of "
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
