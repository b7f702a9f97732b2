// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/output/text_table.h"
#include "analysis/study/validation.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::vector<std::string> agreementLine(const Agreement& one, bool clamp) {
  std::vector<std::string> out = {one.set,
                                  one.predictor,
                                  std::to_string(one.scenarios),
                                  fixedText(valueOf(one.kendall.tauC)),
                                  intervalText(intervalOf(one.kendall.tauC)),
                                  pText(one.kendall.p),
                                  fixedText(valueOf(one.pearson)),
                                  intervalText(intervalOf(one.pearson)),
                                  pText(pOf(one.pearson))};
  if (clamp) {
    out.push_back(fixedText(valueOf(one.clamped.correlation)));
    out.push_back(one.clamped.clamp ? fmt::format("{} at {:.3g}", one.clamped.clamped, *one.clamped.clamp)
                                    : "-");
  }
  out.push_back(one.published ? fmt::format("tau_c {:.3f}, r {:.3f}{}", one.published->tauC, one.published->r,
                                            one.published->clamped ? " clamped" : "")
                              : "");
  return out;
}

std::string errorText(const std::optional<LinkError>& error, const LinkErrorIntervals* intervals,
                      const std::string& name) {
  if (!error) return fmt::format("    {:<38} -\n", name);
  std::string out = fmt::format("    {:<38} log loss {}, Brier {:.4f} a trial; RMS of rates {:.4f}\n", name,
                                fixedText(error->logLoss, 4), error->brier, error->rmsRate);
  if (intervals)
    out += fmt::format("    {:<38} log loss {}, Brier {}; RMS {}\n", "  95 % over observers",
                       intervalText(intervals->logLoss), intervalText(intervals->brier),
                       intervalText(intervals->rmsRate));
  return out;
}

std::string linkText(const LinkReport& link) {
  std::string out = "\n  link P(R) = g + (1 - g - l) / (1 + exp(-(R - m) / s))\n";
  if (link.refit) {
    const Link& fit = *link.refit;
    out += fmt::format("    fitted: g {:.4f}{}, l {:.4f}{}, m {:.4f}, s {:.4f}, ln likelihood {:.3f}\n",
                       fit.guess, fit.guessFitted ? "" : " (fixed)", fit.lapse,
                       fit.lapseFitted ? "" : " (fixed)", fit.midpointR, fit.scaleR, fit.logLikelihood);
    if (link.intervals)
      out +=
          fmt::format("    95 % over observers: g {}, l {}, m {}, s {} ({} of {} samples fitted, seed {})\n",
                      intervalText(link.intervals->guess), intervalText(link.intervals->lapse),
                      intervalText(link.intervals->midpointR), intervalText(link.intervals->scaleR),
                      link.intervals->fitted, link.intervals->samples, link.intervals->seed);
    if (!fit.note.empty()) out += "    " + fit.note + "\n";
  }
  out += fmt::format("    catch trials: {} with a rate of {}\n", link.catchTrials,
                     link.catchTrials > 0 ? percentText(link.guessFromCatch) : "-");
  const LinkIntervals* intervals = link.intervals ? &*link.intervals : nullptr;
  out += errorText(link.refitError, intervals ? &intervals->refitError : nullptr,
                   "fitted, each scenario left out once:");
  out += errorText(link.asPredicted, intervals ? &intervals->asPredicted : nullptr, "as predicted:");
  out += errorText(link.constant, intervals ? &intervals->constant : nullptr,
                   "mean rate of the other scenarios:");
  return out;
}

std::string calibrationText(const Calibration& calibration) {
  std::string out = fmt::format(
      "\n  calibration of detection_probability: Brier {:.4f} = reliability {:.4f} - resolution {:.4f} + "
      "uncertainty {:.4f} + within bins {:.4f}\n",
      calibration.brier, calibration.reliability, calibration.resolution, calibration.uncertainty,
      calibration.withinVariance - calibration.withinCovariance);
  std::vector<std::vector<std::string>> table = {
      {"predicted", "trials", "mean", "observed", "95 % (Wilson)"}};
  for (const CalibrationBin& bin : calibration.bins)
    if (bin.trials > 0)
      table.push_back({fmt::format("{:.1f} to {:.1f}", bin.low, bin.high), std::to_string(bin.trials),
                       fixedText(bin.meanPrediction), fixedText(bin.observed), intervalText(bin.wilson)});
  return out + alignedText(table, {0}, "    ");
}

std::string areaText(const std::vector<TrialArea>& areas) {
  std::vector<std::vector<std::string>> table = {
      {"predictor", "area", "95 %", "minus rating", "95 %", "p (DeLong)"}};
  for (const TrialArea& one : areas) {
    const auto& against = one.againstRating;
    table.push_back({one.predictor, fixedText(one.area.area), intervalText(one.area.interval),
                     against ? fixedText(against->difference) : "-",
                     against ? intervalText(against->interval) : "-", against ? pText(against->p) : "-"});
  }
  return "\n  area under the ROC curve of single trials with a change\n" + alignedText(table, {0}, "    ");
}

