// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/screens.h"

#include <gtest/gtest.h>

namespace limen::study {
namespace {

constexpr int64_t kS = 1'000'000'000;

window::Input keyInput(int code, int64_t timeNs) { return {window::Device::Keyboard, code, 0, 0, timeNs}; }

TEST(Screens, BreakCannotBeLeftBeforeItsTime) {
  TextScreen::Setting setting;
  setting.atLeastS = 5.0;
  TextScreen screen(setting);
  screen.shown(10 * kS);
  EXPECT_EQ(screen.page(12 * kS).status, "You can continue in 3 s");
  screen.take(keyInput(window::kKeySpace, 15 * kS - 1), {});
  EXPECT_FALSE(screen.done());
  screen.take(keyInput(window::kKeySpace, 15 * kS), {});
  EXPECT_TRUE(screen.done());
}

TEST(Screens, BreakGoesOnCountingBehindAPause) {
  TextScreen::Setting setting;
  setting.atLeastS = 5.0;
  TextScreen screen(setting);
  screen.shown(0);
  screen.hidden();
  screen.shown(20 * kS);
  screen.take(keyInput(window::kKeyEnter, 21 * kS), {});
  EXPECT_TRUE(screen.done());
}

TEST(Screens, ConsentIsGivenOnTheLastPageOnly) {
  ConsentScreen screen("text");
  screen.setTextPages(2);
  screen.shown(0);
  screen.take(keyInput('y', 1), {});
  EXPECT_FALSE(screen.done());
  screen.take(keyInput(window::kKeySpace, 2), {});
  EXPECT_EQ(screen.page(3).textPages.index, 1);
  screen.shown(4);
  screen.take(keyInput(window::kKeySpace, 5), {});
  EXPECT_FALSE(screen.done()) << "going on is not agreeing";
  screen.take(keyInput('y', 6), {});
  EXPECT_TRUE(screen.done());
  EXPECT_TRUE(screen.agreed());
}

TEST(Screens, DecliningIsAskedBack) {
  ConsentScreen screen("text");
  screen.shown(0);
  screen.take(keyInput('n', 1), {});
  EXPECT_EQ(screen.name(), "consent_declined");
  EXPECT_FALSE(screen.done());
  screen.shown(2);
  screen.take(keyInput(window::kKeyBackspace, 3), {});
  EXPECT_EQ(screen.name(), "consent");
  screen.shown(4);
  screen.take(keyInput('n', 5), {});
  screen.shown(6);
  screen.take(keyInput('e', 7), {});
  EXPECT_TRUE(screen.done());
  EXPECT_FALSE(screen.agreed());
}

TEST(Screens, FormTakesChoicesAndAsksWhetherTheyAreRight) {
  FormScreen screen(
      {{"age", "Age", {"18 to 25", "26 to 35"}}, {"vision", "Vision", {"normal", "corrected"}}});
  int64_t now = 0;
  const auto press = [&](int code) {
    screen.shown(++now);
    screen.take(keyInput(code, ++now), {});
  };
  press('1');
  press('2');
  EXPECT_EQ(screen.name(), "form_review");
  press(window::kKeyBackspace);
  EXPECT_EQ(screen.name(), "form");
  press('2');
  press('1');
  press(window::kKeyEnter);
  EXPECT_TRUE(screen.done());
  EXPECT_EQ(screen.answers(), (nlohmann::json{{"age", "26 to 35"}, {"vision", "normal"}}));
}

TEST(Screens, StoppingIsAskedTwice) {
  for (const auto& [code, choice] :
       {std::pair{int{'l'}, PauseScreen::Choice::StopForNow}, std::pair{int{'e'}, PauseScreen::Choice::End},
        std::pair{int{window::kKeySpace}, PauseScreen::Choice::Continue}}) {
    PauseScreen screen("");
    screen.shown(0);
    screen.take(keyInput(code == window::kKeySpace ? 's' : code, 1), {});
    EXPECT_FALSE(screen.done());
    if (code != window::kKeySpace) screen.take(keyInput('s', 2), {});
    screen.shown(3);
    screen.take(keyInput(code, 4), {});
    EXPECT_TRUE(screen.done());
    EXPECT_EQ(screen.choice(), choice);
  }
}

TEST(Screens, OneKeyTurnsOnePageHoweverOftenItIsHit) {
  TextScreen screen({});
  screen.setTextPages(3);
  screen.shown(0);
  screen.take(keyInput(window::kKeySpace, 1), {});
  screen.take(keyInput(window::kKeySpace, 2), {});
  EXPECT_EQ(screen.page(3).textPages.index, 1);
}

}  // namespace
}  // namespace limen::study
