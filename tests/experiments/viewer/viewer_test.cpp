// SPDX-License-Identifier: BSD-3-Clause
// The viewer used by mouse and keys, without a window.
#include <GLFW/glfw3.h>

#include <chrono>
#include <fstream>
#include <future>
#include <sstream>
#include <thread>

#include "experiments/base/image.h"
#include "experiments/product.h"
#include "renderer/scene/camera_text.h"
#include "tests/experiments/viewer/viewer_fixture.h"

namespace limen::viewer {
namespace {

using testing::HasSubstr;

/// A reference that takes as long as a test wants it to.
struct Gate {
  std::atomic<bool> closed = false;
  std::atomic<int> waiting = 0;
} gate;

class SlowReference : public techniques::Technique {
 public:
  void prepare(frame::Frame& frame) override { product_.emplace(gl::Format::R32F, frame.sizePx()); }
  void render(frame::Frame&) override {
    ++gate.waiting;
    while (gate.closed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --gate.waiting;
    product_->clear(glm::vec4(0.5F));
  }
  const gl::Texture& product() const override { return *product_; }

 private:
  std::optional<gl::Texture> product_;
};

techniques::TechniqueInfo slowReference() {
  techniques::TechniqueInfo info;
  info.name = "test/slow_reference";
  info.summary = "Waits";
  info.reference = true;
  info.make = [](const ParameterValues&) { return std::make_unique<SlowReference>(); };
  return info;
}
const Registered<techniques::TechniqueInfo> kSlowReference{slowReference()};

class ViewerUse : public ViewerTest {
 protected:
  void awaitPictures() {
    EXPECT_TRUE(drawUntil([&] { return !viewer_->state().saving; }));
  }
};

TEST_F(ViewerUse, ShowsWhatTheTechniqueMadeAndItsErrorAgainstTheReference) {
  ViewSetup setup = smallSetup();
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{64}}}};
  open(setup);
  rest();
  const RenderResult& shown = *viewer_->state().shown;
  ASSERT_EQ(shown.rendered.size(), 1U);
  EXPECT_EQ(shown.rendered[0].error, "");
  EXPECT_EQ(shown.rendered[0].nonFinite, 0);
  EXPECT_GE(shown.rendered[0].frameMs, 0.0);
  ASSERT_TRUE(viewer_->state().evaluated);
  const EvaluationResult& evaluated = *viewer_->state().evaluated;
  EXPECT_EQ(evaluated.error, "");
  // The root of the mean square over receivers, worked out here from the two products.
  const Image &product = *shown.rendered[0].product, &reference = *evaluated.reference,
              &mask = shown.view->mask;
  double sum = 0.0, pixels = 0.0;
  for (size_t i = 0; i < product.pixels(); ++i) {
    if (mask.data[i] == 0.0F) continue;
    sum += std::pow(double{product.data[i]} - reference.data[i], 2.0);
    ++pixels;
  }
  ASSERT_GT(pixels, 100.0);
  bool found = false;
  for (const ErrorFigure& figure : evaluated.figures)
    if (figure.metric == "rmse") {
      found = true;
      EXPECT_NEAR(figure.value, std::sqrt(sum / pixels), 1e-6);
    }
  EXPECT_TRUE(found);
}

TEST_F(ViewerUse, ThePictureOnScreenIsTheOneThatASweepWrites) {
  for (const char* technique : {"soft_shadows/pcf", "soft_shadows/bitmask_coloured", "lod/finest"}) {
    ViewSetup setup =
        smallSetup(technique, std::string(technique) == "lod/finest" ? "lod/terrain" : "sphere_grid");
    open(setup);
    rest();
    const Rendered& one = viewer_->state().shown->rendered.at(0);
    ASSERT_EQ(one.error, "") << technique;
    const ScreenPicture expected = screenPicture(
        experiments::productPicture(one.kind, *one.product, viewer_->state().shown->view->shading));
    ASSERT_EQ(one.picture->rgba.size(), expected.rgba.size());
    // The shader rounds in single precision: a step of a byte either way.
    for (size_t i = 0; i < expected.rgba.size(); ++i)
      ASSERT_NEAR(one.picture->rgba[i], expected.rgba[i], 1) << technique << ", byte " << i;
  }
}

