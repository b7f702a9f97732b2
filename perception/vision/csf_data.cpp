// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/csf_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::perception {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == ',')
      out.emplace_back();
    else if (c != '\r' && c != '"')
      out.back() += c;
  }
  return out;
}

/// One line's cells by the names in the header.
class Row {
 public:
  Row(const std::map<std::string, size_t>& columns, std::vector<std::string> cells, std::string where)
      : columns_(columns), cells_(std::move(cells)), where_(std::move(where)) {}

  double number(const std::string& column, double low, double otherwise) const {
    const auto entry = columns_.find(column);
    if (entry == columns_.end()) return otherwise;
    const std::string& cell = cells_[entry->second];
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value) || value < low)
      throw Error("'" + column + "' is '" + cell + "'", where_,
                  "give a number of at least " + shortestNumber(low));
    return value;
  }
  double positive(const std::string& column) const {
    const double value = number(column, 0.0, 0.0);
    if (value > 0.0) return value;
    throw Error("'" + column + "' is not above 0", where_, "give a positive number");
  }
  bool has(const std::string& column) const { return columns_.count(column) != 0; }
  const std::string& text(const std::string& column) const { return cells_[columns_.at(column)]; }

 private:
  const std::map<std::string, size_t>& columns_;
  std::vector<std::string> cells_;
  std::string where_;
};

}  // namespace

std::vector<CsfMeasurement> readCsfData(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::ifstream file(path);
  if (!fs::is_regular_file(path, error) || !file)
    throw Error("is not a readable file", path, "give measurements as comma-separated values");
  std::map<std::string, size_t> columns;
  std::vector<CsfMeasurement> out;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line[0] == '#' || line == "\r") continue;
    const std::string where = path + ":" + std::to_string(number);
    std::vector<std::string> cells = split(line);
    if (columns.empty()) {
      for (size_t i = 0; i < cells.size(); ++i)
        if (!columns.emplace(cells[i], i).second)
          throw Error("two columns are headed '" + cells[i] + "'", where, "head each column differently");
      for (const char* needed : {"luminance", "s_frequency", "sensitivity"})
        if (columns.count(needed) == 0)
          throw Error(std::string("no column '") + needed + "'", where, suggest(needed, cells));
      continue;
    }
    if (cells.size() != columns.size())
      throw Error(std::to_string(cells.size()) + " cells under " + std::to_string(columns.size()) + " heads",
                  where, "each line needs one cell per column");
    const Row row(columns, std::move(cells), where);
    CsfMeasurement one;
    one.line = number;
    one.dataset = row.has("dataset") ? row.text("dataset") : fs::path(path).stem().string();
    one.point.frequencyCpd = row.number("s_frequency", 0.0, 0.0);
    const double hertz = row.number("t_frequency", 0.0, 0.0);
    one.point.velocityDegS = one.point.frequencyCpd > 0.0 ? hertz / one.point.frequencyCpd : 0.0;
    one.point.luminanceCdM2 = row.positive("luminance");
    if (row.has("area")) {
      one.point.areaDeg2 = row.positive("area");
    } else if (row.has("ge_sigma")) {
      const double sigma = row.positive("ge_sigma");
      one.point.areaDeg2 = std::numbers::pi * sigma * sigma;
    }
    one.point.widthDeg = std::sqrt(one.point.areaDeg2);
    one.point.orientationDeg = row.number("orientation", -360.0, 0.0);
    one.point.eccentricityDeg = row.number("eccentricity", 0.0, 0.0);
    one.sensitivity = row.positive("sensitivity");
    out.push_back(std::move(one));
  }
  if (out.empty()) throw Error("holds no measurement", path, "a header and at least one line are needed");
  return out;
}

CsfError csfError(const CsfInfo& info, const Csf& csf, const std::vector<CsfMeasurement>& data,
                  double leastVelocityDegS) {
  CsfError out;
  std::vector<double> differences;
  for (const CsfMeasurement& one : data) {
    CsfPoint point = one.point;
    point.velocityDegS = std::max(point.velocityDegS, leastVelocityDegS);
    const double predicted = point.frequencyCpd > 0.0 ? csf.sensitivity(point) : 0.0;
    if (!outsideValidRange(info, point).empty()) ++out.outside;
    if (predicted > 0.0)
      differences.push_back(20.0 * std::log10(one.sensitivity / predicted));
    else
      ++out.unpredicted;
  }
  out.count = differences.size();
  if (differences.empty()) return out;
  for (const double difference : differences) out.gainDb += difference;
  out.gainDb /= static_cast<double>(out.count);
  for (const double difference : differences) {
    const double rest = difference - out.gainDb;
    out.rmsDb += rest * rest;
    out.largestDb = std::max(out.largestDb, std::abs(rest));
  }
  out.rmsDb = std::sqrt(out.rmsDb / static_cast<double>(out.count));
  return out;
}

}  // namespace limen::perception
