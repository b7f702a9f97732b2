// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/screens.h"

#include <cmath>

namespace limen::study {
namespace {

enum ButtonId { kGoOn = 100, kBack, kAgree, kDecline, kStop, kLater, kEnd };

PageButton backButton(int id, const std::string& label) {
  return {id, label, "Backspace", "B", {window::kKeyBackspace, window::kPadBack}, true};
}

void addTextTurning(Page& page, bool first) {
  if (!first) page.buttons.push_back(backButton(kBack, "Previous page"));
  page.buttons.push_back(continueButton(kGoOn, "Next page"));
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
  page.reserved = {backButton(kBack, "Previous page"), continueButton(kGoOn, setting_.button)};
  if (!onLastTextPage()) {
    addTextTurning(page, textPage() == 0);
    return page;
  }
  if (textPage() > 0) page.buttons.push_back(backButton(kBack, "Previous page"));
  page.buttons.push_back(continueButton(kGoOn, setting_.button));
  const int64_t since = firstShownNs() ? nowNs - *firstShownNs() : 0;
  const double leftS = setting_.atLeastS - static_cast<double>(since) * 1e-9;
  if (leftS > 0) {
    page.buttons.back().enabled = false;
    page.status = "You can continue in " + std::to_string(static_cast<int>(std::ceil(leftS))) + " s";
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
    page.title = "You do not agree";
    page.text = "Then the session ends here, and no answers are requested or kept. Thank you for your time.";
    page.buttons = {backButton(kBack, "Go back"),
                    {kDecline, "End the session", "E", "Start", {'e', window::kPadStart}, true}};
    return page;
  }
  page.title = "Taking part";
  page.text = text_;
  page.reserved = {backButton(kBack, "Previous page"),
                   {kDecline, "I do not agree", "N", "Left", {'n', window::kPadLeft}, true},
                   {kAgree, "I agree", "Y", "Right", {'y', window::kPadRight}, true}};
  if (!onLastTextPage())
    addTextTurning(page, textPage() == 0);
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
  page.title = "About you";
  const std::string promise = "Your name is not asked for, and nothing that names you is kept.";
  if (fields_.empty() || reviewing()) {
    page.text = fields_.empty() ? promise : "Is this right?";
    for (size_t i = 0; i < chosen_.size(); ++i)
      page.text += "\n\n" + fields_[i].label + "  " + fields_[i].choices[chosen_[i]];
    if (!fields_.empty()) page.buttons.push_back(backButton(kBack, "Choose again"));
    page.buttons.push_back(continueButton(kGoOn, fields_.empty() ? "Continue" : "Yes, continue"));
    return page;
  }
  const FormField& field = fields_[chosen_.size()];
  if (chosen_.empty()) page.text = promise;
  page.question = field.label;
  page.footer = "Question " + std::to_string(chosen_.size() + 1) + " of " + std::to_string(fields_.size());
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
    page.title = "Stop the session?";
    page.text =
        "All your answers so far are kept. The session can be resumed later where you left off, or "
        "be "
        "ended for good.";
    page.buttons = {continueButton(kGoOn, "No, continue"),
                    {kLater, "Stop, continue another time", "L", "Left", {'l', window::kPadLeft}, true},
                    {kEnd, "End for good", "E", "Right", {'e', window::kPadRight}, true}};
    return page;
  }
  page.title = "Pause";
  page.text =
      paragraphs(reason_, text_.empty() ? "Take your time. The last picture will be shown again." : text_);
  page.buttons = {{kStop, "Stop the session", "S", "B", {'s', window::kPadBack}, true},
                  continueButton(kGoOn)};
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
