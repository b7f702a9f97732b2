// SPDX-License-Identifier: BSD-3-Clause
// limen study example: the quick one from end to end, and killed on the way.
#include <gmock/gmock.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "experiments/base/error.h"
#include "experiments/base/yaml_tree.h"
#include "experiments/store/predictions.h"
#include "experiments/store/sessions.h"
#include "tests/run_program.h"

namespace limen::study {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class ExampleProgram : public testing::Test {
 protected:
  ExampleProgram() : folder_(fs::temp_directory_path() / ("limen_example_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ExampleProgram() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Starts the quick example and kills it with a signal that cannot be caught as soon as `reached`.
  void killOnce(const std::string& folder, const std::function<bool()>& reached) {
    std::vector<std::string> words = {
        LIMEN_BIN_DIR "/limen-study", "example", "schwarz_2009_quick", "--quiet", "-o", folder};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, words[0].c_str(), nullptr, nullptr, arguments.data(), environ), 0);
    bool ended = false;
    while (!ended && !reached()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      ended = waitpid(child, nullptr, WNOHANG) == child;
    }
    ASSERT_FALSE(ended) << "it came to its end before it could be killed";
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }

 private:
  fs::path folder_;
};

TEST_F(ExampleProgram, FromEndToEndAndKilledOnTheWay) {
  const std::string whole = path("whole"), broken = path("broken");
  const ProgramRun run = runProgram("limen-study example schwarz_2009_quick --quiet -o " + whole);
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("98.926"));
  EXPECT_THAT(run.text, HasSubstr("no evidence about people"));
  const std::string csv = readTextFile(whole + "/comparison.csv");
  const json summary = json::parse(readTextFile(whole + "/summary.json"));
  EXPECT_EQ(summary.at("studies").at(0).at("window_px"), json({48, 36}));
  EXPECT_EQ(summary.at("comparison").at("sections").size(), 2U);
  for (const char* name : {"experiment_1_rates", "experiment_1_anova", "experiment_1_sdt",
                           "experiment_2_rates", "experiment_2_anova", "experiment_2_sdt"}) {
    const json one = json::parse(readTextFile(whole + "/" + name + ".json"));
    EXPECT_EQ(one.at("protocol"), std::string(name).substr(0, 12));
    EXPECT_TRUE(fs::exists(whole + "/" + name + ".csv")) << name;
  }
  EXPECT_FALSE(fs::exists(whole + "/experiment_1_validate.json"));  // not asked for
  EXPECT_EQ(store::readPredictions(whole + "/experiment_1.sqlite").size(), 28U);
  // Correlations come from the predictions: those of the patch are there, those of the rest are not.
  int withPredictions = 0, without = 0;
  for (const json& study : summary.at("comparison").at("sections"))
    for (const json& statistic : study.at("statistics"))
      if (statistic.at("quantity") == "tau_c")
        ++(statistic.at("note").get<std::string>().find("no predictions") == std::string::npos
               ? withPredictions
               : without);
  EXPECT_EQ(withPredictions, 6);
  EXPECT_EQ(without, 11);

  // Killed among the sessions of the first study, then among its predictions.
  const auto count = [](const auto& read) {
    try {
      return read();
    } catch (const std::exception&) {
      return size_t{0};  // not there yet
    }
  };
  killOnce(broken, [&] {
    return count([&] { return store::readSessions(broken + "/experiment_1.sqlite").size(); }) >= 3;
  });
  EXPECT_FALSE(fs::exists(broken + "/comparison.csv"));
  killOnce(broken, [&] {
    return count([&] { return store::readPredictions(broken + "/experiment_1.sqlite").size(); }) >= 2;
  });
  EXPECT_FALSE(fs::exists(broken + "/comparison.csv"));
  const size_t kept = store::readPredictions(broken + "/experiment_1.sqlite").size();
  EXPECT_LT(kept, 28U);
  const ProgramRun resumed = runProgram("limen-study example schwarz_2009_quick --quiet --json -o " + broken);
  ASSERT_EQ(resumed.code, 0) << resumed.text;
  EXPECT_EQ(readTextFile(broken + "/comparison.csv"), csv);
  EXPECT_EQ(json::parse(resumed.text).at("folder"), broken);

  // Once more does nothing anew, and another seed is not mixed in.
  ASSERT_EQ(runProgram("limen-study example schwarz_2009_quick --quiet -o " + broken).code, 0);
  EXPECT_EQ(store::readSessions(broken + "/experiment_1.sqlite").size(), 8U);
  EXPECT_EQ(readTextFile(broken + "/comparison.csv"), csv);
}

TEST_F(ExampleProgram, RefusesWhatItCannotDo) {
  EXPECT_EQ(runProgram("limen-study example").code, 2);
  const ProgramRun name = runProgram("limen-study example schwarz_2009_quik");
  EXPECT_EQ(name.code, 2);
  EXPECT_THAT(name.text, HasSubstr("schwarz_2009_quick"));
  const std::string file = path("other.yaml");
  const auto write = [&](int seed, const std::string& window) {
    FILE* out = std::fopen(file.c_str(), "w");
    std::fprintf(out,
                 "title: t\nquestion: q\nstudies:\n  - {protocol: quick, observer: {kind: ideal}, seed: %d, "
                 "predictions: false%s}\nanalyses: [rates]\n",
                 seed, window.c_str());
    std::fclose(out);
  };
  // Nothing was published of this one.
  write(1, "");
  const ProgramRun none = runProgram("limen-study example --quiet -o " + path("out") + " " + file);
  EXPECT_EQ(none.code, 0) << none.text;
  EXPECT_THAT(none.text, HasSubstr("nothing was published"));
  EXPECT_FALSE(fs::exists(path("out/comparison.csv")));
  // The store holds other sessions.
  write(2, "");
  const ProgramRun seed = runProgram("limen-study example --quiet -o " + path("out") + " " + file);
  EXPECT_EQ(seed.code, 2);
  EXPECT_THAT(seed.text, HasSubstr("another --seed"));
  write(1, ", window: {width_px: 64, height_px: 48}");
  const ProgramRun window = runProgram("limen-study example --quiet -o " + path("out") + " " + file);
  EXPECT_EQ(window.code, 2);
  EXPECT_THAT(window.text, HasSubstr("another protocol"));
  const ProgramRun folder = runProgram("limen-study example --quiet -o " + file + "/out " + file);
  EXPECT_EQ(folder.code, 2);
  EXPECT_THAT(folder.text, HasSubstr("cannot create the folder"));
  const ProgramRun list = runProgram("limen-study example --list");
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.text, HasSubstr("schwarz_2009_quick"));
}

}  // namespace
}  // namespace limen::study
