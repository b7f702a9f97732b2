// SPDX-License-Identifier: BSD-3-Clause
#include "perception/psychometrics/grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::psychometrics {
namespace {

using nlohmann::json;

constexpr size_t kMostValues = 1'000'000;  // per axis; more points to a wrong step

const char* const kAllowed =
    "a number, a list of ascending numbers, or {from, to, step or count, spacing, unit}";

double finiteNumber(const json& value, const std::string& where) {
  if (!value.is_number()) throw Error("found " + value.dump() + ", not a number", where, "give a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw Error("the number is not finite", where, "give a finite number");
  return number;
}

std::vector<double> readList(const json& list, const std::string& where) {
  if (list.is_number()) return {finiteNumber(list, where)};
  if (!list.is_array()) throw Error("found " + list.dump(), where, std::string("give ") + kAllowed);
  if (list.empty()) throw Error("the list of values is empty", where, std::string("give ") + kAllowed);
  std::vector<double> values;
  for (const json& entry : list) {
    values.push_back(finiteNumber(entry, where));
    if (values.size() > 1 && !(values.back() > values[values.size() - 2])) {
      throw Error(shortestNumber(values.back()) + " is not above the value before it", where,
                  "list the values in ascending order, each once");
    }
  }
  return values;
}

size_t countFromStep(double from, double to, double step, bool logarithmic, const std::string& where) {
  if (!(step > 0.0)) throw Error("the step is not above 0", where + ".step", "give a positive step");
  const double range = logarithmic ? std::log10(to) - std::log10(from) : to - from;
  const double steps = range / step;
  if (!(steps < static_cast<double>(kMostValues))) {
    throw Error("the step gives " + shortestNumber(std::floor(steps) + 1.0) + " values", where + ".step",
                "give at most a million values");
  }
  const double whole = std::max(1.0, std::round(steps));
  if (std::abs(steps - whole) > 1e-6 * whole) {
    throw Error("a step of " + shortestNumber(step) + " does not lead from " + shortestNumber(from) + " to " +
                    shortestNumber(to),
                where + ".step", "take " + shortestNumber(range / whole) + ", or give the count");
  }
  return static_cast<size_t>(whole) + 1;
}

size_t readCount(const json& value, const std::string& where) {
  const bool whole = value.is_number_integer() && value.get<double>() >= 2.0 &&
                     value.get<double>() <= static_cast<double>(kMostValues);
  if (!whole) throw Error("found " + value.dump(), where, "give a whole number from 2 to a million");
  return value.get<size_t>();
}

std::string readUnit(const json& object, const std::string& where) {
  if (!object.contains("unit")) return {};
  if (!object["unit"].is_string()) throw Error("the unit is not a text", where + ".unit", "give a text");
  return object["unit"].get<std::string>();
}

void readRange(const json& object, const std::string& where, GridAxis& axis) {
  for (const char* key : {"from", "to"}) {
    if (!object.contains(key)) {
      throw Error(std::string("'") + key + "' is missing", where, std::string("give ") + kAllowed);
    }
  }
  if (object.contains("step") == object.contains("count")) {
    throw Error("exactly one of 'step' and 'count' is needed", where);
  }
  const double from = finiteNumber(object["from"], where + ".from");
  const double to = finiteNumber(object["to"], where + ".to");
  if (!(from < to)) throw Error("'from' is not below 'to'", where, "list a single value as a number");
  if (object.contains("spacing")) {
    const json& spacing = object["spacing"];
    if (spacing != "linear" && spacing != "log") {
      throw Error("no spacing " + spacing.dump(), where + ".spacing", "give linear or log");
    }
    axis.logarithmic = spacing == "log";
  }
  if (axis.logarithmic && !(from > 0.0)) {
    throw Error("logarithmic spacing needs values above 0", where + ".from",
                "raise it or use linear spacing");
  }
  const size_t count =
      object.contains("count")
          ? readCount(object["count"], where + ".count")
          : countFromStep(from, to, finiteNumber(object["step"], where + ".step"), axis.logarithmic, where);
  axis.values = axis.logarithmic ? logarithmicValues(from, to, count) : linearValues(from, to, count);
}

}  // namespace

std::vector<double> linearValues(double from, double to, size_t count) {
  assert(count >= 2);
  std::vector<double> values(count);
  const auto last = static_cast<double>(count - 1);
  // Weights of both ends, so that rounding of the step does not accumulate.
  for (size_t i = 0; i < count; ++i) {
    const auto place = static_cast<double>(i);
    values[i] = (from * (last - place) + to * place) / last;
  }
  values.front() = from;
  values.back() = to;
  return values;
}

std::vector<double> logarithmicValues(double from, double to, size_t count) {
  assert(from > 0.0 && to > from);
  std::vector<double> values = linearValues(std::log(from), std::log(to), count);
  for (double& value : values) value = std::exp(value);
  values.front() = from;
  values.back() = to;
  return values;
}

GridAxis readAxis(const json& source, const std::string& name, const std::string& where) {
  GridAxis axis;
  axis.name = name;
  if (!source.is_object()) {
    axis.values = readList(source, where);
    return axis;
  }
  const bool listed = source.contains("values");
  const std::vector<std::string> known =
      listed ? std::vector<std::string>{"values", "unit", "spacing"}
             : std::vector<std::string>{"from", "to", "step", "count", "spacing", "unit"};
  for (const auto& [key, value] : source.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw Error("unknown key '" + key + "'", where, suggest(key, known));
    }
  }
  axis.unit = readUnit(source, where);
  if (!listed) {
    readRange(source, where, axis);
    return axis;
  }
  axis.values = readList(source["values"], where + ".values");
  if (source.contains("spacing")) {
    if (source["spacing"] != "linear" && source["spacing"] != "log") {
      throw Error("no spacing " + source["spacing"].dump(), where + ".spacing", "give linear or log");
    }
    axis.logarithmic = source["spacing"] == "log";
    if (axis.logarithmic && !(axis.values.front() > 0.0)) {
      throw Error("logarithmic spacing needs values above 0", where + ".values");
    }
  }
  return axis;
}

json toJson(const GridAxis& axis) {
  json out = {{"values", axis.values}};
  if (!axis.unit.empty()) out["unit"] = axis.unit;
  if (axis.logarithmic) out["spacing"] = "log";
  return out;
}

ProductGrid::ProductGrid(std::vector<GridAxis> axes) : axes_(std::move(axes)), strides_(axes_.size()) {
  for (size_t d = axes_.size(); d-- > 0;) {
    assert(!axes_[d].values.empty());
    strides_[d] = size_;
    size_ *= axes_[d].size();
  }
}

std::vector<double> ProductGrid::valuesOf(size_t point) const {
  std::vector<double> values(axes_.size());
  for (size_t d = 0; d < axes_.size(); ++d) values[d] = valueOf(point, d);
  return values;
}

size_t ProductGrid::find(const std::vector<double>& values) const {
  assert(values.size() == axes_.size());
  size_t point = 0;
  for (size_t d = 0; d < axes_.size(); ++d) {
    const std::vector<double>& known = axes_[d].values;
    const auto found = std::lower_bound(known.begin(), known.end(), values[d]);
    if (found == known.end() || *found != values[d]) return size_;
    point += static_cast<size_t>(found - known.begin()) * strides_[d];
  }
  return point;
}

}  // namespace limen::psychometrics
