// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/screens.h"

#include <cmath>

namespace limen::study {
namespace {

enum ButtonId { kGoOn = 100, kBack, kAgree, kDecline, kStop, kLater, kEnd };

PageButton backButton(int id, const Words& words, const std::string& label) {
  return {id, label, words["key_backspace"], "B", {window::kKeyBackspace, window::kPadBack}, true};
}

void addTextTurning(Page& page, const Words& words, bool first) {
  if (!first) page.buttons.push_back(backButton(kBack, words, words["previous_page"]));
  page.buttons.push_back(continueButton(kGoOn, words, words["next_page"]));
}

std::string paragraphs(const std::string& first, const std::string& second) {
  return first.empty() || second.empty() ? first + second : first + "\n\n" + second;
}

}  // namespace

Page TextScreen::build(int64_t nowNs) const {
  Page page;
  page.title = setting_.title;
  page.text = setting_.text;
  page.progress = setting_.progress;
  page.footer = setting_.footer;
  page.reserved = {backButton(kBack, words_, words_["previous_page"]),
                   continueButton(kGoOn, words_, setting_.button)};
  if (!onLastTextPage()) {
    addTextTurning(page, words_, textPage() == 0);
    return page;
  }
  if (textPage() > 0) page.buttons.push_back(backButton(kBack, words_, words_["previous_page"]));
  page.buttons.push_back(continueButton(kGoOn, words_, setting_.button));
  const int64_t since = firstShownNs() ? nowNs - *firstShownNs() : 0;
  const double leftS = setting_.atLeastS - static_cast<double>(since) * 1e-9;
  if (leftS > 0) {
    page.buttons.back().enabled = false;
    page.status =
        words_.filled("wait_seconds", {{"seconds", std::to_string(static_cast<int>(std::ceil(leftS)))}});
  }
  return page;
}

void TextScreen::pressed(int id, const window::Input&) {
  if (id == kBack)
    turnTextPage(-1);
  else if (!onLastTextPage())
    turnTextPage(1);
  else
    finish();
}

Page ConsentScreen::build(int64_t) const {
  Page page;
  if (declining_) {
    page.title = words_["declined_title"];
    page.text = words_["declined_text"];
    page.buttons = {backButton(kBack, words_, words_["go_back"]),
                    {kDecline, words_["declined_end"], "E", "Start", {'e', window::kPadStart}, true}};
    return page;
  }
  page.title = words_["consent_title"];
  page.text = text_;
  page.reserved = {
      backButton(kBack, words_, words_["previous_page"]),
      {kDecline, words_["consent_decline"], "N", words_["pad_left"], {'n', window::kPadLeft}, true},
      {kAgree, words_["consent_agree"], "Y", words_["pad_right"], {'y', window::kPadRight}, true}};
  if (!onLastTextPage())
    addTextTurning(page, words_, textPage() == 0);
  else
    page.buttons.assign(page.reserved.begin() + (textPage() > 0 ? 0 : 1), page.reserved.end());
  return page;
}

void ConsentScreen::pressed(int id, const window::Input&) {
  if (declining_) {
    if (id == kDecline) return finish();
    declining_ = false;
    return turn();
  }
  if (id == kAgree) {
    agreed_ = true;
    return finish();
  }
  if (id == kDecline) {
    declining_ = true;
    return turn();
  }
  turnTextPage(id == kBack ? -1 : 1);
}

Page FormScreen::build(int64_t) const {
  Page page;
  page.title = words_["form_title"];
  const std::string& promise = words_["form_promise"];
  if (fields_.empty() || reviewing()) {
    page.text = fields_.empty() ? promise : words_["form_review"];
    for (size_t i = 0; i < chosen_.size(); ++i)
      page.text += "\n\n" + fields_[i].label + "  " + fields_[i].choices[chosen_[i]];
    if (!fields_.empty()) page.buttons.push_back(backButton(kBack, words_, words_["form_again"]));
    page.buttons.push_back(
        continueButton(kGoOn, words_, fields_.empty() ? std::string() : words_["form_accept"]));
    return page;
  }
  const FormField& field = fields_[chosen_.size()];
  if (chosen_.empty()) page.text = promise;
  page.question = field.label;
  page.footer = words_.filled("form_progress", {{"number", std::to_string(chosen_.size() + 1)},
                                                {"count", std::to_string(fields_.size())}});
  for (size_t i = 0; i < field.choices.size(); ++i) {
    PageButton button{static_cast<int>(i), field.choices[i], "", "", {}, true};
    if (i < 9) {
      button.hint = std::to_string(i + 1);
      button.keys = {'1' + static_cast<int>(i)};
    }
    page.buttons.push_back(button);
  }
  return page;
}

void FormScreen::pressed(int id, const window::Input&) {
  if (id == kGoOn) return finish();
  if (id == kBack)
    chosen_.clear();
  else
    chosen_.push_back(static_cast<size_t>(id));
  turn();
}

nlohmann::json FormScreen::answers() const {
  nlohmann::json answers = nlohmann::json::object();
  for (size_t i = 0; i < chosen_.size(); ++i) answers[fields_[i].name] = fields_[i].choices[chosen_[i]];
  return answers;
}

Page PauseScreen::build(int64_t) const {
  Page page;
  if (stopping_) {
    page.title = words_["stop_title"];
    page.text = words_["stop_text"];
    page.buttons = {continueButton(kGoOn, words_, words_["stop_continue"]),
                    {kLater, words_["stop_later"], "L", words_["pad_left"], {'l', window::kPadLeft}, true},
                    {kEnd, words_["stop_end"], "E", words_["pad_right"], {'e', window::kPadRight}, true}};
    return page;
  }
  page.title = words_["pause_title"];
  page.text = paragraphs(reason_, text_.empty() ? words_["pause_text"] : text_);
  page.buttons = {{kStop, words_["pause_stop"], "S", "B", {'s', window::kPadBack}, true},
                  continueButton(kGoOn, words_)};
  return page;
}

void PauseScreen::pressed(int id, const window::Input&) {
  if (id == kStop) {
    stopping_ = true;
    return turn();
  }
  choice_ = id == kLater ? Choice::StopForNow : id == kEnd ? Choice::End : Choice::Continue;
  finish();
}

}  // namespace limen::study
