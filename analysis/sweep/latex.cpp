// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/output/text_output.h"
#include "analysis/sweep/exchange.h"
#include "analysis/sweep/page.h"

namespace limen::analysis {
namespace {

/// Characters beyond ASCII that titles and units of the bench have; modern LaTeX reads others itself.
const std::map<std::string, std::string> kBeyondAscii = {{"µ", "\\textmu{}"},
                                                         {"μ", "\\textmu{}"},
                                                         {"²", "\\textsuperscript{2}"},
                                                         {"³", "\\textsuperscript{3}"},
                                                         {"°", "\\textdegree{}"},
                                                         {"·", "\\textperiodcentered{}"},
                                                         {"×", "$\\times$"},
                                                         {"–", "--"},
                                                         {"Δ", "$\\Delta$"}};

std::string latexNumber(double value) {
  const std::string text = formatNumber(value);
  const size_t e = text.find('e');
  if (e == std::string::npos) return text;
  // 1.2e-05 as a power of ten.
  return fmt::format("${} \\times 10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

std::string bold(const std::string& text, bool is) { return is ? "\\textbf{" + text + "}" : text; }

}  // namespace

std::string latexText(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto special = std::find_if(kBeyondAscii.begin(), kBeyondAscii.end(), [&](const auto& pair) {
      return text.compare(i, pair.first.size(), pair.first) == 0;
    });
    if (special != kBeyondAscii.end()) {
      out += special->second;
      i += special->first.size() - 1;
    } else if (std::string("&%$#_{}").find(c) != std::string::npos) {
      out += std::string("\\") + c;
    } else if (c == '\\') {
      out += "\\textbackslash{}";
    } else if (c == '~') {
      out += "\\textasciitilde{}";
    } else if (c == '^') {
      out += "\\textasciicircum{}";
    } else if (c == '<' || c == '>' || c == '|' || c == '"') {
      out += c == '<'   ? "\\textless{}"
             : c == '>' ? "\\textgreater{}"
             : c == '|' ? "\\textbar{}"
                        : "\\textquotedbl{}";
    } else if (c == '\n' || c == '\r' || c == '\t') {
      out += ' ';
    } else {
      out += c;
    }
  }
  return out;
}

std::string latexTable(const Sweep& sweep) {
  std::string out = "% " + latexText(sweep.experiment.title) + "; experiment " +
                    sweep.experiment.hash.substr(0, 16) + ". Needs \\usepackage{booktabs}.\n";
  if (!sweep.isComplete())
    out += fmt::format("% Not complete: {} runs failed, {} are missing.\n", sweep.failed.size(),
                       sweep.missing.size());
  if (sweep.software) out += "% Times of a software renderer: they compare techniques on a CPU only.\n";
  out += "\\begin{tabular}{lrrr}\n\\toprule\n";
  out += fmt::format("Setting & {} & 95\\,\\% interval & {} \\\\\n", latexText(sweep.x.label()),
                     latexText(sweep.y.label()));
  for (const Panel& panel : sweep.panels) {
    std::vector<const Cell*> cells;
    for (const size_t index : panel.cells)
      if (sweep.cells[index].isDrawn()) cells.push_back(&sweep.cells[index]);
    if (cells.empty()) continue;
    std::stable_sort(cells.begin(), cells.end(), [](const Cell* a, const Cell* b) { return *a->x < *b->x; });
    out += "\\midrule\n";
    if (sweep.panels.size() > 1)
      out += fmt::format("\\multicolumn{{4}}{{l}}{{\\emph{{{}}}}} \\\\\n", latexText(panel.title));
    for (const Cell* cell : cells) {
      const std::string interval = cell->interval ? fmt::format("{}--{}", latexNumber(cell->interval->low),
                                                                latexNumber(cell->interval->high))
                                                  : "";
      out +=
          fmt::format("{} & {} & {} & {} \\\\\n", bold(latexText(sweep.label(*cell)), cell->frontNumber > 0),
                      latexNumber(*cell->x), interval, latexNumber(*cell->y));
    }
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace limen::analysis
