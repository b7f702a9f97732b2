// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/example/example.h"

namespace limen::study {

struct ExampleRequest {
  std::string folder;  ///< created if it does not exist
  /// A line for the user: the next step.
  std::function<void(const std::string&)> say;
  /// Progress of a long step; return true to stop.
  std::function<bool(const std::string&)> progress;
};

struct ExampleEnd {
  bool stopped = false;            ///< by `progress` or a signal; the same call resumes
  std::string summary;             ///< text of summary.txt
  std::vector<std::string> notes;  ///< what could not be produced, and why
};

/// Simulates each study into FOLDER/NAME.sqlite, predicts its stimuli, lets limen-analyse write
/// FOLDER/NAME_ANALYSIS.json and .csv and the page FOLDER/NAME_report, then compares published results with
/// the answers: comparison.csv, summary.json, summary.txt. Finished steps of an earlier call are not
/// repeated: a killed call loses at most the session or prediction in progress. The result does not depend on
/// interruptions.
///
/// Throws Error: a store in the folder whose sessions are not those of this example, a folder that cannot be
/// created, limen-analyse missing or failing, and whatever protocol, predictor and renderer refuse.
ExampleEnd runExample(const Example& example, const ExampleRequest& request);

}  // namespace limen::study
