// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/store/sessions.h"
#include "renderer/catalogue.h"
#include "study/command/commands.h"
#include "study/session/replay.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct SessionsOptions {
  std::string store, participant, session;
  bool asJson = false;
};

/// Progress of a session. More may be planned than is asked: procedures can end early.
struct SessionProgress {
  int answered = 0, planned = 0, invalid = 0;
  std::string last;  ///< instant of the last event
};

SessionProgress progressOf(const store::SessionReader& reader, const store::StudySession& session) {
  SessionProgress progress;
  for (const store::StudyBlock& block : reader.blocks(session.id))
    progress.planned += block.practice ? 0 : block.trials;
  for (const store::StudyTrial& trial : reader.trials(session.id)) {
    progress.answered += trial.counts() && !trial.practice ? 1 : 0;
    progress.invalid += trial.valid == false ? 1 : 0;
  }
  const std::vector<store::StudyEvent> events = reader.events(session.id);
  if (!events.empty()) progress.last = events.back().utc;
  return progress;
}

// A session marked as running that no process holds was interrupted and can be resumed.
std::string stateOf(const store::StudySession& session) {
  return session.state == "running" && session.owner.empty() ? "interrupted" : session.state;
}

void listSessions(const SessionsOptions& options) {
  const store::SessionReader reader(options.store);
  const std::vector<store::StudySession> sessions = reader.sessions();
  if (!options.asJson)
    fmt::print("{:<16}  {:<16}  {:<20}  {:<11}  {:>9}  {:>7}  {:<24}  {}\n", "participant", "session",
               "protocol", "state", "answered", "invalid", "started", "last event");
  for (const store::StudySession& session : sessions) {
    const SessionProgress progress = progressOf(reader, session);
    const store::StudyProtocol protocol = reader.protocol(session.protocol);
    if (options.asJson) {
      fmt::print("{}\n", json({{"participant", session.participant},
                               {"participant_number", session.participantNumber},
                               {"session", session.name},
                               {"protocol", protocol.name},
                               {"protocol_hash", protocol.hash},
                               {"display_hash", session.display},
                               {"seed", std::to_string(session.seed)},
                               {"state", stateOf(session)},
                               {"answered", progress.answered},
                               {"planned", progress.planned},
                               {"invalid", progress.invalid},
                               {"started", session.started},
                               {"last_event", progress.last},
                               {"program_version", session.programVersion}})
                             .dump());
      continue;
    }
    fmt::print("{:<16}  {:<16}  {:<20}  {:<11}  {:>9}  {:>7}  {:<24}  {}\n", session.participant,
               session.name, protocol.name, stateOf(session),
               fmt::format("{}/{}", progress.answered, progress.planned), progress.invalid, session.started,
               progress.last);
  }
  if (!options.asJson && sessions.empty()) fmt::print("no sessions\n");
}

store::StudySession findSession(const store::SessionReader& reader, const SessionsOptions& options) {
  std::vector<store::StudySession> found;
  std::vector<std::string> participants, names;
  for (const store::StudySession& session : reader.sessions()) {
    if (std::find(participants.begin(), participants.end(), session.participant) == participants.end())
      participants.push_back(session.participant);
    if (session.participant != options.participant) continue;
    names.push_back(session.name);
    if (options.session.empty() || session.name == options.session) found.push_back(session);
  }
  if (names.empty())
    throw Error("no participant '" + options.participant + "'", options.store,
                suggest(options.participant, participants));
  if (found.empty())
    throw Error("participant " + options.participant + " has no session '" + options.session + "'",
                options.store, suggest(options.session, names));
  if (found.size() > 1)
    throw Error("participant " + options.participant + " has several sessions", options.store,
                "name one with --session: " + join(names));
  return found.front();
}

