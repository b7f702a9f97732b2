// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "perception/vision/display.h"

namespace limen::perception::cvvdp {

/// From a pixel value to light.
enum class Eotf { Srgb, Power, Pq, Linear, Hlg };

/// Primaries and transfer curve, as color_spaces.json states them.
struct ColourSpace {
  std::string name;
  Eotf eotf = Eotf::Srgb;
  double exponent = 1.0;       ///< of Eotf::Power
  glm::dmat3 xyzOfRgb{1.0};    ///< column-major, as glm multiplies
  glm::dmat3 dklOfRgb() const;  ///< light to A, RG, YV (CIE 2006 cones, D65 white)
};

/// Display, room and viewing distance as ColorVideoVDP describes them.
struct Display {
  std::string name;
  double peakCdM2 = 100.0, blackCdM2 = 0.2;
  double ambientLux = 0.0, reflectivity = 0.005;
  double exposure = 1.0;  ///< factor on light before the display clips it
  double pixelsPerDegree = 60.0;
  ColourSpace colours;

  double reflectedCdM2() const;
  /// Light per primary [cd/m2] of a pixel value: display-coded values are clamped to [0, 1]; those of
  /// Eotf::Linear are cd/m2.
  glm::dvec3 light(const glm::dvec3& value) const;
  /// The same of light relative to the display's white, which is clamped to [0, 1].
  glm::dvec3 lightOfRelative(const glm::dvec3& relative) const;
  /// True if relative light has a meaning: primaries of sRGB.
  bool showsRelativeLight() const;
  /// System gamma of Eotf::Hlg.
  double hlgGamma() const;
  /// Name, levels, colour space and pixels per degree, for a report.
  std::string line() const;
};

/// Files in the form of the published display_models.json and color_spaces.json; "" for those.
struct DisplayFiles {
  std::string displays, colourSpaces;
};

/// Names of the published displays.
std::vector<std::string> displayNames();
/// A display of `files` by name. If they are the published ones, also a display profile of Limen, by name or
/// file. Throws Error: unknown name with the nearest known one, unreadable file, missing or impossible value.
Display readDisplay(const std::string& name, const DisplayFiles& files = {});
/// Limen's profile as ColorVideoVDP's model sees it: levels, room and geometry are the same.
Display displayOf(const DisplayProfile& profile);

}  // namespace limen::perception::cvvdp
