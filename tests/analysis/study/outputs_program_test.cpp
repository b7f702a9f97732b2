// SPDX-License-Identifier: BSD-3-Clause
// What the commands of limen-analyse and limen-study write, and what they never do: replace an input, leave
// half a file, end well although something could not be written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/analysis/synthetic_store.h"
#include "tests/full_disk.h"
#include "tests/run_program.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Outputs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    const auto simulate = [](const std::string& protocol, const std::string& name) {
      const ProgramRun run = runProgram("limen-study simulate " + protocol +
                                        " --observers 6 --seed 3 --quiet --store " + shared_->path(name));
      ASSERT_EQ(run.code, 0) << run.text;
    };
    simulate("experiment_1", "one.sqlite");
    simulate("quality_pairs", "pairs.sqlite");
    std::ofstream(shared_->path("trials.csv"))
        << "who,x,k,n,yes,change,left,right,won,value\n"
           "a,1,1,10,1,1,u,v,u,1\na,2,4,10,0,0,v,w,v,2\na,3,8,10,1,1,w,u,w,3\na,4,10,10,0,0,u,w,u,4\n"
           "b,1,2,10,1,1,u,v,v,2\nb,2,5,10,0,0,v,w,w,3\nb,3,7,10,1,0,w,u,u,1\nb,4,9,10,0,1,u,w,w,5\n"
           "c,1,0,10,0,1,u,v,u,2\nc,2,3,10,1,0,v,w,v,1\nc,3,9,10,1,1,w,u,w,3\nc,4,10,10,0,0,v,u,v,6\n";
  }
  static void TearDownTestSuite() { shared_.reset(); }

  /// A fresh copy under the name that the call gives it.
  std::string copy(const std::string& name, const std::string& as) {
    fs::copy_file(shared_->path(name), folder_.path(as), fs::copy_options::overwrite_existing);
    return folder_.path(as);
  }
  size_t files() const {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_.path("."))) ++count;
    return count;
  }

  static std::unique_ptr<TemporaryFolder> shared_;
  const TemporaryFolder folder_;
};
std::unique_ptr<TemporaryFolder> Outputs::shared_;

TEST_F(Outputs, NoTableIsReplacedByAnOutputOrItsSidecar) {
  const std::string fit = "fit DATA --x x --k k --n n", correlate = "correlate DATA --x x --y k",
                    scale = "scale DATA --first left --second right --chosen won";
  // Command, name of the input, output that would replace it.
  const std::vector<std::array<std::string, 3>> calls = {
      {fit, "a.csv", "--csv a.csv"},
      {fit, "a.dat", "--plot a.svg"},
      {fit, "a.gp", "--plot a.pdf"},
      {fit, "a.svg", "--plot a.svg"},
      {fit, "a.csv", "--csv hard.csv"},
      {fit, "a.csv", "--csv link.csv"},
      {correlate, "a.csv", "--csv a.csv"},
      {correlate, "a.dat", "--plot a.svg"},
      {correlate, "a.gp", "--plot a.png"},
      {scale, "a.csv", "--csv a.csv"},
      {scale, "a.dat", "--plot a.svg"},
      {"anova DATA --subject who --within x --k k --n n", "a.csv", "--csv a.csv"},
      {"sdt DATA --outcome yes --signal change --subject who", "a.csv", "--csv a.csv"},
      {"mixed DATA --outcome yes --group who --fixed x", "a.csv", "--csv a.csv"},
  };
  for (const auto& [command, input, output] : calls) {
    const std::string data = copy("trials.csv", input), before = bytesOf(data);
    fs::create_hard_link(data, folder_.path("hard.csv"));
    fs::create_symlink(data, folder_.path("link.csv"));
    std::string call = command;
    call.replace(call.find("DATA"), 4, data);
    const size_t space = output.find(' ');
    call += " " + output.substr(0, space + 1) + folder_.path(output.substr(space + 1));
    const ProgramRun run = runProgram("limen-analyse " + call);
    EXPECT_EQ(run.code, 2) << call << "\n" << run.text;
    EXPECT_THAT(run.text, HasSubstr("is an input")) << call;
    EXPECT_EQ(bytesOf(data), before) << call;
    EXPECT_EQ(files(), 3U) << call << ": nothing else is written either";
    for (const char* name : {"hard.csv", "link.csv"}) fs::remove(folder_.path(name));
    fs::remove(data);
  }
}

TEST_F(Outputs, NoStoreIsReplacedByAnOutput) {
  for (const std::string& command : std::vector<std::string>{
           "rates", "anova", "sdt", "mixed --fixed lod_change", "fit", "correlate", "validate"}) {
    const std::string data = copy("one.sqlite", "s.sqlite"), before = bytesOf(data);
    const ProgramRun run = runProgram("limen-analyse " + command + " " + data + " --csv " + data);
    // What needs predictions is refused for want of them, before or after.
    EXPECT_NE(run.code, 0) << command << "\n" << run.text;
    EXPECT_EQ(bytesOf(data), before) << command;
  }
  const std::string data = copy("pairs.sqlite", "s.sqlite"), before = bytesOf(data);
  EXPECT_EQ(runProgram("limen-analyse scale " + data + " --csv " + data).code, 2);
  EXPECT_EQ(bytesOf(data), before);
  const std::string page = copy("one.sqlite", "report.html"), old = bytesOf(page);
  const ProgramRun run = runProgram("limen-analyse report " + page + " -o " + folder_.path("."));
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_EQ(bytesOf(page), old);
}

