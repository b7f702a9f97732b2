// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
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

std::string readme(const std::vector<ExportedSession>& sessions) {
  std::set<std::string> subjects;
  std::string out = studyName(sessions) + "\n\n";
  for (const ExportedSession& session : sessions) subjects.insert(session.subject);
  out += std::to_string(subjects.size()) + " participants, " + std::to_string(sessions.size()) +
         " sittings, written by " + versionText("limen-study") + ".\n\n";
  out +=
      "A row is a trial that was shown. Use those with counts = 1 and practice = 0 for "
      "results;\n"
      "trials whose frames came late have valid = 0 and were shown again. Times count from the start of the "
      "sitting.\n"
      "Participants are named by pseudonyms, ages by bins; no times of day are given.\n\n";
  out += "subject\tsession\tprotocol\tprotocol SHA-256\tdisplay\tdisplay SHA-256\tseed\tstate\tprogram\n";
  for (const ExportedSession& s : sessions)
    out += s.subject + "\t" + s.name + "\t" + s.protocolName + "\t" + s.protocolHash + "\t" + s.displayName +
           "\t" + s.displayHash + "\t" + std::to_string(s.seed) + "\t" + s.state + "\t" + s.programVersion +
           "\n";
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
  out.emplace_back("dictionary.json", dump(columns));
  return out;
}

Files bidsFiles(const std::vector<ExportedSession>& sessions, bool frames) {
  Files out;
  out.emplace_back("dataset_description.json",
                   dump({{"Name", studyName(sessions)},
                         {"BIDSVersion", "1.9.0"},
                         {"DatasetType", "raw"},
                         {"GeneratedBy", {{{"Name", "Limen"}, {"Version", versionText("limen-study")}}}}}));
  out.emplace_back("README", readme(sessions));
  Table participants = participantTable(sessions);
  participants.columns[0].name = "participant_id";
  for (auto& row : participants.rows) row[0] = "sub-" + label(*row[0]);
  out.emplace_back("participants.tsv", toTsv(participants));
  out.emplace_back("participants.json", dump(dictionary(participants.columns)));
  for (const ExportedSession& session : sessions) {
    const std::string folder = "sub-" + label(session.subject) + "/ses-" + label(session.name) + "/beh/";
    const Table events = asEvents(trialTable({session}));
    json sidecar = dictionary(events.columns);
    sidecar["TaskName"] = label(session.protocolName);
    sidecar["TaskDescription"] = session.protocolTitle;
    sidecar["StimulusPresentation"] = {{"SoftwareName", "Limen"},
                                       {"SoftwareVersion", session.programVersion}};
    out.emplace_back(folder + fileStem(session) + "_events.tsv", toTsv(events));
    out.emplace_back(folder + fileStem(session) + "_events.json", dump(sidecar));
    if (!frames) continue;
    // Not a BIDS suffix: such files belong under sourcedata/.
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
    if (!frames) continue;
    const Table swaps = frameTable({session});
    describe(swaps.columns);
    out.emplace_back(stem + "_description-frames_data.csv", toCsv(swaps));
  }
  const Table participants = participantTable(sessions);
  describe(participants.columns);
  out.emplace_back("data/description-participants_data.csv", toCsv(participants));
  out.emplace_back("dataset_description.json",
                   dump({{"@context", "https://schema.org/"},
                         {"@type", "Dataset"},
                         {"name", studyName(sessions)},
                         {"description", "Answers of viewers, one row per trial, as recorded by Limen"},
                         {"schemaVersion", "Psych-DS 1.0.0"},
                         {"variableMeasured", variables}}));
  out.emplace_back("README.md", readme(sessions));
  return out;
}

}  // namespace limen::study
