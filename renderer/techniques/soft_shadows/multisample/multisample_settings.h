// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>

#include "renderer/frame/sample_raster.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"

namespace limen::techniques {

/// Sample of a pixel for which visibility is found; all rules except the first choose by depth among samples
/// that see a surface.
enum class Representative { First, Nearest, Farthest, Median };
constexpr EnumNames<Representative, 4> enumNames(Representative) {
  return {{{{Representative::First, "first"},
            {Representative::Nearest, "nearest"},
            {Representative::Farthest, "farthest"},
            {Representative::Median, "median"}}}};
}

/// Position whose depth a sample has.
enum class DepthAt { Centre, Sample };
constexpr EnumNames<DepthAt, 2> enumNames(DepthAt) {
  return {{{{DepthAt::Centre, "centre"}, {DepthAt::Sample, "sample"}}}};
}

/// The sample that represents its pixel.
struct ChosenSample {
  Representative representative = Representative::First;
  DepthAt depthAt = DepthAt::Centre;
  static const SettingsTable<ChosenSample>& table();
};

struct SurfaceSamples {
  static constexpr const char *kKind = "surfaces",
                              *kSummary = "each surface in a pixel has a visibility of its own";
  double tolerance = 0.003;  ///< distance from a point's plane, as a share of that from the camera
  double angleDeg = 15.0;    ///< between normals
  double capacity = 0.5;     ///< further points per pixel
  frame::SampleSearch search = frame::SampleSearch::Triangles;
  static const SettingsTable<SurfaceSamples>& table();
};

struct InterpolatedSamples {
  static constexpr const char *kKind = "interpolate",
                              *kSummary = "samples take the visibility that is closest in depth";
  ChosenSample chosen;
  double tolerance = 0.01;  ///< difference in depth, as a share of the sample's
  int neighbours = 4;
  static const SettingsTable<InterpolatedSamples>& table();
};

struct PixelForAll {
  static constexpr const char *kKind = "centre", *kSummary = "all samples take the pixel's visibility";
  ChosenSample chosen;
  static const SettingsTable<PixelForAll>& table();
};

struct EverySample {
  static constexpr const char *kKind = "per_sample", *kSummary = "each sample gets its own visibility";
};

struct MultisampleSettings {
  ChosenEntry inner{"soft_shadows/backprojection", {}};
  int samples = 4;
  frame::Raster raster = frame::Raster::Auto;
  std::variant<SurfaceSamples, InterpolatedSamples, PixelForAll, EverySample> method;
  static const SettingsTable<MultisampleSettings>& table();

  void check() const;
  /// None unless one sample represents its pixel.
  std::optional<ChosenSample> chosen() const;
};

/// For techniques whose product is a colour: always by surfaces.
struct MultisampleColouredSettings {
  ChosenEntry inner{"soft_shadows/bitmask_coloured", {}};
  int samples = 4;
  frame::Raster raster = frame::Raster::Auto;
  SurfaceSamples surfaces;
  void check() const;
  static const SettingsTable<MultisampleColouredSettings>& table();
};

}  // namespace limen::techniques
