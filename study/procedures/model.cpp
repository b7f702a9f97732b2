// SPDX-License-Identifier: BSD-3-Clause
#include "study/procedures/model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/psychometrics/psychometric_function.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;
using psychometrics::PsychometricFunction;
using psychometrics::Sigmoid;
using psychometrics::SigmoidFamily;
using psychometrics::StimulusAxis;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 1e100;        // of a parameter: its products and inverses are finite
constexpr double kMostEqualLapse = 0.49;  // at 0.5 on either side there would be no room to rise

ModelParameter anyNumber(const char* name, const char* description) {
  return {name, description, std::nullopt, -kLargest, kLargest, true, true};
}
ModelParameter positive(const char* name, const char* description, bool ofStimulus = false) {
  return {name, description, std::nullopt, 0.0, kLargest, true, ofStimulus};
}
ModelParameter guessRate() {
  return {"guess", "P if nothing is seen: false alarms, or 1/m for m alternatives", 0.5, 0.0, 1.0};
}
ModelParameter lapseRate() { return {"lapse", "1 - P if everything is seen", 0.02, 0.0, 1.0}; }

void writeBoth(const PsychometricFunction& f, double x, double* out) {
  out[0] = f.logComplement(x);
  out[1] = f.logProbability(x);
}

/// guess + (1 - guess - lapse) F(x) on one stimulus dimension, F from the first two parameters.
struct SigmoidForm {
  const char* name;
  const char* formula;
  std::vector<ModelParameter> shape;
  std::function<Sigmoid(const double*)> make;
  bool logarithmic = false;  // not defined for stimuli below 0
};

class SigmoidModel : public Model {
 public:
  SigmoidModel(SigmoidForm form, bool equalAsymptotes, json ownKeys)
      : form_(std::move(form)),
        equal_(equalAsymptotes),
        ownKeys_(std::move(ownKeys)),
        parameters_(form_.shape) {
    if (!equal_) parameters_.push_back(guessRate());
    parameters_.push_back(lapseRate());
    if (equal_) parameters_.back().maximum = kMostEqualLapse;
  }
  int outcomes() const override { return 2; }
  const std::vector<ModelParameter>& parameters() const override { return parameters_; }
  bool knows(const double* stimulus) const override { return !form_.logarithmic || stimulus[0] >= 0.0; }
  void logProbabilities(const double* stimulus, const double* s, double* out) const override {
    writeBoth(PsychometricFunction(form_.make(s), s[2], equal_ ? s[2] : s[3]), stimulus[0], out);
  }
  void writeKeys(json& out) const override {
    out.update(ownKeys_);
    out["model"] = form_.name;
    out["asymptotes"] = equal_ ? "equal" : "free";
  }

 private:
  SigmoidForm form_;
  bool equal_;
  json ownKeys_;
  std::vector<ModelParameter> parameters_;
};

/// Contrast sensitivity of Watson (2017), equation 8 and example 4; the temporal half is optional.
class ContrastSensitivityModel : public Model {
 public:
  explicit ContrastSensitivityModel(bool temporal) : temporal_(temporal) {
    parameters_ = {anyNumber("minimum_threshold", "lowest threshold, dB"),
                   anyNumber("c0", "threshold extrapolated to 0, dB"),
                   anyNumber("cf", "rise of the threshold, dB per unit of spatial frequency")};
    if (temporal) {
      parameters_.push_back(anyNumber("cw", "rise of the threshold, dB per unit of temporal frequency"));
    }
    parameters_.push_back(positive("slope", "of the Weibull"));
    parameters_.push_back(guessRate());
    parameters_.push_back(lapseRate());
  }
  int outcomes() const override { return 2; }
  std::vector<std::string> stimulusNames() const override {
    std::vector<std::string> names = {"contrast", "spatial_frequency"};
    if (temporal_) names.emplace_back("temporal_frequency");
    return names;
  }
  const std::vector<ModelParameter>& parameters() const override { return parameters_; }
  void logProbabilities(const double* x, const double* s, double* out) const override {
    const double rising = s[1] + s[2] * x[1] + (temporal_ ? s[3] * x[2] : 0.0);
    const double* rest = s + (temporal_ ? 4 : 3);
    writeBoth(PsychometricFunction::watson(std::max(s[0], rising), rest[0], rest[1], rest[2]), x[0], out);
  }
  void writeKeys(json& out) const override { out["model"] = temporal_ ? "csf_spatiotemporal" : "csf"; }

