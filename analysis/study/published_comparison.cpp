// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/published_comparison.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "analysis/output/text_output.h"
#include "experiments/base/text.h"

namespace limen::analysis {

namespace {

std::string shareText(double share) { return fmt::format("{:.2f} %", 100.0 * share); }

ComparedValue comparedShare(const std::string& quantity, double printed, const std::optional<double>& ours) {
  return {quantity, shareText(printed), printed, ours, ours ? shareText(*ours) : "-"};
}
ComparedValue comparedNumber(const std::string& quantity, double printed, const std::optional<double>& ours,
                             int digits) {
  return {quantity, fixedText(printed, digits), printed, ours, fixedText(ours, digits)};
}

class Comparer {
 public:
  explicit Comparer(const StudyFindings& findings)
      : findings_(findings), protocol_(findings.study->plan.name) {}

  PublishedComparison compare() {
    out_.protocol = protocol_;
    out_.observers = findings_.study->observers.size();
    out_.simulated = findings_.study->simulated > 0;
    out_.data = out_.simulated ? "simulated: " + join(findings_.observerKinds) : "people";
    design();
    for (const PublishedRateOf& one : publishedRates())
      if (one.protocol == protocol_) rate(one);
    for (const PublishedScenariosOf& one : publishedScenarios())
      if (one.protocol == protocol_) scenarios(one);
    for (const PublishedEffectOf& one : publishedEffects())
      if (one.protocol == protocol_) effect(one);
    for (const PublishedAgreementOf& one : publishedAgreements())
      if (one.protocol == protocol_) agreement(one);
    notes();
    return std::move(out_);
  }

 private:
  void design() {
    std::vector<std::string> known;
    for (const PublishedDesign& one : publishedDesigns()) {
      known.push_back(one.protocol);
      if (one.protocol != protocol_) continue;
      const size_t observers = out_.observers, answers = findings_.study->answers.size();
      out_.statistics.push_back(
          {"",
           "observers",
           {comparedNumber("count", static_cast<double>(one.observers), static_cast<double>(observers), 0)},
           "",
           one.source});
      const double each = static_cast<double>(answers) / static_cast<double>(observers);
      out_.statistics.push_back({"",
                                 "trials of each observer",
                                 {comparedNumber("count", static_cast<double>(one.trialsEach), each, 0)},
                                 answers % observers == 0 ? "" : "ours: a mean, since answers are missing",
                                 one.source});
      return;
    }
    out_.notes.push_back("nothing was published of this protocol; comparisons are with " + join(known));
  }

  void rate(const PublishedRateOf& one) {
    std::optional<double> mean, sd;
    for (const RateRow& row : findings_.rates->rows)
      if (row.part == one.part && row.scope == RateScope::Part && row.change == one.change) {
        mean = row.overObservers.mean;
        sd = row.overObservers.standardDeviation;
      }
    out_.statistics.push_back(
        {one.part,
         one.change ? "detection rate, trials with a change" : "detection rate, catch trials",
         {comparedShare("mean", one.rate.mean, mean), comparedShare("sd", one.rate.sd, sd)},
         "",
         one.rate.source});
  }

  void scenarios(const PublishedScenariosOf& one) {
    std::optional<double> rate, rateSd, severity, severitySd;
    for (const ScenarioSpread& own : findings_.rates->scenarios) {
      if (own.part != one.part || own.presentation != one.presentation) continue;
      rate = own.rate.mean;
      rateSd = own.rate.sdOfN;
      if (!own.severity) continue;
      severity = own.severity->mean;
      severitySd = own.severity->sdOfN;
    }
    const PublishedScenarios& known = one.scenarios;
    const std::string of = " of " + one.presentation + " scenarios";
    out_.statistics.push_back(
        {one.part,
         "detection rate" + of,
         {comparedShare("mean", known.meanRate, rate), comparedShare("sd", known.sdRate, rateSd)},
         known.remark,
         known.source});
    out_.statistics.push_back({one.part,
                               "mean severity" + of,
                               {comparedNumber("mean", known.meanSeverity, severity, 2),
                                comparedNumber("sd", known.sdSeverity, severitySd, 2)},
                               "",
                               known.source});
    leastScores(one);
  }

