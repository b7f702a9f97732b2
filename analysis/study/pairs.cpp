// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "analysis/output/text_output.h"
#include "analysis/study/analyses.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

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

/// Parts and levels in the order in which the protocol writes them.
std::vector<size_t> placeOf(const StudyPlan& plan, const StudyAnswer& answer,
                            const std::vector<std::string>& by) {
  const StudyPart& part = plan.parts[answer.part];
  const std::vector<size_t> levels = levelsOf(part, answer.condition);
  std::vector<size_t> out{answer.part};
  for (const std::string& factor : by)
    for (size_t i = 0; i < levels.size(); ++i)
      if (part.factors[i].name == factor) out.push_back(levels[i]);
  return out;
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
  struct Place {
    PairGroup group;
    std::map<std::string, size_t> rounds;
  };
  // Levels that the protocol does not list share a place, and are told apart by name.
  std::map<std::pair<std::vector<size_t>, std::string>, Place> groups;
  for (const StudyAnswer& answer : study.answers) {
    const StudyPart& part = parts[answer.part];
    if (!compares(part)) continue;
    const std::string name = groupOf(part, answer, by, count > 1);
    Place& place = groups[{placeOf(study.plan, answer, by), name}];
    PairGroup& group = place.group;
    group.name = name;
    group.ordered = true;
    const bool second = answer.outcome == answer.target;
    PairJudgement one;
    one.winner = indexIn(group.items, answer.condition.at(kItems[second ? 1 : 0]));
    one.loser = indexIn(group.items, answer.condition.at(kItems[second ? 0 : 1]));
    one.subject = indexIn(group.subjects, study.observers[answer.observer]);
    one.round = place.rounds.emplace(roundOf(answer), place.rounds.size()).first->second;
    ++group.judged;
    group.firstChosen += answer.outcome == 0 ? 1 : 0;
    group.judgements.push_back(one);
  }
  if (groups.empty()) throw Error("no pair was judged", study.plan.name);
  std::vector<PairGroup> out;
  for (auto& [key, place] : groups) out.push_back(std::move(place.group));
  return out;
}

std::vector<PartScale> studyScales(const StudyAnswers& study) {
  std::vector<PartScale> out;
  for (size_t i = 0; i < study.plan.parts.size(); ++i) {
    if (study.plan.parts[i].task != "pairwise") continue;
    StudyAnswers own = study;
    own.answers.erase(std::remove_if(own.answers.begin(), own.answers.end(),
                                     [&](const StudyAnswer& answer) { return answer.part != i; }),
                      own.answers.end());
    if (own.answers.empty()) continue;
    PartScale one;
    one.part = study.plan.parts[i].name;
    try {
      one.scale = scaleItems(readStudyPairs(own, {}), one.setting).groups.at(0);
    } catch (const Error& error) {
      one.note = error.message();
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace limen::analysis
