// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/trial_table.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <set>

#include "study/export/pseudonyms.h"

namespace limen::study {
namespace {

using Cell = std::optional<std::string>;

Cell text(const nlohmann::json& value) {
  if (value.is_null()) return std::nullopt;
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? toText(value.get<double>()) : value.dump();
}
Cell flag(bool value) { return std::string(value ? "1" : "0"); }
Cell flag(const std::optional<bool>& value) { return value ? flag(*value) : std::nullopt; }
Cell number(const std::optional<int>& value) { return value ? Cell(std::to_string(*value)) : std::nullopt; }

/// Milliseconds of an ISO 8601 instant "2026-11-21T12:00:00.123Z"; 0 if it is not one.
int64_t milliseconds(const std::string& utc) {
  std::tm time{};
  int fraction = 0;
  if (std::sscanf(utc.c_str(), "%d-%d-%dT%d:%d:%d.%dZ", &time.tm_year, &time.tm_mon, &time.tm_mday,
                  &time.tm_hour, &time.tm_min, &time.tm_sec, &fraction) < 6)
    return 0;
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  return static_cast<int64_t>(timegm(&time)) * 1000 + fraction;
}

/// Names that occur in any trial's object, sorted.
template <class Object>
std::vector<std::string> keys(const std::vector<ExportedSession>& sessions, Object object) {
  std::set<std::string> out;
  for (const ExportedSession& session : sessions)
    for (const store::StudyTrial& trial : session.trials)
      for (const auto& [key, value] : object(trial).items()) out.insert(key);
  return {out.begin(), out.end()};
}

const nlohmann::json& conditionOf(const store::StudyTrial& trial) { return trial.condition; }
const nlohmann::json& extraOf(const store::StudyTrial& trial) {
  static const nlohmann::json kNone = nlohmann::json::object();
  return trial.response ? trial.response->extra : kNone;
}

int missedBlanks(const store::StudyTrial& trial) {
  int sum = 0;
  for (const store::StudyFrame& frame : trial.frames) sum += frame.missedBlanks;
  return sum;
}

constexpr const char* kEarlyInputs = "early_inputs";

/// How many, not which: what was typed stays out, whatever an older store holds.
Cell earlyInputs(const store::StudyTrial& trial) {
  if (!trial.response) return std::nullopt;
  const auto found = trial.response->extra.find(kEarlyInputs);
  return std::to_string(found != trial.response->extra.end() && found->is_array() ? found->size() : 0);
}

/// What each stimulus showed, in words, separated by blanks; nothing if it was not recorded.
Cell shownBy(const store::StudyTrial& trial) {
  std::string out;
  for (const nlohmann::json& stimulus : trial.stimuli) {
    if (!stimulus.is_object() || !stimulus.contains("changes") || !stimulus["changes"].is_boolean())
      return std::nullopt;
    const auto after = stimulus.find("catch_shows_after");
    const bool showsAfter = after != stimulus.end() && after->is_boolean() && after->get<bool>();
    out += out.empty() ? "" : " ";
    out += stimulus["changes"].get<bool>() ? "change" : showsAfter ? "after" : "before";
  }
  return out.empty() ? Cell() : Cell(out);
}

/// Levels of detail that each stimulus showed, "1>0" where it changed; nothing if none did.
Cell levelsBy(const store::StudyTrial& trial) {
  const Cell shown = shownBy(trial);
  std::string out;
  for (const nlohmann::json& stimulus : trial.stimuli) {
    const auto levels = stimulus.find("levels");
    if (!shown || levels == stimulus.end() || !levels->is_object() || !levels->contains("before") ||
        !levels->contains("after"))
      return std::nullopt;
    const std::string before = (*levels)["before"].dump(), after = (*levels)["after"].dump();
    out += out.empty() ? "" : " ";
    out += stimulus["changes"].get<bool>()              ? before + ">" + after
           : stimulus.value("catch_shows_after", false) ? after
                                                        : before;
  }
  return out.empty() ? Cell() : Cell(out);
}

Cell answersFromTheLeft(const ExportedSession& session, const std::string& part) {
  const auto own = session.answersFromTheLeft.find(part);
  if (own == session.answersFromTheLeft.end() || !own->is_array()) return std::nullopt;
  std::string out;
  for (const nlohmann::json& answer : *own)
    if (answer.is_string()) out += (out.empty() ? "" : " | ") + answer.get<std::string>();
  return out;
}

const std::map<std::string, std::string> kYesNo = {{"0", "no"}, {"1", "yes"}};

std::vector<Column> subjectColumns() {
  return {{"subject", "Pseudonym of the participant", "", {}}, {"session", "Name of the sitting", "", {}}};
}

}  // namespace

std::vector<double> eventTimesS(const std::vector<store::StudyEvent>& events) {
  std::vector<double> out;
  double stretchS = 0.0;  // when the current process began
  size_t stretchStart = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    if (i > 0 && events[i].kind == "continued") {
      const int64_t gapMs = milliseconds(events[i].utc) - milliseconds(events[i - 1].utc);
      stretchS = out.back() + static_cast<double>(std::max<int64_t>(gapMs, 0)) * 1e-3;
      stretchStart = i;
    }
    const int64_t ns = events[i].monotonicNs - events[stretchStart].monotonicNs;
    out.push_back(stretchS + static_cast<double>(std::max<int64_t>(ns, 0)) * 1e-9);
  }
  return out;
}

