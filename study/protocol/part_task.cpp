// SPDX-License-Identifier: BSD-3-Clause
// What a part asks.
#include <fmt/format.h>

#include "experiments/base/text.h"
#include "study/protocol/part_reader.h"

namespace limen::study {

std::optional<Scale> PartReader::readScale(const YamlNode& node, const std::string& key, bool always,
                                           Part& out) {
  if (!reader_.isMap(node, "'" + key + "'", "{question: ..., labels: [hardly, clearly]}")) return {};
  std::vector<std::string> keys = {"question", "labels"};
  if (always) keys.emplace_back("always");
  reader_.checkKeys(node, key, keys);
  Scale scale;
  reader_.takeText(node, "question", true, scale.question);
  if (const YamlNode* labels = node.find("labels")) {
    scale.labels = reader_.texts(*labels, "'labels' of " + key, "[hardly, clearly]");
    if (scale.labels.size() == 1)
      reader_.problems().add(labels->mark, "a scale of one step", "give two to eleven labels");
  } else {
    reader_.problems().add(node.mark, "'labels' of " + key + " is missing", "give it: [hardly, clearly]");
  }
  if (always) reader_.take(node, "always", out.task.severityAlways);
  return scale;
}

void PartReader::readAnswers(const YamlNode& map, Part& out) {
  TaskSetting& task = out.task;
  static const char* const kOrdinals[] = {"first", "second",  "third",  "fourth", "fifth",
                                          "sixth", "seventh", "eighth", "ninth"};
  const auto count = static_cast<size_t>(task.alternatives);
  if (task.type == Task::YesNo) {
    task.answers = {"yes", "no"};
  } else if (task.type == Task::Rating) {
    task.answers = {"bad", "poor", "fair", "good", "excellent"};  // ITU-R BT.500
  } else if (task.type == Task::Interval || (task.type == Task::Pairwise && !task.sideBySide)) {
    task.answers.assign(kOrdinals, kOrdinals + count);
  } else if (count == 2) {
    task.answers = {"left", "right"};
  } else {
    for (size_t i = 0; i < count; ++i) task.answers.push_back(std::to_string(i + 1));
  }
  for (const std::string& answer : task.answers)
    task.labels.push_back(words_.all().count(answer) ? words_[answer] : answer);
  const YamlNode* node = map.find("answers");
  if (!node) return;
  const size_t expected = task.answers.size();
  task.answers = reader_.texts(*node, "'answers'", "[yes, no]");
  const bool rating = task.type == Task::Rating;
  if (rating ? task.answers.size() < 2 || task.answers.size() > 11 : task.answers.size() != expected)
    reader_.problems().add(
        node->mark, fmt::format("{} answers to a task '{}'", task.answers.size(), limen::toText(task.type)),
        rating ? "a scale has two to eleven steps, the lowest first" : fmt::format("give {}", expected));
  task.labels = task.answers;
}

void PartReader::readTask(const YamlNode& map, Part& out) {
  const std::string example = "{type: yes_no, question: ...}";
  const YamlNode* node = map.find("task");
  if (!node) {
    reader_.problems().add(map.mark, "'task' is missing", "give it: " + example);
    return;
  }
  if (!reader_.isMap(*node, "'task'", example)) return;
  std::vector<std::string> keys = {"type", "question", "answers", "severity", "confidence"};
  if (!node->find("type"))
    reader_.problems().add(node->mark, "'type' of task is missing", "one of " + join(namesOf<Task>()));
  TaskSetting& task = out.task;
  task.type = Task::YesNo;
  reader_.take(*node, "type", task.type);
  const bool several = task.type == Task::Interval || task.type == Task::Alternative;
  if (several) keys.emplace_back("alternatives");
  if (task.type == Task::Pairwise) keys.emplace_back("layout");
  if (task.type == Task::YesNo) keys.emplace_back("answer_sides");
  reader_.checkKeys(*node, fmt::format("task '{}'", limen::toText(task.type)), keys);
  if (task.type == Task::YesNo) reader_.take(*node, "answer_sides", task.answerSides);
  if (several) reader_.take(*node, "alternatives", {2, 9}, "", task.alternatives);
  if (task.type == Task::Pairwise) {
    const YamlNode* layout = node->find("layout");
    task.sideBySide = !layout || reader_.choice(*layout, "layout", {"side_by_side", "one_after_the_other"}) !=
                                     "one_after_the_other";
  }
  reader_.takeText(*node, "question", true, task.question);
  readAnswers(*node, out);
  if (const YamlNode* severity = node->find("severity"))
    task.severity = readScale(*severity, "severity", true, out);
  if (const YamlNode* confidence = node->find("confidence"))
    task.confidence = readScale(*confidence, "confidence", false, out);
}

}  // namespace limen::study
