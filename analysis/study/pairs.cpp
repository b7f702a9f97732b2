// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/pairs.h"

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/text.h"

namespace limen::analysis {
namespace {

const std::string kItems[] = {"item_a", "item_b"};

/// Name of the group that an answer belongs to.
std::string groupOf(const StudyPart& part, const StudyAnswer& answer, const std::vector<std::string>& by,
                    bool severalParts) {
  std::vector<std::string> words;
  if (severalParts) words.push_back("part=" + part.name);
  for (const std::string& factor : by) {
    const auto level = answer.condition.find(factor);
    if (level == answer.condition.end() || factor == kItems[0] || factor == kItems[1]) {
      std::vector<std::string> known;
      for (const auto& [name, value] : answer.condition)
        if (name != kItems[0] && name != kItems[1]) known.push_back(name);
      throw Error("part '" + part.name + "' has no factor '" + factor + "' beside its items", "--by",
                  suggest(factor, known));
    }
    words.push_back(factor + "=" + level->second);
  }
  return join(words);
}

/// What tells one pass through the pairs from the others.
std::string roundOf(const StudyAnswer& answer) {
  std::string out = std::to_string(answer.session) + "/" + std::to_string(answer.target) + "/" +
                    std::to_string(answer.repetition);
  for (const auto& [name, level] : answer.condition)
    if (name != kItems[0] && name != kItems[1]) out += "/" + level;
  return out;
}

}  // namespace

std::vector<PairGroup> readStudyPairs(const StudyAnswers& study, const std::vector<std::string>& by) {
  const auto compares = [](const StudyPart& part) { return part.task == "pairwise"; };
  const std::vector<StudyPart>& parts = study.plan.parts;
  const auto count = std::count_if(parts.begin(), parts.end(), compares);
  if (count == 0)
    throw Error("no part compares items in pairs", study.plan.name, "limen analyse rates takes the others");
  std::vector<PairGroup> out;
  std::vector<std::map<std::string, size_t>> rounds;
  for (const StudyAnswer& answer : study.answers) {
    const StudyPart& part = parts[answer.part];
    if (!compares(part)) continue;
    const std::string name = groupOf(part, answer, by, count > 1);
    auto group = std::find_if(out.begin(), out.end(), [&](const PairGroup& one) { return one.name == name; });
    if (group == out.end()) {
      group = out.insert(out.end(), PairGroup{});
      group->name = name;
      group->ordered = true;
      rounds.emplace_back();
    }
    auto& known = rounds[static_cast<size_t>(group - out.begin())];
    const bool second = answer.outcome == answer.target;
    PairJudgement one;
    one.winner = group->item(answer.condition.at(kItems[second ? 1 : 0]));
    one.loser = group->item(answer.condition.at(kItems[second ? 0 : 1]));
    one.subject = group->subject(study.observers[answer.observer]);
    one.round = known.emplace(roundOf(answer), known.size()).first->second;
    ++group->judged;
    group->firstChosen += answer.outcome == 0 ? 1 : 0;
    group->judgements.push_back(one);
  }
  if (out.empty()) throw Error("no pair was judged", study.plan.name);
  return out;
}

}  // namespace limen::analysis
