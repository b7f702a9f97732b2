// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/power_law.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "analysis/output/text_output.h"
#include "analysis/statistics/distributions.h"
#include "analysis/sweep/chart.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

/// Names of the columns that the parameters called `path` have: "columns", or "scene.columns" where a
/// technique has one of that path, too.
bool isColumnOf(const std::string& column, const std::string& path) {
  return column == path || column == "scene." + path || column == "technique." + path ||
         column == "image." + path;
}

}  // namespace

std::optional<PowerLaw> fitPowerLaw(const std::vector<std::pair<double, double>>& points) {
  const auto n = static_cast<double>(points.size());
  double meanX = 0.0, meanY = 0.0;
  for (const auto& [x, y] : points) meanX += std::log(x) / n, meanY += std::log(y) / n;
  double squares = 0.0, products = 0.0;
  for (const auto& [x, y] : points) {
    const double along = std::log(x) - meanX;
    squares += along * along;
    products += along * (std::log(y) - meanY);
  }
  // Equal x leave rounding.
  if (points.size() < 2 || squares <= 1e-24 * n * (1.0 + meanX * meanX)) return std::nullopt;
  PowerLaw law;
  law.exponent = products / squares;
  law.factor = std::exp(meanY - law.exponent * meanX);
  double residuals = 0.0, farthest = 0.0;
  for (const auto& [x, y] : points) {
    const double residual = std::log(y) - meanY - law.exponent * (std::log(x) - meanX);
    residuals += residual * residual;
    farthest = std::max(farthest, std::abs(residual));
  }
  law.departure = std::exp(farthest);
  if (points.size() > 2)
    law.exponent95 =
        around(law.exponent, tCritical(0.05, n - 2.0) * std::sqrt(residuals / (n - 2.0) / squares));
  return law;
}

std::vector<std::string> fittedOver(const Sweep& sweep) {
  std::vector<std::string> out;
  std::istringstream names(sweep.experiment.report.value("fit", ""));
  for (std::string name; names >> name;) {
    if (name.back() == ',') name.pop_back();
    out.push_back(name);
  }
  return out;
}

std::vector<Scaling> findScalings(const Sweep& sweep) {
  const std::vector<std::string> fit = fittedOver(sweep);
  if (fit.empty()) return {};
  std::vector<Scaling> out;
  std::vector<std::vector<std::pair<double, double>>> points;
  std::map<std::vector<std::string>, size_t> places;
  for (const Cell& cell : sweep.cells) {
    std::vector<std::string> key = {cell.run.scene, cell.run.technique, cell.run.device};
    std::vector<std::string> settings;
    for (const Axis& column : sweep.varyingColumns) {
      const auto value = cell.varying.find(column.name);
      if (value == cell.varying.end() || std::any_of(fit.begin(), fit.end(), [&](const std::string& path) {
            return isColumnOf(column.name, path);
          }))
        continue;
      key.push_back(column.name + "=" + value->second);
      settings.push_back(column.name + " " + value->second);
    }
    const auto [place, isNew] = places.try_emplace(key, out.size());
    if (isNew) {
      if (sweep.severalDevices) settings.push_back(cell.run.device);
      out.push_back({cell.run.scene,
                     cell.run.technique.substr(sweep.seriesPrefix.size()),
                     cell.series,
                     join(settings),
                     0,
                     0,
                     0.0,
                     0.0,
                     {}});
      points.emplace_back();
    }
    Scaling& scaling = out[place->second];
    if (!cell.isDrawn() || !(*cell.x > 0.0) || !(*cell.y > 0.0)) {
      ++scaling.leftOut;
      continue;
    }
    points[place->second].emplace_back(*cell.x, *cell.y);
  }
  for (size_t i = 0; i < out.size(); ++i) {
    Scaling& scaling = out[i];
    scaling.n = points[i].size();
    if (points[i].empty()) continue;
    const auto [low, high] = std::minmax_element(points[i].begin(), points[i].end());
    scaling.xLow = low->first, scaling.xHigh = high->first;
    scaling.law = fitPowerLaw(points[i]);
  }
  return out;
}

ResultTable tableOf(const Sweep& sweep, const std::vector<Scaling>& scalings) {
  return TableOf("scalings", "", scalings)
      .add(text("scene", "Scene"), &Scaling::scene)
      .add(forData(text("technique")), &Scaling::technique)
      .add(html("Technique"),
           [](const Scaling& one) { return markerSvg(one.series) + breakable(one.technique); })
      .add(ifAny(text("settings", "Settings")),
           [](const Scaling& one) { return one.settings.empty() ? ResultCell() : ResultCell(one.settings); })
      .add(integer("n", "Runs"), &Scaling::n)
      .add(ifAny(integer("left_out", "Left out")), when(&Scaling::leftOut, &Scaling::leftOut))
      .add(rounded("x_low", "Least " + sweep.x.label()), when(&Scaling::n, &Scaling::xLow))
      .add(rounded("x_high", "Largest " + sweep.x.label()), when(&Scaling::n, &Scaling::xHigh))
      .add(number("exponent", "Exponent"), at(&Scaling::law, &PowerLaw::exponent))
      .add(interval("exponent"), at(&Scaling::law, &PowerLaw::exponent95))
      .add(rounded("factor", "Factor"), at(&Scaling::law, &PowerLaw::factor))
      .add(number("departure", "Largest departure, times", 2), at(&Scaling::law, &PowerLaw::departure));
}

}  // namespace limen::analysis
