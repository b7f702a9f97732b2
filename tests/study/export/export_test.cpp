// SPDX-License-Identifier: BSD-3-Clause
#include "study/export/export.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "experiments/base/error.h"
#include "study/export/pseudonyms.h"
#include "study/session/session_seed.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

constexpr int64_t kSecond = 1'000'000'000;

class Export : public testing::Test {
 protected:
  Export() : folder_(fs::temp_directory_path() / ("limen_export_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    store_ = folder_ / "study.sqlite";
  }
  ~Export() override { fs::remove_all(folder_); }

  /// A session of three trials: practice, one whose frames came late, its repetition.
  void addSession(const std::string& participant, const std::string& name, bool simulated = false) {
    store::SessionLog log(store_);
    store::StudySession session;
    session.participant = participant;
    session.participantNumber = log.participantNumber(participant, "2026-03-01T12:00:00.000Z");
    session.name = name;
    session.protocol = "p0";
    session.display = "d0";
    session.seed = seed_;
    session.programVersion = "limen-study 0.1";
    session.started = "2026-03-01T12:00:00.000Z";
    const store::StudyBlock practice{0, "main", "main: practice", true, 1},
        block{1, "main", "main", false, 1};
    store::StudyEntry started;
    started.event = {0, "started", "2026-03-01T12:00:00.000Z", 10 * kSecond, json::object()};
    started.event.data["answers_from_the_left"] = {{"main", {"no", "yes"}}};
    started.form = json{{"age", "34"}, {"vision", "normal"}};
    const int64_t id = log.start(session, {"p0", "quick", "quick.yaml", "A title", "title: A title"},
                                 {"d0", "desk", "name: desk", json::object()},
                                 {"llvmpipe", true, {{"front_end", {{"simulated", simulated}}}}},
                                 {practice, block}, {started});
    ASSERT_TRUE(log.claim(id));
    int number = 0;
    const auto show = [&](int trial, int attempt, bool isPractice, int startS, int endS, bool valid) {
      store::StudyEntry begun, ended;
      begun.event = {++number, "trial_started", "2026-03-01T12:00:01.000Z", startS * kSecond, json::object()};
      store::StudyTrial row;
      row.number = trial;
      row.attempt = attempt;
      row.event = number;
      row.part = "main";
      row.block = isPractice ? 0 : 1;
      row.condition = {{"distance", "4"}};
      // Practice changed, the others showed either level throughout.
      row.stimuli = json::array({{{"changes", isPractice},
                                  {"catch_shows_after", attempt == 1},
                                  {"levels", {{"before", 3}, {"after", 0}}}}});
      row.stimulusHashes = {"abc"};
      row.practice = isPractice;
      row.seed = 7417417417;
      row.startedUtc = begun.event.utc;
      begun.begun = row;
      ended.event = {++number, valid ? "answered" : "trial_invalid", "2026-03-01T12:00:02.000Z",
                     endS * kSecond, json::object()};
      if (markers_)
        ended.event.data = {{"trial", trial},
                            {"attempt", attempt},
                            {"markers",
                             {{{"marker", "stimulus"},
                               {"code", 1},
                               {"due_ns", startS * kSecond + kSecond / 2},
                               {"sent_ns", startS * kSecond + kSecond / 2 + kSecond / 1000}}}}};
      store::StudyTrialEnd end{trial, attempt, valid, valid ? "" : "2 missed frames", {}, {}};
      if (valid) {
        store::StudyResponse response;
        response.event = number;
        response.answer = "yes";
        response.outcome = 1;
        response.correct = true;
        response.severity = 3;
        response.reactionTimeS = reactionTimeS_;
        response.device = "keyboard";
        for (const char* key : {"s", "m", "i"})
          response.extra["early_inputs"].push_back({{"key", key}, {"device", "keyboard"}});
        end.response = response;
      }
      end.frames = {{0, 0, 0, 100 * kSecond, 0}, {0, 0, 1, 100 * kSecond + kSecond / 4, valid ? 0 : 2}};
      ended.ended = end;
      log.append(id, {begun, ended});
    };
    show(0, 0, true, 11, 13, true);
    show(1, 0, false, 14, 15, false);
    show(1, 1, false, 16, 19, true);
    log.release(id);
  }

  static std::string read(const fs::path& file) {
    std::ifstream in(file);
    EXPECT_TRUE(in) << file;
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Cells of a table without quotes in it, by column.
  static std::vector<std::map<std::string, std::string>> parse(const std::string& text, char separator) {
    std::istringstream lines(text);
    std::string line;
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> rows;
    const auto split = [&](const std::string& in) {
      std::vector<std::string> out(1);
      for (const char c : in) c == separator ? out.emplace_back() : out.back() += std::string(1, c);
      return out;
    };
    while (std::getline(lines, line)) {
      const std::vector<std::string> cells = split(line);
      if (names.empty()) {
        names = cells;
        continue;
      }
      EXPECT_EQ(cells.size(), names.size()) << line;
      rows.emplace_back();
      for (size_t i = 0; i < cells.size(); ++i) rows.back()[names[i]] = cells[i];
    }
    return rows;
  }

  ExportRequest request(const std::string& name, std::vector<ExportFormat> formats) {
    ExportRequest out;
    out.store = store_;
    out.folder = folder_ / name;
    out.formats = std::move(formats);
    out.frames = true;
    return out;
  }
  std::string subjectOf(const std::string& code) {
    Pseudonyms pseudonyms(keyFileOf(store_));
    return pseudonyms.of(code);
  }

  fs::path folder_;
  std::string store_;
  uint64_t seed_ = 18446744073709551615U;
  double reactionTimeS_ = 0.25;
  bool markers_ = false;  ///< sessions were run with a recorder
};

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

TEST_F(Export, NoFileTellsCodesOrTimesOfDay) {
  addSession("annalena", "1");
  writeExport(request("out", {ExportFormat::Csv, ExportFormat::Bids, ExportFormat::PsychDs}));
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out")) {
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("annalena")));
    EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr(".key.")));
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_THAT(read(entry.path()), testing::Not(HasSubstr("annalena"))) << entry.path();
    EXPECT_THAT(read(entry.path()), testing::Not(HasSubstr("2026"))) << entry.path();
  }
  EXPECT_GT(files, 10);
  struct stat status {};
  ASSERT_EQ(stat(keyFileOf(store_).c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_THAT(read(keyFileOf(store_)), HasSubstr("annalena,P001"));
}

/// All that an export has written, with its paths.
std::string everythingIn(const fs::path& folder) {
  std::string out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    out += entry.path().string() + "\n";
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    out.append(std::istreambuf_iterator<char>(in), {});
  }
  return out;
}

