// SPDX-License-Identifier: BSD-3-Clause
//
// Reference values, computed with 34 decimal digits from the printed equations (reference/README.md), and a
// selection of them typed from print, should the table be replaced.
#include "vision_vectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace limen::perception {
namespace {

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
  std::ifstream file(LIMEN_SOURCE_DIR "/tests/perception/reference/vision_vectors.csv");
  ASSERT_TRUE(file);
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

// Printed with `digits` significant digits in the specification's tables.
struct Printed {
  const char* function;
  std::vector<double> arguments;
  double value;
  int digits;
};

void check(const Printed& row) {
  const double got = vectorFunctions().at(row.function)(row.arguments);
  std::string arguments;
  for (const double argument : row.arguments) arguments += " " + std::to_string(argument);
  // Half a unit of the last digit printed.
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(row.value))) - row.digits + 1);
  EXPECT_NEAR(got, row.value, 0.5001 * unit) << row.function << arguments;
}

TEST(VisionVectors, PeaksOfLuminanceCsfs) {
  const struct {
    double l, b89Cpd, b89, b03Cpd, b03;
  } kRows[] = {{0.01, 0.905, 62.49, 0.466, 67.43},  {0.1, 1.279, 136.6, 0.750, 156.7},
               {1.0, 1.804, 262.6, 1.206, 318.7},   {10.0, 2.515, 401.8, 1.909, 525.4},
               {100.0, 3.248, 525.2, 2.814, 685.0}, {1000.0, 3.553, 575.1, 3.446, 750.3}};
  for (const auto& row : kRows) {
    check({"peak_rho_B89", {row.l}, row.b89Cpd, row.l < 0.05 ? 3 : 4});
    check({"peak_val_B89", {row.l}, row.b89, 4});
    check({"peak_rho_B03", {row.l, 187.0}, row.b03Cpd, row.l < 0.5 ? 3 : 4});
    check({"peak_val_B03", {row.l, 187.0}, row.b03, 4});
  }
}

TEST(VisionVectors, PeaksOfDaly98) {
  const struct {
    double v, cpd, value;
    int cpdDigits, digits;
  } kRows[] = {{0.1, 5.0246, 237.56, 5, 5},  {0.15, 4.8352, 245.44, 5, 5}, {0.5, 3.8257, 248.29, 5, 5},
               {1.0, 2.9468, 250.64, 5, 5},  {2.0, 2.0191, 231.23, 5, 5},  {8.0, 0.6989, 148.31, 4, 5},
               {16.0, 0.3734, 129.69, 4, 5}, {32.0, 0.1933, 114.79, 4, 5}, {80.0, 0.0790, 91.17, 3, 4}};
  for (const auto& row : kRows) {
    check({"peak_rho_D98", {row.v, 0.67, 1.7}, row.cpd, row.cpdDigits});
    check({"peak_val_D98", {row.v, 1.14, 0.67, 1.7}, row.value, row.digits});
  }
}

TEST(VisionVectors, LuminanceAdaptation) {
  const struct {
    double l, c0, c1, pupil, illuminance, scale;
  } kRows[] = {{0.01, 0.11223, 4.04902, 6.9921, 0.3840, 0.03526},
               {0.1, 0.26081, 2.51217, 6.1398, 2.9608, 0.09792},
               {1.0, 0.53049, 1.56355, 5.0000, 19.635, 0.25217},
               {10.0, 0.87440, 0.98776, 3.8602, 117.03, 0.61563},
               {35.0, 1.03787, 0.78692, 3.3516, 308.79, 1.0},
               {100.0, 1.14, 0.67, 3.0079, 710.58, 1.51698},
               {250.0, 1.20001, 0.60226, 2.7683, 1504.7, 2.20747},
               {1000.0, 1.24868, 0.54713, 2.4990, 4904.95, 3.98556}};
  for (const auto& row : kRows) {
    EXPECT_NEAR(vectorFunctions().at("c0")({row.l, 187.0}), row.c0, 5.1e-6);
    EXPECT_NEAR(vectorFunctions().at("c1")({row.l, 187.0}), row.c1, 5.1e-6);
    EXPECT_NEAR(vectorFunctions().at("pupil_diameter_mm")({row.l}), row.pupil, 5.1e-5);
    check({"retinal_illuminance_td", {row.l}, row.illuminance, row.l < 0.05 ? 4 : row.l > 500.0 ? 6 : 5});
    EXPECT_NEAR(vectorFunctions().at("chroma_scale")({row.l, 35.0}), row.scale, 5.1e-6);
  }
}