Table trialTable(const std::vector<ExportedSession>& sessions) {
  const std::vector<std::string> factors = keys(sessions, conditionOf);
  std::vector<std::string> extras = keys(sessions, extraOf);
  std::erase(extras, kEarlyInputs);
  const bool seeds = std::any_of(sessions.begin(), sessions.end(),
                                 [](const ExportedSession& session) { return session.seed.has_value(); });
  size_t axes = 0;
  for (const ExportedSession& session : sessions)
    for (const store::StudyTrial& trial : session.trials)
      axes = std::max(axes, trial.procedureStimulus.size());

  Table out;
  out.columns = subjectColumns();
  const std::vector<Column> first = {
      {"onset_s", "Start of the trial since the start of the session", "s", {}},
      {"duration_s", "From the start of the trial to its answer or abandonment", "s", {}},
      {"order", "Position in presentation order, from 0", "", {}},
      {"trial", "Number of the trial in the session's plan, from 0", "", {}},
      {"attempt", "0: first presentation; repeats follow late frames or an interruption", "", {}},
      {"part", "Part of the protocol", "", {}},
      {"block", "Number of the block, from 0 in presentation order", "", {}},
      {"practice", "Whether the trial was practice", "", kYesNo},
      {"change", "Whether something changed; 0 for a catch trial", "", kYesNo},
      {"repetition", "Repetition of the condition, from 0", "", {}},
      {"shown",
       "What each stimulus showed, in order: 'change', or the state 'before' or 'after' the change "
       "throughout",
       "",
       {}},
      {"levels",
       "Levels of detail that each stimulus showed, 0 the finest: 1>0 for a change from 1 to 0",
       "",
       {}},
      {"target", "Interval or position that had the change (pairs: item_b), from 0", "", {}}};
  out.columns.insert(out.columns.end(), first.begin(), first.end());
  for (const std::string& factor : factors)
    out.columns.push_back({"condition_" + factor, "Level of the factor '" + factor + "'", "", {}});
  for (size_t i = 0; i < axes; ++i)
    out.columns.push_back(
        {"stimulus_level_" + std::to_string(i),
         "Value shown by the adaptive procedure, in the unit of its axis " + std::to_string(i),
         "",
         {}});
  const std::vector<Column> last = {
      {"procedure", "Number of the adaptive procedure that chose the stimulus", "", {}},
      {"valid", "Whether all frames were on time and nothing interrupted", "", kYesNo},
      {"invalid_reason", "Why the trial is invalid", "", {}},
      {"counts", "Valid, answered and not in a block that was restarted. Results use those with practice = 0",
       "", kYesNo},
      {"answer", "Answer in the protocol's words", "", {}},
      {"answers_from_the_left",
       "Answers as they stood on screen, from left to right, separated by |",
       "",
       {}},
      {"outcome", "Answer as a number: 1 for yes or correct; rating: step from 0; pairs: position", "", {}},
      {"correct", "Whether the answer was correct", "", kYesNo},
      {"severity", "Step of the severity scale, 1 is the lowest", "", {}},
      {"confidence", "Step of the confidence scale, 1 is the lowest", "", {}},
      {"reaction_time_s", "From the question to the answer", "s", {}},
      {"device", "Device used to answer", "", {}},
      {"frames", "Swaps logged", "", {}},
      {"missed_blanks", "Vertical blanks for which a frame stayed on screen too long", "", {}},
      {"early_inputs", "Keys and clicks before the question, which answered nothing", "", {}},
      {"stimulus_hashes", "SHA-256 of each stimulus shown, in order, separated by blanks", "", {}},
      {"simulated", "Whether a simulated observer answered, and no person", "", kYesNo}};
  out.columns.insert(out.columns.end(), last.begin(), last.end());
  if (seeds) out.columns.push_back({"seed", "Seed of all randomness within the trial", "", {}});
  for (const std::string& extra : extras)
    out.columns.push_back({"observer_" + extra, "Of a simulated observer: " + extra, "", {}});

  for (const ExportedSession& session : sessions) {
    for (size_t i = 0; i < session.trials.size(); ++i) {
      const store::StudyTrial& trial = session.trials[i];
      const auto& response = trial.response;
      std::string hashes;
      for (const std::string& hash : trial.stimulusHashes) hashes += (hashes.empty() ? "" : " ") + hash;
      std::vector<Cell> row = {session.subject,
                               session.name,
                               toText(session.startS[i]),
                               session.endS[i] < 0.0 ? Cell() : toText(session.endS[i] - session.startS[i]),
                               std::to_string(i),
                               std::to_string(trial.number),
                               std::to_string(trial.attempt),
                               trial.part,
                               std::to_string(trial.block),
                               flag(trial.practice),
                               flag(trial.change),
                               std::to_string(trial.repetition),
                               shownBy(trial),
                               levelsBy(trial),
                               std::to_string(trial.target)};
      for (const std::string& factor : factors)
        row.push_back(trial.condition.contains(factor) ? text(trial.condition[factor]) : std::nullopt);
      for (size_t axis = 0; axis < axes; ++axis)
        row.push_back(axis < trial.procedureStimulus.size() ? Cell(toText(trial.procedureStimulus[axis]))
                                                            : std::nullopt);
      row.push_back(number(trial.procedure));
      row.push_back(flag(trial.valid));
      row.push_back(trial.reason.empty() ? Cell() : Cell(trial.reason));
      row.push_back(flag(trial.counts()));
      row.push_back(response ? Cell(response->answer) : std::nullopt);
      row.push_back(answersFromTheLeft(session, trial.part));
      row.push_back(response ? Cell(std::to_string(response->outcome)) : std::nullopt);
      row.push_back(response ? flag(response->correct) : std::nullopt);
      row.push_back(response ? number(response->severity) : std::nullopt);
      row.push_back(response ? number(response->confidence) : std::nullopt);
      row.push_back(response ? Cell(toText(response->reactionTimeS)) : std::nullopt);
      row.push_back(response ? Cell(response->device) : std::nullopt);
      row.push_back(std::to_string(trial.frames.size()));
      row.push_back(trial.frames.empty() ? Cell() : Cell(std::to_string(missedBlanks(trial))));
      row.push_back(earlyInputs(trial));
      row.push_back(hashes);
      row.push_back(flag(session.simulated));
      if (seeds) row.push_back(session.seed ? Cell(std::to_string(trial.seed)) : std::nullopt);
      for (const std::string& extra : extras) {
        const nlohmann::json& object = extraOf(trial);
        row.push_back(object.contains(extra) ? text(object[extra]) : std::nullopt);
      }
      out.add(std::move(row));
    }
  }
  return out;
}

