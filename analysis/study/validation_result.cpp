// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/correlations/cluster_bootstrap.h"
#include "analysis/study/validation.h"

namespace limen::analysis {
namespace {

ResultTable scenarioTable(const PartValidation& part) {
  TableOf out("scenarios", "", part.scenarios);
  out.add(text("condition"), &Scenario::condition)
      .add(text("presentation"), &Scenario::presentation)
      .add(text("stimulus_hash"), &Scenario::stimulusHash)
      .add(text("display_hash"), &Scenario::displayHash)
      .add(count("yes", "trials"), countOf(&Scenario::yes, &Scenario::trials))
      .add(share("rate"), &Scenario::rate)
      .add(number("mean_severity"), &Scenario::meanSeverity);
  for (const std::string& predictor : part.predictors)
    out.add(number(predictor), [&predictor](const Scenario& one) {
      const auto value = one.predictors.find(predictor);
      return value == one.predictors.end() ? ResultCell() : ResultCell(value->second);
    });
  ResultTable table = out;
  for (Column& column : table.columns) column = forData(column);
  return table;
}

ResultTable agreementTable(const std::vector<Agreement>& agreements, bool severity) {
  const auto kendall = [](auto... of) { return at(&Agreement::kendall, of...); };
  const auto pearson = [](auto... of) { return at(&Agreement::pearson, of...); };
  const auto clamped = [](auto... of) { return at(&Agreement::clamped, of...); };
  const auto coefficient = &Correlation::coefficient;
  const auto correlation = &ClampedPearson::correlation;
  const auto published = [](auto member) { return at(&Agreement::published, member); };
  TableOf out("agreement", severity ? "with mean severity of what was noticed" : "with detection rates",
              agreements);
  out.add(forData(text("with")), [=](const Agreement&) { return severity ? "severity" : "rate"; })
      .add(text("predictor"), &Agreement::predictor)
      .add(text("set", "scenarios"), &Agreement::set)
      .add(integer("n"), &Agreement::scenarios)
      .add(number("tau_c", "τ_c"), kendall(&Kendall::tauC, &Coefficient::value))
      .add(interval("tau_c"), kendall(&Kendall::tauC, &Coefficient::interval))
      .add(forData(number("tau_b")), kendall(&Kendall::tauB, &Coefficient::value))
      .add(probability("p_tau", "p"), kendall(&Kendall::p))
      .add(forData(integer("concordant_minus_discordant")),
           kendall([](const Kendall& one) { return one.concordant - one.discordant; }))
      .add(forData(integer("m")),
           kendall([](const Kendall& one) { return std::min(one.distinctX, one.distinctY); }))
      .add(number("r"), pearson(coefficient, &Coefficient::value))
      .add(interval("r"), pearson(coefficient, &Coefficient::interval))
      .add(probability("p_r", "p"), pearson(&Correlation::p));
  if (!severity)
    out.add(number("r_clamped", "r clamped"), clamped(correlation, coefficient, &Coefficient::value))
        .add(forData(interval("r_clamped")), clamped(correlation, coefficient, &Coefficient::interval))
        .add(forData(probability("p_r_clamped")), clamped(correlation, &Correlation::p))
        .add(integer("clamped"), clamped(&ClampedPearson::clamped))
        .add(significant("clamp", "at", 3), clamped(&ClampedPearson::clamp));
  return out.add(ifAny(number("published_tau_c", "published τ_c")), published(&PublishedAgreement::tauC))
      .add(ifAny(number("published_r", "published r")), published(&PublishedAgreement::r))
      .add(ifAny(flag("published_r_clamped", "clamped")), published(&PublishedAgreement::clamped))
      .add(forData(text("published_source")), published(&PublishedAgreement::source));
}

ResultTable areaTable(const PartValidation& part) {
  const auto against = [](auto member) { return at(&TrialArea::againstRating, member); };
  return TableOf("areas", "area under the ROC curve of single trials with a change", part.areas)
      .add(text("predictor"), &TrialArea::predictor)
      .add(number("estimate", "area"), at(&TrialArea::area, &RocArea::area))
      .add(interval(), at(&TrialArea::area, &RocArea::interval))
      .add(number("minus_rating", "minus rating"), against(&RocComparison::difference))
      .add(interval("minus_rating"), against(&RocComparison::interval))
      .add(forData(number("z")), against(&RocComparison::z))
      .add(probability("p", "p (DeLong)"), against(&RocComparison::p));
}

ResultTable comparisonTable(const PartValidation& part) {
  const auto areas = [](auto... of) { return at(&TrialComparison::areas, of...); };
  return TableOf("comparisons", "differences of these areas, on the same trials", part.comparisons)
      .add(text("first"), &TrialComparison::first)
      .add(text("second", "minus"), &TrialComparison::second)
      .add(number("difference"), areas(&RocComparison::difference))
      .add(interval("difference"), areas(&RocComparison::interval))
      .add(forData(number("z")), areas(&RocComparison::z))
      .add(probability("p", "p (DeLong)"), areas(&RocComparison::p));
}

struct LinkRow {
  std::string name, title;
  double value;
  std::optional<bool> fitted;
  std::optional<Interval> bounds;
};

ResultTable linkTable(const LinkReport& link) {
  std::vector<LinkRow> rows;
  if (link.refit) {
    const Link& fit = *link.refit;
    const LinkIntervals none, &bounds = link.intervals ? *link.intervals : none;
    rows = {{"guess_rate", "guess g", fit.guess, fit.guessFitted, bounds.guess},
            {"lapse_rate", "lapse l", fit.lapse, fit.lapseFitted, bounds.lapse},
            {"rating_midpoint", "midpoint m", fit.midpointR, true, bounds.midpointR},
            {"rating_scale_r", "scale s", fit.scaleR, true, bounds.scaleR},
            {"log_likelihood", "log likelihood", fit.logLikelihood, {}, {}}};
  }
  return TableOf("link", "link P(R) = g + (1 - g - l) / (1 + exp(-(R - m) / s))", rows)
      .add(forData(text("parameter")), &LinkRow::name)
      .add(forPeople(text("", "parameter")), &LinkRow::title)
      .add(number("estimate", "", 4), &LinkRow::value)
      .add(interval("", "95 % over observers"), &LinkRow::bounds)
      .add(flag("fitted"), &LinkRow::fitted);
}

struct ErrorRow {
  const char *name, *title;
  LinkError error;
  LinkErrorIntervals bounds;
};

ResultTable errorTable(const LinkReport& link) {
  std::vector<ErrorRow> rows;
  const LinkIntervals none, &bounds = link.intervals ? *link.intervals : none;
  const auto add = [&](const char* name, const char* title, const std::optional<LinkError>& error,
                       const LinkErrorIntervals& own) {
    if (error) rows.push_back({name, title, *error, own});
  };
  add("leave_one_out", "fitted, each scenario left out once", link.refitError, bounds.refitError);
  add("as_predicted", "as predicted", link.asPredicted, bounds.asPredicted);
  add("constant", "mean rate of the other scenarios", link.constant, bounds.constant);
  const auto of = [](auto member) { return at(&ErrorRow::error, member); };
  const auto range = [](auto member) { return at(&ErrorRow::bounds, member); };
  return TableOf("link_errors", "errors of predicted probabilities, and of rates over scenarios", rows)
      .add(forData(text("prediction")), &ErrorRow::name)
      .add(forPeople(text("", "prediction")), &ErrorRow::title)
      .add(number("log_loss", "", 4), of(&LinkError::logLoss))
      .add(ifAny(interval("log_loss")), range(&LinkErrorIntervals::logLoss))
      .add(number("brier", "Brier", 4), of(&LinkError::brier))
      .add(ifAny(interval("brier")), range(&LinkErrorIntervals::brier))
      .add(number("rms_rate", "RMS of rates", 4), of(&LinkError::rmsRate))
      .add(ifAny(interval("rms_rate")), range(&LinkErrorIntervals::rmsRate));
}

Section sectionOf(const PartValidation& part) {
  Section out;
  out.title = fmt::format("part {}: {} scenarios with a change", part.part, part.scenarios.size());
  out.fact(key(text("part")), part.part);
  const LinkReport& link = part.link;
  out.fact(integer("catch_trials"), link.catchTrials);
  out.fact(link.catchTrials > 0 ? share("guess_from_catch", "rate in catch trials")
                                : forData(share("guess_from_catch")),
           link.guessFromCatch);
  if (link.intervals) {
    out.fact(forData(number("level")), 0.95);
    out.fact(integer("samples", "samples of observers"), link.intervals->samples);
    out.fact(integer("samples_fitted", "of these fitted"), link.intervals->fitted);
    out.fact(integer("seed"), link.intervals->seed);
  }
  out.add(scenarioTable(part));
  out.add(agreementTable(part.agreements, false));
  out.add(agreementTable(part.severity, true));
  out.add(areaTable(part));
  if (!part.comparisons.empty()) out.add(comparisonTable(part));
  if (part.calibration) addCalibration(out, *part.calibration, "detection_probability", "95 %");
  out.add(linkTable(link));
  out.add(errorTable(link));
  out.notes = part.notes;
  if (link.refit && !link.refit->note.empty()) out.notes.push_back(link.refit->note);
  return out;
}

}  // namespace

Result resultOf(const StudyValidation& validation) {
  Result out;
  out.command = "validate";
  if (!validation.settingsHash.empty()) {
    out.head.fact(text("program_version", "predictions made by"), validation.programVersion);
    out.head.fact(text("settings_hash", "settings' SHA-256"), validation.settingsHash);
  }
  if (!validation.scoresFile.empty()) {
    out.head.fact(text("scores", "scores of"), validation.scoresFile);
    out.head.fact(forData(text("scores_hash")), validation.scoresHash);
  }
  out.head.fact(list("predicted_for", "for display"), validation.displays);
  for (const PartValidation& part : validation.parts) out.sections.push_back(sectionOf(part));
  out.notes = validation.notes;
  out.notes.push_back(
      "clamped: predictions above the least that everybody noticed are lowered to it (Schwarz 2009, "
      "section 10.4.1)");
  out.notes.push_back(
      "areas and calibration take trials of one observer as independent: their intervals are too "
      "narrow. Those of the link are percentiles over samples of whole observers");
  out.notes.push_back(kDashNote);
  return out;
}

}  // namespace limen::analysis