 private:
  bool temporal_;
  std::vector<ModelParameter> parameters_;
};

/// Thurstone scale from pair comparisons (Watson 2017, "Thurstone scaling"): stimuli from 0 to 1.
class ThurstoneModel : public Model {
 public:
  int outcomes() const override { return 2; }
  std::vector<std::string> stimulusNames() const override { return {"first", "second"}; }
  const std::vector<ModelParameter>& parameters() const override {
    static const std::vector<ModelParameter> kParameters = {
        positive("maximum", "scale value of 1, in standard deviations of a judgement"),
        {"threshold", "below it the scale is 0", 0.0, 0.0, 1.0 - 1e-9},
        positive("power", "exponent of the scale"),
        {"lapse", "probability of either answer regardless of the stimulus", 0.0, 0.0, kMostEqualLapse}};
    return kParameters;
  }
  bool knows(const double* x) const override {
    return x[0] >= 0.0 && x[0] <= 1.0 && x[1] >= 0.0 && x[1] <= 1.0;
  }
  void logProbabilities(const double* x, const double* s, double* out) const override {
    const auto scale = [s](double value) {
      return s[0] * std::pow(std::max(0.0, value - s[1]) / (1.0 - s[1]), s[2]);
    };
    const double z = (scale(x[0]) - scale(x[1])) / std::numbers::sqrt2;
    writeBoth(PsychometricFunction::equalAsymptotes(Sigmoid::normal(0.0, 1.0), s[3]), z, out);
  }
  void writeKeys(json& out) const override { out["model"] = "thurstone"; }
};

/// Ratings in ordered categories: the stimulus is perceived with normal noise; criteria separate the
/// categories.
class RatingModel : public Model {
 public:
  explicit RatingModel(int categories) : categories_(categories) {
    parameters_ = {positive("sd", "standard deviation of the perceived stimulus", true),
                   anyNumber("criterion_1", "between category 0 and 1")};
    for (int k = 2; k < categories; ++k) {
      parameters_.push_back({"step_" + std::to_string(k),
                             "from criterion " + std::to_string(k - 1) + " to criterion " + std::to_string(k),
                             std::nullopt, 0.0, kLargest, true, true});
    }
  }
  int outcomes() const override { return categories_; }
  const std::vector<ModelParameter>& parameters() const override { return parameters_; }
  // P(category k) = P(perceived above criterion k) - P(above criterion k + 1); computed from the side on
  // which both are small.
  void logProbabilities(const double* x, const double* s, double* out) const override {
    double low = -kInfinity, criterion = 0.0;
    for (int k = 0; k < categories_; ++k) {
      criterion += k + 1 < categories_ ? s[k + 1] : 0.0;
      const double high = k + 1 < categories_ ? (criterion - x[0]) / s[0] : kInfinity;
      out[k] = low > 0.0 ? logDifference(-low, -high) : logDifference(high, low);
      low = high;
    }
  }
  void writeKeys(json& out) const override {
    out["model"] = "rating";
    out["categories"] = categories_;
  }

 private:
  // ln(Phi(high) - Phi(low))
  static double logDifference(double high, double low) {
    const double logHigh = psychometrics::standardLogValue(SigmoidFamily::Normal, high);
    const double logLow = psychometrics::standardLogValue(SigmoidFamily::Normal, low);
    if (logLow == -kInfinity) return logHigh;
    return logHigh + std::log(-std::expm1(logLow - logHigh));
  }
  int categories_;
  std::vector<ModelParameter> parameters_;
};