nlohmann::json correlationJson(const std::optional<Correlation>& correlation) {
  if (!correlation) return {};
  return {{"r", correlation->coefficient.value},
          {"interval", intervalJson(correlation->coefficient.interval)},
          {"p", numberJson(correlation->p)}};
}

nlohmann::json agreementJson(const Agreement& one, bool clamp) {
  nlohmann::json out = {{"set", one.set},
                        {"predictor", one.predictor},
                        {"scenarios", one.scenarios},
                        {"concordant_minus_discordant", one.kendall.concordant - one.kendall.discordant},
                        {"m", std::min(one.kendall.distinctX, one.kendall.distinctY)},
                        {"tau_c", numberJson(valueOf(one.kendall.tauC))},
                        {"tau_c_interval", intervalJson(intervalOf(one.kendall.tauC))},
                        {"tau_b", numberJson(valueOf(one.kendall.tauB))},
                        {"p", one.kendall.p},
                        {"pearson", correlationJson(one.pearson)}};
  if (clamp) {
    out["pearson_clamped"] = correlationJson(one.clamped.correlation);
    out["clamp"] = numberJson(one.clamped.clamp);
    out["clamped"] = one.clamped.clamped;
  }
  if (one.published)
    out["published"] = {{"tau_c", one.published->tauC},
                        {"r", one.published->r},
                        {"r_clamped", one.published->clamped},
                        {"source", one.published->source}};
  return out;
}

nlohmann::json linkErrorJson(const std::optional<LinkError>& error) {
  if (!error) return {};
  return {{"log_loss", numberJson(error->logLoss)}, {"brier", error->brier}, {"rms_rate", error->rmsRate}};
}

nlohmann::json errorIntervalsJson(const LinkErrorIntervals& intervals) {
  return {{"log_loss", intervalJson(intervals.logLoss)},
          {"brier", intervalJson(intervals.brier)},
          {"rms_rate", intervalJson(intervals.rmsRate)}};
}

nlohmann::json linkIntervalsJson(const std::optional<LinkIntervals>& intervals) {
  if (!intervals) return {};
  return {{"level", 0.95},
          {"method", "percentiles over samples of observers"},
          {"samples", intervals->samples},
          {"fitted", intervals->fitted},
          {"seed", intervals->seed},
          {"guess_rate", intervalJson(intervals->guess)},
          {"lapse_rate", intervalJson(intervals->lapse)},
          {"rating_midpoint", intervalJson(intervals->midpointR)},
          {"rating_scale_r", intervalJson(intervals->scaleR)},
          {"leave_one_out", errorIntervalsJson(intervals->refitError)},
          {"as_predicted", errorIntervalsJson(intervals->asPredicted)},
          {"constant", errorIntervalsJson(intervals->constant)}};
}

nlohmann::json linkJson(const LinkReport& link) {
  nlohmann::json out = {{"catch_trials", link.catchTrials},
                        {"guess_from_catch", link.guessFromCatch},
                        {"refit", nullptr},
                        {"leave_one_out", linkErrorJson(link.refitError)},
                        {"as_predicted", linkErrorJson(link.asPredicted)},
                        {"constant", linkErrorJson(link.constant)},
                        {"intervals", linkIntervalsJson(link.intervals)}};
  if (link.refit)
    out["refit"] = {{"guess_rate", link.refit->guess},
                    {"guess_fitted", link.refit->guessFitted},
                    {"lapse_rate", link.refit->lapse},
                    {"lapse_fitted", link.refit->lapseFitted},
                    {"rating_midpoint", link.refit->midpointR},
                    {"rating_scale_r", link.refit->scaleR},
                    {"log_likelihood", link.refit->logLikelihood},
                    {"note", link.refit->note}};
  return out;
}

nlohmann::json calibrationJson(const std::optional<Calibration>& calibration) {
  if (!calibration) return {};
  nlohmann::json bins = nlohmann::json::array();
  for (const CalibrationBin& bin : calibration->bins)
    bins.push_back({{"low", bin.low},
                    {"high", bin.high},
                    {"trials", bin.trials},
                    {"positive", bin.positives},
                    {"mean_prediction", bin.meanPrediction},
                    {"observed", bin.observed},
                    {"wilson", intervalJson(bin.wilson)}});
  return {{"brier", calibration->brier},
          {"reliability", calibration->reliability},
          {"resolution", calibration->resolution},
          {"uncertainty", calibration->uncertainty},
          {"within_variance", calibration->withinVariance},
          {"within_covariance", calibration->withinCovariance},
          {"bins", bins}};
}

}  // namespace

