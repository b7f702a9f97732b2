// SPDX-License-Identifier: BSD-3-Clause
//
// Thresholds over luminance and responses over contrast.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "perception/command/model_commands.h"
#include "perception/vision/masking.h"
#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

struct TviOptions {
  std::string model, csf = "barten89", luminance;
  PointOptions point;
  ConstantOptions constants;
  bool scaled = false, cvi = false, list = false, json = false, csv = false;
  std::string plot;
};

void listTvi(bool json) {
  const std::vector<std::pair<std::string, std::string>> kSources = {
      {"ward",
       "Ward et al. 1997; Schwarz 2009, (9.6). Two downward steps: 2.8 % at 0.0363 and 0.7 % at 79.4 cd/m2"},
      {"ward_smoothed", "the same without the steps: branches shifted to meet, starting at 100 cd/m2"},
      {"from_csf", "L / largest sensitivity at L of --csf MODEL; Schwarz 2009, section 9.1.1"},
      {"from_csf_scaled",
       "the same, scaled to match Ward's at 100 cd/m2 (--scaled); Schwarz 2009, figure 9.3"}};
  nlohmann::json models = nlohmann::json::array();
  for (const auto& [name, source] : kSources) {
    models.push_back({{"model", name}, {"source", source}});
    if (!json) std::printf("%-16s %s\n", name.c_str(), source.c_str());
  }
  if (json) printJson({{"models", models}});
}

std::string tviSource(const std::string& model, const CsfInfo& info) {
  if (model.rfind("from_csf", 0) == 0)
    return (model == "from_csf" ? "L / max csf" : "L / max csf, scaled to Ward et al. 1997 at 100 cd/m2") +
           std::string("; csf: ") + info.source;
  return model == "ward" ? "Ward et al. 1997; Schwarz 2009, (9.6)"
                         : "Ward et al. 1997; Schwarz 2009, (9.6), steps taken out";
}

void runTvi(const TviOptions& options) {
  if (options.list || options.model.empty()) return listTvi(options.json);
  std::string model = options.model;
  const bool fromCsf = model.rfind("from_csf", 0) == 0;
  if (options.scaled) {
    if (!fromCsf)
      throw Error("only a TVI from a CSF can be scaled", "--scaled", "write tvi from_csf --scaled");
    model = "from_csf_scaled";
  }
  const CsfInfo& info = CsfRegistry::instance().get(options.csf, "--csf");
  const auto constants = options.constants.read(fromCsf ? info.parameters.get() : std::vector<Parameter>(),
                                                fromCsf ? info.name : model);
  const std::shared_ptr<const Csf> csf = info.make(ParameterValues(info.parameters, constants, info.name));
  CsfPoint point = options.point.point();
  const auto tvi = makeTvi(model, csf, point, "tvi");
  const bool one = options.point.has("luminance_cd_m2") && options.plot.empty() && !options.csv &&
                   options.point.values("luminance_cd_m2").size() == 1;
  const std::vector<double> luminances = options.point.has("luminance_cd_m2")
                                             ? options.point.values("luminance_cd_m2")
                                             : readNumbers("1e-5:1e4:28", "--luminance");
  const auto value = [&](double l) { return options.cvi ? cvi(tvi(l), l) : tvi(l); };
  // The data of Ferwerda et al. 1996, which Ward combines, span 1e-6 to 1e4 cd/m2.
  const auto outside = [&](double l) {
    if (fromCsf) {
      point.luminanceCdM2 = l;
      point.frequencyCpd = csf->peak(point).frequencyCpd;
      return outsideValidRange(info, point);
    }
    return l >= 1e-6 && l <= 1e4 ? std::vector<std::string>() : std::vector<std::string>{"luminance_cd_m2"};
  };
  const char* unit = options.cvi ? "contrast" : "cd/m2";
  for (const double l : luminances)
    if (!(l > 0.0)) throw Error("'" + shortestNumber(l) + "' is not above 0", "--luminance", "give cd/m2");
  if (!options.plot.empty()) {
    Plot plot{options.cvi ? "Contrast versus intensity" : "Threshold versus intensity",
              "adaptation luminance [cd/m2]",
              options.cvi ? "threshold contrast" : "threshold [cd/m2]",
              {}};
    Plot::Curve curve{model, {}};
    for (const double l : options.point.has("luminance_cd_m2") ? luminances : readNumbers("1e-5:1e4:300", ""))
      curve.points.push_back({l, value(l), !outside(l).empty()});
    plot.curves.push_back(curve);
    drawPlot(plot, options.plot);
    if (!options.json && !options.csv) {
      std::printf("%s\n", options.plot.c_str());
      return;
    }
  }
  nlohmann::json out = {{"model", model}, {"unit", unit}, {"source", tviSource(model, info)}};
  if (fromCsf) {
    out["csf"] = info.name;
    out["constants"] = ParameterValues(info.parameters, constants).toJson();
  }
  if (one && options.json) {
    const double l = luminances[0];
    out["value"] = value(l);
    out["tvi_cd_m2"] = tvi(l);
    out["cvi"] = cvi(tvi(l), l);
    out["arguments"] = {{"luminance_cd_m2", l}};
    out["outside_valid_range"] = outside(l);
    return printJson(out);
  }
  if (options.json) {
    nlohmann::json rows = nlohmann::json::array();
    for (const double l : luminances)
      rows.push_back({{"luminance_cd_m2", l},
                      {"value", value(l)},
                      {"tvi_cd_m2", tvi(l)},
                      {"cvi", cvi(tvi(l), l)},
                      {"outside_valid_range", outside(l)}});
    out["rows"] = rows;
    return printJson(out);
  }
  if (one) {
    std::printf("%s\n", shortestNumber(value(luminances[0])).c_str());
    for (const std::string& argument : outside(luminances[0]))
      std::fprintf(stderr, "%s lies outside the model's range\n", argument.c_str());
    return;
  }
  if (options.csv) std::printf("luminance_cd_m2,tvi_cd_m2,cvi\n");
  if (!options.csv)
    std::printf("%s\n\n%12s %14s %14s\n", tviSource(model, info).c_str(), "L [cd/m2]", "TVI [cd/m2]", "CVI");
  for (const double l : luminances) {
    const double t = tvi(l);
    if (options.csv)
      std::printf("%s,%s,%s\n", shortestNumber(l).c_str(), shortestNumber(t).c_str(),
                  shortestNumber(cvi(t, l)).c_str());
    else
      std::printf("%12s %14s %14s\n", readable(l).c_str(), readable(t).c_str(), readable(cvi(t, l)).c_str());
  }
}

