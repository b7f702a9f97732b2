// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "study/application/page_screen.h"
#include "study/protocol/protocol.h"

namespace limen::study {

/// A text to read, left with one button.
class TextScreen : public PageScreen {
 public:
  struct Setting {
    std::string name, title, text;
    std::string button;      ///< "": that to continue
    double atLeastS = 0.0;   ///< counted from when it was first shown
    double progress = -1.0;  ///< see Page
    std::string footer;
  };
  explicit TextScreen(Setting setting, const Words& words = Words::english())
      : setting_(std::move(setting)), words_(words) {}
  std::string name() const override { return setting_.name; }

 protected:
  Page build(int64_t nowNs) const override;
  void pressed(int id, const window::Input& input) override;

 private:
  Setting setting_;
  const Words& words_;
};

/// Must be read to the end and agreed to; declining asks for confirmation once.
class ConsentScreen : public PageScreen {
 public:
  explicit ConsentScreen(std::string text, const Words& words = Words::english())
      : text_(std::move(text)), words_(words) {}
  std::string name() const override { return declining_ ? "consent_declined" : "consent"; }
  bool agreed() const { return agreed_; }

 protected:
  Page build(int64_t nowNs) const override;
  void pressed(int id, const window::Input& input) override;

 private:
  std::string text_;
  const Words& words_;
  bool declining_ = false, agreed_ = false;
};

/// Asks one multiple-choice question after another and shows all choices before they are accepted.
class FormScreen : public PageScreen {
 public:
  explicit FormScreen(std::vector<FormField> fields, const Words& words = Words::english())
      : fields_(std::move(fields)), words_(words) {}
  bool ignoresRestingPointer() const override { return !reviewing(); }
  std::string name() const override { return reviewing() ? "form_review" : "form"; }
  /// Field -> choice.
  nlohmann::json answers() const;

 protected:
  Page build(int64_t nowNs) const override;
  void pressed(int id, const window::Input& input) override;

 private:
  bool reviewing() const { return chosen_.size() == fields_.size(); }
  std::vector<FormField> fields_;
  const Words& words_;
  std::vector<size_t> chosen_;
};

/// The session is paused: continue, or stop after confirmation.
class PauseScreen : public PageScreen {
 public:
  enum class Choice { Continue, StopForNow, End };
  explicit PauseScreen(std::string text, std::string reason = {}, const Words& words = Words::english())
      : text_(std::move(text)), reason_(std::move(reason)), words_(words) {}
  std::string name() const override { return stopping_ ? "pause_stop" : "pause"; }
  Choice choice() const { return choice_; }

 protected:
  Page build(int64_t nowNs) const override;
  void pressed(int id, const window::Input& input) override;

 private:
  std::string text_, reason_;
  const Words& words_;
  bool stopping_ = false;
  Choice choice_ = Choice::Continue;
};

}  // namespace limen::study
