// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "experiments/base/build_facts.h"
#include "experiments/base/environment.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "experiments/store/sessions.h"
#include "study/session/clock.h"
#include "study/session/loop.h"
#include "study/session/privacy.h"
#include "study/session/rows.h"

namespace limen::study {
namespace {

using store::SessionLog;

// Releases a session whatever happens, so that this process's successor can resume it at once.
struct Hold {
  SessionLog& log;
  int64_t session = 0;
  ~Hold() {
    if (session != 0) log.release(session);
  }
};

std::string textOf(ResumePolicy policy) {
  switch (policy) {
    case ResumePolicy::Resume:
      return "resume";
    case ResumePolicy::RestartBlock:
      return "restart_block";
    case ResumePolicy::Refuse:
      break;
  }
  return "refuse";
}

std::string freeName(const SessionLog& log, const std::string& participant) {
  const std::vector<std::string> taken = log.sessionNames(participant);
  for (int number = 1;; ++number) {
    const std::string name = std::to_string(number);
    if (std::find(taken.begin(), taken.end(), name) == taken.end()) return name;
  }
}

store::Environment environmentOf(const FrontEnd& frontEnd) {
  store::Environment environment;
  environment.facts = environmentFacts({}, "");
  // The command line may contain folder names, and those may contain names of people.
  environment.facts.erase("command");
  environment.facts.erase("working_directory");
  const nlohmann::json shown = frontEnd.environment();
  environment.device = "none";
  for (const char* key : {"gpu", "device"})
    if (shown.contains(key) && shown[key].is_string()) environment.device = shown[key].get<std::string>();
  const auto software = shown.find("software_renderer");
  if (software != shown.end() && software->is_boolean()) environment.software = software->get<bool>();
  environment.facts["front_end"] = shown;
  return environment;
}

std::function<void(const std::string&)> warner(const SessionRequest& request) {
  if (request.warn) return request.warn;
  return [](const std::string& text) { fmt::print(stderr, "warning: {}\n", text); };
}

// Everything that one call of runSession needs.
struct Job {
  const Protocol& protocol;
  const SessionRequest& request;
  FrontEnd& frontEnd;
  Clock& clock;
  SessionLog& log;
  std::function<void(const std::string&)> warn;
};

Sink storeSink(SessionLog& log, std::vector<store::StudyEntry>& pending, const int64_t& session) {
  return {[&pending](const Session& before, const Event& event, const std::vector<ShownFrame>& frames) {
            pending.push_back(entryOf(before, event, frames));
          },
          [&log, &pending, &session] {
            log.append(session, pending);
            pending.clear();
          }};
}

SessionEnd finish(const Session& session, Loop& loop, int64_t id) {
  loop.run();
  return {session.step().kind, id, session.trialsDone(), loop.trialsInvalid()};
}

SessionEnd runNew(const Job& job) {
  const SessionRequest& request = job.request;
  store::StudySession row;
  row.participant = request.participant;
  row.name = request.session;
  row.started = job.clock.utc();
  row.participantNumber = job.log.participantNumber(request.participant, row.started);
  row.seed = request.seed;
  row.programVersion = projectVersion() + " (commit " + buildCommit() + ")";
  const store::Environment environment = environmentOf(job.frontEnd);
  const store::StudyDisplay display{request.display.hash(), request.display.name,
                                    perception::toYaml(request.display), request.calibration};
  const store::StudyProtocol protocol{job.protocol.hash, job.protocol.name, job.protocol.path,
                                      job.protocol.title, job.protocol.text};

  Session session(job.protocol, request.seed, row.participantNumber);
  Hold hold{job.log};
  std::vector<store::StudyEntry> pending;
  Sink sink = storeSink(job.log, pending, hold.session);
  sink.commit = [&, append = sink.commit] {
    if (hold.session != 0) return append();
    hold.session = job.log.start(row, protocol, display, environment, blocksOf(session), pending);
    pending.clear();
  };
  Loop loop(session, job.frontEnd, job.clock, std::move(sink), job.warn);
  loop.record(EventKind::Started, {{"protocol_hash", job.protocol.hash},
                                   {"seed", std::to_string(request.seed)},
                                   {"participant_number", row.participantNumber},
                                   {"plan_version", session.planVersion()},
                                   {"answers_from_the_left", session.answersFromTheLeft()},
                                   {"display_hash", display.hash},
                                   {"program_version", row.programVersion},
                                   {"boot", job.clock.boot()},
                                   {"environment", environment.facts}});
  return finish(session, loop, hold.session);
}

void checkSame(const Job& job, const store::StudySession& row) {
  const std::string who = "session " + row.name + " of participant " + row.participant;
  const std::string& where = job.log.path();
  if (row.state == "finished" || row.state == "aborted")
    throw Error(who + (row.state == "finished" ? " has finished" : " was aborted"), where,
                "start a new one: --session " + freeName(job.log, row.participant) + " without --resume");
  if (row.protocol != job.protocol.hash)
    throw Error(
        fmt::format("{} began with another protocol: '{}', SHA-256 {}; this is '{}', SHA-256 {}", who,
                    job.log.protocolName(row.protocol), row.protocol, job.protocol.name, job.protocol.hash),
        where, "resume it with the original file");
  if (row.display != job.request.display.hash())
    throw Error(fmt::format("{} began on another display: '{}', SHA-256 {}; this is '{}', SHA-256 {}", who,
                            job.log.displayName(row.display), row.display, job.request.display.name,
                            job.request.display.hash()),
                where, "resume it with the original display profile");
  if (job.protocol.session.resume == ResumePolicy::Refuse)
    throw Error("the protocol does not allow " + who + " to be resumed", where,
                "start a new one: --session " + freeName(job.log, row.participant) + " without --resume");
}

// Seconds since the last event by the wall clock.
double ageS(const Job& job, const std::string& last) {
  const std::optional<double> from = utcSeconds(last), to = utcSeconds(job.clock.utc());
  if (!from || !to) throw Error("the store holds an invalid instant: " + last, job.log.path());
  if (*to < *from) {
    job.warn("the wall clock is earlier than the session's last event (" + last +
             "): it was set; the session's " + "age counts as 0");
    return 0.0;
  }
  return *to - *from;
}

// Instant of the last event, if the clock has advanced since.
std::optional<LastInstant> sameBoot(const std::vector<store::StudyEvent>& events, const std::string& boot) {
  std::string last;
  for (const store::StudyEvent& event : events)
    if (const auto boots = event.data.find("boot"); boots != event.data.end() && boots->is_string())
      last = boots->get<std::string>();
  if (last.empty() || last != boot) return std::nullopt;
  return LastInstant{events.back().utc, events.back().monotonicNs};
}

SessionEnd runAgain(const Job& job, const store::StudySession& row) {
  checkSame(job, row);
  if (!job.log.claim(row.id))
    throw Error("session " + row.name + " of participant " + row.participant +
                    " is being run by another process (" + row.owner + ")",
                job.log.path(), "end that one first");
  Hold hold{job.log, row.id};
  const std::vector<store::StudyEvent> events = job.log.events(row.id);
  if (events.empty()) throw Error("the session has no events", job.log.path());
  const double gapS = ageS(job, events.back().utc);
  const double maximumH = job.protocol.session.maximumAgeH;
  if (gapS > maximumH * 3600.0)
    throw Error(fmt::format("session {} of participant {} was left {:.1f} h ago, the protocol allows {:g} h",
                            row.name, row.participant, gapS / 3600.0, maximumH),
                job.log.path(),
                "start a new one: --session " + freeName(job.log, row.participant) + " without --resume");

  int planVersion = 1;
  atEvent(events.front(), job.log.path(), [&] { planVersion = planVersionOf(events.front().data); });
  Session session(job.protocol, row.seed, row.participantNumber, planVersion);
  int invalid = 0;
  for (const store::StudyEvent& event : events) {
    atEvent(event, job.log.path(), [&] { session.apply(eventOf(event)); });
    invalid += event.kind == toText(EventKind::TrialInvalid) ? 1 : 0;
  }
  std::vector<store::StudyEntry> pending;
  Loop loop(session, job.frontEnd, job.clock, storeSink(job.log, pending, hold.session), job.warn,
            sameBoot(events, job.clock.boot()));
  loop.startFrom(invalid);
  loop.record(EventKind::Continued, {{"policy", textOf(job.protocol.session.resume)},
                                     {"gap_s", gapS},
                                     {"boot", job.clock.boot()},
                                     {"environment", environmentOf(job.frontEnd).facts}});
  return finish(session, loop, row.id);
}

}  // namespace

SessionEnd runSession(const Protocol& protocol, const SessionRequest& request, FrontEnd& frontEnd,
                      Clock& clock) {
  checkCode(request.participant, "participant");
  checkCode(request.session, "session");
  perception::checkDisplay(request.display, request.display.name);
  SessionLog log(request.store, request.durability == Durability::PowerLoss);
  const Job job{protocol, request, frontEnd, clock, log, warner(request)};
  const std::optional<store::StudySession> known = log.find(request.participant, request.session);
  if (!known && request.resume) {
    const std::vector<std::string> names = log.sessionNames(request.participant);
    throw Error("participant " + request.participant + " has no session " + request.session, request.store,
                names.empty() ? "leave out --resume to start it" : "known sessions: " + join(names));
  }
  if (!known) return runNew(job);
  if (request.resume) return runAgain(job, *known);
  const bool over = known->state == "finished" || known->state == "aborted";
  throw Error("participant " + request.participant + " has a session " + request.session + " already (" +
                  known->state + ")",
              request.store,
              std::string(over ? "" : "continue it with --resume, or ") + "start a new one with --session " +
                  freeName(log, request.participant));
}

SessionEnd runInMemory(const Protocol& protocol, uint64_t seed, int participantNumber, FrontEnd& frontEnd,
                       Clock& clock, std::vector<Event>& events) {
  Session session(protocol, seed, participantNumber);
  Loop loop(
      session, frontEnd, clock,
      {[&](const Session&, const Event& event, const std::vector<ShownFrame>&) { events.push_back(event); },
       [] {}},
      [](const std::string&) {});
  loop.record(EventKind::Started, {{"protocol_hash", protocol.hash},
                                   {"seed", std::to_string(seed)},
                                   {"participant_number", participantNumber},
                                   {"plan_version", session.planVersion()},
                                   {"answers_from_the_left", session.answersFromTheLeft()}});
  return finish(session, loop, 0);
}

}  // namespace limen::study