TEST(VisionVectors, ThresholdsAndResponses) {
  for (const Printed& row : std::vector<Printed>{{"tvi_W", {1e-4}, 0.00138038, 6},
                                                 {"tvi_W", {0.01}, 0.00547234, 6},
                                                 {"tvi_W", {0.1}, 0.0402717, 6},
                                                 {"tvi_W", {1.0}, 0.391302, 6},
                                                 {"tvi_W", {10.0}, 1.07190, 6},
                                                 {"tvi_W", {100.0}, 5.55904, 6},
                                                 {"tvi_W", {1000.0}, 55.5904, 6},
                                                 {"tvi_B89", {0.01}, 0.000160034, 6},
                                                 {"tvi_B89", {100.0}, 0.190420, 6},
                                                 {"cvi_W", {100.0}, 0.0555904, 6},
                                                 {"T_D", {1.0, 0.0153, 392.498, 4.0, 0.7}, 1.1897247, 8},
                                                 {"T_D", {10.0, 0.0153, 392.498, 4.0, 0.7}, 5.018211823, 10},
                                                 {"T_L", {10.0, 2.2, 0.2}, 3.138402361, 10},
                                                 {"T_L", {0.5, 2.2, 0.2}, 0.348, 3},
                                                 {"T_L", {1.2, 2.2, 0.2}, 1.224, 4},
                                                 {"T_popping", {0.1}, 0.0999900055, 9},
                                                 {"T_popping", {0.5}, 0.4941453946, 10},
                                                 {"T_popping", {1.0}, 0.9330330, 7},
                                                 {"T_popping", {2.0}, 1.605483124, 10},
                                                 {"T_popping", {5.0}, 3.082711978, 10},
                                                 {"T_popping", {10.0}, 5.011371424, 10},
                                                 {"T_popping", {100.0}, 25.11886180, 10},
                                                 {"T_popping", {-3.7}, -2.493975421, 10},
                                                 {"F_orig", {0.6}, 1.0, 2},
                                                 {"F_actualL", {5.0, 100.0}, 1.1003, 5},
                                                 {"F_actualL", {10.0, 100.0}, 2.0393, 5},
                                                 {"F_actualL", {20.0, 100.0}, 6.7356, 5},
                                                 {"F_actualL", {0.6, 100.0}, 2.3479, 5}})
    check(row);
}

TEST(VisionVectors, SingleValues) {
  for (const Printed& row :
       std::vector<Printed>{{"csf_B89", {60.0, 100.0}, 0.297, 3},
                            {"csf_B03", {60.0, 100.0, 187.0}, 0.159, 3},
                            {"csf_M92_L", {60.0, 100.0}, 4.88, 3},
                            {"csf_M92_L", {60.0, 1e5}, 8.7e6, 2},
                            {"csf_M92_L", {0.01, 100.0}, 2.5e-9, 2},
                            {"csf_M92_RG", {0.2, 1.0}, 35.69, 4},
                            {"csf_M92_RG", {0.2, 10.0}, 112.9, 4},
                            {"csf_M92_RG", {0.2, 100.0}, 356.9, 4},
                            {"csf_M92_RG", {0.2, 500.0}, 504.2, 4},
                            {"csf_M92_RG", {4.0, 100.0}, 72.82, 4},
                            {"csf_M92_BY", {0.2, 1.0}, 60.03, 4},
                            {"csf_M92_BY", {0.2, 500.0}, 848.0, 4},
                            {"csf_M92_BY", {4.0, 100.0}, 137.9, 4},
                            {"csf_K83", {0.1, 0.15}, 7.75, 3},
                            {"csf_K83", {30.0, 32.0}, 3e-115, 1},
                            {"csf_Daly93", {3.0, 0.0, 100.0, 187.0, 0.6, 0.0}, 235.19193637, 11},
                            {"csf_Daly93", {8.0, 22.5, 100.0, 187.0, 0.6, 0.0}, 114.93775533, 11},
                            {"csf_Daly93", {8.0, 0.0, 100.0, 187.0, 0.6, 5.0}, 36.012882590, 11},
                            {"csf_B89_size", {3.0, 100.0, 2.0}, 257.06498815, 11},
                            {"ppd_center", {0.6, 0.000254}, 41.229, 5},
                            {"srgb_eotf", {0.5}, 0.21404114048, 11},
                            {"grey_luminance", {0.5, 0.5, 250.0}, 53.903264550, 11},
                            {"pw_ext_mask", {-3.0, 1.2, 0.7, 1.0}, -0.98075876362, 11},
                            {"dE94", {50, 20, 10, 52, 18, 13}, 3.3588788437, 11},
                            {"dE94", {10, 1, 1, 90, -1, -1}, 80.047929962, 11}})
    check(row);
}

}  // namespace
}  // namespace limen::perception
