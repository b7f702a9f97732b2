// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page_screen.h"

#include <algorithm>

namespace limen::study {

PageScreen::~PageScreen() = default;

Page PageScreen::page(int64_t nowNs) const {
  Page page = build(nowNs);
  page.focus = focus_;
  page.textPages = textPages_;
  return page;
}

void PageScreen::setTextPages(int count) {
  textPages_.count = std::max(count, 1);
  textPages_.index = std::min(textPages_.index, textPages_.count - 1);
}

void PageScreen::shown(int64_t nowNs) {
  if (!shownNs_) shownNs_ = nowNs;
  if (!firstShownNs_) firstShownNs_ = nowNs;
}

void PageScreen::take(const window::Input& input, const std::vector<TargetRect>& targets) {
  if (done_ || !shownNs_ || input.timeNs < *shownNs_) return;
  const Page now = page(input.timeNs);
  if (const std::optional<int> id = pressedButton(now, input, targets))
    pressed(*id, input);
  else
    focus_ = movedFocus(now, input);
}

void PageScreen::turn() {
  shownNs_.reset();
  textPages_ = {};
  focus_ = -1;
  ++turns_;
}

void PageScreen::turnTextPage(int step) {
  const TextPages pages{std::clamp(textPages_.index + step, 0, textPages_.count - 1), textPages_.count};
  turn();
  textPages_ = pages;
}

PageButton continueButton(int id, const Words& words, const std::string& label) {
  return {id,
          label.empty() ? words["continue"] : label,
          words["key_space"],
          "A",
          {window::kKeySpace, window::kKeyEnter, window::kPadAccept, window::kPadStart},
          true};
}

}  // namespace limen::study
