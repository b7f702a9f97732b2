// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "experiments/base/parameter.h"

namespace limen::study {

/// Which stimuli of a store are predicted, and how.
struct StorePredictionRequest {
  std::string store;
  std::string protocol;  ///< name or SHA-256; "": all
  std::string
      display;  ///< preset or profile to use instead of the one that a session was shown on; "": that one
  ParameterValues popping;  ///< of perception::PoppingSettings
  /// Also ColorVideoVDP of the clip around each change, which takes some dozen frames.
  bool clips = false;
  /// Cache file for the popping predictor's results, shared with observers that use it; "": none.
  std::string cacheFile;
  /// Called after each stimulus with how many are done and how many there are.
  std::function<void(int, int)> progress;
};

struct StorePredictionEnd {
  int made = 0, known = 0;
  bool stopped = false;  ///< by SIGINT or SIGTERM
};

/// Predictions by popping predictor and image metrics for the changes shown in the sessions of a store,
/// without practice, added to the store unless already present. Throws Error: no sessions, none of the
/// protocol, no change among the stimuli, and whatever predictor and renderer refuse.
StorePredictionEnd predictStore(const StorePredictionRequest& request);

}  // namespace limen::study
