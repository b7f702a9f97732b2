// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/study/protocol/example.h"

namespace limen::study {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Mistake {
  std::string part;      ///< keys of the part, from line 1
  std::string expected;  ///< how the message begins
};

const std::string kTwo = "factors: {distance: [1, 2], kind: [wood, stone]}\n";
const std::string kStaircase =
    "procedure: {type: staircase, stimulus: {name: x, start: 10, minimum: 1, maximum: 40}, steps: 1, "
    "stop: {trials: 20}}\n";
const std::string kPairs = "task: {type: pairwise, question: q}\n";
const std::string kShown = "stimulus: {scene: {name: box}, before: {name: exact}}\n";

// The part's text goes before the rest of the protocol; kYesNo is one line, kBox three.
std::vector<Mistake> mistakes() {
  return {
      {kYesNo + kBox + "trails: {change: 3}\n",
       "5:1: unknown key 'trails' of protocol; did you mean 'trials'?"},
      {kBox, "1:1: 'task' is missing; give it: {type: yes_no"},
      {kYesNo, "1:1: 'stimulus' is missing"},
      {"task: {type: yesno, question: q}\n" + kBox, "1:14: 'type' is yesno; did you mean 'yes_no'?"},
      {"task: {type: yes_no}\n" + kBox, "1:7: 'question' is missing"},
      {"task: {question: q}\n" + kBox, "1:7: 'type' of task is missing; one of yes_no, interval"},
      {"task: {type: yes_no, question: q, alternatives: 3}\n" + kBox,
       "1:35: unknown key 'alternatives' of task 'yes_no'"},
      {"task: {type: yes_no, question: q, answers: [yes, no, maybe]}\n" + kBox,
       "1:44: 3 answers to a task 'yes_no'; give 2"},
      {"task: {type: yes_no, question: q, severity: {question: s, labels: [low]}}\n" + kBox,
       "1:67: a scale of one step"},
      {kYesNo + "stimulus: {scene: {name: bax}, levels: {before: 1, after: 0}}\n",
       "2:26: no scene 'bax'; did you mean 'box'?"},
      {kYesNo + "stimulus: {scene: {name: box, distanc: 3}, levels: {before: 1, after: 0}}\n",
       "2:31: scene 'box' has no parameter 'distanc'; did you mean 'distance'?"},
      {kYesNo + "stimulus: {scene: {name: box, distance: 60}, levels: {before: 1, after: 0}}\n", "2:41: "},
      {kYesNo + "stimulus: {scene: {name: box, distance: [1, 2]}, levels: {before: 1, after: 0}}\n",
       "2:41: 'distance' of scene 'box' is a list; a stimulus has a single value; several values are levels "
       "of a factor"},
      {kYesNo + "stimulus: {scene: {name: box, distance: = 3 * sped}, levels: {before: 1, after: "
                "0}}\nvariables: {speed: 2}\n",
       "2:41: no variable 'sped'; did you mean 'speed'?"},
      {kYesNo + "stimulus: {scene: {name: box, distance: = 30 * speed}, levels: {before: 1, after: "
                "0}}\nvariables: {speed: 2}\n",
       "2:41: 'distance' becomes '60' by '= 30 * speed' with speed = 2; allowed: number from 0.5 to 50"},
      {kYesNo + "stimulus: {scene: {name: box, tile: = speed / 4}, levels: {before: 1, after: "
                "0}}\nvariables: {speed: 2}\n",
       "2:37: 'tile' becomes '0.5' by '= speed / 4' with speed = 2; allowed: whole number from 0 to 63"},
      {kYesNo + "stimulus: {scene: {name: box, distance: = 1 / (speed - 2)}, levels: {before: 1, after: "
                "0}}\nvariables: {speed: 2}\n",
       "2:41: "},
      {kYesNo + "stimulus: {scene: {name: box}}\n", "2:11: the stimulus does not say what it shows"},
      {kYesNo + "stimulus: {scene: {name: box}, before: {name: exact}}\n",
       "2:11: nothing changes in the stimuli of a task 'yes_no'"},
      {kYesNo + "stimulus: {scene: {name: box}, levels: {before: 1, after: 0}, before: {name: exact}}\n",
       "2:40: a stimulus has 'levels' and a technique"},
      {kYesNo + "stimulus: {scene: {name: box}, levels: {before: 1}}\n",
       "2:40: 'after' of levels is missing"},
      {kYesNo + "stimulus: {scene: {name: box}, levels: {before: 1, after: 1}}\n",
       "2:40: level 1 changes to level 1"},
      {kYesNo + "stimulus: {levels: {before: 1, after: 0}}\n", "2:11: 'scene' of a stimulus is missing"},
      {kYesNo + "stimulus: {scene: {name: model}, levels: {before: 1, after: 0}}\n",
       "2:19: 'file' of scene 'model' is missing"},
      {kYesNo + "stimulus: {scene: {name: model, file: none.obj}, levels: {before: 1, after: 0}}\n",
       "2:39: no file 'none.obj'"},
      {kYesNo + kBox + "  duration_s: 2\n  change_at_s: 2\n", "6:16: the change comes at 2 s of 2 s"},
      {kYesNo + kBox + "  cue: {kind: arrow, duration_s: 1, y_px: 3}\n", "5:8: 'x_px' of cue is missing"},
      {kYesNo + kBox + "  before_change: 2\n", "5:3: unknown key 'before_change' of stimulus"},
      {kYesNo + kShown + "", "2:11: nothing changes"},
      {kYesNo + "stimulus: {scene: {name: box}, before: {name: exact}, after: {name: fast}, shading: "
                "{ambient: 1}}\n",
       "2:85: 'shading' is without 'levels'"},
      {kYesNo + kBox + "factors: {distance: 4}\n", "5:21: factor 'distance' is '4'; write it as a list"},
      {kYesNo + kBox + "factors: {distance: [4, 6, 4]}\n", "5:28: factor 'distance' has level '4' twice"},
      {kYesNo + kBox + "factors: {change: [4, 6]}\n", "5:11: a factor is named 'change'"},
      {kYesNo + kBox + "factors: {lod-change: [4, 6]}\n", "5:11: 'lod-change' is not a name for a factor"},
      {kYesNo + kBox + "factors: {pair: {a: {x: 1}, b: {}}}\n",
       "5:29: level 'b' of factor 'pair' sets no 'x'"},
      {kYesNo + kBox + "factors: {pair: {a: {x: 1}, b: {x: 1, y: 2}}}\n",
       "5:29: level 'b' of factor 'pair' sets 'y', which 'a' does not"},
      {kYesNo + kBox + "factors: {pair: [1, = 2]}\n", "5:21: a level of factor 'pair' is an expression"},
      {kYesNo + kBox + kTwo + "variables: {distance: 3}\n",
       "1:1: variable 'distance' is set by 'variables' and by factor 'distance'"},
      {kYesNo + kBox + "variables: {refresh_hz: 3}\n",
       "1:1: variable 'refresh_hz' is set by the display and by 'variables'"},
      {kYesNo + kBox + kTwo + "blocks: {by: distanze}\n",
       "6:14: no factor 'distanze' to make blocks of; did you mean 'distance'?"},
      {kYesNo + kBox + kTwo + "blocks: {by: distance, order: [1]}\n",
       "6:31: level '2' is missing in the order of blocks"},
      {kYesNo + kBox + kTwo + "blocks: {by: distance, order: [1, 2, 3]}\n",
       "6:31: factor 'distance' has no level '3'"},
      {kYesNo + kBox + kTwo + "order: random\n", "6:8: 'order' is random; allowed: one of fixed, shuffle"},
      {kYesNo + kBox + kTwo + "order: {kind: fixed, at_most_in_a_row: {change: 2}}\n",
       "6:40: 'at_most_in_a_row' is used with the order 'fixed'"},
      {kYesNo + kBox + kTwo + "order: {at_most_in_a_row: {distanz: 2}}\n",
       "6:28: unknown key 'distanz' of at_most_in_a_row"},
      {kYesNo + kBox + kTwo + "trials: {change: 3}\norder: {at_most_in_a_row: {change: 2}}\n",
       "7:8: no order of the 12 trials of block 'main' keeps 'at_most_in_a_row'"},
      {kYesNo + kBox + kTwo + "trials: {change: 0}\n", "6:18: "},
      {"task: {type: interval, question: q}\n" + kBox + "trials: {catch: 1}\n",
       "5:17: catch trials of a task 'interval'"},
      {kYesNo + kBox + "items: distance\n", "5:8: 'items' in a part with task 'yes_no'"},
      {kPairs + kShown, "1:1: 'items' is missing"},
      {kPairs + kShown + kTwo + "items: kinds\n", "4:8: no factor 'kinds'; did you mean 'kind'?"},
      {kPairs + kShown + kTwo + "items: kind\n" + kStaircase,
       "5:12: a 'procedure' in a part that compares pairs"},
      {kYesNo + kBox + "procedure: {type: quest_pluss}\n", "5:19: procedure.type"},
      {kYesNo + kBox +
           "procedure: {type: staircase, stimulus: {name: x, start: 10}, steps: 1, stop: {trials: 20}}\n",
       "5:12: the procedure may request any 'x'; give its stimulus a minimum and a maximum"},
      {kYesNo + kBox +
           "procedure: {type: staircase, stimulus: {name: x, start: 10, minimum: 1, maximum: 40}, steps: 1, "
           "stop: {reversals: 20}}\n",
       "5:12: the procedure may never end"},
      {kYesNo + kBox + kStaircase + "trials: {change: 3}\n", "6:10: unknown key 'change' of trials"},
      {kYesNo + kBox + kStaircase + "practice: {trials: 3}\n", "6:11: 'stimuli' of practice is missing"},
      {kYesNo + kBox + kStaircase + "practice: {trials: 3, stimuli: [{}]}\n", "6:33: 'x' is missing"},
      {"task: {type: rating, question: q}\n" + kBox + kStaircase,
       "5:12: the procedure has 2 outcomes, the task 5"},
      {kYesNo + "stimulus: {scene: {name: box, distance: = 2 * x}, levels: {before: 1, after: 0}}\n" +
           kStaircase,
       "2:41: 'distance' becomes '80' by '= 2 * x' with x = 40"},
      {kYesNo + kBox + "practice: {trials: 3, correct: 4}\n", "5:11: 4 correct answers in 3 trials"},
      {"task: {type: rating, question: q}\n" + kBox + "practice: {trials: 3, correct: 2}\n",
       "5:11: 'correct' or 'feedback'"},
      {kYesNo + kBox + kTwo + "trials: {change: 10000}\n",
       "1:1: part 'main' has 4 conditions and 40000 trials; keep to 20000 trials"},
  };
}

TEST(Mistakes, EachGivesOneMessageAtItsPlace) {
  for (const Mistake& mistake : mistakes()) {
    const std::string message = refusal(protocolText(mistake.part));
    EXPECT_THAT(message, StartsWith("test.yaml:" + mistake.expected)) << mistake.part;
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  }
}

const std::string kGood = kYesNo + kBox;
std::string with(const std::string& top) { return kGood + "title: t\nquestion: q\n" + top; }
const std::string kDisplay = "display: schwarz_2009\n";
const std::string kTexts = "texts: {consent: c, instructions: i}\n";

TEST(Mistakes, OutsideOfThePartsToo) {
  const std::pair<std::string, std::string> kCases[] = {
      {"", "is empty"},
      {"[1, 2]", "a protocol is a map"},
      {with(kDisplay), "1:1: 'texts' is missing"},
      {with(kDisplay + "texts: {consent: c}\n"), "8:8: 'instructions' is missing"},
      {with(kTexts), "1:1: 'display' is missing"},
      {with("display: schwarz_2010\n" + kTexts), "7:10: "},
      {with(kDisplay + kTexts + "window: {width_px: 2000}\n"),
       "9:9: a window of 2000 x 768 px on display 'schwarz_2009'"},
      {with(kDisplay + kTexts + "timing: {fixation: 1}\n"),
       "9:10: unknown key 'fixation' of timing; did you mean 'fixation_s'?"},
      {with(kDisplay + kTexts + "timing: {fixation_s: -1}\n"), "9:22: "},
      {with(kDisplay + kTexts + "session: {resume: never}\n"),
       "9:19: 'resume' is never; allowed: one of resume"},
      {with(kDisplay + kTexts + "exclusions: {catch_rate_abve: 0.3}\n"),
       "9:14: unknown key 'catch_rate_abve' of exclusions"},
      {with(kDisplay + kTexts + "exclusions: {catch_rate_above: 3}\n"), "9:32: "},
      {with(kDisplay + kTexts + "form: [{name: name, label: Your name}]\n"),
       "9:8: field 'name' leaves no choice"},
      {with(kDisplay + kTexts + "part_order: {at_most_in_a_row: {change: 1}}\n"),
       "9:32: 'at_most_in_a_row' of 'part_order'"},
      {with(kDisplay + kTexts + "parts: []\n"), "'parts'"},
      {with(kDisplay + kTexts + "simulation: 3\n"), "9:13: 'simulation' is '3'"},
      {with(kDisplay + kTexts + "title: again\n"), "9:1: "}};
  for (const auto& [text, expected] : kCases) EXPECT_THAT(refusal(text), HasSubstr(expected)) << text;
}

TEST(Mistakes, PartsHaveDifferentNames) {
  const std::string part =
      "    task: {type: yes_no, question: q}\n    stimulus: {scene: {name: box}, levels: {before: 1, after: "
      "0}}\n";
  EXPECT_EQ(refusal(protocolText("parts:\n  - name: a\n" + part + "  - name: b\n" + part)), "");
  EXPECT_THAT(refusal(protocolText("parts:\n  - name: a\n" + part + "  - name: a\n" + part)),
              HasSubstr("5:5: two parts are called 'a'"));
  EXPECT_THAT(refusal(protocolText("parts:\n  - name: a\n" + part + "trials: {change: 2}\n")),
              HasSubstr("5:1: unknown key 'trials' of protocol with 'parts'"));
}

TEST(Mistakes, AllAreSaidAtOnceInTheOrderOfTheFile) {
  const std::string message = refusal(protocolText(R"(task: {type: yes_no, question: "q", colour: red}
stimulus:
  scene: {name: box, distance: 70, kind: iron, size: 3}
  levels: {before: 1, after: 0}
trials: {change: 1.5}
practise: {trials: 3}
)"));
  std::vector<std::string> places;
  for (size_t at = 0; at != std::string::npos; at = message.find('\n', at + 1)) {
    const size_t begin = message.find("test.yaml:", at) + 10;
    places.push_back(message.substr(begin, message.find(": ", begin) - begin));
  }
  // What needs whole parts, the stimuli, is looked at when the parts are right.
  EXPECT_EQ(places, (std::vector<std::string>{"1:37", "5:18", "6:1"})) << message;
}

TEST(Mistakes, ALiteralMistakeIsSaidOnceHoweverManyConditions) {
  const std::string message = refusal(protocolText(kYesNo + kTwo + R"(stimulus:
  scene: {name: box, distance: 70, tile: = distance + 0.5}
  levels: {before: 1, after: 0}
)"));
  // distance once, tile by each of the two distances.
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
}

TEST(ProtocolMarkers, AreBytesThatDiffer) {
  const MarkerCodes given = {10, 2, 0, 0, 255};
  EXPECT_EQ(
      exampleProtocol(kYesNo + kBox + "markers: {stimulus: 10, stimulus_end: 0, question: 0, answer: 255}\n")
          .markers,
      given);
  EXPECT_THAT(refusal(protocolText(kYesNo + kBox + "markers: {stimulus: 2}\n")),
              testing::HasSubstr("'stimulus' and 'change' have the code 2"));
  EXPECT_THAT(refusal(protocolText(kYesNo + kBox + "markers: {stimulus: 256}\n")), testing::HasSubstr("255"));
  EXPECT_THAT(refusal(protocolText(kYesNo + kBox + "markers: {stimuli: 1}\n")),
              testing::HasSubstr("'stimulus'"));
}

}  // namespace
}  // namespace limen::study
