// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/metrics/quantile.h"
#include "perception/metrics/row_sums.h"

namespace limen::perception {
namespace {

Limit parseLimit(const std::string& text, bool below, const Figures& known, const std::string& bare) {
  const std::string option = below ? "--fail-below" : "--fail-above";
  const size_t split = text.find('=');
  Limit limit;
  limit.below = below;
  limit.figure = split == std::string::npos ? bare : text.substr(0, split);
  const std::string number = split == std::string::npos ? text : text.substr(split + 1);
  if (limit.figure.empty())
    throw Error("'" + text + "' does not name a figure", option, "write FIGURE=VALUE");
  const auto figure =
      std::find_if(known.begin(), known.end(), [&](const Figure& f) { return f.name == limit.figure; });
  if (figure == known.end()) {
    std::vector<std::string> names;
    for (const Figure& f : known) names.push_back(f.name);
    throw Error("no figure '" + limit.figure + "'", option, suggest(limit.figure, names));
  }
  const char* const end = number.data() + number.size();
  const auto [stop, code] = std::from_chars(number.data(), end, limit.value);
  if (code != std::errc{} || stop != end || !std::isfinite(limit.value))
    throw Error("'" + number + "' is not a number", option, "write " + limit.figure + "=0.5");
  // A limit on the good side would pass anything bad.
  if (figure->higherIsBetter != below)
    throw Error(fmt::format("'{}' is better the {} it is", limit.figure, below ? "lower" : "higher"), option,
                fmt::format("write {} {}={}", below ? "--fail-above" : "--fail-below", limit.figure, number));
  return limit;
}

}  // namespace

std::vector<Limit> parseLimits(const std::vector<std::string>& above, const std::vector<std::string>& below,
                               const Figures& known, const std::string& bare) {
  std::vector<Limit> limits;
  for (const std::string& text : above) limits.push_back(parseLimit(text, false, known, bare));
  for (const std::string& text : below) limits.push_back(parseLimit(text, true, known, bare));
  return limits;
}

std::vector<std::string> exceeded(const Figures& figures, const std::vector<Limit>& limits) {
  std::vector<std::string> out;
  for (const Limit& limit : limits) {
    const auto figure =
        std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.name == limit.figure; });
    if (figure == figures.end() || (!figure->value && !figure->reason.empty()))
      throw Error("'" + limit.figure + "' cannot be evaluated" +
                      (figure == figures.end() ? "" : ": " + figure->reason),
                  limit.below ? "--fail-below" : "--fail-above",
                  "leave this limit out, or supply what is missing");
    if (!figure->value) continue;
    if (limit.below ? *figure->value < limit.value : *figure->value > limit.value)
      out.push_back(fmt::format("{} is {}{}, {} {}", figure->name, numberText(*figure->value),
                                figure->unit.empty() ? "" : " " + figure->unit,
                                limit.below ? "below" : "above", shortestNumber(limit.value)));
  }
  return out;
}

void FigureSummary::add(const Figures& figures, const std::string& frame) {
  for (const Figure& figure : figures) {
    auto series = std::find_if(series_.begin(), series_.end(),
                               [&](const Series& s) { return s.figure.name == figure.name; });
    if (series == series_.end()) series = series_.insert(series_.end(), Series{figure, {}, {}});
    if (!figure.value) continue;
    series->values.push_back(*figure.value);
    series->frames.push_back(frame);
  }
}

nlohmann::json FigureSummary::toJson() const {
  nlohmann::json out = nlohmann::json::object();
  for (const Series& series : series_) {
    if (series.values.empty()) {
      out[series.figure.name] = nullptr;
      continue;
    }
    CompensatedSum sum;
    for (const double value : series.values) sum.add(value);
    std::vector<double> values = series.values;
    const auto [least, most] = std::minmax_element(series.values.begin(), series.values.end());
    const auto frame = [&](auto at) {
      return series.frames[static_cast<size_t>(at - series.values.begin())];
    };
    out[series.figure.name] = {
        {"frames", values.size()},
        {"mean", sum.value() / static_cast<double>(values.size())},
        {"median", nearestRank(values, 0.5)},
        {"min", *least},
        {"min_frame", frame(least)},
        {"max", *most},
        {"max_frame", frame(std::max_element(series.values.begin(), series.values.end()))}};
  }
  return out;
}

std::string FigureSummary::table(const std::vector<std::string>& shown) const {
  size_t width = 6;
  const auto hidden = [&](const Series& series) {
    return !shown.empty() && std::find(shown.begin(), shown.end(), series.figure.name) == shown.end();
  };
  for (const Series& series : series_) width = std::max(width, series.figure.name.size());
  std::string out = fmt::format("  {:<{}} {:>12} {:>12} {:>12} {:>12}  worst frame\n", "", width, "mean",
                                "median", "min", "max");
  const nlohmann::json all = toJson();
  for (const Series& series : series_) {
    if (hidden(series)) continue;
    const nlohmann::json& row = all.at(series.figure.name);
    if (row.is_null()) {
      out += fmt::format("  {:<{}} {:>12}\n", series.figure.name, width, "none");
      continue;
    }
    const auto number = [&](const char* key) { return numberText(row.at(key).get<double>()); };
    out +=
        fmt::format("  {:<{}} {:>12} {:>12} {:>12} {:>12}  {}\n", series.figure.name, width, number("mean"),
                    number("median"), number("min"), number("max"), worstFrame(series.figure.name));
  }
  return out;
}

std::string FigureSummary::worstFrame(const std::string& figure) const {
  for (const Series& series : series_) {
    if (series.figure.name != figure || series.values.empty()) continue;
    const auto worst = series.figure.higherIsBetter
                           ? std::min_element(series.values.begin(), series.values.end())
                           : std::max_element(series.values.begin(), series.values.end());
    return series.frames[static_cast<size_t>(worst - series.values.begin())];
  }
  return {};
}

Figures shownOf(const Figures& figures, const std::vector<std::string>& shown) {
  if (shown.empty()) return figures;
  Figures out;
  for (const Figure& figure : figures)
    if (std::find(shown.begin(), shown.end(), figure.name) != shown.end()) out.push_back(figure);
  return out;
}

std::string figureTable(const Figures& figures) {
  size_t width = 0;
  for (const Figure& figure : figures) width = std::max(width, figure.name.size());
  std::string out;
  std::vector<std::pair<std::string, std::vector<std::string>>> absent;  // by reason
  for (const Figure& figure : figures) {
    if (figure.value || figure.reason.empty()) {
      const std::string value =
          figure.value ? numberText(*figure.value) + (figure.unit.empty() ? "" : " " + figure.unit) : "none";
      out += fmt::format("  {:<{}}  {:<18}{}\n", figure.name, width, value,
                         figure.meaning.empty() ? "" : " " + figure.meaning);
      continue;
    }
    const auto known = std::find_if(absent.begin(), absent.end(),
                                    [&](const auto& entry) { return entry.first == figure.reason; });
    if (known == absent.end()) {
      absent.push_back({figure.reason, {figure.name}});
    } else {
      known->second.push_back(figure.name);
    }
  }
  for (const auto& [reason, names] : absent) out += "  not available: " + join(names) + ": " + reason + "\n";
  return out;
}

nlohmann::json figuresAsJson(const Figures& figures) {
  nlohmann::json out = nlohmann::json::object();
  for (const Figure& figure : figures)
    out[figure.name] = figure.value ? nlohmann::json(*figure.value) : nullptr;
  return out;
}

std::string numberText(double value) { return fmt::format("{:.6g}", value); }

}  // namespace limen::perception
