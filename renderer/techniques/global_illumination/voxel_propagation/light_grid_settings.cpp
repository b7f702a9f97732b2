// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char* kTransportSource = "Gaitatzes 2012, section 5.5.2, equation 11";

}  // namespace

const SettingsTable<ConeTransport>& ConeTransport::table() {
  using S = ConeTransport;
  static const SettingsTable<S> kTable = {
      {&S::halfAngleDeg,
       "half_angle_deg",
       {20.0, 80.0},
       "deg",
       "Of the cone; six of 48.19 degrees have the sphere's solid angle",
       kTransportSource},
      {&S::normalised, "normalised", "Divide by the cone's solid angle", "the bench's own"}};
  return kTable;
}
const SettingsTable<ComponentTransport>& ComponentTransport::table() {
  using S = ComponentTransport;
  static const SettingsTable<S> kTable = {
      {&S::halfAngleDeg, "half_angle_deg", {20.0, 80.0}, "deg", "Of the cone", kTransportSource}};
  return kTable;
}
const SettingsTable<InjectionSettings>& InjectionSettings::table() {
  using S = InjectionSettings;
  static const SettingsTable<S> kTable = {
      {&S::shift,
       "shift",
       {0.0, 2.0},
       "voxels",
       "Along its normal from a point of a surface to where its light starts",
       "Kaplanyan and Dachsbacher 2010 (a half)"},
      {&S::samplesAside,
       "samples_aside",
       {1, 16},
       "",
       "Points of a surface along the side of a voxel, at least",
       "the bench's own"}};
  return kTable;
}
const SettingsTable<BoxOfScene>& BoxOfScene::table() {
  using S = BoxOfScene;
  static const SettingsTable<S> kTable = {
      {&S::margin,
       "margin",
       {0, 8},
       "voxels",
       "How far beyond the scene's box light goes on, so that surfaces at its sides that face outwards get "
       "some; it does not come back. Each after the first is a further voxel on each side of the grid",
       "the bench's own"}};
  return kTable;
}
const SettingsTable<BoxAroundCamera>& BoxAroundCamera::table() {
  using S = BoxAroundCamera;
  static const SettingsTable<S> kTable = {
      {&S::side, "side", {0.01, 100000.0}, "world units", "Of the cube", "Gaitatzes 2012, section 5.7"}};
  return kTable;
}
const SettingsTable<UpdateEvery>& UpdateEvery::table() {
  using S = UpdateEvery;
  static const SettingsTable<S> kTable = {{&S::frames,
                                           "frames",
                                           {2, 16},
                                           "frames",
                                           "From one update to the next",
                                           "Gaitatzes 2012, section 5.7"}};
  return kTable;
}
const SettingsTable<LimitedBounces>& LimitedBounces::table() {
  using S = LimitedBounces;
  static const SettingsTable<S> kTable = {
      {&S::most,
       "most",
       {1, 8},
       "",
       "Surfaces that indirect light is reflected by before the one that is seen, as of paths; the first "
       "is where it is put in",
       "Gaitatzes 2012, section 5.6 (2)"}};
  return kTable;
}
const SettingsTable<StepSettings>& StepSettings::table() {
  using S = StepSettings;
  static const SettingsTable<S> kTable = {
      {&S::sources, "sources", "When light is put in", "Gaitatzes 2012, section 5.5.2"},
      {&S::dispatch, "dispatch",
       "Dispatches that steps are done in, with the same result: all in one where the device keeps its "
       "groups running, one each elsewhere",
       "the bench's own"},
      {&S::bounces, "bounces", "How often light is reflected", "Gaitatzes 2012, section 5.6"},
      {&S::stopBelow,
       "stop_below",
       {0.0, 1.0},
       "",
       "Largest change of a voxel's flux in a step, in radiance times pi, below which steps end; 0: never",
       "the bench's own"}};
  return kTable;
}
void StepSettings::check() const {
  if (std::holds_alternative<OneDispatch>(dispatch) && (sources == LightSources::Once || stopBelow > 0.0))
    throw Error("'dispatch: once' is for steps of a lasting source that do not stop early", "dispatch",
                "leave out 'dispatch', or give sources: steady and stop_below: 0");
}
void LightGridSettings::check() const {
  if (goesOn() && steps.sources == LightSources::Once)
    throw Error("light that goes on from frame to frame and is put in once is that of the first frame",
                "update", "leave out 'update', or give steps: {sources: steady}");
}
const SettingsTable<LightGridSettings>& LightGridSettings::table() {
  using S = LightGridSettings;
  constexpr const char* kChapter = "Gaitatzes 2012, section 5.5.2";
  static const SettingsTable<S> kTable = {
      {&S::resolution,
       "resolution",
       {4, 128},
       "voxels",
       "Along the longest side of the box; light needs some four steps a voxel for its bounces",
       "Gaitatzes 2012, section 5.6 (32)"},
      {&S::iterations,
       "iterations",
       {0, 256},
       "",
       "Steps of a voxel that light travels in a frame",
       "Gaitatzes 2012, Table 2 (11, 12, 64)"},
      {&S::steps, "steps", "How they are done"},
      {&S::transport, "transport", "How light goes from a voxel to its neighbours", kTransportSource},
      {&S::reflection, "reflection", "At occupied voxels", kChapter},
      {&S::albedo, "albedo", "Of the reflection: stored, or .5 everywhere", "Gaitatzes 2012, section 5.7"},
      {&S::format, "format", "Of the fields"},
      {&S::coverage, "coverage", "Which voxels a triangle fills"},
      {&S::box, "box", "Where voxels are"},
      {&S::update, "update", "What is made anew in a frame", "Gaitatzes 2012, section 5.7"},
      {&S::injection, "injection", "How light is put in"}};
  return kTable;
}

}  // namespace limen::techniques