TEST_F(Outputs, LostStandardOutputIsAFailure) {
  const std::string data = copy("one.sqlite", "s.sqlite");
  for (const std::string& call :
       std::vector<std::string>{"limen-analyse rates " + data, "limen-analyse rates --json " + data,
                                std::string("limen-analyse --help"), "limen-study sessions " + data,
                                std::string("limen-study protocol"), std::string("limen-study --version"),
                                std::string("limen-report --help")}) {
    const ProgramRun run = runProgram(call, R"(sh -c 'exec "$0" "$@" 2>&1 >/dev/full')");
    EXPECT_EQ(run.code, 1) << call << "\n" << run.text;
    EXPECT_THAT(run.text, HasSubstr("standard output cannot be written")) << call;
  }
}

TEST_F(Outputs, AFullDiskLeavesNoHalfFile) {
  const std::string data = copy("trials.csv", "a.csv"), store = copy("one.sqlite", "s.sqlite");
  struct Call {
    std::string words, output;
    int blocks;  // that a file may have; reading a store takes 64 for SQLite's index of its log
  };
  const std::vector<Call> calls = {{"fit " + data + " --x x --k k --n n --plot ", "a.svg", 4},
                                   {"correlate " + data + " --x x --y k --plot ", "a.pdf", 4},
                                   {"fit " + data + " --x x --k k --n n --csv ", "a_fit.csv", 1},
                                   {"report " + store + " -o ", "page", 80}};
  for (const Call& call : calls) {
    const ProgramRun run =
        runProgram("limen-analyse " + call.words + folder_.path(call.output), fullDiskAfter(call.blocks));
    EXPECT_NE(run.code, 0) << call.words << "\n" << run.text;
    EXPECT_THAT(run.text, testing::AnyOf(HasSubstr("cannot be written"), HasSubstr("could not be written"),
                                         HasSubstr("gnuplot failed")))
        << call.words;
    EXPECT_FALSE(fs::exists(folder_.path(call.output))) << call.words;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      EXPECT_NE(entry.path().filename().string()[0], '.') << call.words << ": " << entry.path();
  }
}

TEST_F(Outputs, TwoReportsAtOnceMakeOneWholePage) {
  const std::string store = copy("pairs.sqlite", "s.sqlite"), out = folder_.path("page");
  const std::string call = "limen-analyse report " + store + " -o ";
  ASSERT_EQ(runProgram(call + folder_.path("alone")).code, 0);
  const std::string whole = bytesOf(folder_.path("alone/report.html"));
  for (int round = 0; round < 3; ++round) {
    ProgramRun first, second;
    std::thread other([&] { second = runProgram(call + out); });
    first = runProgram(call + out);
    other.join();
    EXPECT_EQ(first.code, 0) << first.text;
    EXPECT_EQ(second.code, 0) << second.text;
    EXPECT_EQ(bytesOf(out + "/report.html"), whole);
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path("alone")))
      EXPECT_EQ(fs::is_regular_file(out / fs::relative(entry.path(), folder_.path("alone"))),
                entry.is_regular_file())
          << entry.path();
    for (const auto& entry : fs::directory_iterator(out))
      EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
  }
}

TEST_F(Outputs, AStudyPageTellsNoSeed) {
  const std::string store = copy("one.sqlite", "s.sqlite");
  ASSERT_EQ(runProgram("limen-analyse report " + store + " -o " + folder_.path("page")).code, 0);
  const std::string sessions = bytesOf(folder_.path("page/tables/sessions.csv"));
  EXPECT_THAT(sessions, HasSubstr("participant"));
  EXPECT_THAT(sessions, testing::Not(HasSubstr("seed")));
  // The seeds themselves, as the lab sees them.
  std::istringstream lines(runProgram("limen-study sessions --json " + store).text);
  std::vector<std::string> seeds;
  for (std::string line; std::getline(lines, line);) {
    const size_t at = line.find("\"seed\":\"");
    ASSERT_NE(at, std::string::npos) << line;
    seeds.push_back(line.substr(at + 8, line.find('"', at + 8) - at - 8));
  }
  ASSERT_EQ(seeds.size(), 6U);
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path("page"))) {
    if (!entry.is_regular_file()) continue;
    for (const std::string& seed : seeds) EXPECT_THAT(bytesOf(entry.path()), testing::Not(HasSubstr(seed)));
  }
}

TEST_F(Outputs, AStudyGoesOnWhereItsStoreWasLeftEmpty) {
  std::ofstream(folder_.path("s.sqlite"));
  const std::string call =
      "limen-study simulate quick --observers 1 --quiet --store " + folder_.path("s.sqlite");
  const ProgramRun run = runProgram(call);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(runProgram(call).text, HasSubstr("1 there before"));
}

}  // namespace
}  // namespace limen::analysis
