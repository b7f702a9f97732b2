// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace limen::perception {

/// One number that a command reports for a frame.
struct Figure {
  std::string name;  ///< "rmse", "largest_jnd"
  std::string unit;  ///< "" for pure numbers
  std::string meaning;
  bool higherIsBetter = false;
  /// None if it cannot be determined for this frame: `reason` says why. Without a popping region there is no
  /// rating.
  std::optional<double> value;
  std::string reason;
};
using Figures = std::vector<Figure>;

/// A bound given with --fail-above or --fail-below.
struct Limit {
  std::string figure;
  double value = 0.0;
  bool below = false;  ///< fails below the value, for figures where higher is better
};

/// Reads "NAME=VALUE" (or just a number, which refers to `bare` unless that is empty). `known` are the
/// figures of the command, without values. Throws Error: unknown name, not a number, a bound on the good
/// side.
std::vector<Limit> parseLimits(const std::vector<std::string>& above, const std::vector<std::string>& below,
                               const Figures& known, const std::string& bare);

/// Which limit is exceeded, as text for stderr: "rmse is 0.2, above 0.1". A figure without a value because
/// there was nothing to rate passes. Throws Error for one that could not be computed (reason with
/// `required`).
std::vector<std::string> exceeded(const Figures& figures, const std::vector<Limit>& limits);

/// Figures of many frames: mean, median, extremes with the frames that have them.
class FigureSummary {
 public:
  void add(const Figures& figures, const std::string& frame);
  /// {"rmse": {"mean":, "median":, "min":, "min_frame":, "max":, "max_frame":, "frames":}, ...}; frames
  /// without a value do not count; null if none has one.
  nlohmann::json toJson() const;
  /// Of these figures; of all if none is named.
  std::string table(const std::vector<std::string>& shown = {}) const;
  /// The frame with the worst value of a figure; "" if no frame has one.
  std::string worstFrame(const std::string& figure) const;

 private:
  struct Series {
    Figure figure;
    std::vector<double> values;
    std::vector<std::string> frames;
  };
  std::vector<Series> series_;  ///< in order of first appearance
};

/// Those with these names; all if none is named.
Figures shownOf(const Figures& figures, const std::vector<std::string>& shown);
/// Aligned lines "  name   value unit".
std::string figureTable(const Figures& figures);
nlohmann::json figuresAsJson(const Figures& figures);
/// Six significant digits.
std::string numberText(double value);

}  // namespace limen::perception
