// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/model_commands.h"
#include "perception/vision/csf_data.h"

namespace limen::perception {
namespace {

struct ErrorOptions {
  std::vector<std::string> files, models;
  std::string leastVelocity = "0.15", distance = "0.6";
  bool json = false;
};

struct Set {
  std::string name;
  std::vector<CsfMeasurement> data;
};

/// One per data set, in order of appearance, and one for all if there are several.
std::vector<Set> readSets(const ErrorOptions& options, double distanceM) {
  std::vector<Set> out;
  Set all{"all", {}};
  for (const std::string& file : options.files)
    for (CsfMeasurement one : readCsfData(file)) {
      one.point.distanceM = distanceM;
      auto set =
          std::find_if(out.begin(), out.end(), [&](const Set& known) { return known.name == one.dataset; });
      if (set == out.end()) set = out.insert(out.end(), Set{one.dataset, {}});
      set->data.push_back(one);
      all.data.push_back(std::move(one));
    }
  if (out.size() > 1) out.push_back(std::move(all));
  return out;
}

double positive(const std::string& text, const std::string& option) {
  const double value = readNumber(text, option);
  if (value > 0.0) return value;
  throw Error("'" + text + "' is not above 0", option, "give a positive number");
}

void runError(const ErrorOptions& options) {
  const double least = readNumber(options.leastVelocity, "--least-velocity");
  if (least < 0.0) throw Error("'" + options.leastVelocity + "' is negative", "--least-velocity");
  const std::vector<Set> sets = readSets(options, positive(options.distance, "--distance"));
  // Measurements of luminance say nothing about chromatic models, unless those were requested.
  const std::vector<std::string> models =
      options.models.empty() ? csfNames(Channel::Achromatic) : options.models;
  nlohmann::json results = nlohmann::json::array();
  struct Line {
    std::string model;
    std::vector<CsfError> errors;
  };
  std::vector<Line> lines;
  for (const std::string& name : models) {
    const CsfInfo& info = CsfRegistry::instance().get(name, "csf-error");
    const std::unique_ptr<Csf> csf = makeCsf(name);
    Line line{name, {}};
    for (const Set& set : sets) {
      const CsfError error = csfError(info, *csf, set.data, least);
      line.errors.push_back(error);
      // Without predictions the error is not 0.
      const auto number = [&](double db) { return error.count == 0 ? nlohmann::json() : nlohmann::json(db); };
      results.push_back({{"model", name},
                         {"model_version", info.version},
                         {"dataset", set.name},
                         {"count", error.count},
                         {"unpredicted", error.unpredicted},
                         {"outside_valid_range", error.outside},
                         {"gain_db", number(error.gainDb)},
                         {"rms_db", number(error.rmsDb)},
                         {"largest_db", number(error.largestDb)}});
    }
    lines.push_back(std::move(line));
  }
  if (options.json)
    return printJson({{"results", results},
                      {"files", options.files},
                      {"unit", "dB, 20 lg of sensitivity"},
                      {"least_velocity_deg_s", least}});
  // Best first, by the last column, which is all data.
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    const CsfError &first = a.errors.back(), &second = b.errors.back();
    return (first.count > 0) != (second.count > 0) ? first.count > 0 : first.rmsDb < second.rmsDb;
  });
  std::printf("RMS error [dB] after one gain for each model and column (in brackets)\n\n%-16s", "");
  for (const Set& set : sets)
    std::printf("  %22s", fmt::format("{:.14} ({})", set.name, set.data.size()).c_str());
  std::printf("\n");
  bool unpredicted = false;
  for (const Line& line : lines) {
    std::printf("%-16s", line.model.c_str());
    for (const CsfError& error : line.errors) {
      unpredicted = unpredicted || error.unpredicted > 0;
      std::printf(
          "  %21s%s",
          (error.count == 0 ? "-" : fmt::format("{:.2f} ({:+.1f})", error.rmsDb, error.gainDb)).c_str(),
          error.unpredicted > 0 ? "!" : " ");
    }
    std::printf("\n");
  }
  std::printf(
      "\nStimuli slower than %s deg/s are treated as that fast: the effect of the eye's drift on static "
      "ones.\n",
      shortestNumber(least).c_str());
  if (unpredicted)
    std::printf(
        "! left out: measurements at 0 cpd and those for which the model says 0; --json counts them\n");
}

}  // namespace

void addCsfErrorCommand(CLI::App& app) {
  const auto options = std::make_shared<ErrorOptions>();
  CLI::App* command =
      app.add_subcommand("csf-error", "Errors of contrast sensitivity models against measured thresholds.");
  command
      ->add_option("DATA", options->files,
                   "comma-separated values with columns luminance, s_frequency, sensitivity, and if known "
                   "t_frequency, area or ge_sigma, orientation, eccentricity, dataset")
      ->required();
  command
      ->add_option("--model", options->models,
                   "model to evaluate; may be repeated (default: all achromatic models)")
      ->take_all();
  command
      ->add_option("--least-velocity", options->leastVelocity,
                   "slower stimuli are treated as having this velocity [deg/s]")
      ->capture_default_str();
  command->add_option("--distance", options->distance, "viewing distance [m]")->capture_default_str();
  command->add_flag("--json", options->json, "prints one JSON object");
  command->allow_extras();
  command->callback([options, command] {
    refuseExtras(*command);
    runError(*options);
  });
}

}  // namespace limen::perception
