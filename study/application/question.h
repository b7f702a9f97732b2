// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/application/page_screen.h"
#include "study/protocol/protocol.h"
#include "study/session/front_end.h"

namespace limen::study {

/// What changes from participant to participant or from language to language.
struct AskedHow {
  bool mirrored = false;  ///< Design::answersMirrored
  const Words& words = Words::english();
};

/// The buttons of a task's answers from left to right, their ids indices of TaskSetting::answers. Keys follow
/// the sides:
///   - two answers: left and right arrow, 1 and 2; for YesNo also the first letters of its words (y, n) if
///   they differ; directional pad left and right on a gamepad;
///   - more: digits from 1 (0 is the tenth), or arrows and Enter, directional pad and the lower face button.
std::vector<PageButton> answerButtons(const TaskSetting& task, const AskedHow& how = {});
std::vector<PageButton> scaleButtons(const Scale& scale);

/// What is stored of an input before the question: "mouse", the name of a key that answers, "other" for any
/// other key: those may spell what nobody is to know.
std::string earlyKeyName(const TaskSetting& task, const window::Input& input);

/// Columns in which alternatives, and therefore their buttons, are arranged on screen.
int answerColumns(const TaskSetting& task);

/// Whether the severity is asked after this answer.
bool asksSeverity(const TaskSetting& task, int answer);

/// The task's question, or a generic one if the protocol has none.
std::string questionOf(const TaskSetting& task, const Words& words = Words::english());

/// How a task is answered, in a sentence for the instructions.
std::string answerHelp(const TaskSetting& task, const AskedHow& how = {});

/// The questions after a stimulus: the answer, then severity and confidence if requested. There is no going
/// back.
class QuestionScreen : public PageScreen {
 public:
  QuestionScreen(const TaskSetting& task, int64_t stimulusEndNs, const AskedHow& how = {});
  std::string name() const override;
  /// Once done(). Reaction times of severity and confidence are in `extra`.
  Answer answer() const { return answer_; }
  /// Whether the answer proper has taken longer than `timeoutS` (0: no limit).
  bool timedOut(int64_t nowNs, double timeoutS) const;
  bool ignoresRestingPointer() const override { return true; }

 protected:
  Page build(int64_t nowNs) const override;
  void pressed(int id, const window::Input& input) override;

 private:
  enum class Step { Answer, Severity, Confidence };
  void next();
  const TaskSetting& task_;
  AskedHow how_;
  int64_t stimulusEndNs_;
  Step step_ = Step::Answer;
  int choice_ = 0;
  Answer answer_;
};

}  // namespace limen::study
