// SPDX-License-Identifier: BSD-3-Clause
// What an export does not tell: codes, seeds, times of day, what was typed; and its pseudonyms.
#include <sys/stat.h>
#include <sys/wait.h>

#include <set>

#include "experiments/base/error.h"
#include "study/session/session_seed.h"
#include "tests/study/export/export_fixture.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ExportPrivacy : public Export {};

TEST_F(ExportPrivacy, NoFileTellsCodesOrTimesOfDay) {
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

TEST_F(ExportPrivacy, NoSeedLeavesUnlessCodesDo) {
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

TEST_F(ExportPrivacy, AFormerSeedIsThatOfTheFormula) {
  // printf 'p0/annalena/1' | sha256sum | cut -c1-15
  EXPECT_EQ(formerSessionSeed("p0", "annalena", "1"), 0x15992b46f13d068ull);
}

TEST_F(ExportPrivacy, RandomSeedsAreNeverTheSameAndFitIntoJson) {
  std::set<uint64_t> seeds;
  for (int i = 0; i < 1000; ++i) seeds.insert(randomSessionSeed());
  EXPECT_EQ(seeds.size(), 1000u);
  EXPECT_LT(*seeds.rbegin(), uint64_t{1} << 60);
  EXPECT_GT(*seeds.rbegin(), uint64_t{1} << 59) << "1000 draws that all miss the upper half: 1e-301";
}

TEST_F(ExportPrivacy, KeysTypedEarlyAreCountedAndNotTold) {
  addSession("anna", "1");
  writeExport(request("out", {ExportFormat::Csv}));
  const auto rows = parse(read(folder_ / "out/trials.csv"), ',');
  EXPECT_EQ(rows.at(0).at("early_inputs"), "3");
  EXPECT_EQ(rows.at(1).at("early_inputs"), "") << "no answer";
  EXPECT_THAT(read(folder_ / "out/trials.csv"), testing::Not(HasSubstr("\"key")));
}

TEST_F(ExportPrivacy, WithCodesOnlyTheOwnerReadsIt) {
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

TEST_F(ExportPrivacy, TwoAtOnceAgreeOnPseudonymsAndMixNothing) {
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

TEST_F(ExportPrivacy, PseudonymsThatAnotherProcessGaveMeanwhileStay) {
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

TEST_F(ExportPrivacy, PseudonymsStayAndNewOnesAreAdded) {
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

}  // namespace
}  // namespace limen::study