/// Probabilities as listed: [stimulus][state][outcome], stimuli and states numbered from 0.
class TableModel : public Model {
 public:
  explicit TableModel(std::vector<std::vector<std::vector<double>>> probabilities, const json& source)
      : probabilities_(std::move(probabilities)), source_(source) {
    parameters_ = {{"state", "number of the column", std::nullopt, 0.0,
                    static_cast<double>(probabilities_[0].size() - 1)}};
  }
  int outcomes() const override { return static_cast<int>(probabilities_[0][0].size()); }
  const std::vector<ModelParameter>& parameters() const override { return parameters_; }
  bool knows(const double* stimulus) const override {
    const double number = stimulus[0];
    return number >= 0.0 && number < static_cast<double>(probabilities_.size()) &&
           number == std::floor(number);
  }
  void logProbabilities(const double* stimulus, const double* s, double* out) const override {
    const auto& row = probabilities_[static_cast<size_t>(stimulus[0])][static_cast<size_t>(s[0])];
    for (size_t k = 0; k < row.size(); ++k) out[k] = std::log(row[k]);
  }
  void writeKeys(json& out) const override {
    out["model"] = "table";
    out["probabilities"] = source_;
  }

 private:
  std::vector<std::vector<std::vector<double>>> probabilities_;
  json source_;
  std::vector<ModelParameter> parameters_;
};

std::shared_ptr<const Model> readTable(SettingsReader& reader) {
  const std::string allowed = "a list [stimulus][state][outcome] of probabilities";
  const json& source = reader.required("probabilities", allowed);
  std::vector<std::vector<std::vector<double>>> table;
  try {
    table = source.get<decltype(table)>();
  } catch (const json::exception&) {
    throw Error("invalid table", reader.at("probabilities"), "give " + allowed);
  }
  const auto refuse = [&](const std::string& what) {
    throw Error(what, reader.at("probabilities"), "give " + allowed + ", all of equal length");
  };
  if (table.empty() || table[0].empty() || table[0][0].size() < 2) refuse("the table has too few entries");
  for (const auto& states : table) {
    if (states.size() != table[0].size()) refuse("stimuli have different numbers of states");
    for (const auto& outcomes : states) {
      if (outcomes.size() != table[0][0].size()) refuse("states have different numbers of outcomes");
      double sum = 0.0;
      for (double p : outcomes) {
        if (!(p >= 0.0 && p <= 1.0)) refuse("a probability is not from 0 to 1");
        sum += p;
      }
      if (std::abs(sum - 1.0) > 1e-9) refuse("probabilities sum to " + shortestNumber(sum) + ", not to 1");
    }
  }
  return std::make_shared<TableModel>(std::move(table), source);
}

std::vector<SigmoidForm> sigmoidForms() {
  return {
      {"weibull",
       "F = 1 - exp(-(x/threshold)^slope), x >= 0 on a linear axis",
       {positive("threshold", "x with F = 1 - 1/e", true), positive("slope", "exponent")},
       [](const double* s) { return Sigmoid::weibull(s[0], s[1]); },
       true},
      {"weibull_log10",
       "F = 1 - exp(-10^(slope (x - threshold))), x in log10 units",
       {anyNumber("threshold", "x with F = 1 - 1/e"), positive("slope", "per log10 unit")},
       [](const double* s) { return Sigmoid::weibullLog10(s[0], s[1]); }},
      {"weibull_db",
       "F = 1 - exp(-10^(slope (x - threshold)/20)), x in dB (Watson 2017)",
       {anyNumber("threshold", "x with F = 1 - 1/e"), positive("slope", "per 20 dB")},
       [](const double* s) { return Sigmoid::weibullDecibel(s[0], s[1]); }},
      {"logistic",
       "F = 1/(1 + exp(-slope (x - threshold)))",
       {anyNumber("threshold", "x with F = 0.5"), positive("slope", "per unit of x")},
       [](const double* s) { return Sigmoid::logistic(s[0], s[1]); }},
      {"normal",
       "F = Phi((x - mean)/sd)",
       {anyNumber("mean", "x with F = 0.5"), positive("sd", "standard deviation", true)},
       [](const double* s) { return Sigmoid::normal(s[0], s[1]); }},
  };
}

