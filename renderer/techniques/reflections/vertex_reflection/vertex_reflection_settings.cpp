// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/vertex_reflection_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {

const SettingsTable<ReflectorMapSettings>& ReflectorMapSettings::table() {
  using S = ReflectorMapSettings;
  static const SettingsTable<S> kTable = {
      {&S::layout, "layout", "How directions are stored", "Roger 2008, section 2.2.3"},
      {&S::resolution,
       "resolution",
       {2, 1024},
       "texel",
       "Side of a face of the cube, or of the square of angles",
       "not given in Roger 2008"},
      {&S::format, "format", "Numbers of a texel: radius and its gradient", "Roger 2008, section 2.2.1"},
      {&S::filter, "filter", "Interpolate between texels"}};
  return kTable;
}

const SettingsTable<SecantSettings>& SecantSettings::table() {
  using S = SecantSettings;
  static const SettingsTable<S> kTable = {
      {&S::gradient, "gradient", "What is taken for the gradient of the path's length",
       "Roger 2008, equation 2.2; corrected: the bench's own"},
      {&S::guess, "guess", "First three samples", "Roger 2008, section 2.2.3"},
      {&S::safeguard, "safeguard", "What is done where the samples wander", "the bench's own"},
      {&S::cap,
       "cap",
       {1, 100},
       "",
       "Samples after the first three at most",
       "Roger 2008, section 2.3.1 (20 at most were seen)"},
      {&S::stop, "stop", "What of the samples' triangle in the picture ends the search by being small",
       "Roger 2008, section 2.2.2 (area)"},
      {&S::stopAreaPx2,
       "stop_area_px2",
       {1e-6, 1e4},
       "px^2",
       "Size in the picture of the triangle of samples below which the search ends",
       "Roger 2008, French summary (one pixel)"},
      {&S::determinantShare,
       "determinant_share",
       {0.0, 1.0},
       "",
       "Determinant over the product of squares below which a sample is exchanged",
       "not given in Roger 2008"},
      {&S::leastSide,
       "least_side",
       {1e-4, 1.0},
       "radii",
       "Side of first triangles that would collapse; a tenth of that of facing_eye",
       "not given in Roger 2008"},
      {&S::falseRootLength,
       "false_root_length",
       {0.0, 1.0},
       "",
       "Length of the sum of directions below which a root is where the straight line passes the surface",
       "the bench's own"}};
  return kTable;
}

reflections::SolverSettings SecantSettings::onCpu() const {
  return {.gradient = gradient,
          .guess = guess,
          .safeguard = safeguard,
          .cap = cap,
          .stop = stop,
          .areaPx2 = stopAreaPx2,
          .determinantShare = determinantShare,
          .leastSide = leastSide,
          .falseRootLength = falseRootLength};
}

const SettingsTable<EvenSegments>& EvenSegments::table() {
  using S = EvenSegments;
  static const SettingsTable<S> kTable = {{&S::segments,
                                           "segments",
                                           {1, 64},
                                           "segments",
                                           "Of each edge of the reflected scene",
                                           "Roger 2008, section 2.3.4"}};
  return kTable;
}

const SettingsTable<AdaptiveSegments>& AdaptiveSegments::table() {
  using S = AdaptiveSegments;
  static const SettingsTable<S> kTable = {
      {&S::segments, "segments", {1, 64}, "segments", "Of each edge, before it is divided further"},
      {&S::tolerancePx,
       "tolerance_px",
       {0.01, 100.0},
       "px",
       "Distance allowed between an edge's reflection and a straight one",
       "Roger 2008, section 2.4 (suggested)"},
      {&S::most, "most", {1, 64}, "segments", "Of an edge at most"}};
  return kTable;
}

const SettingsTable<FarSurroundings>& FarSurroundings::table() {
  using S = FarSurroundings;
  static const SettingsTable<S> kTable = {
      {&S::distance,
       "distance",
       {1.0, 1000.0},
       "radii",
       "From the mirror's centre at which the map begins to replace vertices",
       "Roger 2008, section 2.4 (not given there)"},
      {&S::blend, "blend", {0.001, 10.0}, "", "Width of the passage from vertices to map, over the distance"},
      {&S::resolution, "resolution", {2, 2048}, "texel", "Side of a face of the map"}};
  return kTable;
}

const SettingsTable<VertexReflectionSettings>& VertexReflectionSettings::table() {
  using S = VertexReflectionSettings;
  static const SettingsTable<S> kTable = {
      {&S::placement, "placement", "Where reflection points are found", "Roger 2008, section 2.2.3"},
      {&S::map, "map", "Map of the reflector"},
      {&S::solver, "solver", "Search for the reflection point"},
      {&S::tessellation, "tessellation", "How the reflected scene is divided"},
      {&S::surroundings, "surroundings", "What far parts of the scene are reflected by"},
      {&S::invalid, "invalid", "What becomes of triangles with a corner that has no reflection",
       "not given in Roger 2008"},
      {&S::depth, "depth", "Depth of reflected fragments", "Roger 2008, section 2.2.3"},
      {&S::hideBehindBacks, "hide_behind_backs", "Reject what is reflected behind the reflector's back faces",
       "Roger 2008, section 2.2.3"},
      {&S::backSlack,
       "back_slack",
       {0.0, 0.1},
       "",
       "Share of the distance by which a reflection may lie behind back faces",
       "not given in Roger 2008"},
      {&S::litFrom, "lit_from", "Viewer of highlights on what is reflected", "Roger 2008, section 2.2.3"},
      {&S::shading, "shading", "How the picture is lit"}};
  return kTable;
}

void VertexReflectionSettings::check() const {
  if (invalid == InvalidPolicy::Subdivide && std::holds_alternative<EvenSegments>(tessellation))
    throw Error("only adaptive tessellation can divide triangles that lack a corner", "invalid",
                "choose drop or clamp, or tessellation: {kind: adaptive}");
  if (placement == Placement::VertexShader && solver.guess == reflections::FirstGuess::PreviousFrame)
    throw Error("a vertex shader keeps nothing for the next frame", "placement",
                "choose placement: compute, or another solver.guess");
}

}  // namespace limen::techniques
