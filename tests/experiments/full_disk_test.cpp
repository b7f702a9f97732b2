// SPDX-License-Identifier: BSD-3-Clause
// A sweep whose pictures find no room: the run fails and says why, and nothing is half there.
#include "tests/full_disk.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "experiments/store/store.h"
#include "tests/run_program.h"

namespace limen {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(FullDisk, ARunWhosePicturesCannotBeWrittenFails) {
  std::string folder = (fs::temp_directory_path() / "limen_full_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  // The picture of the reference takes more than a file may have here, the store less.
  std::ofstream(folder + "/d.yaml")
      << "title: full disk\nquestion: what happens to its runs?\n"
         "scenes: [{name: sphere_grid}]\ntechniques: [{name: soft_shadows/hard}]\n"
         "reference: {name: soft_shadows/ray_traced, samples: 16}\n"
         "image: {width: 2200, height: 1650}\n"
         "timing: {warmup: 0, frames: 1, rounds: 1}\n"
         "artefacts: {pictures: true, exr: false}\nmetrics: [rmse]\n"
         "report: {x: gpu_ms, y: rmse, series: technique, panels: scene}\n";
  const std::string store = folder + "/results/s.sqlite";
  const std::string call = "limen-sweep " + folder + "/d.yaml --no-report --store " + store;
  const ProgramRun full = runProgram(call, fullDiskAfter(1000));
  EXPECT_EQ(full.code, 1) << full.text;
  EXPECT_THAT(full.text, HasSubstr("reference.png: cannot be written: File too large"));
  {
    const std::vector<store::Run> runs = store::Store(store, store::Access::ReadOnly).allRuns();
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].status, "failed");
    EXPECT_THAT(runs[0].error, HasSubstr("reference.png: cannot be written"));
    EXPECT_TRUE(runs[0].artefacts.empty());
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
    EXPECT_NE(entry.path().filename(), "reference.png");
  }
  // With room again it is measured.
  const ProgramRun again = runProgram(call);
  EXPECT_EQ(again.code, 0) << again.text;
  const std::vector<store::Run> runs = store::Store(store, store::Access::ReadOnly).allRuns();
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].status, "done");
  EXPECT_EQ(runs[0].artefacts.size(), 3u) << "product, reference, error";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace limen
