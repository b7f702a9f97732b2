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
  std::string display;   ///< preset or profile in place of the one that a session was shown on; "" that one
  ParameterValues popping;  ///< of perception::PoppingSettings
  /// File that keeps what the popping predictor said, shared with observers who see with it; "" none.
  std::string cacheFile;
  /// Called after each stimulus with how many are done and how many there are.
  std::function<void(int, int)> progress;
};

struct StorePredictionEnd {
  int made = 0, known = 0;
  bool stopped = false;  ///< by SIGINT or SIGTERM
};

/// What popping predictor and image metrics say of the changes that the sessions of a store showed, practice
/// aside, added to the store unless it is there. Throws Error: no sessions, none of the protocol, no change
/// among what was shown, and what predictor and renderer refuse.
StorePredictionEnd predictStore(const StorePredictionRequest& request);

}  // namespace limen::study