struct MaskingOptions {
  std::string model, contrast, neighbourMean;
  ConstantOptions constants;
  bool list = false, json = false, csv = false;
  std::string plot;
};

struct ExtendedMaskingSettings {
  double alpha = 0.7, a = 1.0;
  static const SettingsTable<ExtendedMaskingSettings>& table() {
    using S = ExtendedMaskingSettings;
    static const char* const kSource = "JPEG 2000 Part 2, reconstructed; Schwarz 2009, section 9.1.2";
    static const SettingsTable<S> kTable = {
        {&S::alpha, "alpha", {0.05, 1.0}, "", "exponent", kSource},
        {&S::a, "a", {0.0, 1e6}, "", "weight of the neighbours", kSource}};
    return kTable;
  }
};

/// "extended" needs a second argument, so it is not one of the registry's point-wise models.
MaskingInfo extendedInfo(double neighbourMean) {
  const char* const source = "JPEG 2000 Part 2, reconstructed; Schwarz 2009, section 9.1.2";
  return {"extended",
          "Point-wise extended masking: sign(c) |c|^alpha / (1 + a mean), mean of |x|^beta over neighbours.",
          source, ExtendedMaskingSettings::table().parameters(),
          [neighbourMean](const ParameterValues& values) {
            const ExtendedMaskingSettings settings = ExtendedMaskingSettings::table().read(values);
            const auto transducer = [=](double c) {
              return pointwiseExtendedMask(c, neighbourMean, settings.alpha, settings.a);
            };
            return Masking{[=](double c) { return c == 0.0 ? 0.0 : c / transducer(c); }, transducer};
          }};
}

void listMasking(const MaskingOptions& options) {
  std::vector<MaskingInfo> models = {extendedInfo(0.0)};
  for (const auto& [name, info] : MaskingRegistry::instance().all()) models.push_back(info);
  nlohmann::json list = nlohmann::json::array();
  for (const MaskingInfo& info : models) {
    if (!options.model.empty() && info.name != options.model) continue;
    nlohmann::json constants = nlohmann::json::array();
    for (const Parameter& one : info.parameters) constants.push_back(toJson(one));
    list.push_back(
        {{"model", info.name}, {"summary", info.summary}, {"source", info.source}, {"constants", constants}});
    if (!options.json)
      std::printf("%s\n  %s\n%s%s", info.name.c_str(), info.summary.c_str(),
                  info.source.empty() ? "" : ("  Source: " + info.source + "\n").c_str(),
                  describeConstants(info.parameters).c_str());
  }
  if (options.json) printJson({{"models", list}});
}

