// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/perceptual_lod/settings.h"

namespace limen::techniques {
namespace {

constexpr const char* kOpen = "Schwarz 2009, section 9.5 (not given there)";

}  // namespace

template <class T>
const SettingsTable<SeenOnSettings<T>>& SeenOnSettings<T>::table() {
  using S = SeenOnSettings<T>;
  static const SettingsTable<S> kTable = {{&S::thresholds, "thresholds", perception::kThresholdsText},
                                          included(&S::viewing)};
  return kTable;
}

template struct SeenOnSettings<perception::ThresholdSettings>;
template struct SeenOnSettings<perception::ThresholdGpuSettings>;

const SettingsTable<TestSettings>& TestSettings::table() {
  using S = TestSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::objectsPerFrame, "objects_per_frame", Range{1, 16}, "", "Objects tested per frame, in turn",
              kOpen)
          .formerly({"objects_per_frame"}),
      Binding(&S::latencyFrames, "latency_frames", Range{1, 6}, "",
              "Smallest number of frames before a test's result is used", kOpen)
          .formerly({"latency_frames"}),
      Binding(
          &S::wait, "wait_for_results",
          "Wait for results that are due, so that the same frames always give the same bytes; otherwise a "
          "late result is used later and no frame waits")
          .formerly({"wait_for_results"}),
      Binding(&S::count, "count",
              "How pixels above threshold are counted: in a compute shader, or by occlusion queries",
              "Schwarz 2009, section 9.5 (query)")
          .formerly({"count"}),
      Binding(&S::thresholdMaps, "threshold_maps",
              "Layers whose threshold map is computed in a frame: those with an object under test, or all",
              "Schwarz 2009, section 9.5 (all)")
          .formerly({"threshold_maps"})};
  return kTable;
}

const SettingsTable<DarkenedShadows>& DarkenedShadows::table() {
  static const SettingsTable<DarkenedShadows> kTable = {
      Binding(&DarkenedShadows::factor, "factor", Range{0.0, 1.0}, "",
              "Factor of the pattern in shadow; 0.2: ambient light only", kOpen)
          .formerly({"shadow_attenuation"})};
  return kTable;
}

const SettingsTable<PerceptualLodSettings>& PerceptualLodSettings::table() {
  using S = PerceptualLodSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::layers, "layers", "How objects are distributed among layers", kOpen)
          .shorthand("count")
          .formerly({"partition"}),
      {&S::rule, "rule", "When a test changes a level"},
      {&S::tests, "tests", "What a frame tests"},
      {&S::startLevel, "start_level", "Level of all objects before the first test", kOpen},
      {&S::settleFrames,
       "settle_frames",
       {0, 4096},
       "",
       "Frames that run before the first one shown or timed, as part of the preparation; they end where "
       "it "
       "begins"},
      {&S::frameStepS,
       "frame_step_s",
       {0.0, 10.0},
       "s",
       "Time on the camera path from one frame to the next; 0: the caller moves the camera"},
      Binding(&S::castShadows, "cast_shadows", "Shadows that other layers cast on a layer", kOpen)
          .formerly({"shadow_mask"}),
      {&S::oracle, "oracle",
       "Compare the levels with an exhaustive search in double precision when costs are counted (slow for "
       "large images and many objects)"},
      frame::shadingBinding(&S::shading),
      included(&S::model)};
  return kTable;
}

}  // namespace limen::techniques
