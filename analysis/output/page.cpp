// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/output/page.h"

#include <fmt/format.h>

#include "analysis/output/text_output.h"
#include "experiments/base/gnuplot.h"

namespace limen::embedded {
extern const char* const kPageCss;
}  // namespace limen::embedded

namespace limen::analysis {
namespace {

/// "rgb(  0, 114, 178)": how gnuplot writes "#0072B2" into an SVG.
std::string asGnuplotWrites(const std::string& colour) {
  const auto part = [&](size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
  return fmt::format("rgb({:3}, {:3}, {:3})", part(1), part(3), part(5));
}

}  // namespace

std::string renderDocument(const std::string& title, const std::string& style, const std::string& body,
                           const std::string& script) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
      escapeHtml(title) + " – Limen</title>\n<style>\n" + embedded::kPageCss + style +
      "</style>\n</head>\n<body>\n" + body;
  if (!script.empty()) out += "<script>\n" + script + "</script>\n";
  return out + "</body>\n</html>\n";
}

std::string inlineSvg(std::string svg, const std::string& name, const std::string& description,
                      const std::string& role) {
  svg.erase(0, svg.find("<svg"));
  for (size_t at; (at = svg.find("<title>")) != std::string::npos;)
    svg.erase(at, svg.find("</title>", at) + 8 - at);
  for (size_t at; (at = svg.find("<filter")) != std::string::npos;)
    svg.erase(at, svg.find("</filter>", at) + 9 - at);
  replaceAll(svg, "gpDot", name + "_gpDot");
  replaceAll(svg, "gpPt", name + "_gpPt");
  replaceAll(svg, "gnuplot_canvas", name + "_canvas");
  replaceAll(svg, "stroke='black'", "stroke='currentColor'");
  replaceAll(svg, "fill=\"black\"", "fill=\"currentColor\"");
  replaceAll(svg, "color=\"black\"", "");
  replaceAll(svg, "color=\"white\"", "");
  replaceAll(svg, "color='white'", "color='var(--paper)'");  // rings that part marks from bars
  replaceAll(svg, "stroke='rgb(221, 221, 221)'", "class='grid'");
  replaceAll(svg, "class='grid' class=\"gridline\"", "class='grid'");
  for (size_t i = 0; i < kChartColours.size(); ++i)
    replaceAll(svg, asGnuplotWrites(kChartColours[i]), fmt::format("var(--s{})", i));
  svg.replace(0, 4,
              "<svg class=\"chart\" role=\"" + role + "\" aria-label=\"" + escapeHtml(description) + "\"");
  return svg;
}

}  // namespace limen::analysis
