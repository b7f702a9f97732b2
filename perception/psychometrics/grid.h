// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace limen::psychometrics {

/// Values of one stimulus or parameter dimension, ascending, all different.
struct GridAxis {
  std::string name;
  std::string unit;  ///< "" for pure numbers
  std::vector<double> values;
  bool logarithmic = false;  ///< logarithmically spaced, as are the borders between values

  size_t size() const { return values.size(); }
};

/// `count` >= 2 values from `from` to `to`, both exact.
std::vector<double> linearValues(double from, double to, size_t count);
/// The same, logarithmically spaced; 0 < from < to.
std::vector<double> logarithmicValues(double from, double to, size_t count);

/// Reads an axis: a number, a list of numbers in ascending order, or an object with
///     from, to             exact end points
///     step or count        of the values; a step is in log10 units if the spacing is "log" and has to divide
///     the range spacing              "linear" (default) or "log" unit                 text
/// or with `values` (a number or a list) and `unit`. Throws Error that names `where` and the key.
GridAxis readAxis(const nlohmann::json& json, const std::string& name, const std::string& where);

/// An object that readAxis() reads back to the same axis, every value written out.
nlohmann::json toJson(const GridAxis& axis);

/// Points of a product of axes, the last axis fastest. A point's index is its position in that order.
class ProductGrid {
 public:
  explicit ProductGrid(std::vector<GridAxis> axes);

  const std::vector<GridAxis>& axes() const { return axes_; }
  size_t dimensions() const { return axes_.size(); }
  size_t size() const { return size_; }
  /// Index on axis `dimension` of point `point`.
  size_t indexOf(size_t point, size_t dimension) const {
    return point / strides_[dimension] % axes_[dimension].size();
  }
  double valueOf(size_t point, size_t dimension) const {
    return axes_[dimension].values[indexOf(point, dimension)];
  }
  std::vector<double> valuesOf(size_t point) const;
  /// The point with exactly these values, or size() if there is none.
  size_t find(const std::vector<double>& values) const;

 private:
  std::vector<GridAxis> axes_;
  std::vector<size_t> strides_;
  size_t size_ = 1;
};

}  // namespace limen::psychometrics
