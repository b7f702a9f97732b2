// SPDX-License-Identifier: BSD-3-Clause
// The methods as a paper has them: what methods.h says of the sessions, exclusions, analyses, software.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "analysis/output/text_output.h"
#include "analysis/psychometric/fit.h"
#include "analysis/study_page/methods.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/environment.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::string exclusions(const StudyPage& page) {
  const StudyAnswers& study = page.study;
  size_t unfinished = 0, unfinishedAnswers = 0;
  for (const LeftOut& left : study.leftOut)
    if (left.rule == "unfinished session") ++unfinished, unfinishedAnswers += left.answers;
  std::string out;
  if (unfinished > 0)
    out += fmt::format("{} broken off {} left out ({}). ", counted(unfinished, "session"),
                       unfinished == 1 ? "was" : "were", counted(unfinishedAnswers, "answer"));
  if (study.rules.empty()) out += "The protocol declares no rule of exclusion. ";
  std::vector<std::string> applied;
  std::string refused;
  for (const AppliedRule& rule : study.rules) {
    if (!rule.applied) {
      refused += "The rule to leave out " + ruleText(rule.name, rule.limit) +
                 " was declared and not applied (" + rule.note + "). ";
      continue;
    }
    std::set<std::string> observers;
    size_t answers = 0;
    for (const LeftOut& left : study.leftOut)
      if (left.rule == rule.name) observers.insert(left.observer), answers += left.answers;
    const bool single = rule.name.rfind("reaction_time", 0) == 0;
    applied.push_back(ruleText(rule.name, rule.limit) + " (" +
                      (single ? "" : counted(observers.size(), "observer") + ", ") +
                      counted(answers, "answer") + ")");
  }
  if (!applied.empty())
    out += "As declared before the sessions, these were left out: " + join(applied, "; ") + ". ";
  out += refused;
  return out + fmt::format("{} of {} remain.", counted(study.answers.size(), "answer"),
                           counted(study.observers.size(), "observer"));
}

std::string analyses(const StudyPage& page) {
  std::string out;
  if (!page.rates.rows.empty())
    out +=
        "Rates are means over observers of each observer's own rate, with 95 % intervals from Student's t "
        "over observers; intervals of pooled "
        "rates are Wilson's. ";
  const bool anova = std::any_of(page.anova.begin(), page.anova.end(),
                                 [](const PartAnova& part) { return part.result.has_value(); });
  if (anova)
    out +=
        "Rates in trials with a change were compared by repeated-measures analysis of variance, each effect "
        "tested against its own interaction with "
        "observers, without correction and with those of Greenhouse and Geisser and of Huynh and Feldt; "
        "partial η² has a 95 % interval from the "
        "noncentral F distribution. Pairs of levels were compared by paired t tests over observers, p "
        "corrected after Holm over the pairs of a factor. ";
  const bool yesNo = std::any_of(page.sensitivity.begin(), page.sensitivity.end(),
                                 [](const PartSensitivity& part) { return part.yesNo && part.dPrime; });
  const bool choice = std::any_of(page.sensitivity.begin(), page.sensitivity.end(),
                                  [](const PartSensitivity& part) { return !part.yesNo && part.dPrime; });
  if (yesNo || choice)
    out += std::string("Sensitivity d′") + (yesNo ? " and criterion c are those" : " is that") +
           " of the equal-variance Gaussian model, with k of n corrected to (k + 1/2) of (n + 1) "
           "(Hautus 1995)" +
           (yesNo ? " and 95 % intervals of observers after Gourevitch and Galanter (1967)" : "") +
           "; means over observers have t intervals. ";
  out += fitMethods(page) + scaleMethods(page);
  if (page.validation) {
    const ValidationSetting& setting = page.validationSetting;
    out += fmt::format(
        "Predictions were made by {} (settings {}). Agreement of rates with predictions is given as Stuart's "
        "τ_c, with the asymptotic error of Brown "
        "and Benedetti (1977), and as Pearson's r, with Fisher's z; areas under ROC curves are compared "
        "after DeLong, DeLong and Clarke-Pearson "
        "(1988). The link from rating to detection was fitted by maximum likelihood with ",
        page.validation->programVersion, page.validation->settingsHash.substr(0, 12));
    out += setting.guess      ? "a guess rate of " + shortestNumber(*setting.guess)
           : setting.fitGuess ? std::string("a fitted guess rate")
                              : std::string("the rate of reports in catch trials as guess rate");
    out += setting.lapse ? " and a lapse rate of " + shortestNumber(*setting.lapse)
                         : std::string(" and a fitted lapse rate");
    out += "; each scenario was predicted by the link fitted to all others. ";
  }
  const bool drawn = std::any_of(page.scales.begin(), page.scales.end(), [](const PartScale& part) {
    return part.scale && part.scale->bootstrap != ScaleBootstrap::None;
  });
  return out + (drawn ? "No other result on this page rests on random numbers."
                      : "No result on this page rests on random numbers.");
}

std::string software(const StudyPage& page) {
  std::string out = page.facts.programVersions.empty()
                        ? "The version that ran the sessions was not recorded."
                        : "Sessions were run by Limen " + listed(listOf(page.facts.programVersions)) + ".";
  std::vector<std::string> libraries;
  for (auto [name, version] : fitLibraries()) {
    std::replace(version.begin(), version.end(), '_', '.');  // as Boost writes its own
    name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    libraries.push_back(name + " " + version);
  }
  const nlohmann::json facts = environmentFacts({}, "");
  if (facts.contains("libraries") && facts["libraries"].contains("sqlite"))
    libraries.push_back("SQLite " + facts["libraries"]["sqlite"].get<std::string>());
  out += fmt::format(
      " They were analysed by Limen {} (commit {}), built with {}. Figures were drawn by gnuplot.",
      projectVersion(), buildCommit(), listed(libraries));
  if (page.facts.usedSessions > 0)
    out += " Orders were drawn with a seed of each session's own, which is stored with it.";
  return out;
}

}  // namespace

std::string listed(const std::vector<std::string>& items) {
  if (items.size() < 2) return join(items);
  return join({items.begin(), items.end() - 1}) + " and " + items.back();
}

void addMethods(const StudyPage& page, PageWriter& out) {
  std::vector<std::pair<std::string, std::string>> parts = {{"Participants", participantsText(page)},
                                                            {"Apparatus", apparatusText(page)}};
  for (const StudyPart& part : page.study.plan.parts) {
    const auto facts = page.facts.parts.find(part.name);
    if (facts == page.facts.parts.end()) continue;
    const std::string name = page.facts.parts.size() > 1 ? ", part " + part.name : "";
    parts.push_back({"Stimuli, task and procedure" + name,
                     procedureText(part, page.text.part(part.name), facts->second)});
  }
  if (page.facts.parts.size() > 1) parts.push_back({"Parts", orderText(page.text.partOrder, "Parts") + "."});
  parts.push_back({"Exclusions", exclusions(page)});
  parts.push_back({"Analysis", analyses(page)});
  parts.push_back({"Software", software(page)});
  out.openSection("methods", "Methods, as a paper has them");
  std::string plain;
  for (const auto& [name, text] : parts) {
    out.html("<p><b>" + escapeHtml(name) + ".</b> " + escapeHtml(text) + "</p>\n");
    plain += name + ". " + text + "\n\n";
  }
  out.file("methods.txt", plain, "the methods as plain text");
  out.closeSection();
}

}  // namespace limen::analysis