std::string toText(const StudyValidation& validation) {
  std::string out = fmt::format("predictions of {}, settings {}, for display {}\n", validation.programVersion,
                                validation.settingsHash.substr(0, 12), join(validation.displays));
  for (const std::string& note : validation.notes) out += note + "\n";
  for (const PartValidation& part : validation.parts) {
    out += fmt::format("\npart {}: {} scenarios with a change\n", part.part, part.scenarios.size());
    for (const std::string& note : part.notes) out += "  " + note + "\n";
    std::vector<std::vector<std::string>> table = {{"set", "predictor", "n", "tau_c", "95 %", "p", "r",
                                                    "95 %", "p", "r clamped", "clamped", "published"}};
    for (const Agreement& one : part.agreements) table.push_back(agreementLine(one, true));
    out += "  with detection rates\n" + alignedText(table, {0, 1, 11}, "    ");
    if (!part.severity.empty()) {
      table = {{"set", "predictor", "n", "tau_c", "95 %", "p", "r", "95 %", "p", "published"}};
      for (const Agreement& one : part.severity) table.push_back(agreementLine(one, false));
      out += "\n  with mean severity of what was noticed\n" + alignedText(table, {0, 1, 9}, "    ");
    }
    if (!part.areas.empty()) out += areaText(part.areas);
    if (part.calibration) out += calibrationText(*part.calibration);
    out += linkText(part.link);
  }
  out +=
      "\nClamped: predictions above the least that everybody noticed are lowered to it (Schwarz 2009, "
      "section "
      "10.4.1).\nAreas and calibration take trials of one observer as independent: their intervals are too "
      "narrow. Those of the link are percentiles over samples of whole observers.\n-: cannot be told, or of "
      "no width, which is no certainty.\n";
  return out;
}

nlohmann::json toJson(const StudyValidation& validation) {
  nlohmann::json parts = nlohmann::json::array();
  for (const PartValidation& part : validation.parts) {
    nlohmann::json scenarios = nlohmann::json::array(), agreements = nlohmann::json::array(),
                   severity = nlohmann::json::array(), areas = nlohmann::json::array();
    for (const Scenario& one : part.scenarios)
      scenarios.push_back({{"condition", one.condition},
                           {"presentation", one.presentation},
                           {"stimulus_hash", one.stimulusHash},
                           {"display_hash", one.displayHash},
                           {"yes", one.yes},
                           {"trials", one.trials},
                           {"rate", one.rate},
                           {"mean_severity", numberJson(one.meanSeverity)},
                           {"predictors", one.predictors}});
    for (const Agreement& one : part.agreements) agreements.push_back(agreementJson(one, true));
    for (const Agreement& one : part.severity) severity.push_back(agreementJson(one, false));
    for (const TrialArea& one : part.areas) {
      nlohmann::json area = {{"predictor", one.predictor},
                             {"area", one.area.area},
                             {"interval", intervalJson(one.area.interval)},
                             {"against_rating", nullptr}};
      if (const auto& against = one.againstRating)
        area["against_rating"] = {{"difference", against->difference},
                                  {"interval", intervalJson(against->interval)},
                                  {"z", numberJson(against->z)},
                                  {"p", numberJson(against->p)}};
      areas.push_back(area);
    }
    parts.push_back({{"part", part.part},
                     {"scenarios", scenarios},
                     {"rates", agreements},
                     {"severity", severity},
                     {"areas", areas},
                     {"calibration", calibrationJson(part.calibration)},
                     {"link", linkJson(part.link)},
                     {"notes", part.notes}});
  }
  return {{"program_version", validation.programVersion},
          {"settings_hash", validation.settingsHash},
          {"predicted_for", validation.displays},
          {"notes", validation.notes},
          {"parts", parts}};
}

std::string toCsv(const StudyValidation& validation) {
  std::vector<std::string> heading = {"part", "condition", "presentation", "stimulus_hash",
                                      "yes",  "trials",    "rate",         "mean_severity"};
  for (const PredictorName& predictor : studyPredictors()) heading.push_back(predictor.name);
  std::string out = csvLine(heading);
  for (const PartValidation& part : validation.parts)
    for (const Scenario& one : part.scenarios) {
      std::vector<std::string> line = {part.part,
                                       one.condition,
                                       one.presentation,
                                       one.stimulusHash,
                                       std::to_string(one.yes),
                                       std::to_string(one.trials),
                                       cellText(one.rate),
                                       cellText(one.meanSeverity)};
      for (const PredictorName& predictor : studyPredictors()) {
        const auto value = one.predictors.find(predictor.name);
        line.push_back(value == one.predictors.end() ? "" : cellText(value->second));
      }
      out += csvLine(line);
    }
  return out;
}

}  // namespace limen::analysis
