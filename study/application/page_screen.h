// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/application/page.h"
#include "study/protocol/words.h"

namespace limen::study {

/// Something shown until it is done: what it currently shows, and how inputs affect it. Independent of window
/// and clock; only input made while its current page was on screen counts, so that a key held or hit twice
/// never answers a page that nobody has seen.
class PageScreen {
 public:
  virtual ~PageScreen();
  /// Short name for announcements and file names: "consent", "question".
  virtual std::string name() const = 0;

  Page page(int64_t nowNs) const;
  /// Number of pages that the text needs on this screen; from the view.
  void setTextPages(int count);
  /// The page was put on screen.
  void shown(int64_t nowNs);
  /// Something else replaced it on screen; it has to be shown again.
  void hidden() { shownNs_.reset(); }
  /// The page has changed since it was last shown, or was never shown.
  bool isNew() const { return !shownNs_; }
  /// Counts page turns.
  int turns() const { return turns_; }
  void take(const window::Input& input, const std::vector<TargetRect>& targets);
  bool done() const { return done_; }
  /// Whether the pointer counts only once it has been moved: where it happened to rest would be a suggestion.
  virtual bool ignoresRestingPointer() const { return false; }

 protected:
  /// Everything but focus and text pages.
  virtual Page build(int64_t nowNs) const = 0;
  virtual void pressed(int id, const window::Input& input) = 0;
  /// Another page replaces the current one.
  void turn();
  void finish() { done_ = true; }
  std::optional<int64_t> shownNs() const { return shownNs_; }
  /// When the first of all pages was shown.
  std::optional<int64_t> firstShownNs() const { return firstShownNs_; }
  int textPage() const { return textPages_.index; }
  bool onLastTextPage() const { return textPages_.index + 1 >= textPages_.count; }
  void turnTextPage(int step);

 private:
  std::optional<int64_t> shownNs_, firstShownNs_;
  TextPages textPages_;
  int focus_ = -1, turns_ = 0;
  bool done_ = false;
};

/// "Continue", with the keys that people try first.
PageButton continueButton(int id, const Words& words, const std::string& label = {});

}  // namespace limen::study