void runMasking(const MaskingOptions& options) {
  const bool isExtended = options.model == "extended";
  if (!options.model.empty() && !isExtended) {
    std::vector<std::string> names = MaskingRegistry::instance().names();
    names.emplace_back("extended");
    if (MaskingRegistry::instance().find(options.model) == nullptr)
      throw Error("no masking model '" + options.model + "'", "masking", suggest(options.model, names));
  }
  if (options.list || options.model.empty()) return listMasking(options);
  if (isExtended && options.neighbourMean.empty())
    throw Error("--neighbour-mean is missing", "masking extended",
                "give the mean of |x|^beta over the neighbours");
  if (!isExtended && !options.neighbourMean.empty())
    throw Error("'" + options.model + "' does not use neighbours", "--neighbour-mean", "use extended");
  const double mean = isExtended ? readNumber(options.neighbourMean, "--neighbour-mean") : 0.0;
  if (mean < 0.0) throw Error("'" + options.neighbourMean + "' is negative", "--neighbour-mean");
  const MaskingInfo info = isExtended ? extendedInfo(mean) : MaskingRegistry::instance().get(options.model);
  const ParameterValues constants(info.parameters, options.constants.read(info.parameters, info.name),
                                  info.name);
  const Masking masking = info.make(constants);
  const std::vector<double> contrasts =
      readNumbers(options.contrast.empty() ? "0.01:1000:26" : options.contrast, "--contrast");
  if (!options.plot.empty()) {
    Plot plot{info.name + ": " + (info.source.empty() ? "no masking" : info.source),
              "normalised contrast",
              "response, elevation",
              {{"response", {}}, {"elevation", {}}}};
    for (const double c : options.contrast.empty() ? readNumbers("0.01:1000:200", "") : contrasts) {
      plot.curves[0].points.push_back({c, masking.transducer(c)});
      plot.curves[1].points.push_back({c, masking.elevation(c)});
    }
    drawPlot(plot, options.plot);
    if (!options.json && !options.csv) {
      std::printf("%s\n", options.plot.c_str());
      return;
    }
  }
  const auto row = [&](double c) {
    nlohmann::json arguments = {{"contrast", c}};
    if (isExtended) arguments["neighbour_mean"] = mean;
    return nlohmann::json{
        {"value", masking.transducer(c)}, {"elevation", masking.elevation(c)}, {"arguments", arguments}};
  };
  if (options.json) {
    nlohmann::json out = {{"model", info.name},
                          {"source", info.source},
                          {"unit", "JND"},
                          {"constants", constants.toJson()},
                          {"outside_valid_range", nlohmann::json::array()}};
    if (contrasts.size() == 1 && !options.contrast.empty()) {
      out.update(row(contrasts[0]));
    } else {
      out["rows"] = nlohmann::json::array();
      for (const double c : contrasts) out["rows"].push_back(row(c));
    }
    return printJson(out);
  }
  if (contrasts.size() == 1 && !options.csv) {
    std::printf("%s\n", shortestNumber(masking.transducer(contrasts[0])).c_str());
    return;
  }
  if (options.csv) std::printf("contrast,response,elevation\n");
  if (!options.csv)
    std::printf("%s\n\n%12s %14s %14s\n", info.summary.c_str(), "contrast", "response", "elevation");
  for (const double c : contrasts) {
    const double response = masking.transducer(c), elevation = masking.elevation(c);
    if (options.csv)
      std::printf("%s,%s,%s\n", shortestNumber(c).c_str(), shortestNumber(response).c_str(),
                  shortestNumber(elevation).c_str());
    else
      std::printf("%12s %14s %14s\n", readable(c).c_str(), readable(response).c_str(),
                  readable(elevation).c_str());
  }
}

void addFormats(CLI::App& command, bool& json, bool& csv, std::string& plot) {
  command.add_flag("--json", json, "prints one JSON object");
  command.add_flag("--csv", csv, "prints comma-separated values");
  command.add_option("--plot", plot, "draws FILE.svg, .png or .pdf; script and data are written beside it")
      ->type_name("FILE");
}

}  // namespace

void addTviCommand(CLI::App& app) {
  const auto options = std::make_shared<TviOptions>();
  CLI::App* command = app.add_subcommand("tvi", "Just noticeable increment over adaptation luminance.");
  command->add_option("MODEL", options->model,
                      "ward, ward_smoothed, from_csf or from_csf_scaled; none: a list");
  command->add_flag("--list", options->list, "lists the models");
  options->point.add(*command);
  command->add_option("--csf", options->csf, "model used by from_csf")->capture_default_str();
  command->add_flag("--scaled", options->scaled, "from_csf: scaled to match Ward's at 100 cd/m2");
  command->add_flag("--cvi", options->cvi, "value is the contrast, increment / luminance");
  addFormats(*command, options->json, options->csv, options->plot);
  std::vector<std::vector<Parameter>> constants;
  for (const auto& [name, info] : CsfRegistry::instance().all()) constants.push_back(info.parameters);
  options->constants.add(*command, constants);
  command->allow_extras();
  command->callback([options, command] {
    refuseExtras(*command);
    runTvi(*options);
  });
}

void addMaskingCommand(CLI::App& app) {
  const auto options = std::make_shared<MaskingOptions>();
  CLI::App* command = app.add_subcommand("masking", "Response to a contrast, and how much it masks.");
  command->add_option("MODEL", options->model, "name of a model; none: a list");
  command->add_flag("--list", options->list, "lists the models");
  command->add_option("--contrast", options->contrast, "contrast in units of its threshold")
      ->type_name("NUMBERS");
  command->add_option("--neighbour-mean", options->neighbourMean,
                      "extended: mean of |x|^beta over the neighbours");
  addFormats(*command, options->json, options->csv, options->plot);
  std::vector<std::vector<Parameter>> constants = {extendedInfo(0.0).parameters};
  for (const auto& [name, info] : MaskingRegistry::instance().all()) constants.push_back(info.parameters);
  options->constants.add(*command, constants);
  command->allow_extras();
  command->callback([options, command] {
    refuseExtras(*command);
    runMasking(*options);
  });
}

}  // namespace limen::perception
