// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/catalogue.h"
#include "experiments/base/enum_names.h"
#include "experiments/base/yaml_tree.h"
#include "study/protocol/words.h"

namespace limen {
class FileFinder;
}

namespace limen::study {

enum class Task {
  YesNo,        ///< one sequence; "yes" or "no", then a severity if asked for
  Interval,     ///< m intervals one after the other, one of which has the change: 2IFC, m-IFC
  Alternative,  ///< m pictures side by side (or in a grid), one of which has the change: 2AFC, m-AFC
  Rating,       ///< one sequence, a step of a scale
  Pairwise      ///< two items side by side, or one after the other; which is better (or more of something)
};
constexpr EnumNames<Task, 5> enumNames(Task) {
  return {{{{Task::YesNo, "yes_no"},
            {Task::Interval, "interval"},
            {Task::Alternative, "alternative"},
            {Task::Rating, "rating"},
            {Task::Pairwise, "pairwise"}}}};
}

/// A scale of named steps, 1 the least.
struct Scale {
  std::string question;
  std::vector<std::string> labels;
};

/// Which answer stands on the left. Only YesNo: other answers are places, times or steps.
enum class AnswerSides {
  Counterbalanced,  ///< as written for one half of the participants, reversed for the other
  AsWritten,
  Reversed
};
constexpr EnumNames<AnswerSides, 3> enumNames(AnswerSides) {
  return {{{{AnswerSides::Counterbalanced, "counterbalanced"},
            {AnswerSides::AsWritten, "as_written"},
            {AnswerSides::Reversed, "reversed"}}}};
}

struct TaskSetting {
  Task type = Task::YesNo;
  int alternatives = 2;    ///< Interval and Alternative
  bool sideBySide = true;  ///< Pairwise only
  std::string question;
  /// Words of the answers in their order: YesNo {yes, no}, Interval {first, second}, Alternative and Pairwise
  /// {left, right}, Rating the scale's labels.
  std::vector<std::string> answers;
  /// What stands on the buttons: `answers`, or where the protocol gives none their translation.
  std::vector<std::string> labels;
  AnswerSides answerSides = AnswerSides::Counterbalanced;  ///< YesNo only
  std::optional<Scale> severity;  ///< asked after "yes" (or after every answer with severityAlways)
  bool severityAlways = false;
  std::optional<Scale> confidence;  ///< asked after every answer
};

/// A value that a stimulus's parameter takes from a trial's variables: a constant, or an expression
/// ("= distance + 2.25 * speed": + - * / and brackets over numbers and names; a name alone may hold anything,
/// a text or a whole entry {name: ...}).
struct Expression {
  nlohmann::json constant;  ///< if `text` is empty
  std::string text;
  Mark mark;
};
using Variables = std::map<std::string, nlohmann::json>;

/// Value of an expression. Throws Error naming an unknown variable, a text in arithmetic, a division by 0.
nlohmann::json evaluate(const Expression& expression, const Variables& variables, const std::string& file);

/// A factor's level: its name and the variables that it sets (at least one with the factor's own name).
struct FactorLevel {
  std::string name;
  Variables variables;
};
struct Factor {
  std::string name;
  std::vector<FactorLevel> levels;
};

/// A stimulus with expressions in it: {"scene": {"name": ..., "distance": Expression}, ...}, stored as the
/// file's tree so that messages name lines.
struct StimulusTemplate {
  YamlNode node;
};

/// How an adaptive part finds its stimuli: settings of one procedure (see procedures/procedure.h),
/// instantiated for each condition. Each stimulus axis sets the variable of its name.
struct ProcedureSetting {
  nlohmann::json settings;
  Mark mark;
};

enum class OrderKind {
  Fixed,    ///< as written
  Shuffle,  ///< seeded by session
  Latin,    ///< row of a balanced Latin square by participant number
  Williams  ///< row of a Williams design (first-order carry-over balanced) by participant number
};
constexpr EnumNames<OrderKind, 4> enumNames(OrderKind) {
  return {{{{OrderKind::Fixed, "fixed"},
            {OrderKind::Shuffle, "shuffle"},
            {OrderKind::Latin, "latin"},
            {OrderKind::Williams, "williams"}}}};
}

struct OrderSetting {
  OrderKind kind = OrderKind::Shuffle;
  /// Shuffle only: at most this many trials in a row that agree in a factor, or in "change"; 0 no limit.
  std::map<std::string, int> atMostInARow;
};

struct Practice {
  int trials = 0;  ///< drawn evenly from the part's conditions; 0: no practice
  bool feedback = true;
  /// Passed with at least `correct` correct answers in a round; otherwise another round, at most `rounds`,
  /// after which the session stops ("stop") or continues with a note ("continue").
  int correct = 0, rounds = 3;
  bool stopOnFailure = false;
  /// Adaptive parts only, which have no stimuli of their own before the first answer: values of the
  /// procedure's axes, used in turn.
  std::vector<Variables> stimuli;
};

struct Part {
  std::string name;
  TaskSetting task;
  StimulusTemplate stimulus;
  Variables variables;  ///< constants of this part, `refresh_hz` of the protocol's display among them
  std::vector<Factor> factors;
  int changeRepetitions = 1,
      catchRepetitions = 0;                   ///< of every condition; for a procedure: catch trials of all
  std::optional<ProcedureSetting> procedure;  ///< replaces changeRepetitions
  std::string blockBy;                        ///< name of the factor whose levels are blocks; "" one block
  std::vector<std::string> blockLevels;       ///< the levels of blockBy, in written order or as listed
  OrderSetting blockOrder, trialOrder;
  Practice practice;
  int breakEveryTrials = 0;  ///< 0: only between blocks
  /// Pairwise only: the factor whose levels are compared; every pair once in each order and repetition, the
  /// other factors are conditions.
  std::string items;
};

struct Timing {
  double fixationS = 0.5, afterFixationS = 0.0, intervalGapS = 0.5, betweenTrialsS = 0.5;
  double answerTimeoutS = 0.0;  ///< 0: no limit
  double breakAtLeastS = 0.0;
};

struct WindowSetting {
  int widthPx = 1024, heightPx = 768;  ///< of the stimulus, in the middle of the screen
  double background = 0.05;            ///< linear light, 1 the display's white
};

enum class ResumePolicy { Resume, RestartBlock, Refuse };
constexpr EnumNames<ResumePolicy, 3> enumNames(ResumePolicy) {
  return {{{{ResumePolicy::Resume, "resume"},
            {ResumePolicy::RestartBlock, "restart_block"},
            {ResumePolicy::Refuse, "refuse"}}}};
}
struct SessionSetting {
  ResumePolicy resume = ResumePolicy::Resume;
  double maximumAgeH = 24.0;    ///< of the last event; an older session is not resumed
  int repeatInvalidAtMost = 3;  ///< a trial whose frames were late is repeated at most this often
};

/// A rule by which the analysis excludes data, applied by name.
struct Exclusion {
  std::string
      rule;  ///< "catch_rate_above", "lapse_above", "reaction_time_below_s", "reaction_time_above_s", ...
  double value = 0.0;
};

/// What is told to a recorder (EEG, eye tracker) while a trial runs.
enum class MarkerKind {
  Stimulus,     ///< first frame of a stimulus, at each of its showings
  Change,       ///< first frame after the change
  StimulusEnd,  ///< the first frame without it
  Question,     ///< on screen
  Answer        ///< given
};
constexpr EnumNames<MarkerKind, 5> enumNames(MarkerKind) {
  return {{{{MarkerKind::Stimulus, "stimulus"},
            {MarkerKind::Change, "change"},
            {MarkerKind::StimulusEnd, "stimulus_end"},
            {MarkerKind::Question, "question"},
            {MarkerKind::Answer, "answer"}}}};
}
/// Bytes, indexed by kind; 0: not sent.
using MarkerCodes = std::array<int, 5>;

struct Texts {
  std::string consent, instructions, practice, pause, debrief;
};

/// What the form asks about a participant: nothing that identifies a person.
struct FormField {
  std::string name, label;
  std::vector<std::string> choices;  ///< e.g. age bins, vision
};

/// A study as its author wrote it, checked: every condition of every part resolves to a stimulus.
struct Protocol {
  std::string path, text, hash;  ///< hash: SHA-256 of the text
  std::string name;              ///< file name without ending
  std::string title, question, source;
  std::vector<std::string> features;
  std::string display;  ///< preset or profile file for which it was made
  WindowSetting window;
  std::vector<Part> parts;
  OrderSetting partOrder;
  Timing timing;
  SessionSetting session;
  Texts texts;
  std::vector<FormField> form;
  std::vector<Exclusion> exclusions;
  MarkerCodes markers = {1, 2, 3, 4, 5};
  Words words = Words::english();  ///< of the interface
  std::string font;                ///< path of a font file for characters that the usual fonts lack; "": none
  nlohmann::json simulation;       ///< how simulated observers respond to its conditions (see observers/)
  std::map<std::string, std::string> fileHashes;  ///< path of each file that a stimulus names -> SHA-256
  /// The catalogue that its stimuli were checked against and are made with.
  std::shared_ptr<const Catalogue> catalogue;
  std::shared_ptr<const FileFinder> files;
};

/// Reads and checks. Throws one Error with a line "file:line:column: what; what is allowed" per problem.
/// `nameOrPath`: a file, or the name of a shipped protocol.
Protocol readProtocol(const std::string& nameOrPath, std::shared_ptr<const Catalogue> catalogue);
Protocol parseProtocol(const std::string& text, const std::string& path,
                       std::shared_ptr<const Catalogue> catalogue);
/// Names of the protocols in study/protocols, with their titles.
std::vector<std::pair<std::string, std::string>> shippedProtocols();

}  // namespace limen::study
