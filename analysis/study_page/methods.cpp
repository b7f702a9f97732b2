// SPDX-License-Identifier: BSD-3-Clause
// The methods as a paper has them: what methods.h says of the sessions, exclusions, analyses, software.
#include <fmt/format.h>
#include <algorithm>
#include <cctype>

#include "analysis/output/text_output.h"
#include "analysis/psychometric/fit.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/build_facts.h"
#include "experiments/base/environment.h"
#include "experiments/base/text.h"

namespace limen::analysis {

namespace {

/// "2 or 3".
std::string numbers(const std::set<double>& values) {
  std::vector<std::string> words;
  for (const double value : values) words.push_back(shortestNumber(value));
  return join(words, " or ");
}

std::string quoted(const std::string& text) { return "“" + text + "”"; }

std::string quotedList(const std::vector<std::string>& texts) {
  std::vector<std::string> out;
  for (const std::string& text : texts) out.push_back(quoted(text));
  return listed(out);
}

std::string stimuli(const StudyPart& part, const PartFacts& facts) {
  std::string out;
  if (!facts.scenes.empty()) out += "Stimuli were made from the scene " + listed(listOf(facts.scenes)) + ". ";
  if (!facts.durationsS.empty()) out += "A sequence lasted " + numbers(facts.durationsS) + " s";
  if (!facts.durationsS.empty() && !facts.showings.empty()) {
    if (facts.showings == std::set<double>{1.0})
      out += " and was shown once";
    else
      out += " and was shown " + numbers(facts.showings) + " times";
  }
  if (!facts.durationsS.empty()) out += ". ";
  if (facts.durationsS.empty() && facts.scenes.empty()) out += "How long stimuli lasted was not recorded. ";
  if (facts.presentations.size() > 1)
    out += "Presentations were " + listed(listOf(facts.presentations)) + ". ";
  std::vector<std::string> factors;
  for (const StudyFactor& factor : part.factors)
    factors.push_back(fmt::format("{} ({})", factor.name, counted(factor.levels.size(), "level")));
  if (!factors.empty()) out += "Factors were " + listed(factors) + ". ";
  return out;
}

std::string taskText(const StudyPart& part) {
  if (part.task == "yes_no") return "say whether there was a change";
  if (part.task == "interval")
    return fmt::format("say in which of {} intervals the change was", part.alternatives);
  if (part.task == "alternative")
    return fmt::format("say in which of {} pictures the change was", part.alternatives);
  if (part.task == "rating") return "rate what they saw";
  if (part.task == "pairwise") return "choose one of two";
  return "";
}

std::string taskAndTrials(const StudyPart& part, const PartText* text, const PartFacts& facts) {
  std::string out = "Observers had to " + taskText(part);
  if (taskText(part).empty()) out = "The task was of the kind " + quoted(part.task);
  if (text && !text->question.empty()) out += ", asked " + quoted(text->question);
  if (text && !text->answers.empty()) out += " (" + quotedList(text->answers) + ")";
  out += ".";
  if (text && !text->severityLabels.empty())
    out += fmt::format(" {} graded severity in {} steps, {}.",
                       facts.severityAlways ? "They then" : "After a yes they", text->severityLabels.size(),
                       quotedList(text->severityLabels));
  if (text && !text->confidenceLabels.empty())
    out += fmt::format(" They said how sure they were in {} steps, {}.", text->confidenceLabels.size(),
                       quotedList(text->confidenceLabels));
  if (part.adaptive) {
    out += " The procedure " +
           (text && !text->procedure.empty() ? text->procedure : std::string("of the protocol")) +
           fmt::format(" chose the stimuli; each observer gave {} answers in {}.", facts.answers.text(),
                       counted(facts.conditions, "condition"));
  } else if (!part.isBinary()) {
    out += fmt::format(" Each observer gave {} answers, {} in each of {}.", facts.answers.text(),
                       facts.changeRepetitions.text(), counted(facts.conditions, "condition"));
  } else {
    out += fmt::format(" Each observer gave {} answers: {} with a change in each of {}", facts.answers.text(),
                       facts.changeRepetitions.text(), counted(facts.conditions, "condition"));
    out += facts.catchRepetitions.most > 0
               ? fmt::format(" and, in each that had any, {} without one (catch trials).",
                             facts.catchRepetitions.text())
               : std::string("; there were no catch trials.");
  }
  if (text) {
    out += " " + orderText(text->order, "Trials");
    if (!text->blockBy.empty()) {
      const bool kind = text->blockOrder == "shuffle" || text->blockOrder == "latin" ||
                        text->blockOrder == "williams" || text->blockOrder == "fixed";
      out += ", within blocks by " + text->blockBy +
             (kind ? "; " + orderText(text->blockOrder, "blocks") : ", in the order " + text->blockOrder);
    }
    out += ".";
    if (text->breakEveryTrials > 0)
      out += fmt::format(" There was a break every {} trials.", text->breakEveryTrials);
  }
  if (facts.practice.most > 0)
    out += fmt::format(" {} practice trials came first{}, and are not analysed.", facts.practice.text(),
                       text && text->practiceFeedback ? ", with feedback" : "");
  else
    out += " There was no practice.";
  if (facts.notValid > 0)
    out += fmt::format(
        " {} disturbed, such as by late frames, and counted for nothing.",
        facts.notValid == 1 ? "1 showing was" : std::to_string(facts.notValid) + " showings were");
  return out;
}

}  // namespace

std::vector<std::string> listOf(const std::set<std::string>& set) { return {set.begin(), set.end()}; }

std::string orderText(const std::string& kind, const std::string& what) {
  if (kind == "shuffle") return what + " came in an order shuffled for each session";
  if (kind == "latin")
    return what + " came in the order of a row of a Latin square, by the participant's number";
  if (kind == "williams")
    return what + " came in the order of a row of a Williams design, by the participant's number";
  if (kind == "fixed") return what + " came in the order in which the protocol has them";
  return what + " came in the order " + kind;
}

std::string participantsText(const StudyPage& page) {
  const SessionFacts& facts = page.facts;
  const StudyAnswers& study = page.study;
  std::string out;
  if (study.simulated > 0) {
    out = fmt::format(
        "The answers are those of {}{}, not of people.", counted(facts.participants, "simulated observer"),
        facts.observerKinds.empty() ? "" : " (kind: " + listed(listOf(facts.observerKinds)) + ")");
  } else {
    out = fmt::format("{} took part, in {}.", counted(facts.participants, "observer"),
                      counted(study.sessions, "session"));
    if (!facts.firstDay.empty())
      out += facts.firstDay == facts.lastDay
                 ? " The data were collected on " + facts.firstDay + "."
                 : " The data were collected from " + facts.firstDay + " to " + facts.lastDay + ".";
    for (const FormText& field : page.text.form) {
      const auto given = facts.form.find(field.name);
      if (given == facts.form.end()) {
        out += " " + quoted(field.label.empty() ? field.name : field.label) + " was not recorded.";
        continue;
      }
      std::vector<std::string> words;
      size_t answered = 0;
      for (const auto& [choice, count] : given->second) {
        words.push_back(fmt::format("{}: {}", quoted(choice), count));
        answered += count;
      }
      out += " Asked for " + quoted(field.label.empty() ? field.name : field.label) + ", they chose " +
             listed(words) + ".";
      if (answered < facts.participants)
        out += fmt::format(" {} did not answer this.", facts.participants - answered);
    }
    if (page.text.form.empty()) out += " Nothing else about them, such as age or vision, was recorded.";
  }
  return out;
}

std::string apparatusText(const StudyPage& page) {
  const bool simulated = page.study.simulated > 0;
  std::string out =
      simulated
          ? "No picture was shown to a person; the display stands for the one that the study is made for."
          : "";
  for (const DisplayFacts& display : page.facts.displays) {
    std::vector<std::string> facts;
    if (display.widthPx && display.heightPx)
      facts.push_back(fmt::format("{:g} × {:g} pixels", *display.widthPx, *display.heightPx));
    if (display.widthM && display.heightM)
      facts.push_back(
          fmt::format("{:.1f} cm × {:.1f} cm", 100.0 * *display.widthM, 100.0 * *display.heightM));
    if (display.refreshHz) facts.push_back(fmt::format("{:g} Hz", *display.refreshHz));
    if (display.distanceM)
      facts.push_back(fmt::format("a viewing distance of {:g} cm", 100.0 * *display.distanceM));
    if (const auto ppd = display.pixelsPerDegree())
      facts.push_back(fmt::format("{:.1f} pixels per degree in the middle", *ppd));
    if (display.blackCdM2 && display.peakCdM2)
      facts.push_back(
          fmt::format("luminances from {:g} to {:g} cd/m²", *display.blackCdM2, *display.peakCdM2));
    if (!display.transfer.empty()) facts.push_back("transfer curve " + display.transfer);
    if (display.ambientLux)
      facts.push_back(fmt::format("{:g} lux of ambient light on the screen", *display.ambientLux));
    out += fmt::format("{}{} display {}{}.", out.empty() ? "" : " ",
                       simulated ? "It is the" : "Stimuli were shown on the", quoted(display.name),
                       facts.empty() ? ", of which nothing more was recorded" : ": " + join(facts));
    if (!simulated)
      out += display.calibration.is_object() && !display.calibration.empty()
                 ? " How its profile was measured is stored with the sessions."
                 : " How its profile was measured was not recorded.";
  }
  out += fmt::format(
      " Stimuli filled a window of {} × {} pixels{}.", page.study.plan.widthPx, page.study.plan.heightPx,
      page.text.background.empty()
          ? ""
          : " on a background of " + page.text.background + " of the display's white, in linear light");
  if (simulated) return out;
  if (page.facts.renderers.empty())
    out += " What rendered the stimuli was not recorded.";
  else
    out += " Stimuli were rendered by " + listed(listOf(page.facts.renderers)) +
           (page.facts.openGl.empty() ? "" : ", OpenGL " + listed(listOf(page.facts.openGl))) +
           (page.facts.softwareRenderer > 0
                ? fmt::format(" (a software renderer in {})", counted(page.facts.softwareRenderer, "session"))
                : "") +
           (page.facts.systems.empty() ? "" : ", under " + listed(listOf(page.facts.systems))) + ".";
  if (page.study.notLabReady > 0)
    out += fmt::format(" In {} of {} the machine's timing was not ready for a laboratory.",
                       page.study.notLabReady, counted(page.study.sessions, "session"));
  return out;
}

std::string procedureText(const StudyPart& part, const PartText* text, const PartFacts& facts) {
  return stimuli(part, facts) + taskAndTrials(part, text, facts);
}

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
        "over observers on the logit scale (Korn and Graubard 1998), and within observers after Cousineau "
        "and "
        "Morey (Morey 2008); intervals of pooled rates are Wilson's. ";
  const bool anova = std::any_of(page.anova.begin(), page.anova.end(),
                                 [](const PartAnova& part) { return part.result.has_value(); });
  if (anova)
    out +=
        "Rates in trials with a change were compared by repeated-measures analysis of variance, each effect "
        "tested against its own interaction with observers, without correction and with those of Greenhouse "
        "and Geisser and of Huynh and Feldt; partial η² has a 95 % interval from the noncentral F "
        "distribution. Pairs of levels were compared by paired t tests over observers, p corrected after "
        "Holm over the pairs of a factor. ";
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
  out += thresholdMethods(page) + fitMethods(page) + scaleMethods(page);
  if (page.validation) {
    const ValidationSetting& setting = page.validationSetting;
    out += fmt::format(
        "Predictions were made by {} (settings {}). Agreement of rates with predictions is given as Stuart's "
        "τ_c, with the asymptotic error of Brown and Benedetti (1977), and as Pearson's r, with Fisher's z; "
        "areas under ROC curves are compared after DeLong, DeLong and Clarke-Pearson (1988). The link from "
        "rating to detection was fitted by maximum likelihood with ",
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
  const std::vector<SessionRow>& sessions = page.facts.sessions;
  if (std::any_of(sessions.begin(), sessions.end(), [](const SessionRow& one) { return one.used; }))
    out += " Orders were drawn with a separate seed for each session, which is stored with it.";
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
