// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "perception/popping/regions.h"
#include "perception/popping/settings.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// What the predictor compares: the frame as it was rendered with the new level of detail (actual) and the
/// same frame with the old one (predicted). All images have the same size, row 0 at the top.
struct PoppingInput {
  /// 1 channel (grey) or 3 or more (RGB, others ignored).
  Image actual, predicted;
  /// Values are light (Rec. 709, 1: the display's white); those above 1 are brighter than the display's
  /// white. Otherwise they are pixel values, which the display's transfer curve turns into light.
  bool linear = false;
  /// The predicted content is shown until the actual one replaces it, and viewers watch for that: `temporal`
  /// of the settings applies. Otherwise both are compared as lasting pictures.
  bool isSwitch = false;
  /// Displacement of each pixel against the previous frame: 2 or more channels, pixels per frame. Empty:
  /// nothing moves. If only one is given, it is used for both frames.
  Image actualDisplacement, predictedDisplacement;
  /// Factors in [0, 1] on the difference map, 1 channel, e.g. disocclusionWeight() and flickerWeight().
  /// Empty: 1 everywhere.
  Image disocclusion, flicker;
};

/// Derived quantities of the model for one display and image size; part of every result, so that they can be
/// printed.
struct PoppingModel {
  double pixelsPerDegree = 0.0;
  double areaDeg2 = 0.0, widthDeg = 0.0;  ///< of the images on the display
  int gaussianLevels = 0, contrastLevels = 0, adaptationLevel = 0;
  std::vector<double> peakCpd, gain;                  ///< of each contrast level
  double scaleA = 1.0, scaleRg = 1.0, scaleBy = 1.0;  ///< on the sensitivities: calibration
};

struct PoppingSummary {
  double largestJnd = 0.0, meanJnd = 0.0;
  /// Mean of the signed difference map: positive where the actual frame has the stronger response. Swapping
  /// the frames flips its sign.
  double signedMeanJnd = 0.0;
  int64_t aboveThresholdPx = 0;       ///< pixels of at least regionThresholdJnd
  int64_t seedPx = 0;                 ///< those whose input colours differ
  int64_t regionPx = 0;               ///< in popping regions
  double coverage = 0.0;              ///< regionPx over all pixels
  double largestRating = 0.0;         ///< minus infinity without a region
  double detectionProbability = 0.0;  ///< of the highest rating; the guess rate without a region
};

struct PoppingResult {
  Image jnd;                     ///< difference map after weighting [JND], 1 channel
  std::vector<double> jndExact;  ///< the same in double precision
  RegionMap regions;
  PoppingSummary summary;
  PoppingModel model;
  int64_t flushedInputs = 0;     ///< non-finite input values that were replaced by 0 (weights: by 1)
  int64_t guardedContrasts = 0;  ///< contrasts whose denominator was raised to denominatorEpsilon
  /// Requested stages, by name, each with the size of its pyramid level (see poppingStages()).
  std::map<std::string, Image> stages;
};

struct PoppingOptions {
  /// Sensitivities: false evaluates the model for each pixel; true reads fine tables (see sensitivity.h),
  /// which is faster and differs by less than 1e-6 of the value.
  bool tables = true;
  /// Names of stages to return; "all" for every one.
  std::vector<std::string> stages;
};

/// Names of the stages of a model, in the order of computation: "lms_actual_0" ... (cone responses, alpha the
/// speed in pixels per frame), "contrast_actual_0" ... (A, a, b), "luminance_actual_0" ... (adaptation,
/// cd/m2), "velocity_actual_0" ... (retinal, deg/s), "response_actual_0" ... (JND, A, a, b, as a
/// lasting picture), the same for "predicted", "difference_0" ... (A, a, b), "jnd" (before weighting),
/// "signed_jnd" (weighted), "weight", "weighted_jnd", "seeds", "labels", "rating".
std::vector<std::string> poppingStages(const PoppingModel& model);

/// The model that predictPopping() uses. Throws Error like that.
PoppingModel poppingModel(int widthPx, int heightPx, const DisplayProfile& display,
                          const PoppingSettings& settings);

/// The predictor in double precision: the reference for the GPU's. Finite on every input. Throws Error on
/// images of different sizes or too few channels, and on an unknown stage. Source: Schwarz 2009,
/// section 10.3. Uniform content has no contrast and never pops, however much it changes: a property of the
/// model.
PoppingResult predictPopping(const PoppingInput& input, const DisplayProfile& display,
                             const PoppingSettings& settings = {}, const PoppingOptions& options = {});

}  // namespace limen::perception