// F by threshold and width, as in psignifit.
SigmoidForm thresholdWidthForm(SigmoidFamily family, StimulusAxis axis) {
  const bool logarithmic = axis == StimulusAxis::Logarithmic || family == SigmoidFamily::Weibull;
  return {
      "sigmoid",
      "F of `family` by threshold and width",
      {logarithmic ? positive("threshold", "x with F = 0.5", true) : anyNumber("threshold", "x with F = 0.5"),
       positive("width", "from F = 0.05 to 0.95; of ln x on a logarithmic axis", !logarithmic)},
      [family, axis](const double* s) { return Sigmoid::fromThresholdWidth(family, axis, s[0], s[1]); },
      logarithmic};
}

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const SigmoidForm& form : sigmoidForms()) names.emplace_back(form.name);
  for (const char* name : {"sigmoid", "csf", "csf_spatiotemporal", "thurstone", "rating", "table"})
    names.emplace_back(name);
  return names;
}

}  // namespace

std::shared_ptr<const Model> readModel(SettingsReader& reader, const std::string& otherwise) {
  const std::string name = reader.choiceOr("model", otherwise, modelNames());
  if (name == "csf") return std::make_shared<ContrastSensitivityModel>(false);
  if (name == "csf_spatiotemporal") return std::make_shared<ContrastSensitivityModel>(true);
  if (name == "thurstone") return std::make_shared<ThurstoneModel>();
  if (name == "rating") return std::make_shared<RatingModel>(reader.integer("categories", 2, 20));
  if (name == "table") return readTable(reader);
  const bool equal = reader.choiceOr("asymptotes", "free", {"free", "equal"}) == "equal";
  if (name == "sigmoid") {
    const std::string family = reader.choiceOr("family", "logistic", psychometrics::sigmoidNames());
    const std::string axis =
        reader.choiceOr("axis", family == "weibull" ? "log" : "linear", {"linear", "log"});
    return std::make_shared<SigmoidModel>(
        thresholdWidthForm(psychometrics::sigmoidFamily(family),
                           axis == "log" ? StimulusAxis::Logarithmic : StimulusAxis::Linear),
        equal, json{{"family", family}, {"axis", axis}});
  }
  const std::vector<SigmoidForm> forms = sigmoidForms();
  const auto form = std::find_if(forms.begin(), forms.end(), [&](const auto& f) { return name == f.name; });
  return std::make_shared<SigmoidModel>(*form, equal, json::object());
}

namespace {

std::string describe(const std::vector<ModelParameter>& parameters) {
  std::string out;
  for (const ModelParameter& p : parameters) {
    out += "        " + p.name + ": " + p.description;
    if (p.otherwise) out += " (default " + shortestNumber(*p.otherwise) + ")";
    out += "\n";
  }
  return out;
}

}  // namespace

std::string describeModels() {
  std::string out =
      "Models: P of outcome 1 is guess + (1 - guess - lapse) F unless said otherwise. `asymptotes: equal` "
      "makes\n"
      "guess = lapse, with lapse the one parameter.\n";
  for (const SigmoidForm& form : sigmoidForms()) {
    out += std::string("    ") + form.name + ": " + form.formula + "\n" + describe(form.shape);
  }
  out +=
      "    sigmoid: F by threshold and width (psignifit 4); keys `axis` (linear, log) and `family` (\n     "
      " " +
      join(psychometrics::sigmoidNames()) + ")\n" +
      describe(thresholdWidthForm(SigmoidFamily::Logistic, StimulusAxis::Linear).shape);
  out += "      of all of these:\n" + describe({guessRate(), lapseRate()});
  out +=
      "    csf: stimulus contrast (dB) and spatial_frequency; a weibull_db whose threshold is\n"
      "      max(minimum_threshold, c0 + cf spatial_frequency) (Watson 2017, example 4)\n" +
      describe(ContrastSensitivityModel(false).parameters()) +
      "    csf_spatiotemporal: the same with a stimulus dimension temporal_frequency: + cw "
      "temporal_frequency (eq. 8)\n";
  out +=
      "    thurstone: stimulus first and second, from 0 to 1; outcome 1: the first is judged greater, with\n"
      "      Phi((S(first) - S(second))/sqrt 2), S(x) = maximum (max(0, x - threshold)/(1 - "
      "threshold))^power\n" +
      describe(ThurstoneModel().parameters());
  out += "    rating: `categories` ordered outcomes; outcome >= k with Phi((x - criterion_k)/sd)\n" +
         describe(RatingModel(3).parameters());
  out +=
      "    table: `probabilities` as a list [stimulus][state][outcome]; stimuli and states are numbered from "
      "0\n";
  return out;
}

}  // namespace limen::study
