// SPDX-License-Identifier: BSD-3-Clause
// The viewer's panes and controls: where they are, what they show, what they fold away.
#include <GLFW/glfw3.h>

#include "tests/experiments/viewer/viewer_fixture.h"

namespace limen::viewer {
namespace {

class ViewerPanes : public ViewerTest {};

TEST_F(ViewerPanes, PanesFollowTheWindowsSize) {
  open(smallSetup());
  rest();
  for (const glm::ivec2 size :
       {glm::ivec2(320, 200), glm::ivec2(1600, 300), glm::ivec2(200, 900), glm::ivec2(1, 1)}) {
    ui_->resize(size);
    draw();
    draw();
    const ControlMap::Place* picture = viewer_->controls().find("picture");
    ASSERT_TRUE(picture);
    if (size.x < 300) continue;
    // All of it between the panes, as large as there is room.
    EXPECT_GT(picture->mostPx.x, picture->leastPx.x + 10.0F);
    EXPECT_GE(picture->leastPx.x, 0.0F);
    EXPECT_LE(picture->mostPx.x, static_cast<float>(size.x));
    EXPECT_LE(picture->mostPx.y, static_cast<float>(size.y));
  }
  key(GLFW_KEY_TAB);
  ui_->resize({400, 400});
  draw();
  EXPECT_LT(viewer_->controls().find("picture")->leastPx.x, 5.0F) << "panes are hidden";
  for (const gl::DebugMessage& message : ui_->context().takeDebugMessages())
    EXPECT_TRUE(message.performance) << message.text;
}

TEST_F(ViewerPanes, PicturesAreEnlargedByWholeFactors) {
  open(smallSetup(), {}, {1000, 700});
  rest();
  int larger = 0;
  for (const glm::ivec2 size : {glm::ivec2(1000, 700), glm::ivec2(640, 480), glm::ivec2(1280, 800),
                                glm::ivec2(777, 333), glm::ivec2(90, 900)}) {
    ui_->resize(size);
    draw();
    draw();
    const ControlMap::Place* picture = viewer_->controls().find("picture");
    ASSERT_TRUE(picture);
    const glm::vec2 factor = (picture->mostPx - picture->leastPx) / glm::vec2(40.0F, 30.0F);
    EXPECT_NEAR(factor.x, factor.y, 1e-4F);
    if (factor.x < 1.0F) continue;
    ++larger;
    EXPECT_EQ(factor.x, std::round(factor.x)) << size.x << " x " << size.y;
    EXPECT_EQ(picture->leastPx, glm::round(picture->leastPx));
  }
  EXPECT_GE(larger, 3);
}

TEST_F(ViewerPanes, BarsWrapWhereTheWindowIsNarrow) {
  open(smallSetup(), {}, {1280, 800});
  rest();
  for (const glm::ivec2 size : {glm::ivec2(1280, 800), glm::ivec2(640, 480)}) {
    ui_->resize(size);
    draw();
    draw();
    const auto width = static_cast<float>(size.x), height = static_cast<float>(size.y);
    glm::vec2 end(0.0F);
    for (const char* name : {"first", "second", "side by side", "split", "flicker", "error", "prediction"}) {
      const ControlMap::Place* place = viewer_->controls().find(std::string("arrangement.") + name);
      ASSERT_TRUE(place) << name;
      // After the one before, on its line or below it, and within the pane.
      EXPECT_TRUE(place->leastPx.x >= end.x || place->leastPx.y >= end.y) << name << " at " << size.x;
      EXPECT_LT(place->mostPx.x, width - 150.0F) << name << " at " << size.x;
      end = place->mostPx;
    }
    const ControlMap::Place* messages = viewer_->controls().find("messages");
    ASSERT_TRUE(messages);
    EXPECT_LE(messages->mostPx.x, width);
    EXPECT_LE(messages->mostPx.y, height);
    EXPECT_GE(messages->leastPx.y, viewer_->controls().find("picture")->mostPx.y);
  }
}

TEST_F(ViewerPanes, ErrorsComeInAFixedOrderWithTheirBetterDirection) {
  ViewSetup setup = smallSetup();
  setup.reference = Entry{"soft_shadows/ray_traced", {{"samples", int64_t{16}}}};
  open(setup);
  rest();
  const std::vector<ErrorFigure>& figures = viewer_->state().evaluated->figures;
  ASSERT_GT(figures.size(), 4U);
  EXPECT_EQ(figures[0].metric, "rmse");
  EXPECT_EQ(figures[1].metric, "mae");
  EXPECT_EQ(figures[2].metric, "psnr");
  EXPECT_EQ(figures[0].direction, Direction::LowerIsBetter);
  EXPECT_EQ(figures[2].direction, Direction::HigherIsBetter);
  viewer_->execute(command::Arrange{Arrangement::ErrorMap});
  draw();
  EXPECT_TRUE(viewer_->controls().find("colour_bar"));
}

TEST_F(ViewerPanes, AChoiceShowsTheControlsOfItsAlternativeAlone) {
  open(smallSetup("test/alternatives"));
  rest();
  const auto has = [&](const std::string& control) {
    return viewer_->controls().find("technique." + control) != nullptr;
  };
  EXPECT_TRUE(has("source.level"));
  EXPECT_FALSE(has("source.steps"));
  // Below its choice.
  EXPECT_GT(centreOf("technique.source.level").y, centreOf("technique.source").y);
  EXPECT_LT(centreOf("technique.source.level").y, centreOf("technique.gain").y);
  click(along("technique.source.level", 0.25F));
  rest();
  const ParameterValue level = viewer_->state().setup.technique.given.at("source.level");
  EXPECT_NEAR(viewer_->state().shown->rendered.at(0).product->at(3, 3), std::get<double>(level), 1e-6);

  click("technique.source");
  click("technique.source/stepped");
  rest();
  EXPECT_FALSE(has("source.level"));
  EXPECT_TRUE(has("source.steps"));
  EXPECT_FALSE(viewer_->state().setup.technique.given.count("source.level"));
  EXPECT_EQ(viewer_->state().shown->rendered.at(0).product->at(3, 3), 0.25F);  // step 1 of 4

  // Back to the default alternative by the button beside the choice: its earlier value is there again.
  click("technique.source.default");
  rest();
  EXPECT_EQ(viewer_->state().setup.technique.given.at("source.level"), level);

  viewer_->execute(command::SetParameter{Slot::Technique, "source", "dark"});
  rest();
  EXPECT_FALSE(has("source.level") || has("source.steps"));
}

TEST_F(ViewerPanes, GroupsFold) {
  open(smallSetup("test/alternatives"));
  rest();
  ASSERT_TRUE(viewer_->controls().find("technique.gain.factor"));
  click("technique.gain");
  draw();
  EXPECT_FALSE(viewer_->controls().find("technique.gain.factor"));
  click("technique.gain");
  draw();
  EXPECT_TRUE(viewer_->controls().find("technique.gain.factor"));
}

TEST_F(ViewerPanes, LongListsOfDetailsStartFoldedUnlessChanged) {
  ViewSetup setup = smallSetup("soft_shadows/bitmask");
  open(setup);
  rest();
  const auto has = [&](const std::string& control) {
    return viewer_->controls().find("technique." + control) != nullptr;
  };
  EXPECT_TRUE(has("budget.limit"));
  EXPECT_TRUE(has("bias"));
  EXPECT_FALSE(has("bias.slope"));
  click("technique.bias.fold");
  EXPECT_TRUE(has("bias.slope"));
  click("technique.bias.fold");
  EXPECT_FALSE(has("bias.slope"));
  // What is not at its default is in sight from the start.
  setup.technique.given = {{"bias.slope", 0.75}};
  open(setup);
  rest();
  EXPECT_TRUE(has("bias.slope"));
}

TEST_F(ViewerPanes, AFixedListOfNumbersIsChosenFrom) {
  ViewSetup setup = smallSetup("test/alternatives");
  setup.technique.given = {{"source", "stepped"}};
  open(setup);
  rest();
  click("technique.source.steps");
  click("technique.source.steps/8");
  rest();
  EXPECT_EQ(viewer_->state().setup.technique.given.at("source.steps"), ParameterValue(int64_t{8}));
  EXPECT_EQ(viewer_->state().shown->rendered.at(0).product->at(0, 0), 0.125F);
}

}  // namespace
}  // namespace limen::viewer
