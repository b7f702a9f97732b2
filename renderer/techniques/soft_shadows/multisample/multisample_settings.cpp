// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/multisample/multisample_settings.h"

#include "experiments/base/error.h"

namespace limen::techniques {

const SettingsTable<ChosenSample>& ChosenSample::table() {
  using S = ChosenSample;
  static const SettingsTable<S> kTable = {
      Binding(&S::representative, "representative",
              "Sample for which visibility is found; all rules except the first choose by depth among "
              "samples that see a surface",
              "Schwarz 2009, section 4.6 (first; others suggested)")
          .formerly({"representative"}),
      Binding(
          &S::depthAt, "depth_at",
          "Position whose depth a sample has: the pixel's centre, as if shading ran once per pixel, or its "
          "own",
          "Schwarz 2009, section 4.6, footnote 10 (centre)")
          .formerly({"depth_at"})};
  return kTable;
}

const SettingsTable<SurfaceSamples>& SurfaceSamples::table() {
  using S = SurfaceSamples;
  static const SettingsTable<S> kTable = {
      {&S::tolerance,
       "tolerance",
       {0, 1},
       "",
       "Largest distance of a sample from the plane of a point on the same surface, as a share of its "
       "distance "
       "from the camera",
       "bench; Schwarz 2009, section 4.6, compares depths"},
      {&S::angleDeg,
       "angle",
       {0, 90},
       "degree",
       "Largest angle between normals of the same surface",
       "bench"},
      {&S::capacity,
       "capacity",
       {0, 8},
       "1/px",
       "Room for points beyond one per pixel; samples that find none take their pixel's visibility",
       "bench"},
      {&S::search, "search",
       "Pixels whose samples are looked at: all in which triangles other than the one behind the centre may "
       "be seen, or those beside a pixel whose centre sees another surface, which misses what is thinner "
       "than 1.4 pixels; centres: the same, whose samples see triangles that are behind one of the nine "
       "centres "
       "around, without a pass over triangles",
       "bench"}};
  return kTable;
}

const SettingsTable<InterpolatedSamples>& InterpolatedSamples::table() {
  using S = InterpolatedSamples;
  static const SettingsTable<S> kTable = {
      included(&S::chosen),
      Binding(&S::tolerance, "tolerance", Range{0, 1}, "",
              "Largest depth difference within a surface, as a share of the sample's depth",
              "Schwarz 2009, section 4.6 (value not given there)")
          .formerly({"tolerance"}),
      Binding(&S::neighbours, "neighbours", oneOf({4, 8}), "px",
              "Neighbouring pixels that may lend their visibility", "Schwarz 2009, section 4.6 (4)")
          .formerly({"neighbours"})};
  return kTable;
}

const SettingsTable<PixelForAll>& PixelForAll::table() {
  static const SettingsTable<PixelForAll> kTable = {included(&PixelForAll::chosen)};
  return kTable;
}

template <class S>
Binding<S> samplesBinding() {
  return {&S::samples,
          "samples",
          oneOf({1, 2, 4, 8}),
          "",
          "Samples per pixel; drivers need not support every number",
          "Schwarz 2009, section 4.6"};
}

template <class S>
Binding<S> rasterBinding() {
  return {&S::raster, "raster",
          "How samples find their triangles: by the driver's rasteriser, at places that it chooses, or in "
          "compute shaders, at standard places and only where a pixel may see several triangles; auto: "
          "compute on a GPU"};
}

const SettingsTable<MultisampleSettings>& MultisampleSettings::table() {
  using S = MultisampleSettings;
  static const SettingsTable<S> kTable = {
      innerBinding(&S::inner, InnerKind::OrRayTraced),
      samplesBinding<S>(),
      rasterBinding<S>(),
      {&S::method, "method", "How samples get their visibility", "Schwarz 2009, section 4.6"}};
  return kTable;
}

const SettingsTable<MultisampleColouredSettings>& MultisampleColouredSettings::table() {
  using S = MultisampleColouredSettings;
  static const SettingsTable<S> kTable = {
      innerBinding(&S::inner, InnerKind::Coloured),
      samplesBinding<S>(),
      rasterBinding<S>(),
      {&S::surfaces, "surfaces", "Which samples of a pixel share a point"}};
  return kTable;
}

namespace {

void checkSearch(const SurfaceSamples& surfaces, frame::Raster raster, const char* where) {
  if (surfaces.search != frame::SampleSearch::Triangles && raster != frame::Raster::Compute)
    throw Error(
        "the driver's rasteriser finds the samples of all pixels, and 'search: neighbours' and 'centres' "
        "leave "
        "some out",
        where, "give raster: compute, or search: triangles");
}

}  // namespace

void MultisampleSettings::check() const {
  if (const auto* surfaces = std::get_if<SurfaceSamples>(&method))
    checkSearch(*surfaces, raster, "method.search");
}

void MultisampleColouredSettings::check() const { checkSearch(surfaces, raster, "surfaces.search"); }

std::optional<ChosenSample> MultisampleSettings::chosen() const {
  if (const auto* interpolated = std::get_if<InterpolatedSamples>(&method)) return interpolated->chosen;
  if (const auto* pixel = std::get_if<PixelForAll>(&method)) return pixel->chosen;
  return std::nullopt;
}

}  // namespace limen::techniques
