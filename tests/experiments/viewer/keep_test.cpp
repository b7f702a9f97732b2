// SPDX-License-Identifier: BSD-3-Clause
// What is kept is what was seen: a sweep of the kept descriptor makes the same product, to the last bit.
#include "experiments/viewer/keep.h"

#include <fstream>
#include <sstream>

#include "experiments/store/store.h"
#include "tests/experiments/viewer/viewer_fixture.h"
#include "tests/run_program.h"

namespace limen::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;

class Keep : public ViewerTest {
 protected:
  /// Product hashes of a sweep of the descriptor, one for each technique. Fewer timed frames than it asks
  /// for: they do not decide the product.
  std::vector<std::string> sweptHashes(const std::string& descriptor) {
    std::stringstream text;
    text << std::ifstream(descriptor).rdbuf();
    std::string quick = text.str();
    const std::string timing = "{warmup: 8, frames: 64}";
    EXPECT_THAT(quick, HasSubstr(timing));
    quick.replace(quick.find(timing), timing.size(), "{warmup: 0, frames: 1, rounds: 1}");
    std::ofstream(descriptor) << quick;
    const std::string store = descriptor + ".sqlite";
    const ProgramRun run = runProgram("limen-sweep '" + descriptor + "' --store '" + store + "'");
    EXPECT_EQ(run.code, 0) << run.text;
    std::vector<std::string> hashes;
    for (const store::Run& done : store::Store(store, store::Access::ReadOnly).allRuns())
      hashes.push_back(done.sceneFacts.value("product_hash", ""));
    return hashes;
  }

  void expectKept(const std::string& what) {
    rest();
    const RenderResult shown = *viewer_->shown();
    ASSERT_EQ(shown.error, "") << what;
    for (const Rendered& one : shown.rendered) ASSERT_EQ(one.error, "") << what;
    const std::string path = viewer_->keepDescriptor();
    ASSERT_NE(path, "") << what << ": " << viewer_->messages().back();
    const std::vector<std::string> hashes = sweptHashes(path);
    ASSERT_EQ(hashes.size(), shown.rendered.size()) << what;
    for (size_t i = 0; i < hashes.size(); ++i) EXPECT_EQ(hashes[i], shown.rendered[i].productHash) << what;
  }
};

TEST_F(Keep, AViewThatWasDraggedToWithOtherParameters) {
  Choices choices = smallChoices("soft_shadows/bitmask");
  choices.technique.given["budget"] = int64_t{37};
  choices.scene.given["light_size"] = 1.0 / 3.0;
  choices.reference = Chosen{"soft_shadows/ray_traced", {{"samples", int64_t{16}}}};
  choices.other = Chosen{"soft_shadows/pcss", {}};
  open(choices);
  rest();
  const glm::vec2 centre = centreOf("picture");
  drag(centre, centre + glm::vec2(37.0F, -21.0F));
  ui_->moveMouse(centre);
  ui_->scroll(2.0F);
  draw();
  expectKept("dragged");
}

TEST_F(Keep, APlaceOnTheScenesPathFarFromTheOrigin) {
  Choices choices = smallChoices("soft_shadows/pcf", "columns_hall");
  choices.scene.given["camera.time_s"] = 1.2345;
  choices.scene.given["offset"] = 1000.0;
  open(choices);
  expectKept("on the path");
}

TEST_F(Keep, LevelsOfDetailInColour) {
  open(smallChoices("lod/blend", "lod/object"));
  expectKept("levels");
}

TEST_F(Keep, WhatIsKeptIsOpenedAgainAsItWas) {
  Choices choices = smallChoices("soft_shadows/bitmask");
  choices.technique.given["pattern"] = std::string("regular_8");
  choices.scene.given["light_size"] = 0.1;
  choices.scene.given["camera"] = std::string("view");
  choices.scene.given["camera.text"] = std::string("eye 0.1 2.3 -4.5 target 0 0 0 up 0 1 0 fov 33.3");
  choices.reference = Chosen{"soft_shadows/ray_traced", {{"samples", int64_t{64}}}};
  const std::string folder = folder_.string();
  const std::string first = keep(choices, folder), second = keep(choices, folder);
  EXPECT_NE(first, second) << "nothing is overwritten";
  EXPECT_EQ(choicesOf(first), choices);
  EXPECT_THAT(descriptorOf(choices), Not(HasSubstr("budget")));
}

TEST_F(Keep, WhatASweepWouldRefuseIsNotWritten) {
  Choices choices = smallChoices();
  choices.reference = Chosen{"lod/finest", {}};  // another kind of product
  EXPECT_THROW(keep(choices, folder_.string()), Error);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) ADD_FAILURE() << entry.path();
}

}  // namespace
}  // namespace limen::viewer
