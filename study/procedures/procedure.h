// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace limen::study {

struct ProcedureTrial {
  std::vector<double>
      stimulus;     ///< one value per stimulus dimension, in the order of ProcedureSettings::stimulus
  int outcome = 0;  ///< 0 = no or incorrect, 1 = yes or correct; or the category
};

struct ParameterEstimate {
  std::string name;
  double mean = 0.0, median = 0.0, mode = 0.0;
  double low = 0.0, high = 0.0;  ///< interval of Estimate::kind
  std::string unit;
};

/// The estimate from the answers so far. `kind` names the interval; the kinds differ in meaning:
///   - "equal-tailed credible interval" (quest, psi, quest_plus): given model, prior and answers the
///   parameter lies
///     inside with probability `level`. For observers drawn from the prior it contains the truth that often,
///     which the tests check; for one fixed observer it may not, and it does not account for a wrong slope or
///     lapse rate fixed in the settings.
///   - "mean of N reversals, approximate t interval of block means" (staircase): for the stimulus at which
///   the rule
///     targets its probability. Reversals depend on each other and the rule settles only near its target
///     (Garcia-Perez 1998, Vision Research 38), so that it contains the targeted stimulus less often than
///     `level`, much less with few reversals: see meanOfReversals() in staircase.h for measured rates. There
///     is no mode.
///   - "proportions, Wilson score interval" (constant): for every stimulus the proportion of outcome 1 with
///   Wilson's
///     (1927) interval: over repetitions of the experiment it contains the true probability with a frequency
///     of about `level`.
/// With too few answers for an interval, `low` and `high` are NaN, as are estimates that do not exist yet.
struct Estimate {
  double level = 0.95;
  std::string kind;
  std::vector<ParameterEstimate> parameters;
};

/// Chooses the stimulus of each trial from the previous answers. A pure function of settings, seed and
/// answered trials: the same trials give the same next stimulus and state bit for bit.
class Procedure {
 public:
  virtual ~Procedure();
  /// Stimulus of the next trial, the same until update(); nothing once the procedure has finished.
  virtual std::optional<std::vector<double>> next() const = 0;
  /// Takes an answer, in the order of the answers. The stimulus need not be the one from next(): a trial may
  /// have been shown with another (rounded, or published). Answers after the end are accepted too. Throws
  /// Error for a stimulus of the wrong length, an outcome that does not exist or an answer that is impossible
  /// under the model.
  virtual void update(const std::vector<double>& stimulus, int outcome) = 0;
  virtual int trialsDone() const = 0;
  virtual Estimate estimate(double level = 0.95) const = 0;
  /// Everything that determines future behaviour, for bit-for-bit comparison; a posterior as its hash.
  virtual nlohmann::json state() const = 0;
};

struct StimulusDimension {
  std::string name, unit;
  double minimum = 0.0, maximum = 0.0;  ///< limits of next(); infinite if there are none
};

/// Settings of one type of procedure, checked.
class ProcedureDetail {
 public:
  virtual ~ProcedureDetail();
  virtual std::unique_ptr<Procedure> make(uint64_t seed) const = 0;
  /// All keys but `type`, defaults written out.
  virtual nlohmann::json toJson() const = 0;
};

/// Parsed and checked settings; cheap to copy.
struct ProcedureSettings {
  std::string type;  ///< "constant", "staircase", "quest", "psi", "quest_plus", "interleaved"
  std::vector<StimulusDimension> stimulus;  ///< what next() returns, in this order; for interleaved ones the
                                            ///< first is "procedure", the number of the one that requested it
  int outcomes = 2;
  std::optional<int> mostTrials;  ///< the procedure ends after these at the latest, if known
  std::shared_ptr<const ProcedureDetail> detail;
};

/// Reads settings: an object with `type` and the keys of that type (describeProcedures()). Throws Error that
/// names the key after `where`, what is allowed and the nearest valid name; unknown keys are refused.
ProcedureSettings readProcedure(const nlohmann::json& settings, const std::string& where);

/// The settings with every default written out; readProcedure() reads it back to the same.
nlohmann::json toJson(const ProcedureSettings& settings);

std::unique_ptr<Procedure> makeProcedure(const ProcedureSettings& settings, uint64_t seed);

/// Help text: all types and keys with defaults, units and sources.
std::string describeProcedures();

}  // namespace limen::study
