// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/export.h"

#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "tests/study/export/export_fixture.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(Export, CsvHasARowForEveryShowing) {
  addSession("anna", "1");
  writeExport(request("out", {ExportFormat::Csv}));
  const auto rows = parse(read(folder_ / "out/trials.csv"), ',');
  ASSERT_EQ(rows.size(), 3u);
  const auto cells = [&](const std::string& column) {
    std::vector<std::string> out;
    for (const auto& row : rows) out.push_back(row.at(column));
    return out;
  };
  using testing::ElementsAre;
  EXPECT_THAT(cells("onset_s"), ElementsAre("1", "4", "6"));
  EXPECT_THAT(cells("duration_s"), ElementsAre("2", "1", "3"));
  EXPECT_THAT(cells("practice"), ElementsAre("1", "0", "0"));
  EXPECT_THAT(cells("valid"), ElementsAre("1", "0", "1"));
  EXPECT_THAT(cells("counts"), ElementsAre("1", "0", "1"));
  EXPECT_THAT(cells("invalid_reason"), ElementsAre("", "2 missed frames", ""));
  EXPECT_THAT(cells("attempt"), ElementsAre("0", "0", "1"));
  EXPECT_THAT(cells("answer"), ElementsAre("yes", "", "yes"));
  EXPECT_THAT(cells("severity"), ElementsAre("3", "", "3"));
  EXPECT_THAT(cells("reaction_time_s"), ElementsAre("0.25", "", "0.25"));
  EXPECT_THAT(cells("missed_blanks"), ElementsAre("0", "2", "0"));
  EXPECT_THAT(cells("condition_distance"), ElementsAre("4", "4", "4"));
  EXPECT_THAT(cells("shown"), ElementsAre("change", "before", "after"));
  EXPECT_THAT(cells("levels"), ElementsAre("3>0", "3", "0"));
  EXPECT_THAT(cells("answers_from_the_left"), ElementsAre("no | yes", "no | yes", "no | yes"));
  const auto frames = parse(read(folder_ / "out/frames.csv"), ',');
  ASSERT_EQ(frames.size(), 6u);
  EXPECT_EQ(frames[3].at("swap_s"), "0.25");
  EXPECT_EQ(frames[3].at("missed_blanks"), "2");
  const auto people = parse(read(folder_ / "out/participants.csv"), ',');
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].at("age"), "30-39");
  EXPECT_EQ(people[0].at("vision"), "normal");
}

TEST_F(Export, MarkersComeWithTheirTimes) {
  addSession("anna", "1");
  writeExport(request("without", {ExportFormat::Csv}));
  EXPECT_FALSE(fs::exists(folder_ / "without/markers.csv"));
  markers_ = true;
  addSession("anna", "2");
  writeExport(request("out", {ExportFormat::Csv, ExportFormat::Bids, ExportFormat::PsychDs}));
  const auto rows = parse(read(folder_ / "out/csv/markers.csv"), ',');
  ASSERT_EQ(rows.size(), 3u);
  // The session began at 10 s of the clock, its trials at 11, 14 and 16 s.
  const double due[] = {1.5, 4.5, 6.5};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::stod(rows[i].at("due_s")), due[i], 1e-9);
    EXPECT_NEAR(std::stod(rows[i].at("sent_s")), due[i] + 0.001, 1e-9);
    EXPECT_EQ(rows[i].at("marker"), "stimulus");
    EXPECT_EQ(rows[i].at("code"), "1");
    EXPECT_EQ(rows[i].at("session"), "2");
  }
  EXPECT_EQ(rows[2].at("attempt"), "1");
  const std::string subject = subjectOf("anna");
  EXPECT_TRUE(
      fs::exists(folder_ / "out/bids/sourcedata" / ("sub-" + subject + "_ses-2_task-quick_markers.tsv")));
  EXPECT_TRUE(fs::exists(folder_ / "out/psych_ds/data" /
                         ("study-quick_subject-" + subject + "_session-2_description-markers_data.csv")));
}

TEST_F(Export, EveryColumnIsInTheDictionaries) {
  markers_ = true;
  addSession("anna", "1");
  addSession("bert", "1");
  writeExport(request("out", {ExportFormat::Csv, ExportFormat::Bids, ExportFormat::PsychDs}));
  const auto firstLine = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  const json csv = json::parse(read(folder_ / "out/csv/dictionary.json"));
  const json psychDs = json::parse(read(folder_ / "out/psych_ds/dataset_description.json"));
  std::set<std::string> described;
  for (const json& variable : psychDs["variableMeasured"]) described.insert(variable["name"]);
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out")) {
    const std::string path = entry.path().string(), extension = entry.path().extension();
    if (extension != ".csv" && extension != ".tsv") continue;
    std::istringstream names(firstLine(read(path)));
    std::string name;
    const bool bids = path.find("/bids/") != std::string::npos;
    if (bids && path.find("sourcedata") != std::string::npos) continue;
    json sidecar;
    if (bids) sidecar = json::parse(read(fs::path(path).replace_extension(".json")));
    while (std::getline(names, name, extension == ".csv" ? ',' : '\t')) {
      ++checked;
      if (bids) {
        EXPECT_TRUE(sidecar.contains(name)) << path << " " << name;
      } else if (path.find("/psych_ds/") != std::string::npos) {
        EXPECT_TRUE(described.count(name)) << path << " " << name;
      } else {
        EXPECT_TRUE(csv[entry.path().filename()].contains(name)) << path << " " << name;
      }
    }
  }
  EXPECT_GT(checked, 100);
}

