// SPDX-License-Identifier: BSD-3-Clause
// Title, what the data are, how many there are.
#include <fmt/format.h>

#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"
#include "experiments/base/text.h"

namespace limen::analysis {

void addHead(const StudyPage& page, PageWriter& out) {
  const StudyAnswers& study = page.study;
  const SessionFacts& facts = page.facts;
  const bool simulated = study.simulated > 0;
  std::string html = "<header>\n<h1>" + escapeHtml(study.plan.title) + "</h1>\n";
  if (!page.text.question.empty())
    html += "<p class=\"question\">" + escapeHtml(page.text.question) + "</p>\n";
  out.html(html);
  if (simulated)
    out.notice("Simulated observers: a program gave these answers. They say nothing about people.", true);
  if (page.unfinishedWanted) out.notice("Sessions that were broken off are among the data.");
  if (study.notLabReady > 0)
    out.notice(fmt::format(
        "{} of {} began although the machine's timing was not ready for a laboratory{}", study.notLabReady,
        counted(study.sessions, "session"),
        facts.doubts.empty() ? "." : ": " + join({facts.doubts.begin(), facts.doubts.end()}, "; ") + "."));
  if (!page.exclusionsWanted && !study.plan.exclusions.empty())
    out.notice("The protocol's exclusion rules are not applied on this page.");
  html = "<dl class=\"facts\">";
  const auto fact = [&](const std::string& name, const std::string& value) {
    if (!value.empty()) html += "<div><dt>" + name + "</dt><dd>" + escapeHtml(value) + "</dd></div>";
  };
  fact("Observers",
       std::to_string(study.observers.size()) +
           (facts.participants > study.observers.size() ? fmt::format(" of {}", facts.participants)
                                                        : std::string()) +
           (simulated ? ", simulated" : ""));
  fact("Sessions", std::to_string(study.sessions));
  fact("Answers", fmt::format("{} of {}", study.answers.size(), page.everything.answers.size()));
  fact("Display", join(study.displays));
  if (!simulated)
    fact("Machine", study.notLabReady == 0 ? "ready for a laboratory in every session, as it said itself"
                                           : "not ready for a laboratory in every session");
  if (!facts.firstDay.empty())
    fact("Days", facts.firstDay == facts.lastDay ? facts.firstDay : facts.firstDay + " to " + facts.lastDay);
  fact("Source", page.text.source);
  fact("Protocol", study.plan.name + ", SHA-256 " + study.plan.hash.substr(0, 12));
  out.html(html + "</dl>\n</header>\n");
}

}  // namespace limen::analysis