TEST_F(Export, NoSeedLeavesUnlessCodesDo) {
  // As an older version gave it: whoever guesses the code can check it.
  seed_ = formerSessionSeed("p0", "annalena", "1");
  addSession("annalena", "1");
  seed_ = 18446744073709551615U;
  addSession("bert", "1");
  const std::vector<ExportFormat> all = {ExportFormat::Csv, ExportFormat::Bids, ExportFormat::PsychDs};
  EXPECT_EQ(writeExport(request("out", all)).ordersTellCode, 1u);
  const std::string text = everythingIn(folder_ / "out");
  for (const std::string& secret :
       {std::to_string(formerSessionSeed("p0", "annalena", "1")), std::to_string(seed_),
        std::string("7417417417"), std::string("seed"), std::string("annalena")})
    EXPECT_THAT(text, testing::Not(HasSubstr(secret)));
  ExportRequest codes = request("codes", all);
  codes.codes = true;
  EXPECT_EQ(writeExport(codes).ordersTellCode, 0u);
  EXPECT_THAT(everythingIn(folder_ / "codes"),
              testing::AllOf(HasSubstr("7417417417"), HasSubstr(std::to_string(seed_))));
}

TEST_F(Export, AFormerSeedIsThatOfTheFormula) {
  // printf 'p0/annalena/1' | sha256sum | cut -c1-15
  EXPECT_EQ(formerSessionSeed("p0", "annalena", "1"), 0x15992b46f13d068ull);
}

TEST_F(Export, RandomSeedsAreNeverTheSameAndFitIntoJson) {
  std::set<uint64_t> seeds;
  for (int i = 0; i < 1000; ++i) seeds.insert(randomSessionSeed());
  EXPECT_EQ(seeds.size(), 1000u);
  EXPECT_LT(*seeds.rbegin(), uint64_t{1} << 60);
  EXPECT_GT(*seeds.rbegin(), uint64_t{1} << 59) << "1000 draws that all miss the upper half: 1e-301";
}

