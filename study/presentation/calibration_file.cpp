// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "experiments/base/error.h"
#include "experiments/base/input_files.h"
#include "experiments/base/replace_file.h"
#include "study/presentation/calibration.h"

namespace limen::study {
namespace {

std::string trimmed(const std::string& text) {
  const char* const kBlank = " \t\r";
  const size_t first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::optional<double> number(const std::string& text) {
  const std::string word = trimmed(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Two numbers separated by one of `separators`.
std::optional<std::pair<double, double>> twoNumbers(const std::string& text, const char* separators) {
  const size_t at = text.find_first_of(separators);
  if (at == std::string::npos) return std::nullopt;
  const auto first = number(text.substr(0, at)), second = number(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

}  // namespace

std::vector<Reading> readReadings(const std::string& path) {
  protectInput(path);
  std::ifstream file(path);
  if (!file) throw Error("cannot be read", path, "name a CSV file of level,cd/m2");
  std::vector<Reading> out;
  std::string line;
  bool headerMayCome = true;
  for (int count = 1; std::getline(file, line); ++count) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto values = twoNumbers(line, ",;\t");
    if (values)
      out.push_back({values->first, values->second});
    else if (!headerMayCome)
      throw Error("'" + line + "' is not two numbers", path + ":" + std::to_string(count),
                  "write a level from 0 to 1, a comma and its luminance in cd/m2");
    headerMayCome = false;
  }
  return out;
}

std::vector<Match> parseMatches(const std::string& text) {
  std::vector<Match> out;
  std::stringstream all(text);
  for (std::string part; std::getline(all, part, ',');) {
    const auto values = twoNumbers(part, "=");
    if (!values)
      throw Error("'" + part + "' is not a match", "--match",
                  "write PROPORTION=LEVEL, as 0.25=0.53,0.5=0.72");
    out.push_back({values->first, values->second});
  }
  return out;
}

void writeProfile(const std::string& path, const perception::DisplayProfile& profile,
                  const std::vector<std::string>& comments, bool force) {
  perception::checkDisplay(profile, path);
  std::error_code failure;
  if (!force && std::filesystem::exists(path, failure))
    throw Error("already exists", path, "name another file, or give --force to overwrite it");
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  replaceFile(path, text + perception::toYaml(profile));
}

}  // namespace limen::study
