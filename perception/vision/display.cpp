// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/text.h"
#include "perception/vision/colour.h"

namespace limen::perception {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kBrightest = 1e6;  ///< relative light that an infinite value counts as

// Rows of the spec's matrix for XYZ, whose second adds up to 1.0000001: divided by that, so that white has Y
// = 1.
constexpr double kRed = 0.2126729 / 1.0000001, kGreen = 0.7151522 / 1.0000001, kBlue = 0.0721750 / 1.0000001;

double light(double value) { return value > 0.0 ? std::min(value, kBrightest) : 0.0; }

double relativeY(const std::array<double, 3>& rgb) {
  return kRed * light(rgb[0]) + kGreen * light(rgb[1]) + kBlue * light(rgb[2]);
}

}  // namespace

double DisplayProfile::reflectedCdM2() const { return ambientLux * screenReflectance / std::numbers::pi; }

double DisplayProfile::decode(double value) const {
  if (transfer == TransferCurve::Linear) return light(value);
  const double u = value > 0.0 ? std::min(value, 1.0) : 0.0;
  return transfer == TransferCurve::Srgb ? decodeSrgb(u) : std::pow(u, gamma);
}

double DisplayProfile::luminanceCdM2(const std::array<double, 3>& linearRgb) const {
  const double black = blackLevelCdM2();
  return (whiteLevelCdM2() - black) * relativeY(linearRgb) + black;
}

glm::dvec3 DisplayProfile::xyz(const std::array<double, 3>& linearRgb) const {
  const double black = blackLevelCdM2(), range = whiteLevelCdM2() - black;
  glm::dvec3 relative = xyzFromLinearRgb({light(linearRgb[0]), light(linearRgb[1]), light(linearRgb[2])});
  relative.y = relativeY(linearRgb);
  return range * relative + black * whiteXyz();
}

double DisplayProfile::pixelsPerDegree() const {
  return 2.0 * distanceM * std::tan(0.5 / kDegrees) / pitchM();
}

double DisplayProfile::pixelsPerDegreeAt(double offsetPx) const {
  // 1 / (atan((x + p / 2) / d) - atan((x - p / 2) / d)), the difference as one arc tangent.
  const double p = pitchM(), x = offsetPx * p, d = distanceM;
  return 1.0 / (kDegrees * std::atan2(p * d, d * d + x * x - 0.25 * p * p));
}

double DisplayProfile::areaDeg2(glm::dvec2 sizePx) const {
  const auto angle = [&](double px) { return 2.0 * kDegrees * std::atan(0.5 * px * pitchM() / distanceM); };
  return angle(sizePx.x) * angle(sizePx.y);
}

std::string DisplayProfile::hash() const {
  DisplayProfile unnamed = *this;
  unnamed.name.clear();
  return sha256("display 1\n" + toYaml(unnamed));
}

std::string DisplayProfile::line() const {
  const double reflected = reflectedCdM2();
  return fmt::format(
      "{}: {} x {} px, {:.0f} x {:.0f} mm at {:.4g} m, {:.4g} to {:.4g} cd/m2{}, {:.4g} px/deg, "
      "{:.4g} Hz, {}",
      name.empty() ? "display" : name, resolutionPx.x, resolutionPx.y, 1000.0 * widthM, 1000.0 * heightM,
      distanceM, blackCdM2, peakCdM2, reflected > 0.0 ? fmt::format(" and {:.2g} reflected", reflected) : "",
      pixelsPerDegree(), refreshHz,
      transfer == TransferCurve::Srgb    ? "sRGB"
      : transfer == TransferCurve::Gamma ? fmt::format("gamma {:.4g}", gamma)
                                         : "linear");
}

void checkDisplay(const DisplayProfile& profile, const std::string& where) {
  const auto check = [&](const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    throw Error(fmt::format("'{}' is {}", what, shortestNumber(value)), where,
                fmt::format("allowed: {} to {}", shortestNumber(low), shortestNumber(high)));
  };
  check("resolution_px", profile.resolutionPx.x, 1, 65536);
  check("resolution_px", profile.resolutionPx.y, 1, 65536);
  check("width", profile.widthM, 1e-3, 100.0);
  check("height", profile.heightM, 1e-3, 100.0);
  check("distance_m", profile.distanceM, 1e-2, 1000.0);
  check("black_cd_m2", profile.blackCdM2, 0.0, 1e5);
  check("peak_cd_m2", profile.peakCdM2, 1e-3, 1e6);
  check("ambient_lux", profile.ambientLux, 0.0, 2e5);
  check("screen_reflectance", profile.screenReflectance, 0.0, 1.0);
  check("gamma", profile.gamma, 0.2, 10.0);
  check("refresh_hz", profile.refreshHz, 0.1, 10000.0);
  if (profile.peakCdM2 <= profile.blackCdM2)
    throw Error(fmt::format("'peak_cd_m2' ({}) is not above 'black_cd_m2' ({})",
                            shortestNumber(profile.peakCdM2), shortestNumber(profile.blackCdM2)),
                where, "give the luminance of white and of black");
  const double aspect = profile.pitchM() * profile.resolutionPx.y / profile.heightM;
  if (aspect < 0.95 || aspect > 1.05)
    throw Error(fmt::format("pixels of {} x {} mm are not square", shortestNumber(1000.0 * profile.pitchM()),
                            shortestNumber(1000.0 * profile.heightM / profile.resolutionPx.y)),
                where,
                "give width and height of the lit area to match the resolution that the display shows");
}

}  // namespace limen::perception
