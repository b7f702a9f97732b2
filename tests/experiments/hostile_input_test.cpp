// SPDX-License-Identifier: BSD-3-Clause
// Names, texts, sizes and counts that nobody writes by accident, given to the programs as a user would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "tests/run_program.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class HostileInput : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "limen_hostile_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// In single quotes of the shell.
  static std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
  }
  ProgramRun call(const std::string& words, const std::string& environment = {}) const {
    const auto begin = std::chrono::steady_clock::now();
    ProgramRun run = runProgram(words, environment);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << words.substr(0, 200);
    EXPECT_THAT(run.code, testing::AnyOf(0, 1, 2)) << run.text;
    return run;
  }
  void expectRefused(const std::string& words, const std::string& said,
                     const std::string& environment = {}) const {
    const ProgramRun run = call(words, environment);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_THAT(run.text, HasSubstr(said));
  }

  std::string answers(const std::string& condition, const std::string& count = "100") const {
    std::string text = "condition,level,correct,trials\n";
    const std::vector<std::pair<const char*, double>> shares = {
        {"1", 0.1}, {"2", 0.4}, {"3", 0.7}, {"4", 0.95}};
    for (const auto& [level, share] : shares)
      text += "\"" + condition + "\"," + level + "," +
              std::to_string(static_cast<long long>(share * std::stod(count))) + "," + count + "\n";
    return write("answers.csv", text);
  }
  static std::string columns() {
    return " --x level --k correct --n trials --by condition --task yesno --samples 100";
  }

  fs::path folder_;
};

TEST_F(HostileInput, AChartsNameRunsNothing) {
  const std::string file = answers("a");
  for (const std::string name : {"a\nsystem(\"touch ran\")\n.svg", "\x1b[2J.svg", "a\r.svg"}) {
    const ProgramRun run = call("limen-analyse fit " + file + columns() + " --plot " + quoted(path(name)));
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_THAT(run.text, HasSubstr("control characters"));
  }
  for (const std::string name :
       {"<touch ran;.svg", "|touch ran;.svg", "'; system('touch ran').svg", "`touch ran`.svg", "-.svg"}) {
    const ProgramRun run = call("limen-analyse fit " + file + columns() + " --plot " + quoted(path(name)));
    EXPECT_EQ(run.code, 0) << run.text;
    EXPECT_TRUE(fs::exists(path(name))) << name;
  }
  EXPECT_FALSE(fs::exists(path("ran")));
  EXPECT_FALSE(fs::exists("ran"));
}

TEST_F(HostileInput, LabelsRunNothingAndAreDrawn) {
  for (const std::string label :
       {"'tis", "''", "50 % of %s", "`touch ran`", "a'.system('touch ran').'", "@x \\n"}) {
    const ProgramRun run =
        call("limen-analyse fit " + answers(label) + columns() + " --plot " + path("chart.svg"));
    EXPECT_EQ(run.code, 0) << label << ": " << run.text;
    EXPECT_TRUE(fs::exists(path("chart.svg")));
    fs::remove(path("chart.svg"));
  }
  EXPECT_FALSE(fs::exists(path("ran")));
  EXPECT_FALSE(fs::exists("ran"));
}

TEST_F(HostileInput, TerminalsGetNoEscapeSequences) {
  const std::string evil = "\x1b[2J\x1b]0;title\x07\x7f\xc2\x9b";
  const std::string file = answers("a");
  for (const std::string& words :
       {"limen-analyse fit " + file + " --x " + quoted(evil) + " --k correct --n trials",
        "limen-analyse " + quoted(evil), "limen-study protocol " + quoted(evil),
        "limen-sweep " + quoted(evil), "limen-sweep --" + quoted(evil),
        "limen-perceive compare " + quoted(evil) + " b.png", "limen-study sessions " + quoted(evil),
        "limen-view --technique " + quoted(evil) + " --screenshot a.png"}) {
    const ProgramRun run = call(words);
    EXPECT_EQ(run.code, 2) << run.text;
    for (const char* raw : {"\x1b", "\x07", "\x7f", "\xc2\x9b"})
      EXPECT_THAT(run.text, Not(HasSubstr(raw))) << words;
  }
}

TEST_F(HostileInput, StoresAreFiles) {
  const auto simulate = [](const std::string& store) {
    return "limen-study simulate quick --observers 1 --quiet --store " + store;
  };
  expectRefused(simulate(":memory:"), "would be lost");
  expectRefused(simulate("/dev/null"), "a pipe or a device");
  expectRefused(simulate(quoted(path("a\nb.sqlite"))), "control characters");
}

TEST_F(HostileInput, PathsThatAreTooLongAreRefused) {
  const std::string name(5000, 'a');
  for (const std::string& words :
       {"limen-analyse fit " + name + columns(), "limen-study sessions " + name, "limen-sweep " + name,
        "limen-perceive compare " + name + " " + name, "limen-analyse report " + name, "limen-report " + name,
        "limen-study simulate quick --observers 1 --quiet --store " + name, "limen-study protocol " + name,
        "limen-study example " + name, "limen-analyse report " + path("none.sqlite") + " -o " + name}) {
    const ProgramRun run = call(words);
    EXPECT_EQ(run.code, 2) << run.text.substr(0, 300);
  }
}

TEST_F(HostileInput, HugeCountsAreFitted) {
  for (const char* count : {"1000000", "1000000000", "1000000000000"}) {
    const ProgramRun run = call("limen-analyse fit " + answers("a", count) + columns() +
                                " --overdispersion --intervals bootstrap");
    EXPECT_THAT(run.text, Not(HasSubstr("nan"))) << count;
  }
}

TEST_F(HostileInput, ManyMistakesAreToldSoon) {
  std::string text = "title: a\nquestion: b\n";
  for (int i = 0; i < 300000; ++i) text += "k" + std::to_string(i) + ": 1\n";
  const auto begin = std::chrono::steady_clock::now();
  expectRefused("limen-sweep " + write("many.yaml", text), "more errors");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(15));
}

TEST_F(HostileInput, AMachineWithoutADeviceIsRefused) {
  const std::string file =
      write("d.yaml",
            "title: a\nquestion: b\nscenes: [{name: half_plane}]\ntechniques: [{name: "
            "soft_shadows/pcss}]\nreference: {name: soft_shadows/sampled_light}\nimage: {width: 16, "
            "height: 16}\nmetrics: [rmse]\n");
  const ProgramRun run =
      call("limen-sweep " + file + " --no-report --store " + path("s.sqlite"), "LIMEN_EGL_DEVICE=77");
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_THAT(run.text, HasSubstr("EGL device 77"));
}

TEST_F(HostileInput, AStoreInAFolderThatLooksLikeAnOptionIsReported) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  fs::create_directory("-o");
  const std::string file =
      write("d.yaml", "title: a\nquestion: b\nscenes: [{name: grid}]\ntechniques: [{name: soft/bitmask}]\n");
  const ProgramRun run = call("sweep_fake " + file + " --store=-o/s.sqlite");
  fs::current_path(before);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(fs::exists(folder_ / "-o" / "s.sqlite"));
  EXPECT_TRUE(fs::exists(folder_ / "-o" / "s_report" / "report.html")) << run.text;
}

}  // namespace
}  // namespace limen
