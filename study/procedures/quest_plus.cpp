// SPDX-License-Identifier: BSD-3-Clause
// QUEST+ (Watson 2017, Journal of Vision 17(3):10) and psi (Kontsevich and Tyler 1999, Vision Research 39;
// with nuisance parameters psi-marginal of Prins 2013, Journal of Vision 13(7):3): the stimulus whose answer
// minimises the expected entropy. Psi is QUEST+ with one stimulus dimension and two outcomes.
#include <cmath>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "study/procedures/details.h"
#include "study/procedures/entropy_search.h"
#include "study/procedures/model_settings.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;
using psychometrics::GridPosterior;

struct QuestPlusDetail : ProcedureDetail, std::enable_shared_from_this<QuestPlusDetail> {
  ModelSettings model;
  StopRule stop;
  size_t candidates = 1;  // 1: the best; otherwise one of this many at random
  bool highestDensity = false;
  double tieTolerance = kTieTolerance;
  std::shared_ptr<const EntropySearch> search;  // shared by all procedures of these settings

  std::unique_ptr<Procedure> make(uint64_t seed) const override;
  json toJson() const override {
    json out;
    writeModelSettings(model, out);
    out["stop"] = study::toJson(stop);
    out["select"] = candidates == 1 ? "min_entropy" : "min_n_entropy";
    if (candidates > 1) out["candidates"] = candidates;
    out["tie_tolerance"] = tieTolerance;
    out["interval"] = highestDensity ? "highest_density" : "equal_tailed";
    return out;
  }
};

class QuestPlus : public Procedure {
 public:
  QuestPlus(std::shared_ptr<const QuestPlusDetail> detail, uint64_t seed)
      : detail_(std::move(detail)),
        seed_(seed),
        posterior_(detail_->model.parameters, detail_->model.priors) {}

  std::optional<std::vector<double>> next() const override {
    if (finished()) return std::nullopt;
    if (!next_) next_ = choose();
    return detail_->search->stimulusGrid().valuesOf(*next_);
  }

  void update(const std::vector<double>& stimulus, int outcome) override {
    const ModelSettings& model = detail_->model;
    const auto outcomes = static_cast<size_t>(model.model->outcomes());
    checkTrial(stimulus, outcome, model.stimulus.size(), model.model->outcomes());
    if (!model.knows(stimulus)) throw Error("the model does not cover the trial's stimulus");
    std::vector<double> logs(outcomes), likelihood(posterior_.size());
    for (size_t i = 0; i < posterior_.size(); ++i) {
      model.logProbabilities(stimulus, posterior_.grid().valuesOf(i).data(), logs.data());
      likelihood[i] = logs[static_cast<size_t>(outcome)];
    }
    if (!posterior_.update(likelihood.data())) {
      throw Error(
          "outcome " + std::to_string(outcome) + " is impossible at every point of the parameter grid", {},
          "allow for guesses and lapses");
    }
    ++trials_;
    next_.reset();
  }

  int trialsDone() const override { return trials_; }

  Estimate estimate(double level) const override {
    Estimate out;
    out.level = level;
    out.kind = detail_->highestDensity ? "shortest credible interval" : "equal-tailed credible interval";
    const size_t mode = posterior_.modePoint();
    const std::vector<psychometrics::GridAxis>& axes = posterior_.grid().axes();
    for (size_t d = 0; d < axes.size(); ++d) {
      if (axes[d].size() == 1) continue;
      const psychometrics::CredibleInterval interval =
          detail_->highestDensity ? posterior_.highestDensity(d, level) : posterior_.equalTailed(d, level);
      out.parameters.push_back({axes[d].name, posterior_.mean(d), posterior_.median(d),
                                posterior_.grid().valueOf(mode, d), interval.low, interval.high,
                                axes[d].unit});
    }
    return out;
  }

  json state() const override {
    return {{"trials", trials_},
            {"posterior", posterior_.hash()},
            {"entropy", posterior_.entropy()},
            {"seed", seed_}};
  }

 private:
  bool finished() const {
    const StopRule& stop = detail_->stop;
    if (stop.trials > 0 && trials_ >= stop.trials) return true;
    return stop.entropy > 0.0 && posterior_.entropy() <= stop.entropy;
  }

  size_t choose() const {
    const std::vector<double> entropies = detail_->search->expectedEntropies(posterior_);
    if (detail_->candidates == 1) return lowestEntropy(entropies, detail_->tieTolerance);
    const std::vector<size_t> best = lowestEntropies(entropies, detail_->candidates, detail_->tieTolerance);
    psychometrics::Random random(psychometrics::childSeed(seed_, "pick " + std::to_string(trials_)));
    return best[random.below(best.size())];
  }

