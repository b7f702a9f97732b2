// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr double kDefaultScale = 1.0, kDefaultRadius = 4.0;
constexpr int64_t kDefaultSearchTaps = 8, kDefaultBits = 0;
constexpr const char* kDefaultForm = "float";

std::string shaderOf(const std::string& name) {
  return "renderer/techniques/soft_shadows/" + name + "/" + name + ".comp.glsl";
}

gl::ShaderDefines windowDefines(const ParameterValues& values, const frame::PrefilterSettings& settings) {
  gl::ShaderDefines defines = frame::PrefilteredMap::defines(settings);
  const std::string& window = values.text("window");
  defines[window == "fixed"      ? "WINDOW_FIXED"
          : window == "searched" ? "WINDOW_SEARCHED"
                                 : "WINDOW_CONVOLVED"] = "1";
  return defines;
}

}  // namespace

Parameter prefilterParameter(std::vector<std::string> prefilters) {
  const std::string usual = prefilters.front();
  return choiceParameter("prefilter", usual, std::move(prefilters),
                         "What averages are taken from: sums: summed-area table, any rectangle; mips: "
                         "pyramid, squares of the window's area",
                         "Schwarz 2009, section 3.2.1");
}

frame::Prefilter prefilterOf(const ParameterValues& values) {
  return values.text("prefilter") == "sums" ? frame::Prefilter::Sums : frame::Prefilter::Mips;
}

std::vector<Parameter> PrefilteredTechnique::prefilterParameters(std::vector<std::string> windows,
                                                                 std::vector<std::string> prefilters) {
  std::vector<Parameter> all = commonParameters(1.0);
  const std::string window = windows.front();
  all.push_back(
      choiceParameter("window", window, std::move(windows),
                      "What is averaged: a window of fixed size, or of the size that the blockers' average "
                      "depth asks for: searched by taps, convolved from averages",
                      "Schwarz 2009, section 3.2.1"));
  all.push_back(
      realParameter("filter_radius", kDefaultRadius, 0.5, 256.0, "texel", "Half the side of a fixed window"));
  all.push_back(realParameter("search_scale", kDefaultScale, 0.01, 4.0, "",
                              "Window of the blocker search as a share of the light's extents"));
  all.push_back(integerParameter("search_taps", kDefaultSearchTaps, 1, 32, "",
                                 "Taps of a searched window's blocker search along a side"));
  all.push_back(prefilterParameter(std::move(prefilters)));
  all.push_back(
      choiceParameter("sums", kDefaultForm, {"float", "float_mean", "fixed"},
                      "Summed-area table in 32-bit floats, the same of values less their mean, or 32-bit "
                      "whole numbers",
                      "Schwarz 2009, section 3.2.1"));
  all.push_back(integerParameter("sum_bits", kDefaultBits, 0, 24, "bit",
                                 "Bits of a value in sums of whole numbers; 0: as many as never overflow"));
  return all;
}

TechniqueInfo PrefilteredTechnique::declare(std::string name, int version, std::string summary,
                                            std::vector<Parameter> parameters,
                                            decltype(TechniqueInfo::make) make,
                                            decltype(TechniqueInfo::check) check) {
  return {.name = std::move(name),
          .version = version,
          .summary = std::move(summary),
          .source = "Schwarz 2009, section 3.2.1 (SS-03)",
          .product = ProductKind::Visibility,
          .parameters = std::move(parameters),
          .needs = {"area_light"},
          .reference = false,
          .onCpu = false,
          .make = std::move(make),
          .errorBound = {},
          .counters = counterNames(),
          .check = std::move(check)};
}

void PrefilteredTechnique::checkPrefilter(const ParameterValues& values) {
  const std::string &window = values.text("window"), &sums = values.text("sums");
  if (window != "fixed" && values.real("filter_radius") != kDefaultRadius)
    throw Error("'filter_radius' is about a fixed window, and this one is " + window, "filter_radius",
                "leave it out, or give window: fixed");
  if (window == "fixed" && values.real("search_scale") != kDefaultScale)
    throw Error("'search_scale' is about a search, and a fixed window has none", "search_scale",
                "leave it out, or give window: searched");
  if (window != "searched" && values.integer("search_taps") != kDefaultSearchTaps)
    throw Error("'search_taps' is about a searched window, and this one is " + window, "search_taps",
                "leave it out, or give window: searched");
  if (values.text("prefilter") != "sums" && sums != kDefaultForm)
    throw Error("'sums' is about a summed-area table, and there is none", "sums",
                "leave it out, or give prefilter: sums");
  const int64_t bits = values.integer("sum_bits");
  if (sums != "fixed" && bits != kDefaultBits)
    throw Error("'sum_bits' is about sums of whole numbers, and there are none", "sum_bits",
                "leave it out, or give prefilter: sums and sums: fixed");
  const int limit = frame::sumBits(std::stoi(values.text("resolution")));
  if (bits > limit)
    throw Error("values of " + std::to_string(bits) + " bits over a map of " + values.text("resolution") +
                    " texels a side need sums of more than 32 bits",
                "sum_bits", "give at most " + std::to_string(limit) + ", or a smaller resolution");
}

frame::PrefilterSettings PrefilteredTechnique::settingsOf(const ParameterValues& values) {
  frame::PrefilterSettings settings;
  settings.prefilter = prefilterOf(values);
  const std::string& sums = values.text("sums");
  settings.form = sums == "float"        ? frame::SumForm::Float
                  : sums == "float_mean" ? frame::SumForm::FloatMean
                                         : frame::SumForm::Fixed;
  settings.bits = static_cast<int>(values.integer("sum_bits"));
  return settings;
}

PrefilteredTechnique::PrefilteredTechnique(const ParameterValues& values, const std::string& name,
                                           const frame::PrefilterSettings& settings)
    : VisibilityTechnique(values, shaderOf(name), "soft_shadows/" + name, windowDefines(values, settings)),
      settings_(settings),
      searchScale_(values.real("search_scale")),
      filterRadius_(values.real("filter_radius")),
      searchTaps_(static_cast<int>(values.integer("search_taps"))) {
  checkPrefilter(values);
  settings_.map = mapSettings();
}

const frame::LightFrustum& PrefilteredTechnique::bindMap(frame::Frame& frame) {
  map_ = &frame.get<frame::PrefilteredMap>(settings_);
  const auto& map = frame.get<frame::ShadowMap>(mapSettings());
  map.texture().bindTexture(1);
  map_->bind(2);
  return map.frustum();
}

void PrefilteredTechnique::configure(const gl::Program& program) const {
  map_->configure(program);
  program.set("filterRadius", static_cast<float>(filterRadius_));
  program.set("searchScale", static_cast<float>(searchScale_));
  program.set("searchTaps", searchTaps_);
}

std::vector<Quantity> PrefilteredTechnique::counterNames() {
  std::vector<Quantity> names = VisibilityTechnique::counterNames();
  names.emplace_back("structure_bytes");
  return names;
}

std::vector<Counter> PrefilteredTechnique::count(frame::Frame& frame) {
  std::vector<Counter> all = VisibilityTechnique::count(frame);
  all.push_back({"structure_bytes", static_cast<double>(map_->bytes()), "byte", true});
  return all;
}

}  // namespace limen::techniques
