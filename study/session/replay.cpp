// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/replay.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "study/session/rows.h"

namespace limen::study {
namespace {

template <class T>
nlohmann::json orNull(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json comparable(const store::StudyResponse& r) {
  return {{"event", r.event},
          {"answer", r.answer},
          {"outcome", r.outcome},
          {"correct", orNull(r.correct)},
          {"severity", orNull(r.severity)},
          {"confidence", orNull(r.confidence)},
          {"reaction_time_s", r.reactionTimeS},
          {"question_ns", r.questionNs},
          {"answered_ns", r.answeredNs},
          {"device", r.device},
          {"extra", r.extra}};
}

// All except the frames, of which the event log has only the digest.
nlohmann::json comparable(const store::StudyTrial& t) {
  return {{"number", t.number},
          {"attempt", t.attempt},
          {"event", t.event},
          {"part", t.part},
          {"block", t.block},
          {"condition", t.condition},
          {"repetition", t.repetition},
          {"stimuli", t.stimuli},
          {"stimulus_hashes", t.stimulusHashes},
          {"procedure", orNull(t.procedure)},
          {"procedure_stimulus", t.procedureStimulus},
          {"target", t.target},
          {"change", t.change},
          {"practice", t.practice},
          {"seed", t.seed},
          {"started_utc", t.startedUtc},
          {"valid", orNull(t.valid)},
          {"reason", t.reason},
          {"superseded", t.superseded},
          {"response", t.response ? comparable(*t.response) : nlohmann::json()}};
}

nlohmann::json comparable(const store::StudyNote& n) {
  return {{"event", n.event}, {"author", n.author}, {"code", n.code}, {"detail", n.detail}};
}

nlohmann::json comparable(const store::StudyBlock& b) {
  return {{"number", b.number},
          {"part", b.part},
          {"name", b.name},
          {"practice", b.practice},
          {"trials", b.trials}};
}

// Names the first member that differs: rows are long.
std::string difference(const nlohmann::json& found, const nlohmann::json& expected) {
  if (found.is_object() && expected.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      if (found.contains(key) && found[key] != value) return key + ": " + difference(found[key], value);
    }
  }
  return "the store has " + found.dump().substr(0, 80) + ", the events say " + expected.dump().substr(0, 80);
}

template <class Row>
void compare(const std::string& what, const std::vector<Row>& found, const std::vector<Row>& expected,
             std::vector<std::string>& differences) {
  if (found.size() != expected.size())
    differences.push_back(what + ": the store has " + std::to_string(found.size()) +
                          " rows, the events say " + std::to_string(expected.size()));
  for (size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    const nlohmann::json has = comparable(found[i]), must = comparable(expected[i]);
    if (has != must) differences.push_back(what + " " + std::to_string(i) + ": " + difference(has, must));
  }
}

// Rows as derived from the entries of a log.
struct Derived {
  std::vector<store::StudyTrial> trials;
  std::vector<nlohmann::json> frameDigests;  ///< of each trial; null: no frames
  std::vector<store::StudyNote> notes;
  nlohmann::json form;
  std::string state;

  void take(const store::StudyEntry& entry) {
    if (entry.begun) {
      trials.push_back(*entry.begun);
      frameDigests.emplace_back();
    }
    if (entry.ended) {
      // Only the trial that began last can end.
      if (trials.empty()) throw Error("event " + std::to_string(entry.event.number) + " ends no trial");
      store::StudyTrial& trial = trials.back();
      trial.valid = entry.ended->valid;
      trial.reason = entry.ended->reason;
      trial.response = entry.ended->response;
      frameDigests.back() = entry.event.data.value("frames", nlohmann::json());
    }
    if (entry.supersedeFrom)
      for (store::StudyTrial& trial : trials) trial.superseded |= trial.event >= *entry.supersedeFrom;
    if (entry.note) notes.push_back(*entry.note);
    if (entry.form) form = *entry.form;
    if (!entry.state.empty()) state = entry.state;
  }
};

void compareFrames(const std::vector<store::StudyTrial>& found, const Derived& expected,
                   std::vector<std::string>& differences) {
  for (size_t i = 0; i < std::min(found.size(), expected.trials.size()); ++i) {
    nlohmann::json has;
    if (!found[i].frames.empty()) has = frameDigest(found[i].frames);
    if (has != expected.frameDigests[i])
      differences.push_back("frame log of trial " + std::to_string(i) + ": " +
                            difference(has, expected.frameDigests[i]));
  }
}

}  // namespace

Verification verifySession(const store::SessionReader& reader, const store::StudySession& session,
                           const Protocol& protocol) {
  Verification verification;
  std::vector<std::string>& differences = verification.differences;
  const store::StudyProtocol stored = reader.protocol(session.protocol);
  if (sha256(stored.text) != stored.hash || protocol.hash != stored.hash)
    differences.push_back("protocol: its text is not the one with which the session began");
  const std::vector<store::StudyEvent> events = reader.events(session.id);
  int planVersion = kPlanVersion;
  if (!events.empty())
    atEvent(events.front(), reader.path(), [&] { planVersion = planVersionOf(events.front().data); });
  Session replayed(protocol, session.seed, session.participantNumber, planVersion);
  Derived expected;
  for (const store::StudyEvent& row : events) {
    atEvent(row, reader.path(), [&] {
      const Event event = eventOf(row);
      expected.take(entryOf(replayed, event));
      replayed.apply(event);
    });
    ++verification.events;
  }
  verification.state = replayed.state();
  const std::vector<store::StudyTrial> trials = reader.trials(session.id, true);
  compare("trial", trials, expected.trials, differences);
  compareFrames(trials, expected, differences);
  compare("note", reader.notes(session.id), expected.notes, differences);
  compare("block", reader.blocks(session.id), blocksOf(replayed), differences);
  if (session.form != expected.form)
    differences.push_back("form: " + difference(session.form, expected.form));
  // A session whose process was killed is still marked as running, which agrees with its events.
  if (session.state != expected.state)
    differences.push_back("state: the store has " + session.state + ", the events say " + expected.state);
  return verification;
}

}  // namespace limen::study
