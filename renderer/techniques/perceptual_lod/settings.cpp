// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/settings.h"

#include <limits>

namespace limen::techniques {
namespace {

constexpr const char* kOpen = "Schwarz 2009, section 9.5 (not given there)";
constexpr const char* kPrefix = "map_";

std::vector<Parameter> mapParameters(bool gpu) {
  std::vector<Parameter> out = perception::ThresholdMapSettings::table().parameters();
  if (gpu) appendTo(out, perception::ThresholdMapGpuSettings::table().parameters());
  return out;
}

}  // namespace

void appendTo(std::vector<Parameter>& to, std::vector<Parameter> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<Parameter> SeenOn::parameters(bool gpu) {
  std::vector<Parameter> out = {choiceParameter("display", "schwarz_2009", perception::displayPresets(),
                                                "Display and viewing distance",
                                                "Schwarz 2009, section 10.4")};
  for (Parameter& parameter : mapParameters(gpu)) {
    parameter.name = kPrefix + parameter.name;
    parameter.description = "Threshold map: " + parameter.description;
    out.push_back(std::move(parameter));
  }
  return out;
}

SeenOn SeenOn::from(const ParameterValues& values) {
  SeenOn out;
  out.display = perception::displayPreset(values.text("display"));
  std::map<std::string, ParameterValue> given;
  for (const auto& [path, value] : values.all())
    if (path.rfind(kPrefix, 0) == 0) given[path.substr(std::string(kPrefix).size())] = value;
  const ParameterValues complete(mapParameters(true), given);
  out.map = perception::ThresholdMapSettings::table().read(complete);
  out.mapGpu = perception::ThresholdMapGpuSettings::table().read(complete);
  return out;
}

std::vector<Parameter> PerceptualLodSettings::parameters() {
  std::vector<Parameter> out = LayerSettings::parameters();
  appendTo(out, LevelRule::parameters());
  appendTo(
      out,
      {integerParameter("objects_per_frame", 2, 1, 16, "", "Objects that are tested in a frame, in turn",
                        kOpen),
       choiceParameter("start_level", "finest", {"finest", "coarsest"},
                       "Of all objects, before the first test", kOpen),
       integerParameter(
           "settle_frames", 32, 0, 4096, "",
           "Frames that run before the first that is shown or timed, as part of the preparation; "
           "they end where it begins"),
       integerParameter("latency_frames", 1, 1, 6, "",
                        "Frames after which a test's result is used at the earliest", kOpen),
       booleanParameter("wait_for_results", false,
                        "Wait for results that are due, so that the same frames always give the same bytes; "
                        "otherwise a late result is used later and no frame waits"),
       realParameter(
           "frame_step_s", 0.0, 0.0, 10.0, "s",
           "Time on the camera path from one frame to the next; 0: whoever asks for frames moves the camera"),
       booleanParameter("shadow_mask", true,
                        "With shadow: shadows that other layers cast on a layer count as a pattern", kOpen),
       realParameter("shadow_attenuation", 0.2, 0.0, 1.0, "",
                     "Factor of that pattern where a shadow falls; 0.2: ambient light alone", kOpen),
       choiceParameter("count", "compute", {"compute", "query"},
                       "How pixels above threshold are counted: in a compute shader, or by occlusion queries",
                       "Schwarz 2009, section 9.5 (query)"),
       choiceParameter(
           "threshold_maps", "tested", {"tested", "all"},
           "Layers whose threshold map is made in a frame: those with an object under test, or all",
           "Schwarz 2009, section 9.5 (all)"),
       booleanParameter(
           "oracle", true,
           "Compare the levels with an exhaustive search in double precision when costs are counted "
           "(slow for large images and many objects)")});
  appendTo(out, frame::ShadedSetting::parameters());
  appendTo(out, SeenOn::parameters(true));
  return out;
}

PerceptualLodSettings PerceptualLodSettings::from(const ParameterValues& values) {
  PerceptualLodSettings out;
  out.layers = LayerSettings::from(values);
  out.rule = LevelRule::from(values);
  out.objectsPerFrame = static_cast<int>(values.integer("objects_per_frame"));
  out.startLevel = values.text("start_level") == "finest" ? 0 : std::numeric_limits<int>::max();
  out.settleFrames = static_cast<int>(values.integer("settle_frames"));
  out.latencyFrames = static_cast<int>(values.integer("latency_frames"));
  out.wait = values.boolean("wait_for_results");
  out.frameStepS = values.real("frame_step_s");
  out.shadowMask = values.boolean("shadow_mask");
  out.shadowAttenuation = values.real("shadow_attenuation");
  out.count = values.text("count") == "query" ? Count::Query : Count::Compute;
  out.allMaps = values.text("threshold_maps") == "all";
  out.oracle = values.boolean("oracle");
  out.shading = frame::ShadedSetting::from(values);
  out.seenOn = SeenOn::from(values);
  return out;
}

}  // namespace limen::techniques
