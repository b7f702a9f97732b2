// SPDX-License-Identifier: BSD-3-Clause
// Where the data come from, and the files that lie beside the page.
#include <fmt/format.h>

#include "analysis/output/result_data.h"
#include "analysis/output/text_output.h"
#include "analysis/study_page/sections.h"

namespace limen::analysis {
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
