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

/// What the popping predictor says about a stimulus' change. Source: Schwarz 2009, chapter 10.
struct PredictedPopping {
  struct Region {
    int64_t sizePx = 0;
    double sigmaJnd = 0.0, rating = 0.0, largestJnd = 0.0, detectionProbability = 0.0;
    glm::ivec2 leastPx{0}, mostPx{0};  ///< bounding box, both corners inside, window pixels
  };
  /// Of the region rated highest. Without a region one less than the least rating that a region can have, so
  /// that it stays a number.
  double rating = 0.0;
  double detectionProbability = 0.0;  ///< of that rating; the guess rate without a region
  std::vector<Region> regions;        ///< highest rating first
  int64_t poppingPx = 0;              ///< in all regions
  double coverage = 0.0;              ///< of the window
  /// Share of the changing object's pixels, before or after the change, that lie in a region; of the window
  /// where a technique changes.
  double coverageOfObject = 0.0;
  double largestJnd = 0.0;
  double largestDe94 = 0.0;  ///< CIE94 between the two pictures, what the predictor is compared with
  bool operator==(const PredictedPopping&) const;
};
nlohmann::json toJson(const PredictedPopping& prediction);
PredictedPopping predictedPoppingFromJson(const nlohmann::json& json);

/// Predictions by what decides them, in memory and, if a file is named, in it.
class PredictionCache {
 public:
  /// `file` empty: memory only. Throws Error on a file that is no such cache.
  explicit PredictionCache(std::string file = {});
  std::optional<PredictedPopping> find(const std::string& key) const;
  /// What other programs put into the file since stays in it. Throws Error if it cannot be written.
  void add(const std::string& key, const PredictedPopping& prediction);

 private:
  std::string file_;
  std::map<std::string, PredictedPopping> known_;
};

/// Predicts how likely an attending viewer notices the change of stimuli in one window of one display.
///
/// The pictures are those that are shown, byte for byte: the first frame after the change, and the same frame
/// with what was before it. In a dynamic sequence displacements, disocclusion and flicker are those of the
/// window's pixel centres, the frame before being one of the display's frames earlier; a static one has none.
/// Where a technique changes there is no flicker weight, since it has no shading of its own to evaluate it
/// by.
class Predictor {
 public:
  /// `popping`: values of perception::PoppingSettings; what is left out takes its default. Throws Error.
  Predictor(gl::Context& context, glm::ivec2 windowPx, const perception::DisplayProfile& display,
            const ParameterValues& popping = {}, PredictionCache* cache = nullptr);

  /// A sequence without change has no region. Throws Error as StimulusRenderer.
  PredictedPopping predict(const Stimulus& stimulus);
  /// SHA-256 over all that decides the prediction: what changes and when, window, display, settings.
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