TEST_F(ViewerUse, RendersNothingAtRest) {
  open(smallSetup());
  rest();
  // Times may still be on their way; after them nothing is.
  for (int i = 0; i < 5; ++i) draw();
  const int64_t before = viewer_->framesRendered();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_FALSE(viewer_->takeResults());
  for (int i = 0; i < 5; ++i) draw();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(viewer_->framesRendered(), before);
  click(along("scene.light_size", 0.9F));
  rest();
  EXPECT_GT(viewer_->framesRendered(), before);
}

TEST_F(ViewerUse, ASlowReferenceHoldsUpNothing) {
  open(smallSetup());
  rest();
  gate.closed = true;
  ViewSetup setup = viewer_->state().setup;
  setup.reference = Entry{"test/slow_reference", {}};
  viewer_->show(setup);
  ASSERT_TRUE(drawUntil([] { return gate.waiting > 0; }))
      << viewer_->state().shown->error << viewer_->state().shown->rendered.at(0).error
      << (viewer_->state().evaluated ? viewer_->state().evaluated->error : "nothing evaluated");
  // While the reference keeps its thread waiting, settings change and pictures follow.
  const std::string hash = viewer_->state().shown->rendered.at(0).productHash;
  click(along("scene.light_size", 0.95F));
  const uint64_t asked = viewer_->state().shown->number;
  EXPECT_TRUE(drawUntil([&] {
    const auto& shown = viewer_->state().shown;
    return shown && shown->settled && shown->number > asked && shown->rendered.at(0).productHash != hash;
  }));
  EXPECT_GT(gate.waiting, 0);
  EXPECT_FALSE(viewer_->atRest());
  gate.closed = false;
  rest();
  EXPECT_TRUE(viewer_->state().evaluated && viewer_->state().evaluated->error.empty());
}

TEST_F(ViewerUse, AReferenceGetsBetterAndBetter) {
  ViewSetup setup = smallSetup();
  setup.sizePx = {16, 12};
  setup.reference = Entry{"soft_shadows/ray_traced", {}};  // 1,024 rays: after 16, 64 and 256
  open(setup);
  rest();
  EXPECT_EQ(viewer_->evaluation().referencesMade(), 4);
  EXPECT_EQ(viewer_->state().evaluated->step, "");
  // Another technique needs no other reference.
  ViewSetup other = viewer_->state().setup;
  other.technique.name = "soft_shadows/pcf";
  viewer_->show(other);
  rest();
  EXPECT_EQ(viewer_->evaluation().referencesMade(), 4);
}

TEST_F(ViewerUse, DragsOrbitAndTheSceneIsNotBuiltAgain) {
  open(smallSetup());
  rest();
  const scene::Camera before = viewer_->state().shown->camera;
  const ControlMap::Place* picture = viewer_->controls().find("picture");
  ASSERT_TRUE(picture);
  const glm::vec2 centre = picture->centre();
  drag(centre, centre + glm::vec2(80.0F, 20.0F));
  rest();
  const scene::Camera after = viewer_->state().shown->camera;
  EXPECT_NEAR(glm::length(after.eye - after.target), glm::length(before.eye - before.target), 1e-9);
  EXPECT_EQ(after.target, before.target);
  EXPECT_GT(glm::length(after.eye - before.eye), 0.1);
  ASSERT_TRUE(viewer_->state().setup.scene.given.count("camera.text"));
  // What is asked for is what is shown, to the last bit.
  EXPECT_EQ(scene::toText(after),
            std::get<std::string>(viewer_->state().setup.scene.given.at("camera.text")));
  key('R');
  rest();
  EXPECT_EQ(viewer_->state().shown->camera.eye, before.eye);
}