TEST_F(Export, BidsHasWhatTheStandardRequires) {
  addSession("anna", "first_1");
  writeExport(request("out", {ExportFormat::Bids}));
  const std::string sub = "sub-" + subjectOf("anna");
  const json description = json::parse(read(folder_ / "out/dataset_description.json"));
  EXPECT_EQ(description["Name"], "A title");
  EXPECT_TRUE(description["BIDSVersion"].is_string());
  const std::string stem = sub + "/ses-first1/beh/" + sub + "_ses-first1_task-quick_events";
  const std::string events = read(folder_ / "out" / (stem + ".tsv"));
  EXPECT_EQ(events.rfind("onset\tduration\t", 0), 0u) << events;
  const auto rows = parse(events, '\t');
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].at("answer"), "n/a");
  // BIDS 1.9, "Task events": a sidecar of events describes columns, each by an object; what is said of a task
  // is in a file for all that has its label.
  const json sidecar = json::parse(read(folder_ / "out" / (stem + ".json")));
  for (const auto& [column, about] : sidecar.items()) EXPECT_TRUE(about.is_object()) << column;
  EXPECT_EQ(json::parse(read(folder_ / "out/task-quick_beh.json"))["TaskName"], "quick");
  EXPECT_EQ(parse(read(folder_ / "out/participants.tsv"), '\t')[0].at("participant_id"), sub);
}

TEST_F(Export, SimulatedDataSayThatTheyAre) {
  addSession("sim1", "1", true);
  addSession("sim2", "1", true);
  const std::vector<ExportFormat> all = {ExportFormat::Csv, ExportFormat::Bids, ExportFormat::PsychDs};
  writeExport(request("out", all));
  for (const char* file : {"csv/README", "bids/README", "psych_ds/README.md"}) {
    const std::string text = read(folder_ / "out" / file);
    EXPECT_THAT(text, HasSubstr("2 simulated observers, 2 sittings")) << file;
    EXPECT_THAT(text, HasSubstr("no person took part")) << file;
    EXPECT_THAT(text, testing::Not(HasSubstr("participants,"))) << file;
  }
  const json bids = json::parse(read(folder_ / "out/bids/dataset_description.json"));
  EXPECT_EQ(bids["Name"], "A title (2 simulated observers)");
  const json psychDs = json::parse(read(folder_ / "out/psych_ds/dataset_description.json"));
  EXPECT_THAT(psychDs["description"].get<std::string>(), HasSubstr("no person took part"));
  for (const auto& row : parse(read(folder_ / "out/csv/trials.csv"), ','))
    EXPECT_EQ(row.at("simulated"), "1");
  for (const auto& row : parse(read(folder_ / "out/bids/participants.tsv"), '\t'))
    EXPECT_EQ(row.at("simulated"), "1");
  // People and simulated observers in one store.
  addSession("anna", "1");
  writeExport(request("both", {ExportFormat::Csv}));
  EXPECT_THAT(read(folder_ / "both/README"),
              testing::AllOf(HasSubstr("1 participant and 2 simulated observers, 3 sittings"),
                             HasSubstr("Holds simulated data")));
  std::map<std::string, int> rows;
  for (const auto& row : parse(read(folder_ / "both/trials.csv"), ',')) ++rows[row.at("simulated")];
  EXPECT_EQ(rows, (std::map<std::string, int>{{"0", 3}, {"1", 6}}));
  EXPECT_THAT(read(folder_ / "both/participants.csv"), HasSubstr("simulated"));
}

TEST_F(Export, RefusesWhatItCannotDoAndOverwritesNothing) {
  const auto message = [](const ExportRequest& request) {
    try {
      writeExport(request);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  { const store::SessionLog log(store_); }
  EXPECT_THAT(message(request("out", {ExportFormat::Csv})), HasSubstr("holds no sessions"));
  addSession("anna", "a_b");
  addSession("anna", "ab");
  EXPECT_THAT(message(request("out", {ExportFormat::Bids})), HasSubstr("the same letters and digits"));
  ExportRequest other = request("out", {ExportFormat::Csv});
  other.protocol = "quik";
  EXPECT_THAT(message(other), HasSubstr("did you mean 'quick'"));
  EXPECT_EQ(message(request("out", {ExportFormat::Csv})), "no error");
  const std::string before = read(folder_ / "out/trials.csv");
  EXPECT_THAT(message(request("out", {ExportFormat::Csv})), HasSubstr("is not an empty folder"));
  EXPECT_EQ(read(folder_ / "out/trials.csv"), before);
  std::ofstream(keyFileOf(store_)) << "something else\n";
  EXPECT_THAT(message(request("new", {ExportFormat::Csv})), HasSubstr("not a line of a key table"));
  other = request("codes", {ExportFormat::Csv});
  other.codes = true;
  EXPECT_EQ(message(other), "no error");
  EXPECT_THAT(read(folder_ / "codes/trials.csv"), HasSubstr("anna,a_b"));
}

}  // namespace
}  // namespace limen::study