  std::shared_ptr<const QuestPlusDetail> detail_;
  uint64_t seed_;
  GridPosterior posterior_;
  int trials_ = 0;
  mutable std::optional<size_t> next_;  // once requested
};

std::unique_ptr<Procedure> QuestPlusDetail::make(uint64_t seed) const {
  return std::make_unique<QuestPlus>(shared_from_this(), seed);
}

ProcedureSettings read(SettingsReader& reader, const char* type, const char* defaultModel) {
  auto detail = std::make_shared<QuestPlusDetail>();
  detail->model = readModelSettings(reader, defaultModel);
  const std::string select = reader.choiceOr("select", "min_entropy", {"min_entropy", "min_n_entropy"});
  if (select == "min_n_entropy") {
    detail->candidates = static_cast<size_t>(reader.integerOr("candidates", 4, 2, 1'000'000));
    const size_t stimuli = psychometrics::ProductGrid(detail->model.stimulus).size();
    if (detail->candidates > stimuli) {
      throw Error(
          std::to_string(detail->candidates) + " candidates of " + std::to_string(stimuli) + " stimuli",
          reader.at("candidates"), "give fewer candidates or more stimuli");
    }
  }
  detail->highestDensity =
      reader.choiceOr("interval", "equal_tailed", {"equal_tailed", "highest_density"}) == "highest_density";
  detail->tieTolerance = reader.numberOr("tie_tolerance", kTieTolerance, 0.0, 0.1);
  detail->stop = readStop(reader, {"trials", "entropy"});
  reader.finish();
  detail->search = std::make_shared<EntropySearch>(detail->model, reader.where());
  ProcedureSettings out;
  out.type = type;
  out.stimulus = dimensionsOf(detail->model.stimulus);
  out.outcomes = detail->model.model->outcomes();
  if (detail->stop.trials > 0) out.mostTrials = detail->stop.trials;
  out.detail = std::move(detail);
  return out;
}

}  // namespace

ProcedureSettings readQuestPlus(SettingsReader& reader) { return read(reader, "quest_plus", "weibull_db"); }

ProcedureSettings readPsi(SettingsReader& reader) {
  ProcedureSettings out = read(reader, "psi", "logistic");
  if (out.stimulus.size() != 1 || out.outcomes != 2) {
    throw Error("psi has one stimulus dimension and two outcomes", reader.at("model"), "use type quest_plus");
  }
  return out;
}

const char* describeQuestPlus() {
  return "quest_plus: the stimulus whose answer minimises the expected entropy (Watson 2017, J. Vision "
         "17(3):10)\n"
         "    model         default weibull_db; see models below, some with their own keys\n"
         "    stimulus      {name, from, to, step or count, spacing: linear or log, unit}, {name, values, "
         "unit}, or a\n"
         "                  list of these; the last dimension runs fastest\n"
         "    parameters    for each parameter of the model a number, a list or a range like a stimulus; "
         "with\n"
         "                  prior: uniform (default), {normal: {mean, sd}}, {beta: {a, b}} or a list of "
         "weights\n"
         "    nuisance      names of parameters that are marginalised out before stimuli are compared (Prins "
         "2013)\n"
         "    select        min_entropy (default), or min_n_entropy: one of the best `candidates` (default "
         "4) at random\n"
         "    interval      equal_tailed (default) or highest_density\n"
         "    stop          {trials, entropy}: after this many trials, or once the posterior's entropy is at "
         "or below\n                  this many nats\n"
         "    tie_tolerance   expected entropies that exceed the lowest by no more than this part of it (and "
         "of 0.01 nats\n"
         "                  more) count as equal, and the first stimulus in the declared order is taken "
         "(default 1e-12);\n                  0 takes the plain minimum, as in programs that replay "
         "published runs\n"
         "    mode in estimates is that of the joint posterior; parameters with a single value are left "
         "out.\n";
}

const char* describePsi() {
  return "psi: the same with one stimulus dimension and two outcomes, model logistic by default (Kontsevich "
         "and Tyler\n"
         "    1999, Vision Research 39); with `nuisance` the psi-marginal method (Prins 2013, J. Vision "
         "13(7):3). Give\n"
         "    a slope with spacing: log, so that its uniform prior is one of the logarithm. Keys: those of "
         "quest_plus.\n";
}

}  // namespace limen::study