TEST_F(ViewerUse, APickedPixelTellsAllProducts) {
  open(smallSetup());
  rest();
  const ControlMap::Place place = *viewer_->controls().find("picture");
  const glm::vec2 texel = (place.mostPx - place.leastPx) / glm::vec2(40.0F, 30.0F);
  const glm::ivec2 pixel(22, 19);
  click(place.leastPx + (glm::vec2(pixel) + 0.5F) * texel);
  rest();
  const Rendered& one = viewer_->state().shown->rendered.at(0);
  ASSERT_FALSE(one.picked.empty());
  EXPECT_EQ(one.picked[0].name, "product");
  ASSERT_EQ(one.picked[0].values.size(), 1U);
  EXPECT_EQ(one.picked[0].values[0], one.product->at(pixel.x, pixel.y));
  const auto albedo = std::find_if(one.picked.begin(), one.picked.end(),
                                   [](const PickedValues& values) { return values.name == "albedo"; });
  ASSERT_NE(albedo, one.picked.end());
  EXPECT_EQ(albedo->values.size(), 4U);
}

TEST_F(ViewerUse, WhatATechniqueRefusesIsSaidAndTheNextChoiceWorks) {
  ViewSetup setup = smallSetup("lod/blend");
  open(setup);
  rest();
  EXPECT_THAT(viewer_->state().shown->rendered.at(0).error, HasSubstr("needs a scene with"));
  setup.technique = {"soft_shadows/ray_traced", {{"samples", int64_t{16}}}};
  viewer_->show(setup);
  rest();
  EXPECT_EQ(viewer_->state().shown->rendered.at(0).error, "");
}

TEST_F(ViewerUse, ARecordedPathPlaysAndASavedViewComesBack) {
  open(smallSetup());
  rest();
  click("camera.view_name");
  ui_->type("from the front");
  draw();
  click("camera.save_view");
  const scene::Camera front = viewer_->state().shown->camera;
  const glm::vec2 centre = centreOf("picture");
  click("camera.record");
  drag(centre, centre + glm::vec2(60.0F, 0.0F));
  drag(centre, centre + glm::vec2(0.0F, 30.0F));
  click("camera.record");
  rest();
  ASSERT_TRUE(viewer_->state().setup.scene.given.count("camera.file")) << viewer_->state().messages.back();
  EXPECT_GT(viewer_->state().shown->path.durationS(), 0.05);
  EXPECT_NEAR(glm::length(viewer_->state().shown->camera.eye - front.eye), 0.0,
              0.01 * glm::length(front.eye));
  click("camera.play");
  EXPECT_TRUE(viewer_->animated());
  for (int i = 0; i < 3; ++i) draw();
  EXPECT_TRUE(viewer_->state().setup.scene.given.count("camera.time_s"));
  click("camera.play");
  EXPECT_FALSE(viewer_->animated());
  click("camera.view.from the front");
  rest();
  EXPECT_EQ(viewer_->state().shown->camera.eye, front.eye);
}

TEST_F(ViewerUse, PicturesAreSavedOfAllProducts) {
  ViewSetup setup = smallSetup();
  setup.second = Entry{"soft_shadows/hard", {}};
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{16}}}};
  open(setup);
  rest();
  const std::string folder = (folder_ / "exported" / "pictures_001").string();
  viewer_->savePictures();
  EXPECT_TRUE(viewer_->state().saving);
  awaitPictures();
  EXPECT_THAT(viewer_->state().messages.back(), HasSubstr(folder));
  for (const char* name : {"product", "second_product", "reference", "absolute_error"}) {
    EXPECT_TRUE(std::filesystem::exists(folder + "/" + name + ".png")) << name;
    EXPECT_TRUE(std::filesystem::exists(folder + "/" + name + ".exr")) << name;
  }
  EXPECT_EQ(experiments::productHash(readImage(folder + "/product.exr")),
            viewer_->state().shown->rendered.at(0).productHash);
}

TEST_F(ViewerUse, WhatCannotBeWrittenIsSaid) {
  open(smallSetup());
  rest();
  std::ofstream(folder_ / "exported") << "a file where the folder should be";
  EXPECT_EQ(viewer_->exportDescriptor(), "");
  EXPECT_THAT(viewer_->state().messages.back(), HasSubstr("--results"));
  viewer_->savePictures();
  awaitPictures();
  EXPECT_THAT(viewer_->state().messages.back(), HasSubstr("--results"));
  EXPECT_EQ(viewer_->state().messages.size(), 2U);
}

