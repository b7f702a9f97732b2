// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace limen::study {

/// Settings of every type, each with an end after a known number of trials.
inline std::vector<nlohmann::json> exampleSettings() {
  const char* const kTexts[] = {
      R"({"type": "constant", "stimulus": [{"name": "x", "values": [0.1, 0.2, 0.4]}, {"name": "y", "values": [1, 2]}],
          "repetitions": 7})",
      R"({"type": "staircase", "stimulus": {"name": "contrast", "start": 0.5, "minimum": 0.001, "maximum": 1},
          "scale": "db", "steps": [8, 4, 2], "down": 3, "stop": {"trials": 50, "reversals": 20}})",
      R"({"type": "quest", "threshold_guess": -1, "threshold_guess_sd": 1, "stop": {"trials": 40}})",
      R"({"type": "psi", "stimulus": {"name": "level", "from": 0.01, "to": 1, "count": 21, "spacing": "log"},
          "model": "weibull", "nuisance": ["slope"], "stop": {"trials": 30, "entropy": 0.5},
          "parameters": {"threshold": {"from": 0.02, "to": 0.8, "count": 15, "spacing": "log"},
                         "slope": {"from": 1, "to": 6, "count": 6, "prior": {"normal": {"mean": 3, "sd": 1}}},
                         "lapse": {"values": [0.01, 0.02, 0.05], "prior": {"beta": {"a": 2, "b": 30}}}}})",
      R"({"type": "quest_plus", "stimulus": {"name": "contrast", "from": -40, "to": 0, "step": 2, "unit": "dB"},
          "select": "min_n_entropy", "candidates": 3, "stop": {"trials": 40}, "interval": "highest_density",
          "parameters": {"threshold": {"from": -40, "to": 0, "step": 2}, "slope": [2, 3, 4]}})",
      R"({"type": "quest_plus", "model": "rating", "categories": 3, "stop": {"trials": 25},
          "stimulus": {"name": "quality", "from": 0, "to": 4, "step": 0.5},
          "parameters": {"sd": [0.5, 1], "criterion_1": [0.5, 1, 1.5], "step_2": [0.5, 1, 2]}})",
      R"({"type": "quest_plus", "model": "sigmoid", "family": "student_t", "asymptotes": "equal", "stop": {"trials": 25},
          "stimulus": {"from": -4, "to": 4, "step": 0.5},
          "parameters": {"threshold": {"from": -2, "to": 2, "step": 0.5}, "width": [1, 2, 4], "lapse": [0, 0.02]}})",
      R"({"type": "interleaved", "procedures": [
          {"type": "staircase", "stimulus": {"name": "x", "start": 5}, "steps": 1, "stop": {"trials": 20}},
          {"type": "quest_plus", "name": "bayes", "stimulus": {"name": "x", "from": 0, "to": 9, "step": 1},
           "model": "normal", "parameters": {"mean": {"from": 0, "to": 9, "step": 1}, "sd": [1, 2], "guess": 0},
           "stop": {"trials": 20}}]})"};
  std::vector<nlohmann::json> out;
  for (const char* text : kTexts) out.push_back(nlohmann::json::parse(text));
  return out;
}

}  // namespace limen::study
