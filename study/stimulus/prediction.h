// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "perception/vision/display.h"
#include "renderer/gl/context.h"
#include "study/stimulus/stimulus.h"
#include "study/stimulus/stimulus_scene.h"

namespace limen::study {

/// The popping predictor's result for a stimulus's change. Source: Schwarz 2009, chapter 10.
struct PredictedPopping {
  struct Region {
    int64_t sizePx = 0;
    double sigmaJnd = 0.0, rating = 0.0, largestJnd = 0.0, detectionProbability = 0.0;
    glm::ivec2 leastPx{0}, mostPx{0};  ///< bounding box, both corners inclusive, window pixels
    bool atCue = true;                 ///< whether the question is about it; true of all without a cue
  };
  /// Version of the figures below, raised when their meaning changes. 1: `rating` and `detectionProbability`
  /// were those of the region rated highest, cued or not, and the figures of the rest did not exist. 2:
  /// flicker was found in single samples. 3: onsets between 0.0113 and 0.014 cd/m2 were off by up to a factor
  /// of 2.4.
  static constexpr int kVersion = 4;
  /// What the question is about: the region rated highest among those at the cue (see cued_place.h), of all
  /// without a cue. Without such a region, one less than the lowest possible rating of a region, so that it
  /// stays finite.
  double rating = 0.0;
  double detectionProbability = 0.0;  ///< probability for that rating; the guess rate without a region
  /// The same of all regions away from the cue; nothing without a cue.
  std::optional<double> restRating, restDetectionProbability;
  std::vector<Region> regions;  ///< highest rating first
  int64_t poppingPx = 0;        ///< in all regions
  double coverage = 0.0;        ///< of the window
  /// Share of the changing object's pixels, before or after the change, that lie in a region; of the window
  /// if a technique changes.
  double coverageOfObject = 0.0;
  double largestJnd = 0.0;
  double largestDe94 = 0.0;  ///< CIE94 between the two pictures, for comparison with the predictor
  bool operator==(const PredictedPopping&) const;
  /// Whether there is a region that the question is about.
  bool popsAtCue() const;
};
nlohmann::json toJson(const PredictedPopping& prediction);
PredictedPopping predictedPoppingFromJson(const nlohmann::json& json);

/// Predictions by their inputs, in memory and, if a file is named, in that file.
class PredictionCache {
 public:
  /// `file` empty: memory only. Throws Error on a file that is not such a cache.
  explicit PredictionCache(std::string file = {});
  std::optional<PredictedPopping> find(const std::string& key) const;
  /// Keeps what other programs have since added to the file. Throws Error if it cannot be written.
  void add(const std::string& key, const PredictedPopping& prediction);

 private:
  std::string file_;
  std::map<std::string, PredictedPopping> known_;
};

/// Predicts how likely an attending viewer notices the change of stimuli in one window of one display.
///
/// The pictures are those shown, byte for byte: the first frame after the change, and the same frame in the
/// state before it. In a dynamic sequence displacements and disocclusion are those of the window's pixel
/// centres, the previous frame being one display frame earlier; flicker is that of the pictures as shown, of
/// pixel centres if there are highlights. A static sequence has none. If a technique changes there is no
/// flicker weight, since there is no separate shading to evaluate it with.
class Predictor {
 public:
  /// `popping`: values of perception::PoppingSettings; what is left out takes its default. Throws Error.
  Predictor(gl::Context& context, glm::ivec2 windowPx, const perception::DisplayProfile& display,
            const ParameterValues& popping = {}, PredictionCache* cache = nullptr);

  /// A sequence without change has no region. Throws Error like StimulusRenderer.
  PredictedPopping predict(const Stimulus& stimulus);
  /// SHA-256 over everything that determines the prediction: what changes and when, where the cue points,
  /// window, display, settings.
  std::string key(const Stimulus& stimulus) const;

 private:
  PredictedPopping withoutChange() const;
  PredictedPopping make(const Stimulus& stimulus);

  gl::Context& context_;
  glm::ivec2 windowPx_;
  perception::DisplayProfile display_;
  ParameterValues popping_;
  PredictionCache own_;
  PredictionCache& cache_;
  SceneCache scenes_;
};

}  // namespace limen::study
