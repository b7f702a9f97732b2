// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page.h"

#include <gtest/gtest.h>

namespace limen::study {
namespace {

Page threeButtons() {
  Page page;
  page.buttons = {
      {10, "a", "", "", {'1'}, true}, {11, "b", "", "", {'2'}, true}, {12, "c", "", "", {'3'}, false}};
  return page;
}

const std::vector<TargetRect> kTargets = {{10, 0, 0, 100, 50}, {11, 120, 0, 220, 50}, {12, 240, 0, 340, 50}};

TEST(Page, TakesKeysOfItsButtonsOnly) {
  const Page page = threeButtons();
  EXPECT_EQ(pressedButton(page, {window::Device::Keyboard, '2', 0, 0, 0}, kTargets), 11);
  EXPECT_FALSE(pressedButton(page, {window::Device::Keyboard, '4', 0, 0, 0}, kTargets));
  EXPECT_FALSE(pressedButton(page, {window::Device::Keyboard, window::kKeySpace, 0, 0, 0}, kTargets))
      << "nothing has the focus";
}

TEST(Page, DisabledButtonsTakeNothing) {
  const Page page = threeButtons();
  EXPECT_FALSE(pressedButton(page, {window::Device::Keyboard, '3', 0, 0, 0}, kTargets));
  EXPECT_FALSE(pressedButton(page, {window::Device::Mouse, window::kKeyNone, 300, 20, 0}, kTargets));
}

TEST(Page, MousePressesWhatIsUnderIt) {
  const Page page = threeButtons();
  EXPECT_EQ(pressedButton(page, {window::Device::Mouse, window::kKeyNone, 99.5F, 49.5F, 0}, kTargets), 10);
  EXPECT_FALSE(pressedButton(page, {window::Device::Mouse, window::kKeyNone, 110, 20, 0}, kTargets))
      << "between two";
  EXPECT_FALSE(pressedButton(page, {window::Device::Mouse, window::kKeyNone, 50, 50, 0}, kTargets))
      << "just below";
}

TEST(Page, FocusStartsNowhereSoThatNoAnswerIsSuggested) {
  Page page = threeButtons();
  EXPECT_EQ(movedFocus(page, {window::Device::Keyboard, window::kKeyRight, 0, 0, 0}), 0);
  EXPECT_EQ(movedFocus(page, {window::Device::Gamepad, window::kPadLeft, 0, 0, 0}), 2);
  page.focus = 2;
  EXPECT_EQ(movedFocus(page, {window::Device::Keyboard, window::kKeyRight, 0, 0, 0}), 2)
      << "no way round the end";
  page.focus = 1;
  EXPECT_EQ(movedFocus(page, {window::Device::Keyboard, 'x', 0, 0, 0}), 1);
  EXPECT_EQ(pressedButton(page, {window::Device::Keyboard, window::kKeyEnter, 0, 0, 0}, {}), 11);
  EXPECT_EQ(pressedButton(page, {window::Device::Gamepad, window::kPadAccept, 0, 0, 0}, {}), 11);
}

}  // namespace
}  // namespace limen::study
