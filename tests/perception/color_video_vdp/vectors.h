// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "perception/metrics/color_video_vdp/comparison_input.h"

namespace limen::perception::cvvdp {

/// Rows of a CSV file by column name. Quotes are not used in these files.
using Row = std::map<std::string, std::string>;
std::vector<Row> readRows(const std::string& file);
double number(const Row& row, const std::string& column);

/// A pair with a published score (reference/README.md).
struct Vector {
  std::string id;
  Row row;
  double jod = 0.0, jodFixed = 0.0, difference = 0.0;
  Options options;
  Pair pair() const;  ///< its images are made when asked for; refers to this object
  double sumOf(bool test) const;

 private:
  friend std::vector<Vector> readVectors();
  double value(const std::string& parameter) const { return parameters_.at(parameter); }
  Image image(bool test, int frame) const;
  double sample(bool test, int frame, int x, int y, int c) const;
  double reference(int frame, int x, int y, int c) const;
  double random(int frame, int x, int y, int c) const;
  double bar(int frame, double speed, int x) const;

  std::map<std::string, double> parameters_;
  std::map<std::string, std::string> words_;
  int width_ = 0, height_ = 0, frames_ = 1;
  std::vector<double> random_;
};

std::vector<Vector> readVectors();
const Vector& vectorOf(const std::string& id);
/// Names of the vectors, known without their file so that tests exist, and fail, without it.
std::vector<std::string> vectorIds(const std::set<std::string>& without = {});

}  // namespace limen::perception::cvvdp
