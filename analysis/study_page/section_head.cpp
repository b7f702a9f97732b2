// SPDX-License-Identifier: BSD-3-Clause
// Title, what the data are, how many there are.
// What was left out, by which rule, and what the rates are with it.
// Where the data come from, and the files that lie beside the page.
#include <fmt/format.h>
#include <algorithm>

#include "analysis/output/result_renderers.h"
#include "analysis/output/text_output.h"
#include "analysis/study/analyses.h"
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
  if (const std::string answer = answerText(page); !answer.empty())
    html += "<p class=\"answer\">" + escapeHtml(answer) + "</p>\n";
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

namespace {

const RateRow* wholePart(const StudyRates& rates, const RateRow& like) {
  const auto found = std::find_if(rates.rows.begin(), rates.rows.end(), [&](const RateRow& row) {
    return row.scope == RateScope::Part && row.part == like.part && row.change == like.change;
  });
  return found == rates.rows.end() ? nullptr : &*found;
}

}  // namespace

std::string ruleText(const std::string& rule, double limit) {
  if (rule == "catch_rate_above")
    return fmt::format("observers who said yes in more than {} of their trials without a change",
                       percentText(limit));
  if (rule == "lapse_above")
    return fmt::format("observers with a fitted lapse rate above {}", percentText(limit));
  if (rule == "reaction_time_below_s")
    return fmt::format("answers given less than {} s after the question", shortestNumber(limit));
  if (rule == "reaction_time_above_s")
    return fmt::format("answers given more than {} s after the question", shortestNumber(limit));
  return fmt::format("what the rule {} ({}) names", rule, shortestNumber(limit));
}

void addExclusions(const StudyPage& page, PageWriter& out) {
  const StudyAnswers& study = page.study;
  out.openSection("exclusions", "What was left out");
  if (study.rules.empty()) out.paragraph("The protocol declares no exclusion rules.");
  out.table(ruleTable(study), "Rules that the protocol declares.");
  if (study.leftOut.empty()) {
    out.paragraph("Nothing was left out.");
    out.closeSection();
    return;
  }
  const ResultTable left = leftOutTable(study);
  out.file("tables/left_out.csv", toCsv(left), "what was left out");
  out.table(left, "What was left out.", "tables/left_out.csv", 12);
  std::vector<RateRow> rows;
  for (const RateRow& row : page.allRates.rows)
    if (row.scope == RateScope::Part) rows.push_back(row);
  const auto own = [&](auto member) {
    return [&, member](const RateRow& row) {
      const RateRow* analysed = wholePart(page.rates, row);
      return analysed ? ResultCell(analysed->overObservers.*member) : ResultCell();
    };
  };
  const auto all = [](auto member) { return at(&RateRow::overObservers, member); };
  out.table(TableOf("exclusions", "", rows)
                .add(text("part"), &RateRow::part)
                .add(text("rate_of"),
                     [](const RateRow& row) { return row.change ? row.of : row.of + ", no change"; })
                .add(integer("observers"), own(&MeanOverSubjects::subjects))
                .add(share("estimate", "as analysed"), own(&MeanOverSubjects::mean))
                .add(share("sd", "SD"), own(&MeanOverSubjects::standardDeviation))
                .add(integer("all_observers", "observers"), all(&MeanOverSubjects::subjects))
                .add(share("all_estimate", "nothing excluded"), all(&MeanOverSubjects::mean))
                .add(share("all_sd", "SD"), all(&MeanOverSubjects::standardDeviation)),
            "Detection rates as analysed and with nothing excluded: mean over observers of their own rates, "
            "SD over observers.");
  out.file("tables/rates_nothing_excluded.csv", toCsv(resultOf(page.allRates).sections),
           "detection rates with nothing excluded");
  out.closeSection();
}

namespace {

void addSessions(const StudyPage& page, PageWriter& out) {
  const ResultTable sessions = TableOf("sessions", "", page.facts.sessions)
                                   .add(text("participant"), &SessionRow::participant)
                                   .add(text("session"), &SessionRow::name)
                                   .add(text("state"), &SessionRow::state)
                                   .add(flag("used"), &SessionRow::used)
                                   .add(integer("answers"), &SessionRow::answers)
                                   .add(text("display"), &SessionRow::display)
                                   .add(text("program_version"), &SessionRow::programVersion);
  out.file("tables/sessions.csv", toCsv(sessions), "sessions");
}

void addHashes(const StudyPage& page, PageWriter& out) {
  std::string html = "<div class=\"scroll\"><table class=\"pairs\"><tbody>\n";
  const auto row = [&](const std::string& name, const std::string& value) {
    if (!value.empty())
      html += "<tr><th scope=\"row\">" + escapeHtml(name) + "</th><td class=\"hash\">" + escapeHtml(value) +
              "</td></tr>\n";
  };
  row("protocol", page.study.plan.name);
  row("protocol, SHA-256", page.study.plan.hash);
  for (const DisplayFacts& display : page.facts.displays)
    row("display " + display.name + ", SHA-256", display.hash);
  if (page.validation) {
    row("predictions, settings' SHA-256", page.validation->settingsHash);
    row("predictions made by", page.validation->programVersion);
  }
  for (const std::string& version : page.facts.programVersions) row("sessions run by", version);
  out.html(html + "</tbody></table></div>\n");
}

}  // namespace

void addProvenance(const StudyPage& page, PageWriter& out) {
  addSessions(page, out);
  out.openSection("data", "Data and provenance");
  addHashes(page, out);
  out.html("<details><summary>Protocol</summary><pre tabindex=\"0\"><code>" + escapeHtml(page.protocol.text) +
           "</code></pre></details>\n");
  out.heading("Files");
  std::string html = "<ul class=\"prose files\">\n";
  for (const PageFile& file : out.files())
    html += "<li><a href=\"" + escapeHtml(file.path) + "\">" + breakable(file.path) +
            "</a>: " + escapeHtml(file.meaning) + "</li>\n";
  for (const Figure& figure : out.figures()) {
    const std::string base = "figures/" + figure.name;
    html += "<li>" + breakable(base);
    for (const char* extension : {".svg", ".pdf", ".gp", ".dat"})
      html += fmt::format(" <a href=\"{0}{1}\">{1}</a>", escapeHtml(base), extension);
    html += "</li>\n";
  }
  out.html(html +
           "</ul>\n<p><code>gnuplot all.gp</code> in <a href=\"figures/\">figures/</a> draws all figures "
           "anew.</p>\n");
  out.closeSection();
}

}  // namespace limen::analysis
