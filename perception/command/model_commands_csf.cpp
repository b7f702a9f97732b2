// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/model_commands.h"

namespace limen::perception {
namespace {

const char* const kUnit = "1 / threshold contrast";
const char* const kDefaultFrequencies = "0.1:60:25";

struct CsfOptions {
  std::vector<std::string> models;
  PointOptions point;
  ConstantOptions constants;
  bool list = false, json = false, csv = false;
  std::string plot;
};

struct Model {
  const CsfInfo* info = nullptr;
  ParameterValues constants;
  std::unique_ptr<Csf> csf;
};

const char* channelName(Channel channel) {
  return channel == Channel::Achromatic ? "achromatic"
         : channel == Channel::RedGreen ? "red-green"
                                        : "blue-yellow";
}

nlohmann::json describe(const CsfInfo& info) {
  nlohmann::json arguments = nlohmann::json::array(), constants = nlohmann::json::array();
  for (const CsfArgument& one : info.arguments)
    arguments.push_back(
        {{"name", one.name}, {"unit", one.unit}, {"valid_low", one.validLow}, {"valid_high", one.validHigh}});
  for (const Parameter& one : info.parameters) constants.push_back(toJson(one));
  return {{"model", info.name},
          {"model_version", info.version},
          {"summary", info.summary},
          {"source", info.source},
          {"channel", channelName(info.channel)},
          {"arguments", arguments},
          {"constants", constants},
          {"unit", kUnit}};
}

void printModels(const CsfOptions& options) {
  std::vector<const CsfInfo*> shown;
  if (options.models.empty())
    for (const auto& [name, info] : CsfRegistry::instance().all()) shown.push_back(&info);
  for (const std::string& name : options.models) shown.push_back(&CsfRegistry::instance().get(name, "csf"));
  if (options.json) {
    nlohmann::json models = nlohmann::json::array();
    for (const CsfInfo* info : shown) models.push_back(describe(*info));
    printJson({{"models", models}});
    return;
  }
  for (const CsfInfo* info : shown) {
    std::printf("%s (%s)\n  %s\n  Source: %s\n  Valid:", info->name.c_str(), channelName(info->channel),
                info->summary.c_str(), info->source.c_str());
    for (const CsfArgument& one : info->arguments)
      std::printf(" %s %s to %s %s%s", optionOf(one.name).c_str(), readable(one.validLow).c_str(),
                  readable(one.validHigh).c_str(), one.unit.c_str(),
                  &one == &info->arguments.back() ? "\n" : ",");
    // All constants only if a model was named: some have dozens.
    if (!options.models.empty()) std::printf("  Constants:\n%s", describeConstants(info->parameters).c_str());
  }
  if (options.models.empty())
    std::printf("\nlimen-perceive csf MODEL --list shows a model's constants, csf MODEL its sensitivity.\n");
}

std::vector<Model> makeModels(const CsfOptions& options) {
  std::vector<Model> out;
  for (const std::string& name : options.models) {
    Model model;
    model.info = &CsfRegistry::instance().get(name, "csf");
    const auto given = options.constants.read(model.info->parameters, name);
    model.constants = ParameterValues(model.info->parameters, given, name);
    model.csf = model.info->make(model.constants);
    out.push_back(std::move(model));
  }
  return out;
}

/// Every combination of the arguments that have several values, except the frequency.
std::vector<CsfPoint> combinations(const CsfOptions& options, std::vector<std::string>& varied) {
  std::vector<CsfPoint> out = {options.point.point()};
  for (const std::string& argument : csfArgumentNames()) {
    if (argument == "frequency_cpd") continue;
    const std::vector<double> values = options.point.values(argument);
    if (values.size() == 1) continue;
    varied.push_back(argument);
    std::vector<CsfPoint> next;
    for (const CsfPoint& point : out)
      for (const double value : values) {
        next.push_back(point);
        argumentOf(next.back(), argument) = value;
      }
    out = std::move(next);
    if (out.size() > 10000) throw Error("too many combinations", optionOf(argument), "give at most 10000");
  }
  return out;
}

bool reads(const CsfInfo& info, const std::string& argument) {
  return std::any_of(info.arguments.begin(), info.arguments.end(),
                     [&](const CsfArgument& one) { return one.name == argument; });
}

/// Arguments that the model does not know: better reported than silently ignored.
std::vector<std::string> ignored(const CsfOptions& options, const CsfInfo& info) {
  std::vector<std::string> out;
  for (const std::string& argument : csfArgumentNames())
    if (options.point.has(argument) && !reads(info, argument)) out.push_back(argument);
  return out;
}

CsfPoint at(CsfPoint point, double frequencyCpd) {
  point.frequencyCpd = frequencyCpd;
  return point;
}

nlohmann::json arguments(const CsfInfo& info, const CsfPoint& point) {
  nlohmann::json out = nlohmann::json::object();
  for (const CsfArgument& one : info.arguments) out[one.name] = argumentOf(point, one.name);
  return out;
}

nlohmann::json peakJson(const Csf& csf, const CsfPoint& point) {
  const Csf::Peak peak = csf.peak(point);
  return {{"frequency_cpd", peak.frequencyCpd}, {"sensitivity", peak.sensitivity}};
}

nlohmann::json head(const CsfOptions& options, const Model& model) {
  return {{"model", model.info->name},
          {"model_version", model.info->version},
          {"source", model.info->source},
          {"unit", kUnit},
          {"constants", model.constants.toJson()},
          {"ignored_arguments", ignored(options, *model.info)}};
}

void printPoint(const CsfOptions& options, const Model& model, const CsfPoint& point) {
  const double value = model.csf->sensitivity(point);
  const std::vector<std::string> outside = outsideValidRange(*model.info, point);
  if (options.json) {
    nlohmann::json out = head(options, model);
    out["value"] = value;
    out["arguments"] = arguments(*model.info, point);
    out["outside_valid_range"] = outside;
    out["peak"] = peakJson(*model.csf, point);
    printJson(out);
    return;
  }
  std::printf("%s\n", shortestNumber(value).c_str());
  for (const std::string& one : outside)
    std::fprintf(stderr, "%s: %s = %s lies outside the model's range\n", model.info->name.c_str(),
                 one.c_str(), shortestNumber(argumentOf(point, one)).c_str());
  for (const std::string& one : ignored(options, *model.info))
    std::fprintf(stderr, "%s does not know %s\n", model.info->name.c_str(), one.c_str());
}

std::string label(const Model& model, const CsfPoint& point, const std::vector<std::string>& varied,
                  bool withModel) {
  std::string out = withModel ? model.info->name : "";
  static const std::map<std::string, std::string> kShort = {
      {"velocity_deg_s", "deg/s"}, {"luminance_cd_m2", "cd/m2"}, {"area_deg2", "deg2"},
      {"width_deg", "deg wide"},   {"orientation_deg", "deg"},   {"eccentricity_deg", "deg off"},
      {"distance_m", "m"}};
  for (const std::string& argument : varied)
    if (reads(*model.info, argument))
      out +=
          (out.empty() ? "" : " ") + shortestNumber(argumentOf(point, argument)) + " " + kShort.at(argument);
  return out.empty() ? model.info->name : out;
}

struct Column {
  const Model* model;
  CsfPoint point;
  std::string label;
};

/// A model that does not depend on what varies has only one column.
std::vector<Column> columnsOf(const std::vector<Model>& models, const std::vector<CsfPoint>& points,
                              const std::vector<std::string>& varied) {
  std::vector<Column> out;
  for (const Model& model : models)
    for (const CsfPoint& point : points) {
      Column column{&model, point, label(model, point, varied, models.size() > 1)};
      const bool known = std::any_of(out.begin(), out.end(), [&](const Column& other) {
        return other.model == column.model && other.label == column.label;
      });
      if (!known) out.push_back(std::move(column));
    }
  return out;
}

void printText(const std::vector<Column>& columns, const std::vector<double>& frequencies) {
  std::vector<int> widths;
  for (const Column& column : columns)
    widths.push_back(std::max<int>(11, static_cast<int>(column.label.size())));
  std::printf("%10s", "cpd");
  for (size_t i = 0; i < columns.size(); ++i) std::printf("  %*s", widths[i], columns[i].label.c_str());
  std::printf("\n");
  bool anyOutside = false;
  for (const double frequency : frequencies) {
    std::printf("%10s", fmt::format("{:.5g}", frequency).c_str());
    for (size_t i = 0; i < columns.size(); ++i) {
      const CsfPoint point = at(columns[i].point, frequency);
      const bool outside = !outsideValidRange(*columns[i].model->info, point).empty();
      anyOutside = anyOutside || outside;
      std::printf(" %s%*s", outside ? "*" : " ", widths[i],
                  readable(columns[i].model->csf->sensitivity(point)).c_str());
    }
    std::printf("\n");
  }
  std::printf("\nPeak\n");
  for (const char* what : {"at cpd", "value"}) {
    std::printf("%10s", what);
    for (size_t i = 0; i < columns.size(); ++i) {
      const Csf::Peak peak = columns[i].model->csf->peak(columns[i].point);
      std::printf("  %*s", widths[i],
                  readable(what[0] == 'a' ? peak.frequencyCpd : peak.sensitivity).c_str());
    }
    std::printf("\n");
  }
  if (anyOutside) std::printf("\n* outside the range that the model's data cover\n");
}

void printCsv(const std::vector<Column>& columns, const std::vector<double>& frequencies) {
  std::printf("model,%s,sensitivity,outside_valid_range\n", join(csfArgumentNames(), ",").c_str());
  for (const Column& column : columns)
    for (const double frequency : frequencies) {
      const CsfPoint point = at(column.point, frequency);
      std::string line = column.model->info->name;
      // Empty if the model does not read the argument.
      for (const std::string& argument : csfArgumentNames())
        line +=
            "," + (reads(*column.model->info, argument) ? shortestNumber(argumentOf(point, argument)) : "");
      std::printf("%s,%s,%s\n", line.c_str(), shortestNumber(column.model->csf->sensitivity(point)).c_str(),
                  join(outsideValidRange(*column.model->info, point), " ").c_str());
    }
}

void printJsonTable(const CsfOptions& options, const std::vector<Column>& columns,
                    const std::vector<double>& frequencies) {
  nlohmann::json curves = nlohmann::json::array();
  for (const Column& column : columns) {
    nlohmann::json curve = head(options, *column.model), rows = nlohmann::json::array();
    for (const double frequency : frequencies) {
      const CsfPoint point = at(column.point, frequency);
      rows.push_back({{"frequency_cpd", frequency},
                      {"value", column.model->csf->sensitivity(point)},
                      {"outside_valid_range", outsideValidRange(*column.model->info, point)}});
    }
    curve["arguments"] = arguments(*column.model->info, column.point);
    curve["arguments"].erase("frequency_cpd");
    curve["rows"] = rows;
    curve["peak"] = peakJson(*column.model->csf, column.point);
    curves.push_back(curve);
  }
  printJson({{"curves", curves}});
}

void plot(const CsfOptions& options, const std::vector<Column>& columns,
          const std::vector<double>& frequencies) {
  Plot out;
  out.title = options.models.size() == 1
                  ? columns[0].model->info->name + ": " + columns[0].model->info->source
                  : "Contrast sensitivity";
  out.xTitle = "spatial frequency [cpd]";
  out.yTitle = "contrast sensitivity";
  for (const Column& column : columns) {
    Plot::Curve curve{column.label, {}};
    for (const double frequency : frequencies) {
      const CsfPoint point = at(column.point, frequency);
      const double value = column.model->csf->sensitivity(point);
      // A contrast above 1 does not exist; anything far below a sensitivity of 1 would only stretch the axis.
      if (value >= 0.1)
        curve.points.push_back({frequency, value, !outsideValidRange(*column.model->info, point).empty()});
    }
    out.curves.push_back(std::move(curve));
  }
  drawPlot(out, options.plot);
}

void runCsf(const CsfOptions& options) {
  if (options.list || options.models.empty()) {
    if (!options.constants.empty() || !options.plot.empty())
      throw Error("no model given", "csf", "write limen-perceive csf MODEL; --list shows them");
    return printModels(options);
  }
  if (options.json && options.csv) throw Error("--json and --csv exclude each other", "csf", "give one");
  const std::vector<Model> models = makeModels(options);
  std::vector<std::string> varied;
  const std::vector<CsfPoint> points = combinations(options, varied);
  const std::vector<double> frequencies = options.point.has("frequency_cpd")
                                              ? options.point.values("frequency_cpd")
                                              : readNumbers(kDefaultFrequencies, "--frequency");
  const bool onePoint = options.point.has("frequency_cpd") && frequencies.size() == 1 && points.size() == 1 &&
                        models.size() == 1 && !options.csv && options.plot.empty();
  if (onePoint) return printPoint(options, models[0], at(points[0], frequencies[0]));
  const std::vector<Column> columns = columnsOf(models, points, varied);
  if (!options.plot.empty()) {
    plot(options, columns,
         options.point.has("frequency_cpd") ? frequencies : readNumbers("0.1:60:200", "--frequency"));
    if (!options.json && !options.csv) {
      std::printf("%s\n", options.plot.c_str());
      return;
    }
  }
  if (options.json) return printJsonTable(options, columns, frequencies);
  if (options.csv) return printCsv(columns, frequencies);
  for (const Model& model : models) {
    std::printf("%s: %s\n", model.info->name.c_str(), model.info->source.c_str());
    const std::vector<std::string> unread = ignored(options, *model.info);
    if (!unread.empty()) std::printf("  does not know %s\n", join(unread).c_str());
  }
  std::printf("\n");
  printText(columns, frequencies);
}

}  // namespace

void addCsfCommand(CLI::App& app) {
  const auto options = std::make_shared<CsfOptions>();
  CLI::App* command =
      app.add_subcommand("csf", "Contrast sensitivity by a model, as a table, a chart or one number.");
  command->add_option("MODEL", options->models, "name of a model, or several; none: a list of them");
  command->add_flag("--list", options->list, "lists the models, or the constants of MODEL");
  options->point.add(*command);
  command->add_flag("--json", options->json, "prints one JSON object");
  command->add_flag("--csv", options->csv, "prints comma-separated values");
  command
      ->add_option("--plot", options->plot,
                   "draws FILE.svg, .png or .pdf; script and data are written beside it")
      ->type_name("FILE");
  std::vector<std::vector<Parameter>> constants;
  for (const auto& [name, info] : CsfRegistry::instance().all()) constants.push_back(info.parameters);
  options->constants.add(*command, constants);
  command->allow_extras();
  command->footer(
      "NUMBERS are a number, several as 1,2,4 or low:high:count, logarithmically spaced.\n"
      "One frequency and no other list prints one value. csf MODEL --list shows the constants of a model.");
  command->callback([options, command] {
    refuseExtras(*command);
    runCsf(*options);
  });
}

}  // namespace limen::perception
