// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/example/example.h"

namespace limen::study {

struct ExampleRequest {
  std::string folder;  ///< is made if it is not there
  /// A line for the user: what is done next.
  std::function<void(const std::string&)> say;
  /// How far a long step is; true stops.
  std::function<bool(const std::string&)> progress;
};

struct ExampleEnd {
  bool stopped = false;            ///< by `progress` or a signal; the same call goes on
  std::string summary;             ///< text of summary.txt
  std::vector<std::string> notes;  ///< what could not be made, and why
};

/// Simulates each study into FOLDER/NAME.sqlite, predicts its stimuli, lets limen-analyse write
/// FOLDER/NAME_ANALYSIS.json and .csv and the page FOLDER/NAME_report, then sets all that was published
/// beside the answers: comparison.csv, summary.json, summary.txt. What an earlier call finished is not done
/// again: a killed call loses no more than the session or the prediction in progress. The result does not
/// depend on it.
///
/// Throws Error: a store in the folder whose sessions are not those of this example, a folder that cannot be
/// made, limen-analyse missing or failing, and what protocol, predictor and renderer refuse.
ExampleEnd runExample(const Example& example, const ExampleRequest& request);

}  // namespace limen::study
