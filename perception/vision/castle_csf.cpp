// SPDX-License-Identifier: BSD-3-Clause
//
// The achromatic mechanisms are those of stela_csf.cpp with other constants. The chromatic ones have the same
// form: one hyperbola over luminance, a log-parabola that is flat below its peak, the same spatial
// integration. Written from the equations of the paper; constants as published with it.
#include "perception/vision/castle_csf.h"

#include <algorithm>
#include <cmath>

#include "perception/vision/csf_arguments.h"
#include "perception/vision/stela_csf.h"

namespace limen::perception {
namespace {

struct Chromatic {
  StelaChannel spatial;
  double width, exponent;   ///< of the decay with temporal frequency
  double drop, dropPerCpd;  ///< lg loss with eccentricity, nasal field [1/deg], [1/(deg cpd)]
};

constexpr Chromatic kRedGreen = {
    {{681.434, 38.0038, 0.480386, 0.0, 0.0}, {0.0178364, 0.0, 0.0}, 2.42104, 0.0, 2816.44, 0.0711058},
    16.4325,
    1.15591,
    2.89615e-05,
    0.18108};
constexpr Chromatic kYellowViolet = {
    {{166.683, 62.8974, 0.41193, 0.0, 0.0}, {0.00425753, 0.0, 0.0}, 2.68197, 0.0, 2.82789e+07, 0.000635093},
    7.15012,
    0.969123,
    5.85804e-141,
    0.0110662};

const StelaChannel& channelOf(CastleMechanism mechanism) {
  switch (mechanism) {
    case CastleMechanism::Sustained:
      return kCastle2024.sustained;
    case CastleMechanism::Transient:
      return kCastle2024.transient;
    case CastleMechanism::RedGreen:
      return kRedGreen.spatial;
    case CastleMechanism::YellowViolet:
      break;
  }
  return kYellowViolet.spatial;
}

double heldLuminance(double l) { return std::clamp(l, 1e-3, 1e4); }

}  // namespace

double castleSpatial(CastleMechanism mechanism, double rho, double luminanceCdM2, double areaDeg2) {
  if (std::isnan(luminanceCdM2) || !(rho > 0.0) || std::isinf(rho) || !(areaDeg2 > 0.0)) return 0.0;
  return stelaSpatial(rho, heldLuminance(luminanceCdM2), std::min(areaDeg2, 1e12), channelOf(mechanism));
}

double castleTransientHz(double luminanceCdM2) {
  // Below 0.011 cd/m2 the fit is negative; see stela_csf.cpp.
  return std::max(
      0.0, kCastle2024.transientHz + kCastle2024.transientSlope * std::log10(heldLuminance(luminanceCdM2)));
}

double castleKinkCdM2() { return std::pow(10.0, -kCastle2024.transientHz / kCastle2024.transientSlope); }

double castleTemporal(CastleMechanism mechanism, double omegaHz, double luminanceCdM2) {
  if (std::isnan(omegaHz) || std::isnan(luminanceCdM2)) return 0.0;
  const double omega = std::abs(omegaHz);
  const auto decay = [&](double width, double exponent) {
    return std::exp(-std::pow(omega, exponent) / width);
  };
  switch (mechanism) {
    case CastleMechanism::Sustained:
      return decay(kCastle2024.sustainedWidth, kCastle2024.sustainedExponent);
    case CastleMechanism::RedGreen:
      return decay(kRedGreen.width, kRedGreen.exponent);
    case CastleMechanism::YellowViolet:
      return decay(kYellowViolet.width, kYellowViolet.exponent);
    case CastleMechanism::Transient:
      break;
  }
  const double exponent = kCastle2024.transientExponent;
  const double off = std::pow(omega, exponent) - std::pow(castleTransientHz(luminanceCdM2), exponent);
  return std::exp(-off * off / kCastle2024.transientWidth);
}

double csfCastle(CastleMechanism mechanism, double rho, double omegaHz, double luminanceCdM2, double areaDeg2,
                 double eccentricityDeg) {
  const double spatial = castleSpatial(mechanism, rho, luminanceCdM2, areaDeg2);
  if (spatial == 0.0 || std::isnan(eccentricityDeg)) return 0.0;
  double drop = kCastle2024.drop, dropPerCpd = kCastle2024.dropPerCpd;
  if (mechanism == CastleMechanism::RedGreen) drop = kRedGreen.drop, dropPerCpd = kRedGreen.dropPerCpd;
  if (mechanism == CastleMechanism::YellowViolet)
    drop = kYellowViolet.drop, dropPerCpd = kYellowViolet.dropPerCpd;
  const double loss = std::pow(10.0, -(drop + rho * dropPerCpd) * std::abs(eccentricityDeg));
  return loss * spatial * castleTemporal(mechanism, omegaHz, luminanceCdM2);
}

double csfCastleAchromatic(double rho, double omegaHz, double luminanceCdM2, double areaDeg2,
                           double eccentricityDeg) {
  return csfStela(rho, omegaHz, luminanceCdM2, areaDeg2, eccentricityDeg, kCastle2024);
}

namespace {

struct CastleSettings {
  CsfGain gain;
  static const SettingsTable<CastleSettings>& table() {
    static const SettingsTable<CastleSettings> kTable = {included(&CastleSettings::gain)};
    return kTable;
  }
};

template <CastleMechanism kMechanism>
std::unique_ptr<Csf> make(const CastleSettings& settings) {
  return makeFunctionCsf(settings.gain, [](const CsfPoint& p) {
    const double hz = p.frequencyCpd * p.velocityDegS;
    return std::isfinite(hz)
               ? csfCastle(kMechanism, p.frequencyCpd, hz, p.luminanceCdM2, p.areaDeg2, p.eccentricityDeg)
               : 0.0;
  });
}

CsfInfo describe(const char* name, Channel channel, const char* what) {
  return {.name = name,
          .summary =
              std::string(what) +
              " of castleCSF; absolute sensitivity. Beyond its range extrapolated; luminance is clamped to "
              "[1e-3, 1e4] cd/m2; 0 for an area of 0.",
          .source = "Ashraf, Mantiuk, Chapiro and Wuerger 2024, constants published with the paper",
          .channel = channel,
          .arguments = {frequencyArgument(0.0625, 64.0), velocityArgument(0.0, 1000.0),
                        luminanceArgument(1e-3, 1e4), areaArgument(0.001, 1e4),
                        CsfArgument{"eccentricity_deg", "deg", 0.0, 60.0}}};
}

const RegisteredCsf<CastleSettings> kRegisteredRedGreen{
    describe("castlecsf_rg", Channel::RedGreen, "Red-green mechanism (contrast RG of DKL space)"),
    &make<CastleMechanism::RedGreen>};
const RegisteredCsf<CastleSettings> kRegisteredYellowViolet{
    describe("castlecsf_yv", Channel::BlueYellow, "Yellow-violet mechanism (contrast YV of DKL space)"),
    &make<CastleMechanism::YellowViolet>};
const RegisteredCsf<CastleSettings> kRegisteredSustained{
    describe("castlecsf_sustained", Channel::Achromatic, "Sustained achromatic mechanism alone"),
    &make<CastleMechanism::Sustained>};
const RegisteredCsf<CastleSettings> kRegisteredTransient{
    describe("castlecsf_transient", Channel::Achromatic, "Transient achromatic mechanism alone"),
    &make<CastleMechanism::Transient>};

}  // namespace
}  // namespace limen::perception
