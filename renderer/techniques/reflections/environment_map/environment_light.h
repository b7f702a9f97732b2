// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/reflections/environment_map/cube_map.h"
#include "renderer/techniques/reflections/environment_map/surroundings.h"
#include "renderer/techniques/reflections/view_raster.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

struct InfiniteMap {
  static constexpr const char *kKind = "infinite", *kSummary = "by direction alone";
  static const SettingsTable<InfiniteMap>& table() {
    static const SettingsTable<InfiniteMap> kTable = {};
    return kTable;
  }
};
struct FiniteMap {
  static constexpr const char *kKind = "finite", *kSummary = "on a sphere around the mirror's middle";
  double radius = 0.25;
  static const SettingsTable<FiniteMap>& table() {
    static const SettingsTable<FiniteMap> kTable = {{&FiniteMap::radius,
                                                     "radius",
                                                     {1e-3, 100.0},
                                                     "scene diagonals",
                                                     "Radius of the sphere",
                                                     "Roger 2008, section 1.3.2.1 (1 world unit there)"}};
    return kTable;
  }
};
struct DepthMap {
  static constexpr const char *kKind = "depth",
                              *kSummary = "at the distance of each texel, found along the ray";
  int steps = 32, refinements = 10, layers = 1;
  double crackShare = 0.02;
  static const SettingsTable<DepthMap>& table() {
    using S = DepthMap;
    static const SettingsTable<S> kTable = {
        {&S::steps, "steps", {1, 1024}, "", "Places along the ray", "Roger 2008, section 1.3.2.2"},
        {&S::refinements, "refinements", {0, 32}, "", "Halvings of the step that enters a surface"},
        {&S::crackShare,
         "crack",
         {1e-6, 1.0},
         "",
         "Depth behind a surface, as a share of its distance, beyond which the ray slipped past its border"},
        {&S::layers, "layers", oneOf({1, 2}), "",
         "Surfaces that the map knows in each direction: the nearest, and behind it the nearest that faces "
         "the "
         "map's middle",
         "Roger 2008, section 1.3.2.2 (more layers)"}};
    return kTable;
  }
};

enum class MapFilter { Nearest, Linear, Mip };
constexpr EnumNames<MapFilter, 3> enumNames(MapFilter) {
  return {{{{MapFilter::Nearest, "nearest"}, {MapFilter::Linear, "linear"}, {MapFilter::Mip, "mip"}}}};
}

struct NotPrefiltered {
  static constexpr const char *kKind = "none", *kSummary = "as it is seen";
  static const SettingsTable<NotPrefiltered>& table() {
    static const SettingsTable<NotPrefiltered> kTable = {};
    return kTable;
  }
};
struct PrefilteredLobe {
  static constexpr const char *kKind = "lobe",
                              *kSummary = "mean over a power of the cosine; 1 is that of diffuse surfaces";
  double exponent = 20.0;
  int resolution = 32, source = 32;
  static const SettingsTable<PrefilteredLobe>& table() {
    using S = PrefilteredLobe;
    static const SettingsTable<S> kTable = {
        {&S::exponent, "exponent", {1.0, 1000.0}, "", "Of the cosine", "Roger 2008, section 1.3.2.3"},
        {&S::resolution, "resolution", {4, 256}, "texels", "Side of a face of the filtered map"},
        {&S::source, "source_resolution", oneOf({8, 16, 32, 64, 128}), "texels",
         "Side of a face of the level that is filtered"}};
    return kTable;
  }
};

struct EnvironmentLightSettings {
  int resolution = 256;
  std::variant<InfiniteMap, FiniteMap, DepthMap> lookup;
  MapFilter filter = MapFilter::Linear;
  std::variant<NotPrefiltered, PrefilteredLobe> prefilter;
  static const SettingsTable<EnvironmentLightSettings>& table() {
    using S = EnvironmentLightSettings;
    static const SettingsTable<S> kTable = {
        {&S::resolution, "resolution", oneOf({16, 32, 64, 128, 256, 512, 1024, 2048}), "texels",
         "Side of a face", "Roger 2008, section 1.3.2"},
        {&S::lookup, "lookup", "Where the map's surroundings are"},
        {&S::filter, "filter", "Nearest texel, four texels, or mip levels by the angle between pixels' rays"},
        {&S::prefilter, "prefilter", "Filters the map for surfaces that are no perfect mirrors"}};
    return kTable;
  }
  void check() const {
    const auto* lobe = std::get_if<PrefilteredLobe>(&prefilter);
    if (lobe && lobe->source > resolution)
      throw Error("the filtered level would have more texels than the map", "prefilter.source_resolution",
                  "give at most " + std::to_string(resolution));
  }
};

/// Light along mirrored rays from a cube map of the surroundings of the scene's largest mirror.
class EnvironmentLight {
 public:
  /// `under`: look() adds to what rays have brought already.
  EnvironmentLight(const EnvironmentLightSettings& settings, const frame::ShadedSetting& shading, bool under)
      : settings_(settings), shading_(shading), under_(under) {}

  void prepare(frame::Frame& frame);
  /// Draws the map, in passes of its own.
  void draw(frame::Frame& frame);
  /// Looks up the light of each pixel's ray, in a pass of its own: RGBA32F, alpha 1. Under what `target`
  /// holds already, with colours multiplied by alpha.
  void look(frame::Frame& frame, const frame::MirrorRays& rays, const gl::Texture& target);
  /// After look(), which it repeats.
  std::vector<Counter> count(frame::Frame& frame, const gl::Texture& target);
  static std::vector<Quantity> counters();

 private:
  void prefilter(const PrefilteredLobe& lobe);
  void look(frame::Frame& frame, const frame::MirrorRays& rays, const gl::Program& program,
            const gl::Texture& target);

  EnvironmentLightSettings settings_;
  frame::ShadedSetting shading_;
  bool under_;
  const gl::Program *prefilter_ = nullptr, *look_ = nullptr, *countLook_ = nullptr;
  std::optional<Surroundings> surroundings_;
  std::optional<CubeMap> filtered_;
  std::optional<gl::Texture> fates_;
};

}  // namespace limen::techniques
