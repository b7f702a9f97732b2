// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::perception {

enum class TransferCurve {
  Srgb,   ///< IEC 61966-2-1
  Gamma,  ///< u^gamma
  Linear  ///< values are light already (rendered and HDR images)
};

/// A display, the room and the viewing position: everything that turns pixel values into light on the retina.
/// One profile determines what a study shows and what every model assumes. Source: Schwarz 2009, sections 9.1
/// and 10.3; black and white level as in section 10.3.
struct DisplayProfile {
  std::string name;
  glm::ivec2 resolutionPx{1920, 1080};
  double widthM = 0.527, heightM = 0.296;  ///< of the lit area
  double distanceM = 0.6;                  ///< viewer's eye to the screen's centre
  double blackCdM2 = 0.5, peakCdM2 = 250.0;
  double ambientLux = 0.0;           ///< light that falls on the screen
  double screenReflectance = 0.005;  ///< diffuse share of it that is reflected
  TransferCurve transfer = TransferCurve::Srgb;
  double gamma = 2.2;  ///< used by TransferCurve::Gamma
  double refreshHz = 60.0;

  /// Luminance of the ambient light reflected by the screen, added to black and white alike.
  double reflectedCdM2() const;
  double blackLevelCdM2() const { return blackCdM2 + reflectedCdM2(); }
  double whiteLevelCdM2() const { return peakCdM2 + reflectedCdM2(); }
  /// Pixel value in [0, 1] to relative light in [0, 1]; values outside are clamped, NaN counts as 0. Linear
  /// passes values above 1 through.
  double decode(double value) const;
  /// Absolute luminance of relative linear RGB (Rec. 709 primaries).
  double luminanceCdM2(const std::array<double, 3>& linearRgb) const;
  /// Absolute XYZ of relative linear RGB: the light between black and white level, plus black with D65's
  /// chromaticity.
  glm::dvec3 xyz(const std::array<double, 3>& linearRgb) const;
  double pitchM() const { return widthM / resolutionPx.x; }
  /// At the screen's centre: 2 d tan(0.5 deg) / pitch.
  double pixelsPerDegree() const;
  /// At a distance of `offsetPx` pixels from the centre, along that direction.
  double pixelsPerDegreeAt(double offsetPx) const;
  /// Of `sizePx` pixels centred on the screen.
  double areaDeg2(glm::dvec2 sizePx) const;
  /// SHA-256 over everything that determines what is seen (not the name).
  std::string hash() const;
  /// One line fit for a paper: name, resolution, size, distance, levels, pixels per degree, refresh.
  std::string line() const;
};

/// Throws Error with `where` on values impossible for a display (sizes not positive, peak not above black,
/// ...).
void checkDisplay(const DisplayProfile& profile, const std::string& where);
/// Presets by name: "schwarz_2009" (the thesis's study set-up: 20 in 4:3, 1600x1200, 0.6 m, 0.5 to 250 cd/m2,
/// 60 Hz), "desktop_24" ... All with a source or a stated reason.
std::vector<std::string> displayPresets();
DisplayProfile displayPreset(const std::string& name);
/// Rationale of a preset; empty for an unknown name.
std::string displayPresetReason(const std::string& name);
/// A preset's name or the path of a profile (YAML). Throws Error: unknown name with the nearest known one,
/// unreadable file, unknown key, bad value with line. The keys are listed at the top of display_profiles.cpp;
/// a profile without a name takes the file's.
DisplayProfile readDisplay(const std::string& nameOrFile);
/// Text form that readDisplay() reads back to the same profile.
std::string toYaml(const DisplayProfile& profile);

}  // namespace limen::perception
