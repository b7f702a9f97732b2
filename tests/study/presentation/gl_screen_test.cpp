// SPDX-License-Identifier: BSD-3-Clause
// A window as a screen: what the X server then has on its screen, pixel for pixel.
#include <epoxy/gl.h>

#include <cmath>
#include <cstdlib>

#include "experiments/base/error.h"
#include "perception/vision/colour.h"
#include "renderer/gl/texture.h"
#include "renderer/gl/window_system.h"
#include "study/presentation/gl_screen.h"
#include "tests/renderer/window/x_server.h"
#include "tests/study/presentation/x_picture.h"

// After the GL headers, whose names Xlib's macros would change.
#include <gtest/gtest.h>

namespace limen::study {
namespace {

constexpr int kWidth = 320, kHeight = 240;

/// Codes of a picture without a symmetry: red counts columns, green rows, blue layers.
glm::ivec3 codesAt(int x, int y, int layer) { return {10 + x, 50 + y, 100 + layer}; }

gl::Texture layers(glm::ivec2 sizePx, int count) {
  gl::Texture out(gl::Format::RGBA8, sizePx, 1, count);
  for (int layer = 0; layer < count; ++layer) {
    std::vector<uint8_t> bytes;
    for (int y = 0; y < sizePx.y; ++y)
      for (int x = 0; x < sizePx.x; ++x) {
        const glm::ivec3 codes = codesAt(x, y, layer);
        for (int c = 0; c < 3; ++c) bytes.push_back(static_cast<uint8_t>(codes[c]));
        bytes.push_back(255);
      }
    glTextureSubImage3D(out.id(), 0, 0, 0, layer, sizePx.x, sizePx.y, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        bytes.data());
  }
  return out;
}

int srgbCode(double light) { return static_cast<int>(std::lround(255.0 * perception::encodeSrgb(light))); }

class GlScreenTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    server_ = std::make_unique<test::XServer>(kWidth, kHeight);
    setenv("DISPLAY", server_->display().c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    gl::WindowSetting setting;
    setting.fullScreen = true;
    context_ = std::make_unique<gl::WindowContext>(setting);
  }
  static void TearDownTestSuite() {
    context_.reset();
    server_.reset();
  }
  void TearDown() override { EXPECT_NO_THROW(context_->checkDebugMessages()); }

  static std::unique_ptr<test::XServer> server_;
  static std::unique_ptr<gl::WindowContext> context_;
};
std::unique_ptr<test::XServer> GlScreenTest::server_;
std::unique_ptr<gl::WindowContext> GlScreenTest::context_;

TEST_F(GlScreenTest, PicturesReachTheScreenByteForByteAndTheRightWayUp) {
  GlScreen screen(*context_, perception::DisplayProfile{});
  ASSERT_EQ(screen.sizePx(), glm::ivec2(kWidth, kHeight));
  const glm::ivec2 size(24, 17), at(40, 31);
  const gl::Texture pictures = layers(size, 3);
  int64_t last = 0;
  for (const int layer : {2, 0}) {
    screen.clear(0.05);
    screen.draw({pictures.id(), layer}, at, size);
    const int64_t now = screen.swap();
    EXPECT_GT(now, last);
    last = now;
    const test::XPicture shown = test::pictureOfScreen(server_->display());
    int wrong = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::ivec2 inside = glm::ivec2(x, y) - at;
        const bool within =
            glm::all(glm::greaterThanEqual(inside, glm::ivec2(0))) && glm::all(glm::lessThan(inside, size));
        // 0.05 of the light is 63 of 255 in sRGB.
        wrong += shown.at(x, y) != (within ? codesAt(inside.x, inside.y, layer) : glm::ivec3(63));
      }
    EXPECT_EQ(wrong, 0) << "layer " << layer;
  }
}

