// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/enum_names.h"
#include "perception/psychometrics/sigmoid.h"

namespace limen::analysis {

/// Level of trials that showed no stimulus (catch trials): F = 0 there, whatever threshold, width, axis and
/// direction, so that P is the guess rate. Such blocks are not part of ranges of levels.
inline constexpr double kNoStimulus = -std::numeric_limits<double>::infinity();

/// Answers to `trials` presentations of one stimulus level.
struct Block {
  double level = 0.0;  ///< finite, or kNoStimulus; 0 on a logarithmic axis is no stimulus, too
  int64_t correct = 0, trials = 0;
  double order = 0.0;  ///< when it was shown, in any unit; simultaneous blocks have the same value
};

/// Blocks that one psychometric function describes.
struct Condition {
  std::string name;
  std::vector<Block> blocks;
};

/// What describes one condition. Threshold is the level x at which F = FitSettings::thresholdLevel; width is
/// the distance on the axis from F = 0.05 to 0.95, in units of ln x on a logarithmic axis.
enum class FitParameter { Threshold, Width, Guess, Lapse, Eta };
inline constexpr size_t kFitParameters = 5;
const std::array<std::string, kFitParameters>& fitParameterNames();  ///< "threshold", ...
inline size_t indexOf(FitParameter parameter) { return static_cast<size_t>(parameter); }
inline bool isRate(FitParameter parameter) {
  return parameter != FitParameter::Threshold && parameter != FitParameter::Width;
}

/// The guess rate: a separate rate (yes/no), 1/M for forced choice, or equal to the lapse rate.
struct FitTask {
  enum class Kind { YesNo, ForcedChoice, EqualAsymptotes };
  Kind kind = Kind::ForcedChoice;
  int alternatives = 2;  ///< of a forced choice
};
/// "yesno", "2afc", "mafc:M", "equal". Throws Error that names `where`.
FitTask readFitTask(const std::string& text, const std::string& where);
std::string nameOf(const FitTask& task);

enum class FitMethod {
  MaximumLikelihood,
  MaximumPosterior  ///< the mode of likelihood times priors (prior.h)
};
constexpr EnumNames<FitMethod, 2> enumNames(FitMethod) {
  return {{{{FitMethod::MaximumLikelihood, "ml"}, {FitMethod::MaximumPosterior, "map"}}}};
}

struct FitSettings {
  psychometrics::SigmoidFamily sigmoid = psychometrics::SigmoidFamily::Normal;
  psychometrics::StimulusAxis axis = psychometrics::StimulusAxis::Linear;
  /// F falls with x, as detection does with distance: the rising sigmoid is one of -x, on a logarithmic axis
  /// of 1/x. For families that are not symmetric that is not 1 - F of the rising one.
  bool falling = false;
  FitTask task;
  FitMethod method = FitMethod::MaximumLikelihood;
  double thresholdLevel = 0.5;  ///< the F that defines the threshold
  /// Parameters that are not fitted, and their values. A threshold is one of x, a width one of the axis.
  std::array<std::optional<double>, kFitParameters> fixed;
  /// Parameters shared by all conditions.
  std::array<bool, kFitParameters> shared{};
  double lapseMost = 0.1;  ///< upper bound of a fitted lapse rate
  double guessMost = 0.5;  ///< upper bound of a fitted guess rate
  /// Fit eta: answers are beta-binomial with nu = 1/eta^2 - 1 in place of binomial (Schuett et al. 2016).
  bool overdispersion = false;
  /// Levels between which the threshold is expected to lie, for bounds and priors; those of the data unless
  /// set.
  std::optional<std::array<double, 2>> range;

  bool sharesAny() const { return std::find(shared.begin(), shared.end(), true) != shared.end(); }
  bool logarithmic() const {
    return axis == psychometrics::StimulusAxis::Logarithmic ||
           sigmoid == psychometrics::SigmoidFamily::Weibull;
  }
};

/// Throws Error for settings or data that have no fit: no trials, counts out of range, levels that are
/// neither finite nor kNoStimulus, or cannot be on a logarithmic axis, one level if threshold and width are
/// both free, fixed values out of range. `where` names the data.
void checkFit(const std::vector<Condition>& conditions, const FitSettings& settings,
              const std::string& where = {});

/// Whether answers get worse with the level: the covariances of level (on the axis) and answers within
/// conditions sum to less than 0. Trials without a stimulus do not count.
bool answersFall(const std::vector<Condition>& conditions, const FitSettings& settings);

}  // namespace limen::analysis