  /// The thesis says of its static terrain scenarios only from which level on their scores are.
  void leastScores(const PublishedScenariosOf& one) {
    std::optional<double> coverage, rating;
    const auto take = [](std::optional<double>& least, const Scenario& scenario, const char* predictor) {
      const auto value = scenario.predictors.find(predictor);
      if (value != scenario.predictors.end()) least = std::min(least.value_or(value->second), value->second);
    };
    if (findings_.validation)
      for (const PartValidation& part : findings_.validation->parts)
        for (const Scenario& scenario : part.scenarios)
          if (part.part == one.part && scenario.presentation == one.presentation) {
            take(coverage, scenario, "coverage_score");
            take(rating, scenario, "rating_level");
          }
    const PublishedScenarios& known = one.scenarios;
    const auto least = [](const std::string& quantity, int level, const std::optional<double>& ours) {
      return ComparedValue{quantity, fmt::format(">= {}", level), {}, ours, fixedText(ours, 0)};
    };
    out_.statistics.push_back({one.part,
                               "least scores of " + one.presentation + " scenarios",
                               {least("coverage level", known.leastCoverageLevel, coverage),
                                least("rating level", known.leastRatingLevel, rating)},
                               known.least + (coverage ? "" : "; ours: " + findings_.whyNotValidated),
                               known.source});
  }

  void effect(const PublishedEffectOf& one) {
    const AnovaEffect* own = nullptr;
    std::string why = "the part was not analysed";
    for (const PartAnova& part : *findings_.anova) {
      if (part.part != one.part) continue;
      why = part.note.empty() ? "no such effect in these answers" : part.note;
      for (size_t i = 0; part.result && i < part.result->effects.size(); ++i) {
        std::vector<std::string> names;
        for (const size_t factor : part.result->effects[i].factors)
          names.push_back(part.factors[factor].name);
        if (std::is_permutation(names.begin(), names.end(), one.factors.begin(), one.factors.end()))
          own = &part.result->effects[i];
      }
    }
    const PublishedEffect& known = one.effect;
    const auto degrees = [&](double value) { return own ? std::optional<double>(value) : std::nullopt; };
    const std::optional<double> f = own ? own->f : std::nullopt, p = own ? own->p : std::nullopt;
    ComparedValue pValue{"p", known.p, {}, p, pText(p)};
    if (known.p.find('<') == std::string::npos) pValue.printed = std::stod(known.p);
    std::string note = known.remark;
    if (!own || !own->note.empty()) note += (note.empty() ? "ours: " : "; ours: ") + (own ? own->note : why);
    out_.statistics.push_back(
        {one.part,
         "variance by " + join(one.factors, " x "),
         {comparedNumber("F", known.f, f, 3), comparedNumber("df", known.df, degrees(own ? own->df : 0.0), 0),
          comparedNumber("df error", known.dfError, degrees(own ? own->dfError : 0.0), 0), pValue},
         note,
         known.source});
    // F was worked out of p, and nothing else but p was printed.
    if (known.fDerived)
      for (ComparedValue& value : out_.statistics.back().values)
        if (value.quantity != "p") value.published += " (derived)";
  }