Table frameTable(const std::vector<ExportedSession>& sessions) {
  Table out;
  out.columns = subjectColumns();
  const std::vector<Column> more = {
      {"trial", "Number of the trial in the session's plan, from 0", "", {}},
      {"attempt", "Presentation of the trial, from 0", "", {}},
      {"stimulus", "Which of the trial's stimuli, from 0", "", {}},
      {"showing", "Which presentation of the stimulus, from 0", "", {}},
      {"frame", "Frame of the stimulus, from 0", "", {}},
      {"swap_s", "When the swap returned, since the trial's first one", "s", {}},
      {"missed_blanks", "Vertical blanks for which the previous frame stayed on screen too long", "", {}}};
  out.columns.insert(out.columns.end(), more.begin(), more.end());
  for (const ExportedSession& session : sessions)
    for (const store::StudyTrial& trial : session.trials)
      for (const store::StudyFrame& frame : trial.frames)
        out.add({session.subject, session.name, std::to_string(trial.number), std::to_string(trial.attempt),
                 std::to_string(frame.stimulus), std::to_string(frame.showing), std::to_string(frame.frame),
                 toText(static_cast<double>(frame.swapNs - trial.frames.front().swapNs) * 1e-9),
                 std::to_string(frame.missedBlanks)});
  return out;
}

