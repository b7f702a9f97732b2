// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/study/hand_made.h"

namespace limen::analysis {
namespace {

constexpr const char* kUtc = "2026-01-31T12:00:00.000Z";

store::StudyEntry entryOf(const HandMadeTrial& trial, int number, int event) {
  store::StudyEntry out;
  out.event = {event, "answered", kUtc, event, nlohmann::json::object()};
  store::StudyTrial row;
  row.number = number;
  row.event = event;
  row.part = trial.part;
  row.condition = trial.condition;
  row.stimuli = {{{"presentation", trial.presentation}}};
  if (!trial.catchShows.empty()) row.stimuli[0]["catch_shows_after"] = trial.catchShows == "after";
  row.stimulusHashes = {handMadeHash(trial)};
  row.change = trial.change;
  row.procedureStimulus = trial.axes;
  row.practice = trial.practice;
  row.startedUtc = kUtc;
  out.begun = row;
  store::StudyTrialEnd end{number, 0, trial.valid, trial.valid ? "" : "late", {}, {}};
  if (trial.valid) {
    store::StudyResponse response;
    response.event = event;
    response.answer = trial.outcome == 1 ? "yes" : "no";
    response.outcome = trial.outcome;
    response.severity = trial.severity;
    response.reactionTimeS = trial.reactionTimeS;
    end.response = response;
  }
  out.ended = end;
  if (trial.superseded) out.supersedeFrom = event;
  return out;
}

}  // namespace

std::vector<HandMadeTrial> trials(const std::map<std::string, std::string>& condition, int yes, int count,
                                  bool change) {
  std::vector<HandMadeTrial> out;
  for (int i = 0; i < count; ++i) {
    HandMadeTrial one;
    one.condition = condition;
    one.outcome = i < yes ? 1 : 0;
    one.change = change;
    out.push_back(one);
  }
  return out;
}

std::vector<HandMadeTrial> operator+(std::vector<HandMadeTrial> a, const std::vector<HandMadeTrial>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string handMadeHash(const HandMadeTrial& trial) {
  return !trial.hash.empty() ? trial.hash
                             : trial.part + trial.presentation + nlohmann::json(trial.condition).dump() +
                                   (trial.change ? "" : "catch");
}

void addHandMadeSession(const std::string& path, const std::string& participant, const std::string& protocol,
                        const std::vector<HandMadeTrial>& shown, const std::string& state,
                        const std::string& name, const nlohmann::json& frontEnd, const std::string& title,
                        const std::string& display) {
  store::SessionLog log(path, false);
  store::StudySession session;
  session.participant = participant;
  session.name = name;
  session.participantNumber = log.participantNumber(participant, kUtc);
  session.protocol = protocol;
  session.display = "display_hash";
  session.started = kUtc;
  std::vector<store::StudyEntry> entries(1);
  entries[0].event = {0, "started", kUtc, 0, nlohmann::json::object()};
  for (const HandMadeTrial& trial : shown) {
    const int number = static_cast<int>(entries.size());
    entries.push_back(entryOf(trial, number - 1, number));
  }
  entries.back().state = state;
  log.start(session, {protocol, "hand_made", "hand_made.yaml", title, protocol},
            {"display_hash", "desk", display, nlohmann::json::object()},
            {"gpu", false, {{"front_end", frontEnd}}}, {{0, "main", "main", false, 1}}, entries);
}

void addHandMadePrediction(const std::string& path, const std::string& stimulusHash,
                           const nlohmann::json& figures, const std::string& programVersion,
                           const nlohmann::json& settings) {
  store::PredictionLog log(path);
  store::StudyPrediction one;
  one.stimulusHash = stimulusHash;
  one.displayHash = "display_hash";
  one.widthPx = 1024;
  one.heightPx = 768;
  one.predictor = "popping";
  one.settings = settings;
  one.programVersion = programVersion;
  one.created = kUtc;
  one.figures = figures;
  log.add(one, {"display_hash", "desk", "name: desk", nlohmann::json::object()});
}

}  // namespace limen::analysis