TEST_F(GlScreenTest, ShapesLieWhereTheyAreAskedFor) {
  GlScreen screen(*context_, perception::DisplayProfile{});
  screen.clear(0.0);
  screen.fill({0, kHeight - 10}, {10, 10}, 1.0);
  screen.ring({160.0, 100.0}, 40.0, 4.0, 0.5);
  screen.arrow({250.0, 120.0}, 60.0, 0.25);
  screen.swap();
  const test::XPicture shown = test::pictureOfScreen(server_->display());
  const auto grey = [](int code) { return glm::ivec3(code); };
  EXPECT_EQ(shown.at(0, kHeight - 1), grey(255));
  EXPECT_EQ(shown.at(9, kHeight - 10), grey(255));
  EXPECT_EQ(shown.at(10, kHeight - 1), grey(0));
  EXPECT_EQ(shown.at(0, kHeight - 11), grey(0));
  EXPECT_EQ(shown.at(0, 0), grey(0));
  for (const glm::ivec2 offset : {glm::ivec2(40, 0), {-40, 0}, {0, 40}, {0, -40}, {28, 28}})
    EXPECT_EQ(shown.at(160 + offset.x, 100 + offset.y), grey(srgbCode(0.5))) << offset.x << " " << offset.y;
  for (const int radius : {0, 36, 44}) EXPECT_EQ(shown.at(160 + radius, 100), grey(0));
  // The arrow points down: wide above its tip, narrow at the tip and in the shaft.
  const auto width = [&](int y) {
    int count = 0;
    for (int x = 200; x < 300; ++x) count += shown.at(x, y) == grey(srgbCode(0.25));
    return count;
  };
  EXPECT_LE(width(118), 4);
  EXPECT_GE(width(99), 20);
  EXPECT_GE(width(70), 4);
  EXPECT_LE(width(70), 10);
  EXPECT_EQ(width(121), 0);
  EXPECT_EQ(width(58), 0);
}

TEST_F(GlScreenTest, AVirtualServerIsNoLab) {
  const std::vector<std::string> found = objectionsTo(*context_);
  // Mesa's software renderer on a server that states no rate; no compositing manager runs, the window is
  // full.
  EXPECT_EQ(found.size(), 2U);
  EXPECT_EQ(context_->refreshHz(), 0.0);
  EXPECT_TRUE(context_->fullScreen());
  EXPECT_FALSE(gl::windowSystem().compositor);
  {
    const test::SelectionOwner manager(server_->display(), "_NET_WM_CM_S0");
    EXPECT_TRUE(gl::windowSystem().compositor);
    EXPECT_EQ(objectionsTo(*context_).size(), 3U);
  }
}

TEST_F(GlScreenTest, MonitorsAreListedAndAWrongOneIsRefused) {
  const std::vector<gl::Monitor> found = gl::monitors();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].sizePx, glm::ivec2(kWidth, kHeight));
  EXPECT_EQ(found[0].refreshHz, 0.0);
  gl::WindowSetting setting;
  setting.fullScreen = true;
  setting.monitor = 3;
  EXPECT_THROW(gl::WindowContext{setting}, Error);
}

TEST_F(GlScreenTest, AHiddenWindowIsLost) {
  gl::WindowSetting setting;
  setting.sizePx = {64, 48};
  setting.visible = false;
  {
    gl::WindowContext hidden(setting);
    EXPECT_EQ(hidden.framebufferScale(), glm::vec2(1.0F));
    EXPECT_FALSE(hidden.fullScreen());
    GlScreen screen(hidden, perception::DisplayProfile{}, false);
    EXPECT_TRUE(screen.lost());
    EXPECT_FALSE(hidden.contextLost());
  }
  context_->makeCurrent();
  EXPECT_FALSE(GlScreen(*context_, perception::DisplayProfile{}).lost());
}

TEST_F(GlScreenTest, KeysBecomeEventsWithTheirTime) {
  GlScreen screen(*context_, perception::DisplayProfile{});
  screen.clear(0.0);
  const int64_t before = screen.swap();
  screen.poll();
  ASSERT_EQ(
      std::system(
          ("DISPLAY=" + server_->display() + " xdotool key space key y mousemove 50 60 click 1").c_str()),
      0);
  std::vector<ScreenEvent> heard;
  for (int i = 0; i < 500 && heard.size() < 3; ++i) {
    for (const ScreenEvent& event : screen.poll()) heard.push_back(event);
    screen.swap();
  }
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[0].name, "space");
  EXPECT_EQ(heard[1].name, "y");
  EXPECT_EQ(heard[2].kind, ScreenEvent::Kind::Mouse);
  EXPECT_EQ(heard[2].name, "left");
  EXPECT_EQ(heard[2].atPx, glm::dvec2(50.0, 60.0));
  for (const ScreenEvent& event : heard) EXPECT_GT(event.timeNs, before);
}

}  // namespace
}  // namespace limen::study
