// SPDX-License-Identifier: BSD-3-Clause
// What is exported is what was seen: a sweep of the exported descriptor makes the same product, to the last
// bit.
#include "experiments/viewer/export_descriptor.h"

#include <fstream>
#include <sstream>

#include "experiments/store/store.h"
#include "tests/experiments/viewer/viewer_fixture.h"
#include "tests/run_program.h"

namespace limen::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;

class ExportDescriptor : public ViewerTest {
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

  void expectSameProducts(const std::string& what) {
    rest();
    const RenderResult shown = *viewer_->state().shown;
    ASSERT_EQ(shown.error, "") << what;
    for (const Rendered& one : shown.rendered) ASSERT_EQ(one.error, "") << what;
    const std::string path = viewer_->exportDescriptor();
    ASSERT_NE(path, "") << what << ": " << viewer_->state().messages.back();
    const std::vector<std::string> hashes = sweptHashes(path);
    ASSERT_EQ(hashes.size(), shown.rendered.size()) << what;
    for (size_t i = 0; i < hashes.size(); ++i) EXPECT_EQ(hashes[i], shown.rendered[i].productHash) << what;
  }
};

TEST_F(ExportDescriptor, AViewThatWasDraggedToWithOtherParameters) {
  ViewSetup setup = smallSetup("soft_shadows/bitmask");
  setup.technique.given = {{"budget", "radial"}, {"budget.rim", int64_t{37}}};
  setup.scene.given["light_size"] = 1.0 / 3.0;
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{16}}}};
  setup.second = Entry{"soft_shadows/pcss", {}};
  open(setup);
  rest();
  const glm::vec2 centre = centreOf("picture");
  drag(centre, centre + glm::vec2(37.0F, -21.0F));
  ui_->moveMouse(centre);
  ui_->scroll(2.0F);
  draw();
  expectSameProducts("dragged");
}

TEST_F(ExportDescriptor, APlaceOnTheScenesPathFarFromTheOrigin) {
  ViewSetup setup = smallSetup("soft_shadows/pcf", "columns_hall");
  setup.scene.given["camera.time_s"] = 1.2345;
  setup.scene.given["offset"] = 1000.0;
  open(setup);
  expectSameProducts("on the path");
}

TEST_F(ExportDescriptor, LevelsOfDetailInColour) {
  open(smallSetup("lod/blend", "lod/object"));
  expectSameProducts("levels");
}

TEST_F(ExportDescriptor, WhatIsExportedIsOpenedAgainAsItWas) {
  ViewSetup setup = smallSetup("soft_shadows/bitmask");
  setup.technique.given["pattern"] = std::string("regular_8");
  setup.scene.given["light_size"] = 0.1;
  setup.scene.given["camera"] = std::string("view");
  setup.scene.given["camera.text"] = std::string("eye 0.1 2.3 -4.5 target 0 0 0 up 0 1 0 fov 33.3");
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{64}}}};
  const std::string folder = folder_.string();
  const std::string first = exportDescriptor(setup, folder), second = exportDescriptor(setup, folder);
  EXPECT_NE(first, second) << "nothing is overwritten";
  EXPECT_EQ(readSetup(first), setup);
  EXPECT_THAT(descriptorOf(setup), Not(HasSubstr("budget")));
}

TEST_F(ExportDescriptor, AlternativesAreOpenedAgainAsTheyWere) {
  ViewSetup setup = smallSetup("test/alternatives");
  setup.technique.given = {{"source", "stepped"}, {"source.steps", int64_t{8}}, {"gain.factor", 1.0 / 3.0}};
  EXPECT_EQ(readSetup(exportDescriptor(setup, folder_.string())), setup);
}

TEST_F(ExportDescriptor, WhatASweepWouldRefuseIsNotWritten) {
  ViewSetup setup = smallSetup();
  setup.reference = Entry{"lod/finest", {}};  // another kind of product
  EXPECT_THROW(exportDescriptor(setup, folder_.string()), Error);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) ADD_FAILURE() << entry.path();
}

}  // namespace
}  // namespace limen::viewer
