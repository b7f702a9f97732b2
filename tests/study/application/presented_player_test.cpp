// SPDX-License-Identifier: BSD-3-Clause
// Stimuli in a window of this process, next to the experimenter's.
#include "study/application/presented_player.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "renderer/catalogue.h"
#include "renderer/gl/window_context.h"
#include "renderer/window/ui_window.h"
#include "study/session/clock.h"
#include "study/session/run.h"
#include "tests/renderer/window/x_server.h"

// After the GL headers, whose names Xlib's macros would change.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limen::study {
namespace {

using Action = std::function<void()>;

/// Plays the first trial of a session and ends it; `between` happens wherever other windows may be drawn.
class OneTrial : public FrontEnd {
 public:
  OneTrial(StimulusPlayer& player, Action between) : player_(player), between_(std::move(between)) {}
  ScreenResult show(const Screen&, const Session&) override {
    ScreenResult result;
    result.answers = {{"consent", true}};
    return result;
  }
  TrialResult present(const Trial& trial, const Session& session) override {
    between_();
    player_.prepare(trial, session, between_);
    between_();
    played = player_.play([] { return true; });
    TrialResult result;
    result.outcome = Outcome::Aborted;
    return result;
  }
  void feedback(bool) override {}
  nlohmann::json environment() const override { return nlohmann::json::object(); }

  PlayResult played;

 private:
  StimulusPlayer& player_;
  Action between_;
};

class PresentedPlayerTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { test::openWindowsOnOneServer(); }

  PresentedPlayerTest() : protocol_(readProtocol("quick", catalogueFromRegistries())) { openWindow(); }

  /// A new one, whose context has compiled no program yet.
  void openWindow() {
    window_.reset();
    window::UiWindowOptions options;
    options.sizePx = {400, 300};
    window_ = std::make_unique<window::UiWindow>(options);
  }

  /// The first trial with pictures of it; `during` happens in its middle.
  PlayResult play(
      const Action& during = [] {}, const Action& between = [] {}) {
    PresentedPlayer player(*window_, protocol_, perception::readDisplay(protocol_.display), true);
    player.setCapture([&] {
      picture_ = window_->readBack();
      during();
    });
    OneTrial frontEnd(player, between);
    std::vector<Event> events;
    runInMemory(protocol_, 7, 0, frontEnd, systemClock(), events);
    return frontEnd.played;
  }

  Protocol protocol_;
  std::unique_ptr<window::UiWindow> window_;
  Image picture_;
};

TEST_F(PresentedPlayerTest, AStimulusLooksTheSameBesideASecondWindow) {
  const PlayResult alone = play();
  EXPECT_EQ(alone.invalid, "");
  const Image expected = picture_;
  const auto [least, most] = std::minmax_element(expected.data.begin(), expected.data.end());
  ASSERT_GT(*most - *least, 0.2F) << "nothing is seen";
  openWindow();
  // Its context is the current one when the player's screen compiles its programs, and before every step.
  window::UiWindow second(window::UiWindowOptions{});
  const PlayResult beside = play([] {}, [&] { second.context().makeCurrent(); });
  EXPECT_EQ(beside.invalid, "");
  EXPECT_EQ(beside.frames.size(), alone.frames.size());
  EXPECT_EQ(picture_.data, expected.data);
}

TEST_F(PresentedPlayerTest, AnOpenGlErrorMakesATrialInvalidWhateverItsTiming) {
  const PlayResult good = play();
  EXPECT_EQ(good.invalid, "");
  const PlayResult bad = play([] { glEnable(0xDEAD); });
  EXPECT_EQ(bad.invalid, "OpenGL error 0x0500");  // GL_INVALID_ENUM
  EXPECT_EQ(play().invalid, "") << "the next one is good again";
}

}  // namespace
}  // namespace limen::study
