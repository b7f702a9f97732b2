// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study_page/session_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/output/text_output.h"
#include "analysis/study/observer_names.h"
#include "experiments/base/yaml_tree.h"
#include "experiments/store/sessions.h"

namespace limen::analysis {
namespace {

std::optional<double> numberAt(const YamlNode& node, const char* key) {
  const YamlNode* found = node.find(key);
  return found ? finiteNumber(found->text) : std::nullopt;
}

std::optional<double> itemAt(const YamlNode& node, const char* key, size_t index) {
  const YamlNode* found = node.find(key);
  return found && index < found->items.size() ? finiteNumber(found->items[index].text) : std::nullopt;
}

DisplayFacts displayOf(const store::StudyDisplay& display, const std::string& store) {
  DisplayFacts out;
  out.hash = display.hash;
  out.name = display.name;
  out.calibration = display.calibration;
  const YamlNode root = parseYaml(display.profile, store + " (display " + display.name + ")");
  out.widthPx = itemAt(root, "resolution_px", 0);
  out.heightPx = itemAt(root, "resolution_px", 1);
  out.widthM = itemAt(root, "size_m", 0);
  out.heightM = itemAt(root, "size_m", 1);
  out.distanceM = numberAt(root, "distance_m");
  out.blackCdM2 = numberAt(root, "black_cd_m2");
  out.peakCdM2 = numberAt(root, "peak_cd_m2");
  out.ambientLux = numberAt(root, "ambient_lux");
  out.refreshHz = numberAt(root, "refresh_hz");
  if (const YamlNode* transfer = root.find("transfer")) out.transfer = transfer->text;
  return out;
}

std::string textIn(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void add(std::set<std::string>& set, const std::string& text) {
  if (!text.empty()) set.insert(text);
}

void addEnvironment(SessionFacts& out, const store::Environment& environment, bool simulated) {
  const nlohmann::json shown = frontEndOf(environment);
  if (!environment.facts.is_object()) return;
  add(out.systems, textIn(environment.facts, "os"));
  if (simulated) {
    if (const auto observer = shown.find("observer"); observer != shown.end() && observer->is_object())
      add(out.observerKinds, textIn(*observer, "kind"));
    return;
  }
  add(out.renderers, environment.device == "none" ? "" : environment.device);
  add(out.openGl, textIn(shown, "opengl"));
  out.softwareRenderer += environment.software ? 1 : 0;
  if (const auto doubts = shown.find("lab_doubts"); doubts != shown.end() && doubts->is_array())
    for (const nlohmann::json& doubt : *doubts)
      if (doubt.is_string()) add(out.doubts, doubt.get<std::string>());
}

void addStimuli(PartFacts& out, const store::StudyTrial& trial) {
  for (const nlohmann::json& stimulus : trial.stimuli) {
    if (!stimulus.is_object()) continue;
    add(out.presentations, textIn(stimulus, "presentation"));
    if (const auto scene = stimulus.find("scene"); scene != stimulus.end() && scene->is_object())
      add(out.scenes, textIn(*scene, "name"));
    if (const auto value = stimulus.find("duration_s"); value != stimulus.end() && value->is_number())
      out.durationsS.insert(value->get<double>());
    if (const auto value = stimulus.find("showings"); value != stimulus.end() && value->is_number())
      out.showings.insert(value->get<double>());
  }
}

/// Counts of one participant in one part.
struct Tally {
  size_t answers = 0, practice = 0;
  std::map<std::string, size_t> change, catches;
};

CountRange rangeOf(const std::vector<size_t>& counts) {
  if (counts.empty()) return {};
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  return {*least, *most};
}

void finishParts(SessionFacts& out, const std::map<std::string, std::map<std::string, Tally>>& tallies) {
  for (const auto& [part, participants] : tallies) {
    std::vector<size_t> answers, practice, change, catches;
    std::set<std::string> conditions;
    for (const auto& [participant, tally] : participants) {
      answers.push_back(tally.answers);
      practice.push_back(tally.practice);
      for (const auto& [condition, count] : tally.change) {
        change.push_back(count);
        conditions.insert(condition);
      }
      for (const auto& [condition, count] : tally.catches) catches.push_back(count);
    }
    PartFacts& facts = out.parts[part];
    facts.answers = rangeOf(answers);
    facts.practice = rangeOf(practice);
    facts.changeRepetitions = rangeOf(change);
    facts.catchRepetitions = rangeOf(catches);
    facts.conditions = conditions.size();
  }
}

void addForm(SessionFacts& out, const nlohmann::json& form) {
  if (!form.is_object() || form.empty()) return;
  for (const auto& [field, choice] : form.items())
    if (choice.is_string()) ++out.form[field][choice.get<std::string>()];
}

}  // namespace

std::optional<double> DisplayFacts::pixelsPerDegree() const {
  if (!widthPx || !widthM || !distanceM || *widthPx <= 0.0 || *widthM <= 0.0) return {};
  return 2.0 * *distanceM * std::tan(0.5 * std::numbers::pi / 180.0) * *widthPx / *widthM;
}

std::string CountRange::text() const {
  return least == most ? std::to_string(least) : fmt::format("{} to {}", least, most);
}

SessionFacts readSessionFacts(const StudyChoice& choice, const std::string& hash) {
  const store::SessionReader reader(choice.store);
  SessionFacts out;
  std::map<std::string, std::map<std::string, Tally>> tallies;  // part, participant
  std::set<std::string> participants, displays;
  const std::vector<store::StudySession> sessions = reader.sessions();
  const ObserverNames names(sessions, choice.codes);
  for (const store::StudySession& session : sessions) {
    if (session.protocol != hash) continue;
    const store::Environment environment = reader.environment(session.environment);
    const bool simulated = isSimulated(environment);
    if (isOther(choice.observers, simulated)) continue;
    const store::StudyDisplay display = reader.display(session.display);
    SessionRow row{names.of(session.participant, simulated),
                   session.name,
                   session.state,
                   display.name,
                   session.programVersion,
                   0,
                   session.state == "finished" || choice.unfinished};
    for (const store::StudyTrial& trial : reader.trials(session.id)) {
      if (trial.counts() && !trial.practice) ++row.answers;
      if (!row.used) continue;
      Tally& tally = tallies[trial.part][session.participant];
      if (!trial.valid.value_or(true)) ++out.parts[trial.part].notValid;
      if (!trial.counts()) continue;
      if (trial.practice) {
        ++tally.practice;
        continue;
      }
      ++tally.answers;
      ++(trial.change ? tally.change : tally.catches)[trial.condition.dump()];
      addStimuli(out.parts[trial.part], trial);
      if (trial.response->severity && trial.response->outcome != 1)
        out.parts[trial.part].severityAlways = true;
    }
    if (row.used) {
      if (participants.insert(session.participant).second) addForm(out, session.form);
      if (displays.insert(session.display).second) out.displays.push_back(displayOf(display, choice.store));
      addEnvironment(out, environment, simulated);
      add(out.programVersions, session.programVersion);
      // The clock of simulated observers runs in a time of its own.
      const std::string day = simulated ? "" : session.started.substr(0, 10);
      if (!day.empty()) {
        out.firstDay = out.firstDay.empty() ? day : std::min(out.firstDay, day);
        out.lastDay = std::max(out.lastDay, day);
      }
    }
    out.sessions.push_back(std::move(row));
  }
  out.participants = participants.size();
  finishParts(out, tallies);
  return out;
}

}  // namespace limen::analysis
