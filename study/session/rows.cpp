// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/rows.h"

#include <fmt/core.h>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"

namespace limen::study {
namespace {

store::StudyTrial trialRow(const Session& session, const Event& event) {
  // In a damaged log an event may stand anywhere.
  if (!session.step().trial) throw Error("the store is damaged: the event begins no trial that is due");
  const Trial& due = *session.step().trial;
  store::StudyTrial row;
  row.number = due.number;
  row.attempt = due.attempt;
  row.event = event.number;
  row.part = session.protocol().parts[static_cast<size_t>(due.plan.part)].name;
  row.block = session.blockOfDue();
  row.condition = due.plan.condition;
  row.repetition = due.plan.repetition;
  for (const Stimulus& stimulus : due.stimuli) {
    row.stimuli.push_back(toJson(stimulus));
    row.stimulusHashes.push_back(stimulusHash(stimulus));
  }
  if (due.plan.procedure >= 0) row.procedure = due.plan.procedure;
  row.procedureStimulus = due.procedureStimulus;
  row.target = due.plan.target;
  row.change = due.plan.change;
  row.practice = due.plan.practice;
  row.seed = due.seed;
  row.startedUtc = event.utc;
  return row;
}

template <class T>
std::optional<T> orNone(const nlohmann::json& data, const char* key) {
  const auto found = data.find(key);
  return found == data.end() || found->is_null() ? std::nullopt : std::optional<T>(found->get<T>());
}

store::StudyResponse responseRow(const Event& event) {
  const nlohmann::json& data = event.data;
  store::StudyResponse row;
  row.event = event.number;
  row.answer = data.at("answer");
  row.outcome = data.at("outcome");
  row.correct = orNone<bool>(data, "correct");
  row.severity = orNone<int>(data, "severity");
  row.confidence = orNone<int>(data, "confidence");
  row.reactionTimeS = data.at("reaction_time_s");
  row.questionNs = data.at("question_ns");
  row.answeredNs = data.at("answered_ns");
  row.device = data.at("device");
  row.extra = data.at("extra");
  return row;
}

// The trial on screen, ended by something other than an answer.
store::StudyTrialEnd brokenOff(const Session& session, const std::string& reason) {
  return {session.step().trial->number, session.step().trial->attempt, false, reason, std::nullopt, {}};
}

}  // namespace

std::vector<store::StudyFrame> framesOf(const std::vector<ShownFrame>& frames) {
  std::vector<store::StudyFrame> rows;
  for (const ShownFrame& f : frames)
    rows.push_back({f.stimulus, f.showing, f.frame, f.swapNs, f.missedBlanks});
  return rows;
}

nlohmann::json frameDigest(const std::vector<store::StudyFrame>& frames) {
  Sha256 hash;
  for (const store::StudyFrame& f : frames)
    hash.update(fmt::format("{},{},{},{},{}\n", f.stimulus, f.showing, f.frame, f.swapNs, f.missedBlanks));
  return {{"count", frames.size()}, {"sha256", hash.hex()}};
}

std::vector<store::StudyBlock> blocksOf(const Session& session) {
  std::vector<store::StudyBlock> rows;
  for (const PlannedBlock& block : session.design().blocks)
    rows.push_back({static_cast<int>(rows.size()),
                    session.protocol().parts[static_cast<size_t>(block.part)].name, block.name,
                    block.practice, static_cast<int>(block.trials.size())});
  return rows;
}

void atEvent(const store::StudyEvent& row, const std::string& store, const std::function<void()>& work) {
  const std::string place = "table event, number " + std::to_string(row.number) + ": ";
  try {
    work();
  } catch (const Error& error) {
    if (!error.where().empty()) throw;
    throw Error(place + error.message(), store, error.hint());
  } catch (const nlohmann::json::exception&) {
    throw Error(place + "the store is damaged: the event lacks what it must say", store,
                "put back a copy, or save what is left with 'sqlite3 FILE .recover'");
  }
}

Event eventOf(const store::StudyEvent& row) {
  return {row.number, eventKind(row.kind), row.utc, row.monotonicNs, row.data};
}

store::StudyEntry entryOf(const Session& before, const Event& event, const std::vector<ShownFrame>& frames) {
  store::StudyEntry entry;
  entry.event = {event.number, toText(event.kind), event.utc, event.monotonicNs, event.data};
  const auto breakOff = [&](const std::string& reason) {
    if (!before.trialInProgress()) return;
    entry.ended = brokenOff(before, reason);
    entry.ended->frames = framesOf(frames);
  };
  switch (event.kind) {
    case EventKind::Started:
      entry.state = "running";
      break;
    case EventKind::ScreenDone:
      if (event.data.at("screen") == toText(Screen::Kind::Form)) entry.form = event.data.at("answers");
      if (event.data.contains("note"))
        entry.note = {event.number, "participant", "note_given", event.data.at("note")};
      break;
    case EventKind::TrialStarted:
      entry.begun = trialRow(before, event);
      break;
    case EventKind::Answered:
      entry.ended = {event.data.at("trial"), event.data.at("attempt"), true, "",
                     responseRow(event),     framesOf(frames)};
      break;
    case EventKind::TrialInvalid:
      entry.ended = {event.data.at("trial"), event.data.at("attempt"), false, event.data.at("reason"),
                     std::nullopt,           framesOf(frames)};
      break;
    case EventKind::Paused:
      breakOff("paused");
      entry.state = "paused";
      break;
    case EventKind::Continued:
      breakOff("interrupted");
      if (event.data.at("policy") == "restart_block") entry.supersedeFrom = before.brokenBlockEvent();
      entry.state = "running";
      break;
    case EventKind::Note:
      entry.note = {event.number, event.data.at("by"), event.data.at("code"), event.data.at("detail")};
      break;
    case EventKind::ClockJump:
      break;
    case EventKind::Aborted:
      breakOff("session broken off");
      entry.state = "aborted";
      break;
    case EventKind::Finished:
      entry.state = "finished";
      break;
  }
  return entry;
}

}  // namespace limen::study
