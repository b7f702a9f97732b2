// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/store/predictions.h"

namespace limen::analysis {

/// A trial and its answer, as a session would have left them.
struct HandMadeTrial {
  std::map<std::string, std::string> condition;
  int outcome = 0;
  bool change = true;
  std::optional<int> severity = {};
  double reactionTimeS = 1.0;
  std::string part = "main", presentation = "dynamic", hash = {};  ///< hash "": one for each condition
  bool practice = false, valid = true, superseded = false;
  std::vector<double> axes = {};  ///< what a procedure asked for
  std::string catchShows = {};    ///< "before" or "after"; "" as in older stores
};

/// `count` trials alike, the first `yes` of them answered with yes.
std::vector<HandMadeTrial> trials(const std::map<std::string, std::string>& condition, int yes, int count,
                                  bool change = true);
std::vector<HandMadeTrial> operator+(std::vector<HandMadeTrial> a, const std::vector<HandMadeTrial>& b);

/// The hash that a trial without one gets.
std::string handMadeHash(const HandMadeTrial& trial);

/// A session of such trials, by the store's own writer. The protocol's hash is its text; `display` a profile.
void addHandMadeSession(const std::string& store, const std::string& participant, const std::string& protocol,
                        const std::vector<HandMadeTrial>& trials, const std::string& state = "finished",
                        const std::string& name = "1",
                        const nlohmann::json& frontEnd = nlohmann::json::object(),
                        const std::string& title = "By hand", const std::string& display = "name: desk");

/// A prediction for the sessions' display and a window of 1024 x 768.
void addHandMadePrediction(const std::string& store, const std::string& stimulusHash,
                           const nlohmann::json& figures, const std::string& programVersion = "1",
                           const nlohmann::json& settings = {{"a", 1}});

}  // namespace limen::analysis