json trialJson(const store::StudyTrial& trial) {
  json out = {{"event", trial.event},
              {"trial", trial.number},
              {"attempt", trial.attempt},
              {"part", trial.part},
              {"block", trial.block},
              {"practice", trial.practice},
              {"change", trial.change},
              {"target", trial.target},
              {"condition", trial.condition},
              {"procedure_stimulus", trial.procedureStimulus},
              {"stimuli", trial.stimuli},
              {"stimulus_hashes", trial.stimulusHashes},
              {"seed", std::to_string(trial.seed)},
              {"counts", trial.counts()},
              {"reason", trial.reason},
              {"answer", nullptr}};
  if (trial.response) out["answer"] = trial.response->answer;
  return out;
}

void printTrial(const store::StudyTrial& trial) {
  const std::string answer = trial.response ? trial.response->answer
                             : trial.valid  ? "invalid: " + trial.reason
                                            : "not ended";
  fmt::print("trial {}, attempt {}, {}{}{}: {}\n", trial.number, trial.attempt, trial.part,
             trial.practice ? ", practice" : "", trial.superseded ? ", superseded" : "", answer);
  for (size_t i = 0; i < trial.stimuli.size(); ++i)
    fmt::print("  {}\n  {}\n", trial.stimulusHashes[i], trial.stimuli[i].dump());
}

/// Its file may have changed or gone since; a mistake in the stored text is the store's.
Protocol storedProtocol(const store::StudyProtocol& stored, const std::string& store) {
  try {
    return parseProtocol(stored.text, stored.path, catalogueFromRegistries());
  } catch (const Error& error) {
    throw Error("the protocol that it holds cannot be read: " + std::string(error.what()), store,
                "was the store written by another version of Limen, or is it damaged?");
  }
}

void replay(const SessionsOptions& options, Run& run) {
  const store::SessionReader reader(options.store);
  const store::StudySession session = findSession(reader, options);
  const store::StudyProtocol stored = reader.protocol(session.protocol);
  const Protocol protocol = storedProtocol(stored, options.store);
  const Verification verification = verifySession(reader, session, protocol);
  const std::vector<store::StudyTrial> trials = reader.trials(session.id);
  const bool good = verification.differences.empty();
  if (options.asJson) {
    json out = {{"participant", session.participant},
                {"session", session.name},
                {"state", stateOf(session)},
                {"events", verification.events},
                {"verified", good},
                {"differences", verification.differences},
                {"trials", json::array()}};
    for (const store::StudyTrial& trial : trials) out["trials"].push_back(trialJson(trial));
    fmt::print("{}\n", out.dump());
  } else {
    for (const store::StudyTrial& trial : trials) printTrial(trial);
    fmt::print("{} events, {} trial presentations: {}\n", verification.events, trials.size(),
               good ? "every row agrees with the events" : "some rows disagree with the events");
    for (const std::string& line : verification.differences) fmt::print("  {}\n", line);
  }
  if (!good) run.exitCode = kExitFailedRuns;
}

}  // namespace

void addSessionsCommand(CLI::App& app, Run& run) {
  const auto options = std::make_shared<SessionsOptions>();
  CLI::App* sessions = app.add_subcommand("sessions", "Lists the sessions of a store and their progress.");
  sessions->add_option("store", options->store, "result store")->required();
  sessions->add_flag("--json", options->asJson, "one JSON object per line");
  sessions->callback([options] { listSessions(*options); });

  const auto replayed = std::make_shared<SessionsOptions>();
  CLI::App* again =
      app.add_subcommand("replay",
                         "Replays a session's event log, checks every stored row against it and prints each "
                         "trial with its stimuli.\nExits with 1 if a row differs.");
  again->add_option("store", replayed->store, "result store")->required();
  again->add_option("participant", replayed->participant, "participant's code")->required();
  again->add_option("--session", replayed->session, "number or name, if there are several");
  again->add_flag("--json", replayed->asJson, "one JSON object");
  again->callback([replayed, &run] { replay(*replayed, run); });
}

}  // namespace limen::study
