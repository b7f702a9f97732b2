// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

/// The budgets between which a map varies, in micro-occluders per pixel. Between them the square root, the
/// number of micro-occluders per axis, follows what a driver measures: error and cost per axis depend on it.
struct BudgetRange {
  int64_t least = 25, most = 256;
  float leastRoot() const;
  float mostRoot() const;
};

struct UniformBudget {
  static constexpr const char *kKind = "uniform", *kSummary = "the same for all pixels";
  int limit = 256;  ///< micro-occluders; 0: no limit
  static const SettingsTable<UniformBudget>& table();
};

/// Schwarz 2009, figure 5.5 d: 12^2 in the centre and 5^2 at the left and right borders.
struct RadialBudget {
  static constexpr const char *kKind = "radial", *kSummary = "falling from a centre towards a rim";
  int64_t centre = 256, rim = 25;
  double centreX = 0.5, centreY = 0.5;  ///< share of the image, from its top left corner
  double inner = 0.0, outer = 1.0;      ///< half widths of the image
  static const SettingsTable<RadialBudget>& table();
  void check() const;
};

struct MaskingBudget {
  static constexpr const char *kKind = "masking", *kSummary = "reduced where the receivers' texture masks";
  int64_t plain = 256, masked = 25;
  int radius = 8;  ///< px
  double lowContrast = 0.05, highContrast = 0.2;
  static const SettingsTable<MaskingBudget>& table();
  void check() const;
  BudgetRange range() const { return {masked, plain}; }
};

/// How an image with another aspect ratio than the frame's is treated.
enum class PaintedFit {
  Refuse,   ///< an error, beyond rounding to whole pixels
  Stretch,  ///< each axis by its own factor
  Cover     ///< one factor; what then lies beyond the frame is cropped symmetrically
};
constexpr EnumNames<PaintedFit, 3> enumNames(PaintedFit) {
  return {{{{PaintedFit::Refuse, "refuse"}, {PaintedFit::Stretch, "stretch"}, {PaintedFit::Cover, "cover"}}}};
}

struct PaintedBudget {
  static constexpr const char *kKind = "painted", *kSummary = "from an image of weights";
  FilePath file;
  int64_t white = 256, black = 25;
  PaintedFit fit = PaintedFit::Refuse;
  static const SettingsTable<PaintedBudget>& table();
  void check() const;
  BudgetRange range() const { return {black, white}; }
};

/// Threshold map that a perceptual budget keeps errors below, with its default settings.
enum class BudgetThresholds {
  Single,       ///< one threshold for all frequencies: larger, and not safe
  Bands,        ///< combined from frequency bands by the predictor
  Schwarz2009,  ///< Single, with the thesis's settings
};
constexpr EnumNames<BudgetThresholds, 3> enumNames(BudgetThresholds) {
  return {{{{BudgetThresholds::Single, "single"},
            {BudgetThresholds::Bands, "bands"},
            {BudgetThresholds::Schwarz2009, "schwarz_2009"}}}};
}

struct PerceptualBudget {
  static constexpr const char *kKind = "perceptual",
                              *kSummary = "enough to keep errors below a threshold map";
  int64_t most = 256, least = 25;
  BudgetThresholds thresholdMap = BudgetThresholds::Single;
  double error = 2.0;       ///< of the visibility with one micro-occluder per axis
  double thresholds = 1.0;  ///< multiple of the visible increment
  std::string display = "schwarz_2009";
  double ambient = 0.2, diffuse = 0.8;  ///< shares of the albedo
  static const SettingsTable<PerceptualBudget>& table();
  void check() const;
  BudgetRange range() const { return {least, most}; }
};

/// A limit for all pixels, scaled by the frame time.
struct ScaledBudget {
  static constexpr const char *kKind = "uniform", *kSummary = "the same for all pixels";
  int64_t limit = 256;
  static const SettingsTable<ScaledBudget>& table();
};

struct FrameTimeBudget {
  using Base = std::variant<ScaledBudget, RadialBudget, MaskingBudget, PaintedBudget, PerceptualBudget>;
  static constexpr const char *kKind = "frame_time",
                              *kSummary = "another budget, scaled to the available frame time";
  double targetMs = 2.0;
  int64_t least = 25;
  Base base;
  double gain = 0.25, deadBand = 0.05;
  int memory = 32;  ///< frames
  double largestFactor = 4.0;
  bool dither = true;
  int settleFrames = 32;
  static const SettingsTable<FrameTimeBudget>& table();
  void check() const;
  /// `least`, and the largest number that the base allows.
  BudgetRange range() const;
};

/// Micro-occluders allowed per pixel: the same for all, or an image made by a driver. Source: Schwarz 2009,
/// sections 4.1, 4.5 and 5.2.1.
using BudgetSettings = std::variant<UniformBudget, RadialBudget, MaskingBudget, PaintedBudget,
                                    PerceptualBudget, FrameTimeBudget>;

/// The largest number that any pixel may use; 0: no limit.
int64_t mostOf(const BudgetSettings& budget);

}  // namespace limen::techniques
