// SPDX-License-Identifier: BSD-3-Clause
//
// Reference values: computed with 34 decimal digits from the printed equations. The whole table lies beside
// the project in development only; the rows below are printed in the specification and hold everywhere.
#include "vision_vectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace limen::perception {
namespace {

namespace fs = std::filesystem;

struct Row {
  std::string function;
  std::vector<double> arguments;
  double value;
};

// Places of a maximum are computed to fewer digits: the table itself gives them to 14 places.
double toleranceOf(const std::string& function) {
  return function.rfind("peak_rho", 0) == 0 || function == "c1" ? 1e-7 : 1e-9;
}

void check(const Row& row) {
  const double got = vectorFunctions().at(row.function)(row.arguments);
  std::string arguments;
  for (const double argument : row.arguments) arguments += " " + std::to_string(argument);
  // A difference of equal numbers leaves their rounding.
  EXPECT_NEAR(got, row.value, std::abs(row.value) * toleranceOf(row.function) + 1e-14)
      << row.function << arguments;
}

TEST(VisionVectors, WholeTable) {
  const fs::path path =
      fs::path(LIMEN_SOURCE_DIR) / ".." / "shared" / "techniques" / "perception_vectors.csv";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << "the table of reference values is not here";
  std::string line;
  std::getline(file, line);
  std::set<std::string> uncovered;
  int rows = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string function, cell;
    std::getline(cells, function, ',');
    Row row{function, {}, 0.0};
    while (std::getline(cells, cell, ','))
      if (!cell.empty()) row.arguments.push_back(std::stod(cell));
    row.value = row.arguments.back();
    row.arguments.pop_back();
    ++rows;
    if (vectorFunctions().count(function) == 0)
      uncovered.insert(function);
    else
      check(row);
  }
  EXPECT_EQ(rows, 443);
  EXPECT_TRUE(uncovered.empty()) << "no function in vision_vectors.cpp for: " << [&] {
    std::string names;
    for (const std::string& name : uncovered) names += name + " ";
    return names;
  }();
}

}  // namespace
}  // namespace limen::perception
