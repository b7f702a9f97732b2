// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/number_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace limen::viewer {

std::string numberText(double value) {
  if (std::isnan(value)) return "";
  const double size = std::abs(value);
  std::array<char, 32> text{};
  if (value == std::trunc(value) && size < 1e4) {
    std::snprintf(text.data(), text.size(), "%.0f", size == 0.0 ? 0.0 : value);
    return text.data();
  }
  std::snprintf(text.data(), text.size(), "%.4g", value);
  std::string out = text.data();
  // A single digit says less than is known: 0.5 is 0.50 here.
  std::snprintf(text.data(), text.size(), "%#.2g", value);
  const std::string two = text.data();
  const auto hasExponent = [](const std::string& number) { return number.find('e') != std::string::npos; };
  if (two.back() != '.' && two.size() > out.size() && hasExponent(two) == hasExponent(out)) return two;
  return out;
}

std::string bytesText(int64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  size_t unit = 0;
  // 999.6 would be printed as 1000.
  for (; unit + 1 < kUnits.size() && value >= 999.5; ++unit) value *= 1e-3;
  const int decimals = unit == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f %s", decimals, value, kUnits.at(unit));
  return text.data();
}

}  // namespace limen::viewer
