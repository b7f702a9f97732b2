// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/store/sessions.h"

namespace limen::store {

/// What a predictor predicts for a stimulus with a change (table `prediction`). All members except `id`,
/// `created` and `figures` form its key.
struct StudyPrediction {
  int64_t id = 0;
  std::string stimulusHash, displayHash;
  int widthPx = 0, heightPx = 0;  ///< of the window
  std::string predictor;
  nlohmann::json settings = nlohmann::json::object();  ///< all values that determine the figures
  std::string programVersion, created;
  nlohmann::json figures = nlohmann::json::object();
};

/// SHA-256 of settings as the store holds them.
std::string settingsHash(const nlohmann::json& settings);

/// Names what a stimulus looks like in one window of one display: "clip_" and 16 hexadecimal digits. Exported
/// clips have these names, and scores of them come back under them.
std::string clipName(const std::string& stimulusHash, const std::string& displayHash, int widthPx,
                     int heightPx);

/// Writes predictions. Like SessionLog, every member throws Error.
class PredictionLog {
 public:
  explicit PredictionLog(const std::string& path);
  ~PredictionLog();
  PredictionLog(const PredictionLog&) = delete;
  PredictionLog& operator=(const PredictionLog&) = delete;

  /// Whether there is one with this key.
  bool has(const StudyPrediction& key) const;
  /// False, and nothing is written, if there is one with this key (another process may have been faster).
  bool add(const StudyPrediction& prediction, const StudyDisplay& display);

 private:
  sqlite3* database_ = nullptr;
};

/// Every prediction of a store, oldest first. Throws Error: no store, or one whose schema has no studies.
std::vector<StudyPrediction> readPredictions(const std::string& path);

}  // namespace limen::store
