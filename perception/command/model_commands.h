// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "perception/vision/csf.h"

/// What the vision model commands share.
namespace limen::perception {

void addCsfCommand(CLI::App& app);
void addCsfErrorCommand(CLI::App& app);
void addTviCommand(CLI::App& app);
void addMaskingCommand(CLI::App& app);
void addDisplayCommand(CLI::App& app);

enum class Form { Text, Csv, Json };

/// "0.5", "1,2,4" or "0.1:60:25" (this many from low to high, logarithmically spaced). Throws Error
/// naming `option`.
std::vector<double> readNumbers(const std::string& text, const std::string& option);
/// One of them. Throws Error if there are several.
double readNumber(const std::string& text, const std::string& option);

/// Options for the members of CsfPoint; each takes numbers as readNumbers() does.
struct PointOptions {
  std::map<std::string, std::string> given;  ///< by the argument's name
  void add(CLI::App& command);
  bool has(const std::string& argument) const { return !text(argument).empty(); }
  /// Default of CsfPoint if nothing is given.
  std::vector<double> values(const std::string& argument) const;
  /// For arguments with a single value.
  CsfPoint point() const;

 private:
  const std::string& text(const std::string& argument) const { return given.at(argument); }
};
/// "--luminance" for "luminance_cd_m2".
std::string optionOf(const std::string& argument);

/// Options for the constants of models, as --set name=value and --name value (in names - stands for _).
struct ConstantOptions {
  std::vector<std::string> set;
  std::map<std::string, std::string> given;  ///< by name; empty: not given
  /// Adds an option for each name in `declared` for which the command has none yet; help omits them, since
  /// there are too many.
  void add(CLI::App& command, const std::vector<std::vector<Parameter>>& declared);
  bool empty() const;
  /// Throws Error on anything that is not in `declared`, the constants of `model`.
  std::map<std::string, ParameterValue> read(const std::vector<Parameter>& declared,
                                             const std::string& model) const;
};
/// Throws Error on options that the command does not know, naming the nearest of its own.
void refuseExtras(const CLI::App& command);
/// "  --c0 NUMBER  what it is (default 1.14; source)": lines of help.
std::string describeConstants(const std::vector<Parameter>& declared);

/// Prints a JSON object on one line, including the program's version.
void printJson(nlohmann::json object);
/// Six significant digits, for tables that people read.
std::string readable(double value);

/// Curves over x, drawn by gnuplot.
struct Plot {
  std::string title, xTitle, yTitle;
  struct Curve {
    std::string name;
    struct Point {
      double x = 0.0, y = 0.0;
      bool outside = false;  ///< of the model's range: drawn thin
    };
    std::vector<Point> points;
  };
  std::vector<Curve> curves;
};
/// Writes FILE (.svg, .png or .pdf) and beside it the script (.gp) and data (.dat) that made it. Both axes
/// are logarithmic; points not above 0 are omitted. Throws Error.
void drawPlot(const Plot& plot, const std::string& file);

}  // namespace limen::perception
