// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/export.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>

#include "experiments/base/error.h"
#include "experiments/base/replace_file.h"
#include "experiments/base/staged_folder.h"
#include "experiments/base/text.h"
#include "study/export/pseudonyms.h"
#include "study/session/session_seed.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;

/// Two names with the same label would overwrite each other's file.
void requireDistinct(const std::vector<ExportedSession>& sessions) {
  std::map<std::string, std::string> files;
  for (const ExportedSession& session : sessions) {
    const std::string own = session.subject + " " + session.name;
    const auto [entry, fresh] = files.emplace(label(session.subject) + " " + label(session.name), own);
    if (!fresh)
      throw Error(
          "'" + entry->second + "' and '" + own + "' have the same letters and digits, and so the same file",
          {}, "export CSV, or leave --codes out");
  }
}

bool isSimulated(const store::Environment& environment) {
  const auto frontEnd = environment.facts.find("front_end");
  return frontEnd != environment.facts.end() && frontEnd->is_object() && frontEnd->value("simulated", false);
}

std::string folderName(ExportFormat format) {
  return format == ExportFormat::Csv ? "csv" : format == ExportFormat::Bids ? "bids" : "psych_ds";
}

Files filesOf(ExportFormat format, const std::vector<ExportedSession>& sessions, bool frames) {
  switch (format) {
    case ExportFormat::Bids:
      requireDistinct(sessions);
      return bidsFiles(sessions, frames);
    case ExportFormat::PsychDs:
      requireDistinct(sessions);
      return psychDsFiles(sessions, frames);
    case ExportFormat::Csv:
      break;
  }
  return csvFiles(sessions, frames);
}

/// Markers of an event's data, whose own time since the start of the session is `eventS`.
void addMarkers(const store::StudyEvent& event, double eventS, std::vector<ExportedMarker>& out) {
  const auto markers = event.data.find("markers");
  if (markers == event.data.end()) return;
  try {
    for (const nlohmann::json& marker : *markers) {
      const auto seconds = [&](const char* key) {
        return eventS + static_cast<double>(marker.at(key).get<int64_t>() - event.monotonicNs) * 1e-9;
      };
      out.push_back({event.data.at("trial").get<int>(), event.data.at("attempt").get<int>(),
                     marker.at("code").get<int>(), marker.at("marker").get<std::string>(), seconds("due_ns"),
                     seconds("sent_ns")});
    }
  } catch (const nlohmann::json::exception&) {
    throw Error("the store is damaged: table event, number " + std::to_string(event.number) +
                ": its markers lack what they must say");
  }
}

}  // namespace

std::vector<ExportedSession> loadSessions(const ExportRequest& request) {
  const store::SessionReader reader(request.store);
  std::vector<ExportedSession> out;
  std::vector<std::string> codes, protocols;
  for (const store::StudySession& session : reader.sessions()) {
    const store::StudyProtocol protocol = reader.protocol(session.protocol);
    protocols.push_back(protocol.name);
    if (!request.protocol.empty() && request.protocol != protocol.name && request.protocol != protocol.hash)
      continue;
    codes.push_back(session.participant);
    ExportedSession one;
    one.subject = session.participant;
    one.name = session.name;
    one.protocolName = protocol.name;
    one.protocolTitle = protocol.title;
    one.protocolHash = protocol.hash;
    one.displayHash = session.display;
    one.displayName = reader.display(session.display).name;
    one.state = session.state;
    one.programVersion = session.programVersion;
    if (request.codes) one.seed = session.seed;
    one.simulated = isSimulated(reader.environment(session.environment));
    one.ordersTellCode =
        !request.codes && session.seed == formerSessionSeed(protocol.hash, session.participant, session.name);
    if (session.form.is_object()) one.form = session.form;
    one.trials = reader.trials(session.id, true);
    const std::vector<store::StudyEvent> events = reader.events(session.id);
    const std::vector<double> times = eventTimesS(events);
    if (!events.empty())
      if (const auto sides = events[0].data.find("answers_from_the_left");
          sides != events[0].data.end() && sides->is_object())
        one.answersFromTheLeft = *sides;
    for (size_t i = 0; i < events.size(); ++i) addMarkers(events[i], times[i], one.markers);
    for (const store::StudyTrial& trial : one.trials) {
      const auto start = static_cast<size_t>(trial.event);
      one.startS.push_back(times[start]);
      double end = -1.0;
      for (size_t i = start + 1; i < events.size() && end < 0.0; ++i)
        if (events[i].kind == "answered" || events[i].kind == "trial_invalid") end = times[i];
      one.endS.push_back(trial.valid ? end : -1.0);
    }
    out.push_back(std::move(one));
  }
  if (protocols.empty())
    throw Error("holds no sessions", request.store, "run or simulate a study into it first");
  if (out.empty()) {
    std::sort(protocols.begin(), protocols.end());
    protocols.erase(std::unique(protocols.begin(), protocols.end()), protocols.end());
    throw Error("no session of a protocol '" + request.protocol + "'", request.store,
                suggest(request.protocol, protocols));
  }
  if (!request.codes) {
    Pseudonyms pseudonyms(keyFileOf(request.store));
    pseudonyms.assign(codes);
    for (ExportedSession& session : out) session.subject = pseudonyms.of(session.subject);
  }
  std::sort(out.begin(), out.end(), [](const ExportedSession& a, const ExportedSession& b) {
    return std::tie(a.subject, a.name) < std::tie(b.subject, b.name);
  });
  return out;
}

WrittenExport writeExport(const ExportRequest& request) {
  std::error_code error;
  if (fs::exists(request.folder) && !fs::is_empty(request.folder, error))
    throw Error("is not an empty folder", request.folder, "name a new one; exports never overwrite");
  const std::vector<ExportedSession> sessions = loadSessions(request);
  const Readers readers = request.codes ? Readers::OwnerOnly : Readers::Usual;
  const StagedFolder staged(request.folder, readers);
  WrittenExport written;
  for (const ExportedSession& session : sessions) written.ordersTellCode += session.ordersTellCode ? 1 : 0;
  for (const ExportFormat format : request.formats) {
    const std::string prefix = request.formats.size() > 1 ? folderName(format) + "/" : "";
    for (const auto& [path, content] : filesOf(format, sessions, request.frames)) {
      const fs::path file = staged.path() / (prefix + path);
      fs::create_directories(file.parent_path(), error);
      replaceFile(file.string(), content, {}, readers);
      written.files.push_back(prefix + path);
    }
  }
  staged.putInPlaceAsNew();
  return written;
}

}  // namespace limen::study