  void agreement(const PublishedAgreementOf& one) {
    const Agreement* own = nullptr;
    if (findings_.validation)
      for (const PartValidation& part : findings_.validation->parts)
        if (part.part == one.part)
          for (const Agreement& agreement : one.severity ? part.severity : part.agreements)
            if (agreement.set == one.set && agreement.predictor == one.predictor) own = &agreement;
    std::optional<double> tauC, r;
    if (own) tauC = valueOf(own->kendall.tauC);
    if (own) r = valueOf(one.agreement.clamped ? own->clamped.correlation : own->pearson);
    const Missing missing = whyMissing(one, own, tauC && r);
    const std::string note = missing.full.empty() ? "" : "ours: " + missing.full;
    ComparedStatistic statistic = {
        one.part,
        fmt::format("{} with {}, {}", one.predictor, one.severity ? "mean severity" : "detection rate",
                    one.set),
        {comparedNumber("tau_c", one.agreement.tauC, tauC, 3),
         comparedNumber(one.agreement.clamped ? "r clamped" : "r", one.agreement.r, r, 3)},
        note,
        one.agreement.source};
    // In the row itself, where a dash would leave one wondering.
    for (ComparedValue& value : statistic.values)
      if (!value.ours) value.oursText = "none: " + missing.brief;
    out_.statistics.push_back(std::move(statistic));
  }

  /// Why there is no coefficient; empty if there is.
  struct Missing {
    std::string brief, full;
  };
  Missing whyMissing(const PublishedAgreementOf& one, const Agreement* own, bool given) const {
    if (!findings_.validation) return {"not predicted", findings_.whyNotValidated};
    if (!own) return {"too few", "too few scenarios of this kind"};
    if (given) return {};
    std::vector<double> predictions, answers;
    for (const PartValidation& part : findings_.validation->parts)
      for (const Scenario& scenario : part.scenarios) {
        const auto value = scenario.predictors.find(one.predictor);
        const bool fits = one.set == "both" || one.set == "all" || scenario.presentation == one.set;
        if (part.part != one.part || !fits || (one.severity && !scenario.meanSeverity)) continue;
        if (value != scenario.predictors.end()) predictions.push_back(value->second);
        answers.push_back(one.severity ? *scenario.meanSeverity : scenario.rate);
      }
    const auto constant = [](const std::vector<double>& values) {
      return !values.empty() &&
             std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; });
    };
    const std::string what = one.severity ? "mean severity" : "detection rate";
    if (constant(predictions))
      return {"constant score", fmt::format("{} is {:.4g} in all {} scenarios", one.predictor, predictions[0],
                                            predictions.size())};
    if (constant(answers))
      return {"constant answers",
              fmt::format("the {} is {:.4g} in all {} scenarios", what, answers[0], answers.size())};
    return {"not defined", "the coefficient is not defined for these predictions and answers"};
  }

  void notes() {
    if (!out_.simulated) return;
    out_.notes.push_back("ours are answers of simulated observers (" + join(findings_.observerKinds) +
                         "): a check of the chain, no evidence about people");
    const auto& kinds = findings_.observerKinds;
    if (std::find(kinds.begin(), kinds.end(), "model") != kinds.end())
      out_.notes.push_back(
          "observers of kind 'model' answer by the predictor's own rating: how well that and what is made of "
          "it agree with their answers is circular");
  }

  const StudyFindings& findings_;
  std::string protocol_;
  PublishedComparison out_;
};

}  // namespace

PublishedComparison comparePublished(const StudyFindings& findings) { return Comparer(findings).compare(); }

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
    const auto of = [](auto member) { return at(&ValueRow::statistic, member); };
    const auto value = [](auto member) { return at(&ValueRow::value, member); };
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
                .add(forData(text("note")), of(&ComparedStatistic::note))
                .add(forData(text("source")), of(&ComparedStatistic::source)));
    if (!one.statistics.empty()) own.notes.push_back("published: " + one.statistics.front().source);
    // Once each; beside the rows they would part the table in two.
    std::vector<std::string> said;
    std::map<std::string, std::vector<std::string>> about;
    for (const ComparedStatistic& statistic : one.statistics) {
      if (statistic.note.empty()) continue;
      indexIn(said, statistic.note);
      about[statistic.note].push_back((statistic.part.empty() ? "" : statistic.part + ", ") +
                                      statistic.statistic);
    }
    for (const std::string& note : said) own.notes.push_back(join(about[note], "; ") + ": " + note);
    own.notes.insert(own.notes.end(), one.notes.begin(), one.notes.end());
    out.sections.push_back(std::move(own));
  }
  return out;
}

}  // namespace limen::analysis