TEST_F(ViewerUse, ClosingWaitsForPicturesButNotForAReference) {
  open(smallSetup());
  rest();
  gate.closed = true;
  ViewSetup setup = viewer_->state().setup;
  setup.reference = Entry{"test/slow_reference", {}};
  viewer_->show(setup);
  ASSERT_TRUE(drawUntil([] { return gate.waiting > 0; }));
  viewer_->savePictures();
  viewer_->savePictures();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(viewer_->close(std::chrono::milliseconds(200)));
  // The reference still waits at its gate: nobody waited for it.
  EXPECT_GT(gate.waiting, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  for (const char* name : {"pictures_001", "pictures_002"}) {
    const std::filesystem::path folder = folder_ / "exported" / name;
    EXPECT_EQ(experiments::productHash(readImage((folder / "product.exr").string())),
              viewer_->state().shown->rendered.at(0).productHash);
    EXPECT_TRUE(std::filesystem::exists(folder / "descriptor.yaml"));
  }
  gate.closed = false;
  EXPECT_TRUE(viewer_->close(std::chrono::minutes(1)));
}

TEST_F(ViewerUse, ThePredictionIsNeverEmptyWithoutAReason) {
  ViewSetup setup = smallSetup("soft_shadows/hard");
  setup.sizePx = {96, 72};
  open(setup);
  rest();
  // One picture: thresholds, with their colours explained.
  click("arrangement.prediction");
  rest();
  EXPECT_EQ(viewer_->state().overlay, Overlay::Thresholds);
  ASSERT_TRUE(viewer_->state().evaluated && viewer_->state().evaluated->overlay);
  EXPECT_EQ(viewer_->state().evaluated->overlayKind, Overlay::Thresholds);
  EXPECT_TRUE(viewer_->controls().find("colour_bar"));
  EXPECT_FALSE(viewer_->controls().find("picture.reason"));
  // Popping was asked for, and there is nothing to compare with.
  viewer_->execute(command::Predict{Overlay::Popping});
  rest();
  EXPECT_FALSE(viewer_->state().evaluated->overlay);
  EXPECT_TRUE(viewer_->controls().find("picture.reason"));
  EXPECT_FALSE(viewer_->controls().find("colour_bar"));
  // Two pictures: popping.
  setup.second = Entry{"soft_shadows/pcss", {}};
  viewer_->execute(command::Predict{Overlay::None});
  viewer_->show(setup);
  viewer_->execute(command::Arrange{Arrangement::Overlay});
  rest();
  EXPECT_EQ(viewer_->state().overlay, Overlay::Popping);
  ASSERT_TRUE(viewer_->state().evaluated && viewer_->state().evaluated->overlay);
}

TEST_F(ViewerUse, PredictionsArePaintedOver) {
  ViewSetup setup = smallSetup("soft_shadows/hard");
  setup.sizePx = {96, 72};
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{64}}}};
  open(setup);
  rest();
  for (const Overlay overlay : {Overlay::Thresholds, Overlay::SingleThresholds, Overlay::Popping}) {
    viewer_->execute(command::Predict{overlay});
    rest();
    ASSERT_TRUE(viewer_->state().evaluated && viewer_->state().evaluated->overlay);
    EXPECT_EQ(viewer_->state().evaluated->overlay->sizePx, setup.sizePx);
    EXPECT_THAT(viewer_->state().evaluated->overlayNote, HasSubstr("schwarz_2009"));
    if (overlay == Overlay::Popping) continue;
    // The two kinds of thresholds are told apart.
    EXPECT_THAT(viewer_->state().evaluated->overlayNote,
                HasSubstr(overlay == Overlay::Thresholds ? "all bands" : "single threshold map"));
  }
  // Hard edges in place of soft ones are seen.
  EXPECT_THAT(viewer_->state().evaluated->overlayNote, HasSubstr("popping region"));
}

}  // namespace
}  // namespace limen::viewer