TEST_F(Export, KeysTypedEarlyAreCountedAndNotTold) {
  addSession("anna", "1");
  writeExport(request("out", {ExportFormat::Csv}));
  const auto rows = parse(read(folder_ / "out/trials.csv"), ',');
  EXPECT_EQ(rows.at(0).at("early_inputs"), "3");
  EXPECT_EQ(rows.at(1).at("early_inputs"), "") << "no answer";
  EXPECT_THAT(read(folder_ / "out/trials.csv"), testing::Not(HasSubstr("\"key")));
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

TEST_F(Export, WithCodesOnlyTheOwnerReadsIt) {
  addSession("anna", "1");
  ExportRequest codes = request("codes", {ExportFormat::Csv, ExportFormat::Bids});
  codes.codes = true;
  writeExport(codes);
  const auto mode = [](const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(stat(path.c_str(), &status), 0);
    return status.st_mode & 077;
  };
  EXPECT_EQ(mode(folder_ / "codes"), 0u);
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "codes")) {
    if (entry.is_regular_file()) {
      EXPECT_EQ(mode(entry.path()), 0u) << entry.path();
    }
  }
  EXPECT_EQ(mode(store_), 0u);
}

TEST_F(Export, TwoAtOnceAgreeOnPseudonymsAndMixNothing) {
  std::map<std::string, double> reactionTimesS;  // which tell the participants apart
  for (int i = 0; i < 6; ++i) {
    const std::string code = "code" + std::to_string(i);
    reactionTimeS_ = reactionTimesS[code] = 0.25 * (i + 1);
    addSession(code, "1");
  }
  for (int round = 0; round < 10; ++round) {
    fs::remove(keyFileOf(store_));
    const std::string suffix = std::to_string(round);
    std::vector<pid_t> children;
    // Two into folders of their own, one into the same as the first.
    for (const char* folder : {"a", "b", "a"}) {
      children.push_back(fork());
      if (children.back() != 0) continue;
      try {
        writeExport(request(folder + suffix, {ExportFormat::Csv}));
        _exit(0);
      } catch (const Error& error) {
        _exit(std::string(error.what()).find("is not an empty folder") != std::string::npos ? 2 : 3);
      }
    }
    std::vector<int> codes;
    for (const pid_t child : children) {
      int status = 0;
      waitpid(child, &status, 0);
      codes.push_back(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    }
    EXPECT_EQ(codes[1], 0);
    EXPECT_EQ(codes[0] + codes[2], 2) << "one of both is refused";
    // The same person has the same name in both, and only the table tells who it is.
    std::map<std::string, std::string> key;  // code by pseudonym
    for (const auto& row : parse(read(keyFileOf(store_)), ','))
      key[row.at("pseudonym")] = row.at("participant");
    EXPECT_EQ(key.size(), 6u);
    for (const char* folder : {"a", "b"})
      for (const auto& row : parse(read(folder_ / (folder + suffix) / "trials.csv"), ','))
        if (!row.at("reaction_time_s").empty()) {
          EXPECT_EQ(std::stod(row.at("reaction_time_s")), reactionTimesS[key[row.at("subject")]]) << folder;
        }
    EXPECT_EQ(read(folder_ / ("a" + suffix) / "trials.csv"), read(folder_ / ("b" + suffix) / "trials.csv"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / ("a" + suffix)), fs::directory_iterator()), 5)
        << "trials, frames, participants, dictionary, README";
  }
  for (const auto& entry : fs::directory_iterator(folder_))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
}

TEST_F(Export, PseudonymsThatAnotherProcessGaveMeanwhileStay) {
  std::vector<std::string> codes;
  for (int i = 0; i < 8; ++i) codes.push_back("code" + std::to_string(i));
  Pseudonyms first(keyFileOf(store_)), second(keyFileOf(store_));
  first.assign(codes);
  codes.push_back("late");
  second.assign(codes);
  codes.pop_back();
  for (const std::string& code : codes) {
    EXPECT_EQ(second.of(code), first.of(code));
    EXPECT_EQ(subjectOf(code), first.of(code));
  }
  EXPECT_EQ(second.of("late"), "P009");
}

TEST_F(Export, PseudonymsStayAndNewOnesAreAdded) {
  addSession("anna", "1");
  addSession("bert", "1");
  writeExport(request("one", {ExportFormat::Csv}));
  const std::string anna = subjectOf("anna"), bert = subjectOf("bert");
  EXPECT_NE(anna, bert);
  addSession("aaron", "1");
  writeExport(request("two", {ExportFormat::Csv}));
  EXPECT_EQ(subjectOf("anna"), anna);
  EXPECT_EQ(subjectOf("bert"), bert);
  EXPECT_EQ(subjectOf("aaron"), "P003");
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