Table markerTable(const std::vector<ExportedSession>& sessions) {
  Table out;
  out.columns = subjectColumns();
  const std::vector<Column> more = {
      {"trial", "Number of the trial in the session's plan, from 0", "", {}},
      {"attempt", "Presentation of the trial, from 0", "", {}},
      {"marker", "What happened: stimulus, change, stimulus_end, question or answer", "", {}},
      {"code", "Byte that was sent", "", {}},
      {"due_s",
       "When it happened, since the start of the session; of a frame, when its swap returned",
       "s",
       {}},
      {"sent_s", "When the system had taken the byte, since the start of the session", "s", {}}};
  out.columns.insert(out.columns.end(), more.begin(), more.end());
  for (const ExportedSession& session : sessions)
    for (const ExportedMarker& marker : session.markers)
      out.add({session.subject, session.name, std::to_string(marker.trial), std::to_string(marker.attempt),
               marker.marker, std::to_string(marker.code), toText(marker.dueS), toText(marker.sentS)});
  return out;
}

Table participantTable(const std::vector<ExportedSession>& sessions) {
  std::set<std::string> fields;
  std::map<std::string, std::vector<const ExportedSession*>> subjects;
  for (const ExportedSession& session : sessions) {
    subjects[session.subject].push_back(&session);
    for (const auto& [field, value] : session.form.items()) fields.insert(field);
  }
  Table out;
  out.columns = {{"subject", "Pseudonym of the participant", "", {}}};
  for (const std::string& field : fields)
    out.columns.push_back(
        {field,
         "Answer on the participant's form" + std::string(field.find("age") == 0 ? ", in bins" : ""),
         "",
         {}});
  out.columns.push_back({"simulated", "Whether this is a simulated observer, and no person", "", kYesNo});
  out.columns.push_back({"sessions", "Sittings in this export", "", {}});
  for (const auto& [subject, own] : subjects) {
    std::vector<Cell> row = {subject};
    for (const std::string& field : fields) {
      Cell value;
      for (const ExportedSession* session : own)
        if (session->form.contains(field)) value = text(session->form[field]);
      if (value && field.find("age") == 0) value = ageBin(*value);
      row.push_back(value);
    }
    row.push_back(flag(own.front()->simulated));
    row.push_back(std::to_string(own.size()));
    out.add(std::move(row));
  }
  return out;
}

std::string label(const std::string& name) {
  std::string out;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c))) out += c;
  return out.empty() ? "x" : out;
}

}  // namespace limen::study
