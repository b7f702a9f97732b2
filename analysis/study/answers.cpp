// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/output/text_output.h"
#include "analysis/study/observer_names.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::string levelText(const nlohmann::json& level) {
  return level.is_string() ? level.get<std::string>() : level.dump();
}

StudyAnswer answerOf(const store::StudyTrial& trial, const StudyPart& part) {
  StudyAnswer out;
  out.trial = trial.number;
  for (const auto& [factor, level] : trial.condition.items()) out.condition[factor] = levelText(level);
  out.axes = trial.procedureStimulus;
  out.change = trial.change;
  const bool several = (part.task == "interval" || part.task == "alternative") && trial.target >= 0;
  const size_t which = several ? static_cast<size_t>(trial.target) : 0;
  if (which < trial.stimulusHashes.size()) out.stimulusHash = trial.stimulusHashes[which];
  if (which < trial.stimuli.size() && trial.stimuli[which].is_object())
    out.presentation = trial.stimuli[which].value("presentation", std::string());
  if (!trial.change && !trial.stimuli.empty() && trial.stimuli[0].is_object())
    if (const auto after = trial.stimuli[0].find("catch_shows_after");
        after != trial.stimuli[0].end() && after->is_boolean())
      out.catchShows = after->get<bool>() ? "after" : "before";
  out.outcome = trial.response->outcome;
  out.target = trial.target;
  out.repetition = trial.repetition;
  out.severity = trial.response->severity;
  out.reactionTimeS = trial.response->reactionTimeS;
  return out;
}

/// The protocol whose answers are meant. One that was changed between sessions has two hashes.
store::StudyProtocol chooseProtocol(const store::SessionReader& reader, const StudyChoice& choice) {
  std::map<std::string, store::StudyProtocol> known;
  for (const store::StudySession& session : reader.sessions())
    if (!known.count(session.protocol)) known[session.protocol] = reader.protocol(session.protocol);
  if (known.empty()) throw Error("holds no sessions", choice.store, "run or simulate a study into it first");
  std::vector<std::string> names, fitting;
  for (const auto& [hash, protocol] : known) {
    names.push_back(protocol.name);
    if (choice.protocol.empty() || choice.protocol == protocol.name ||
        (choice.protocol.size() >= 8 && hash.rfind(choice.protocol, 0) == 0))
      fitting.push_back(hash);
  }
  if (fitting.empty())
    throw Error("no session of a protocol '" + choice.protocol + "'", choice.store,
                suggest(choice.protocol, names));
  if (fitting.size() > 1) {
    std::vector<std::string> list;
    for (const std::string& hash : fitting)
      list.push_back(known[hash].name + " (" + hash.substr(0, 12) + ")");
    throw Error("holds sessions of several protocols", choice.store,
                "name one with --protocol, by its name or the first digits of its SHA-256: " + join(list));
  }
  return known[fitting.front()];
}

}  // namespace

nlohmann::json frontEndOf(const store::Environment& environment) {
  if (!environment.facts.is_object()) return nlohmann::json::object();
  nlohmann::json out = environment.facts.value("front_end", nlohmann::json::object());
  return out.is_object() ? out : nlohmann::json::object();
}

bool isSimulated(const store::Environment& environment) {
  return frontEndOf(environment).value("simulated", false);
}

std::vector<size_t> levelsOf(const StudyPart& part, const std::map<std::string, std::string>& condition) {
  std::vector<size_t> out;
  for (const StudyFactor& factor : part.factors) {
    const auto own = condition.find(factor.name);
    const auto place = own == condition.end()
                           ? factor.levels.end()
                           : std::find(factor.levels.begin(), factor.levels.end(), own->second);
    out.push_back(static_cast<size_t>(place - factor.levels.begin()));
  }
  return out;
}

std::string conditionText(const StudyPart& part, const std::map<std::string, std::string>& condition) {
  std::vector<std::string> words;
  for (const StudyFactor& factor : part.factors)
    if (const auto own = condition.find(factor.name); own != condition.end())
      words.push_back(own->first + "=" + own->second);
  for (const auto& [name, level] : condition)
    if (std::none_of(part.factors.begin(), part.factors.end(),
                     [&, &wanted = name](const StudyFactor& factor) { return factor.name == wanted; }))
      words.push_back(name + "=" + level);
  return join(words);
}

StudyAnswers readStudyAnswers(const StudyChoice& choice) {
  const store::SessionReader reader(choice.store);
  const store::StudyProtocol protocol = chooseProtocol(reader, choice);
  StudyAnswers out;
  out.plan = readStudyPlan(protocol, choice.store);
  const std::vector<store::StudySession> sessions = reader.sessions();
  const ObserverNames names(sessions, choice.codes);
  for (const store::StudySession& session : sessions) {
    if (session.protocol != protocol.hash) continue;
    const nlohmann::json frontEnd = frontEndOf(reader.environment(session.environment));
    const bool simulated = frontEnd.value("simulated", false);
    if (isOther(choice.observers, simulated)) continue;
    const std::string name = names.of(session.participant, simulated);
    std::vector<StudyAnswer> own;
    for (const store::StudyTrial& trial : reader.trials(session.id)) {
      if (!trial.counts() || trial.practice) continue;
      const size_t part = out.plan.partNamed(trial.part);
      StudyAnswer answer = answerOf(trial, out.plan.parts[part]);
      answer.part = part;
      answer.session = session.id;
      answer.displayHash = session.display;
      own.push_back(std::move(answer));
    }
    if (session.state != "finished" && !choice.unfinished) {
      out.leftOut.push_back({"unfinished session", name, own.size(),
                             fmt::format("session {} is {}", session.name, session.state)});
      continue;
    }
    const size_t observer = indexIn(out.observers, name);
    indexIn(out.displays, reader.display(session.display).name);
    ++out.sessions;
    out.simulated += simulated ? 1 : 0;
    out.notLabReady += frontEnd.value("lab_ready", true) ? 0 : 1;
    for (StudyAnswer& answer : own) {
      answer.observer = observer;
      out.answers.push_back(std::move(answer));
    }
  }
  if (out.simulated > 0 && out.simulated < out.sessions)
    throw Error("holds sessions of people and of simulated observers", choice.store,
                "choose with --observers people or --observers simulated");
  if (out.answers.empty())
    throw Error("no finished session has an answer", choice.store,
                "finish a session, or take broken-off ones with --unfinished");
  if (choice.exclusions) {
    applyExclusions(out);
    if (out.answers.empty())
      throw Error("the protocol's exclusion rules leave no answer", choice.store, "see with --no-exclusions");
  } else {
    for (const ExclusionRule& rule : out.plan.exclusions)
      out.rules.push_back({rule.name, rule.limit, false, "--no-exclusions"});
  }
  return out;
}

}  // namespace limen::analysis
