// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/base/build_facts.h"
#include "study/export/export.h"

namespace limen::study {
namespace {

using nlohmann::json;

/// A table without its columns `subject` and `session`, which are in the file's name, and with `onset` and
/// `duration` named as in BIDS.
Table asEvents(Table table) {
  for (Column& column : table.columns) {
    if (column.name == "onset_s") column.name = "onset";
    if (column.name == "duration_s") column.name = "duration";
  }
  table.columns.erase(table.columns.begin(), table.columns.begin() + 2);
  for (auto& row : table.rows) row.erase(row.begin(), row.begin() + 2);
  return table;
}

std::string dump(const json& value) { return value.dump(2) + "\n"; }

std::string studyName(const std::vector<ExportedSession>& sessions) {
  std::set<std::string> titles;
  for (const ExportedSession& session : sessions) titles.insert(session.protocolTitle);
  std::string out;
  for (const std::string& title : titles) out += (out.empty() ? "" : "; ") + title;
  return out;
}

std::string counted(size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

/// Who answered: "3 participants", "12 simulated observers", or both.
std::string whoAnswered(const std::vector<ExportedSession>& sessions) {
  std::set<std::string> people, simulated;
  for (const ExportedSession& session : sessions)
    (session.simulated ? simulated : people).insert(session.subject);
  std::string out = people.empty() ? "" : counted(people.size(), "participant");
  if (!simulated.empty())
    out += (out.empty() ? "" : " and ") + counted(simulated.size(), "simulated observer");
  return out;
}

bool anySimulated(const std::vector<ExportedSession>& sessions) {
  return std::any_of(sessions.begin(), sessions.end(),
                     [](const ExportedSession& session) { return session.simulated; });
}

/// "" for people alone.
std::string simulatedWords(const std::vector<ExportedSession>& sessions) {
  if (!anySimulated(sessions)) return {};
  const bool all = std::all_of(sessions.begin(), sessions.end(),
                               [](const ExportedSession& session) { return session.simulated; });
  return all ? "SIMULATED DATA: no person took part. All answers come from simulated observers and say "
               "nothing "
               "about people."
             : "Holds simulated data: rows with simulated = 1 come from simulated observers and say nothing "
               "about "
               "people.";
}

/// Title of a data set, which is all that some readers show.
std::string dataName(const std::vector<ExportedSession>& sessions) {
  return studyName(sessions) + (anySimulated(sessions) ? " (" + whoAnswered(sessions) + ")" : "");
}

std::string readme(const std::vector<ExportedSession>& sessions) {
  const bool seeds = std::any_of(sessions.begin(), sessions.end(),
                                 [](const ExportedSession& session) { return session.seed.has_value(); });
  std::string out = studyName(sessions) + "\n\n";
  if (const std::string words = simulatedWords(sessions); !words.empty()) out += words + "\n\n";
  out += whoAnswered(sessions) + ", " + counted(sessions.size(), "sitting") + ", written by " +
         versionText("limen-study") + ".\n\n";
  out +=
      "A row is a trial that was shown. Use those with counts = 1 and practice = 0 for "
      "results;\n"
      "trials whose frames came late have valid = 0 and were shown again. Times count from the start of the "
      "sitting.\n"
      "Ages are given in bins; no times of day are given. ";
  out += seeds ? "Participants are named by their codes: for the lab's own use.\n\n"
               : "Participants are named by pseudonyms.\n\n";
  out += std::string("subject\tsession\tsimulated\tprotocol\tprotocol SHA-256\tdisplay\tdisplay SHA-256\t") +
         (seeds ? "seed\t" : "") + "state\tprogram\n";
  for (const ExportedSession& s : sessions)
    out += s.subject + "\t" + s.name + "\t" + (s.simulated ? "1" : "0") + "\t" + s.protocolName + "\t" +
           s.protocolHash + "\t" + s.displayName + "\t" + s.displayHash + "\t" +
           (s.seed ? std::to_string(*s.seed) + "\t" : "") + s.state + "\t" + s.programVersion + "\n";
  return out;
}

std::string fileStem(const ExportedSession& session) {
  return "sub-" + label(session.subject) + "_ses-" + label(session.name) + "_task-" +
         label(session.protocolName);
}

}  // namespace

Files csvFiles(const std::vector<ExportedSession>& sessions, bool frames) {
  const Table trials = trialTable(sessions), participants = participantTable(sessions);
  json columns = {{"trials.csv", dictionary(trials.columns)},
                  {"participants.csv", dictionary(participants.columns)}};
  Files out = {
      {"trials.csv", toCsv(trials)}, {"participants.csv", toCsv(participants)}, {"README", readme(sessions)}};
  if (frames) {
    const Table table = frameTable(sessions);
    columns["frames.csv"] = dictionary(table.columns);
    out.emplace_back("frames.csv", toCsv(table));
  }
  if (const Table markers = markerTable(sessions); !markers.rows.empty()) {
    columns["markers.csv"] = dictionary(markers.columns);
    out.emplace_back("markers.csv", toCsv(markers));
  }
  out.emplace_back("dictionary.json", dump(columns));
  return out;
}

Files bidsFiles(const std::vector<ExportedSession>& sessions, bool frames) {
  Files out;
  out.emplace_back("dataset_description.json",
                   dump({{"Name", dataName(sessions)},
                         {"BIDSVersion", "1.9.0"},
                         {"DatasetType", "raw"},
                         {"GeneratedBy", {{{"Name", "Limen"}, {"Version", versionText("limen-study")}}}}}));
  out.emplace_back("README", readme(sessions));
  Table participants = participantTable(sessions);
  participants.columns[0].name = "participant_id";
  for (auto& row : participants.rows) row[0] = "sub-" + label(*row[0]);
  out.emplace_back("participants.tsv", toTsv(participants));
  out.emplace_back("participants.json", dump(dictionary(participants.columns)));
  // Sidecars of events hold columns alone; what is said of a task applies to all of its files.
  std::map<std::string, json> tasks;
  for (const ExportedSession& session : sessions)
    tasks.emplace(label(session.protocolName),
                  json{{"TaskName", session.protocolName}, {"TaskDescription", session.protocolTitle}});
  for (const auto& [task, about] : tasks) out.emplace_back("task-" + task + "_beh.json", dump(about));
  for (const ExportedSession& session : sessions) {
    const std::string folder = "sub-" + label(session.subject) + "/ses-" + label(session.name) + "/beh/";
    const Table events = asEvents(trialTable({session}));
    json sidecar = dictionary(events.columns);
    sidecar["StimulusPresentation"] = {{"SoftwareName", "Limen"},
                                       {"SoftwareVersion", session.programVersion}};
    out.emplace_back(folder + fileStem(session) + "_events.tsv", toTsv(events));
    out.emplace_back(folder + fileStem(session) + "_events.json", dump(sidecar));
    // Not BIDS suffixes: such files belong under sourcedata/.
    if (!session.markers.empty())
      out.emplace_back("sourcedata/" + fileStem(session) + "_markers.tsv", toTsv(markerTable({session})));
    if (!frames) continue;
    Table swaps = frameTable({session});
    out.emplace_back("sourcedata/" + fileStem(session) + "_frames.tsv", toTsv(swaps));
  }
  return out;
}

Files psychDsFiles(const std::vector<ExportedSession>& sessions, bool frames) {
  Files out;
  json variables = json::array();
  std::set<std::string> named;
  const auto describe = [&](const std::vector<Column>& columns) {
    for (const Column& column : columns) {
      if (!named.insert(column.name).second) continue;
      json variable = {
          {"@type", "PropertyValue"}, {"name", column.name}, {"description", column.description}};
      if (!column.unit.empty()) variable["unitText"] = column.unit;
      if (!column.levels.empty()) {
        variable["valueReference"] = json::array();
        for (const auto& [value, meaning] : column.levels)
          variable["valueReference"].push_back(
              {{"@type", "PropertyValue"}, {"value", value}, {"name", meaning}});
      }
      variables.push_back(variable);
    }
  };
  for (const ExportedSession& session : sessions) {
    const std::string stem = "data/study-" + label(session.protocolName) + "_subject-" +
                             label(session.subject) + "_session-" + label(session.name);
    const Table table = trialTable({session});
    describe(table.columns);
    out.emplace_back(stem + "_data.csv", toCsv(table));
    if (!session.markers.empty()) {
      const Table markers = markerTable({session});
      describe(markers.columns);
      out.emplace_back(stem + "_description-markers_data.csv", toCsv(markers));
    }
    if (!frames) continue;
    const Table swaps = frameTable({session});
    describe(swaps.columns);
    out.emplace_back(stem + "_description-frames_data.csv", toCsv(swaps));
  }
  const std::string words = simulatedWords(sessions);
  const std::string description = (words.empty() ? "" : words + " ") +
                                  std::string("Answers of viewers, one row per trial, as recorded by Limen");
  const Table participants = participantTable(sessions);
  describe(participants.columns);
  out.emplace_back("data/description-participants_data.csv", toCsv(participants));
  out.emplace_back("dataset_description.json", dump({{"@context", "https://schema.org/"},
                                                     {"@type", "Dataset"},
                                                     {"name", dataName(sessions)},
                                                     {"description", description},
                                                     {"schemaVersion", "Psych-DS 1.0.0"},
                                                     {"variableMeasured", variables}}));
  out.emplace_back("README.md", readme(sessions));
  return out;
}

}  // namespace limen::study
