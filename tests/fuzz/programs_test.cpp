// SPDX-License-Identifier: BSD-3-Clause
// A few changed inputs through the programs: exit code, message, what is printed.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "experiments/base/printable.h"
#include "tests/analysis/synthetic_store.h"
#include "tests/fuzz/damaged_store.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/rounds.h"
#include "tests/run_program.h"

namespace limen::fuzz {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

constexpr uint64_t kSeeds = 8;

/// Runs the program on a file and checks how it ends; `call` has the file's name in place of a %.
void expectOrderly(std::string call, const std::string& file, uint64_t seed) {
  for (size_t at = call.find('%'); at != std::string::npos; at = call.find('%')) call.replace(at, 1, file);
  const ProgramRun run = runProgram(call, "timeout 60");
  EXPECT_THAT(run.code, AnyOf(0, 1, 2)) << "seed " << seed << ": " << call << "\n" << run.text;
  EXPECT_EQ(printable(run.text), run.text) << "seed " << seed << ": " << call;
  EXPECT_LT(run.text.size(), 1U << 20U) << "seed " << seed << ": " << call;
  if (run.code == 2) {
    EXPECT_THAT(run.text, HasSubstr(fs::path(file).filename().string())) << "seed " << seed << ": " << call;
    EXPECT_THAT(run.text, Not(HasSubstr("what():"))) << "seed " << seed << ": " << call;
  }
}

/// The same with eight seeds.
void expectOrderlyRounds(const std::string& call, const std::string& extension, Mutate mutate,
                         const std::vector<std::string>& corpus) {
  const analysis::TemporaryFolder folder;
  const std::string file = folder.path("input" + extension);
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Random random(seed);
    std::ofstream(file, std::ios::binary) << mutate(random, random.pick(corpus), corpus);
    expectOrderly(call, file, seed);
  }
}

TEST(FuzzPrograms, Descriptors) {
  expectOrderlyRounds("limen-sweep % --dry-run", ".yaml", mutateYaml,
                      shippedFiles("experiments/descriptors", ".yaml"));
}

TEST(FuzzPrograms, Protocols) {
  expectOrderlyRounds("limen-study protocol %", ".yaml", mutateYaml,
                      shippedFiles("study/protocols", ".yaml"));
}

TEST(FuzzPrograms, Tables) {
  const std::vector<std::string> corpus = {
      "who,level,correct,trials\na,1,2,20\na,2,9,20\na,3,18,20\nb,1,4,20\nb,2,11,20\nb,3,19,20\nc,1,3,20\nc,"
      "2,12,20\nc,3,20,20\n"};
  for (const char* const call :
       {"limen-analyse fit % --x level --k correct --n trials --by who --task yesno --samples 100",
        "limen-analyse anova % --subject who --within level --k correct --n trials",
        "limen-analyse correlate % --x level --y correct"})
    expectOrderlyRounds(call, ".csv", mutateCsv, corpus);
}

TEST(FuzzPrograms, Stores) {
  const analysis::TemporaryFolder folder;
  const std::string sound = folder.path("sound.sqlite"), file = folder.path("input.sqlite");
  const ProgramRun made = runProgram("limen-study simulate quick --observers 2 --quiet --store " + sound);
  ASSERT_EQ(made.code, 0) << made.text;
  mergeJournal(sound);
  for (uint64_t seed = 1; seed <= kSeeds; ++seed)
    for (const char* const call : {"limen-analyse rates %", "limen-study sessions %",
                                   "limen-study export % -o %_export", "limen-study replay % S001"}) {
      for (const char* const suffix : {"-wal", "-shm", "-journal", "_export"}) fs::remove_all(file + suffix);
      fs::copy_file(sound, file, fs::copy_options::overwrite_existing);
      Random random(seed);
      damageStore(random, file);
      expectOrderly(call, file, seed);
    }
}

}  // namespace
}  // namespace limen::fuzz
