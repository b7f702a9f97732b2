// SPDX-License-Identifier: BSD-3-Clause
//
// Two mechanisms add up: a sustained and a transient one, each with its response to temporal frequency, a
// log-parabola over spatial frequency cut off below its peak, and spatial integration after Rovamo, Luntinen
// and Nasanen 1993. Written from the equations of the papers; the constants are those published with them.
//
// One departure: the transient mechanism's best temporal frequency falls with luminance in castleCSF and
// passes 0 near 0.011 cd/m2. Below that it is clamped to 0; the paper does not say what a negative frequency
// would mean.
#include "perception/vision/stela_csf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "perception/vision/csf_arguments.h"

namespace limen::perception {

const StelaConstants kStela2022 = {
    {{68.9501, 59.5023, 0.164274, 7.54866e-07, 7.77268e+09},
     {1.62144, 36.6565, 0.255823},
     0.000219263,
     0.103686,
     270.0,
     0.65},
    {{57.3469, 0.0, 0.500846, 0.0, 0.0}, {0.0267489, 0.0, 0.0}, 1.75147, 0.000273289, 270.0, 0.65},
    5.79336,
    1.3314,
    0.12314,
    0.1898,
    5.0,
    0.0,
    0.0113638,
    0.0193858};

const StelaConstants kCastle2024 = {
    {{56.4947, 7.54726, 0.144532, 5.58341e-07, 9.66862e+09},
     {1.78119, 91.5718, 0.256682},
     0.000213047,
     0.100207,
     157.103,
     0.702338},
    {{2748.09, 0.0, 0.193434, 0.0, 0.0}, {0.000316696, 0.0, 0.0}, 2.6761, 0.000241177, 3.81611, 3.01389},
    10.5795,
    1.3314,
    0.0844836,
    0.1898,
    4.7036,
    2.41482,
    0.0400662,
    0.00813619};

namespace {

// (1 + k / l)^-n for k of 1e-6 and n of 1e10, where 1 + k / l would round.
double hyperbola(double k, double n, double l) { return std::exp(-n * std::log1p(k / l)); }

}  // namespace

double stelaSpatial(double rho, double l, double areaDeg2, const StelaChannel& c) {
  double gain = c.gain[0];
  if (c.gain[1] > 0.0)
    gain *= hyperbola(c.gain[1], c.gain[2], l);
  else
    gain *= std::pow(l, c.gain[2]);
  if (c.gain[1] > 0.0 && c.gain[4] > 0.0) gain *= 1.0 - hyperbola(c.gain[3], c.gain[4], l);
  const double peak = c.frequency[0] * hyperbola(c.frequency[1], c.frequency[2], l);
  const double octave = std::log10(rho / peak);
  double shape = std::pow(10.0, -octave * octave / std::exp2(c.bandwidth));
  if (rho < peak) shape = std::max(shape, 1.0 - c.truncation);
  const double relative = rho / c.cornerCpd;
  const double critical = c.area / (1.0 + relative * relative);
  return gain * shape * rho * std::sqrt(critical * (areaDeg2 / (areaDeg2 + critical)));
}

double csfStela(double rho, double omega, double l, double areaDeg2, double eccentricityDeg,
                const StelaConstants& k) {
  if (std::isnan(rho + omega + l + areaDeg2 + eccentricityDeg) || !(rho > 0.0) || !(areaDeg2 > 0.0))
    return 0.0;
  if (std::isinf(rho) || std::isinf(omega)) return 0.0;
  l = std::clamp(l, 1e-3, 1e4);
  areaDeg2 = std::min(areaDeg2, 1e12);
  omega = std::abs(omega);
  const double sustained = std::exp(-std::pow(omega, k.sustainedExponent) / k.sustainedWidth);
  const double best = std::max(0.0, k.transientHz + k.transientSlope * std::log10(l));
  const double off = std::pow(omega, k.transientExponent) - std::pow(best, k.transientExponent);
  const double transient = std::exp(-off * off / k.transientWidth);
  const double drop = (k.drop + rho * k.dropPerCpd) * std::abs(eccentricityDeg);
  return std::pow(10.0, -drop) * (sustained * stelaSpatial(rho, l, areaDeg2, k.sustained) +
                                  transient * stelaSpatial(rho, l, areaDeg2, k.transient));
}

namespace {

// The transient mechanism has a power law instead of hyperbolas, and one peak frequency at all luminances:
// the constants that would be 0 are not settings of it.
struct TransientSettings {
  double gain1 = 0.0, gain3 = 0.0, frequency1 = 0.0;
  double bandwidth = 0.0, truncation = 0.0, areaLimit = 0.0, corner = 0.0;
  double width = 0.0, exponent = 0.0, hz = 0.0, slope = 0.0;
  static const SettingsTable<TransientSettings>& table();
};
struct SustainedSettings {
  double gain1 = 0.0, gain2 = 0.0, gain3 = 0.0, gain4 = 0.0, gain5 = 0.0;
  double frequency1 = 0.0, frequency2 = 0.0, frequency3 = 0.0;
  double bandwidth = 0.0, truncation = 0.0, areaLimit = 0.0, corner = 0.0;
  double width = 0.0, exponent = 0.0;
  static const SettingsTable<SustainedSettings>& table();
};
struct StelaSettings {
  CsfGain gain;
  SustainedSettings sustained;
  TransientSettings transient;
  double drop = 0.0, dropPerCpd = 0.0;
  static const SettingsTable<StelaSettings>& table();
};

constexpr const char *kGain = "gain over luminance", *kFrequency = "peak frequency over luminance",
                     *kDecay = "decay with temporal frequency",
                     *kWidth = "width around its best temporal frequency";

Binding<SustainedSettings> constant(double SustainedSettings::*member, const char* name, double most,
                                    const char* unit, const char* description) {
  return {member, name, Range{0.0, most}, unit, description};
}
Binding<TransientSettings> constant(double TransientSettings::*member, const char* name, double most,
                                    const char* unit, const char* description) {
  return {member, name, Range{0.0, most}, unit, description};
}

const SettingsTable<SustainedSettings>& SustainedSettings::table() {
  using S = SustainedSettings;
  static const SettingsTable<S> kTable = {
      constant(&S::gain1, "gain1", 1e12, "", kGain),
      constant(&S::gain2, "gain2", 1e12, "", kGain),
      constant(&S::gain3, "gain3", 1e12, "", kGain),
      constant(&S::gain4, "gain4", 1e12, "", kGain),
      constant(&S::gain5, "gain5", 1e12, "", kGain),
      constant(&S::frequency1, "frequency1", 1e6, "", kFrequency),
      constant(&S::frequency2, "frequency2", 1e6, "", kFrequency),
      constant(&S::frequency3, "frequency3", 1e6, "", kFrequency),
      constant(&S::bandwidth, "bandwidth", 20.0, "", "lg 2 of the log-parabola's width"),
      constant(&S::truncation, "truncation", 1.0, "", "largest fall below the peak frequency"),
      constant(&S::areaLimit, "area_limit", 1e6, "deg2", "largest area that is integrated over"),
      constant(&S::corner, "corner", 1e3, "cpd", "frequency above which that area shrinks"),
      constant(&S::width, "width", 1e6, "", kDecay),
      constant(&S::exponent, "exponent", 10.0, "", kDecay)};
  return kTable;
}

const SettingsTable<TransientSettings>& TransientSettings::table() {
  using S = TransientSettings;
  static const SettingsTable<S> kTable = {
      constant(&S::gain1, "gain1", 1e12, "", kGain),
      constant(&S::gain3, "gain3", 1e12, "", kGain),
      constant(&S::frequency1, "frequency1", 1e6, "", kFrequency),
      constant(&S::bandwidth, "bandwidth", 20.0, "", "lg 2 of the log-parabola's width"),
      constant(&S::truncation, "truncation", 1.0, "", "largest fall below the peak frequency"),
      constant(&S::areaLimit, "area_limit", 1e6, "deg2", "largest area that is integrated over"),
      constant(&S::corner, "corner", 1e3, "cpd", "frequency above which that area shrinks"),
      constant(&S::width, "width", 1e6, "", kWidth),
      constant(&S::exponent, "exponent", 10.0, "", kWidth),
      constant(&S::hz, "hz", 1e3, "Hz", "best temporal frequency at 1 cd/m2"),
      constant(&S::slope, "slope", 1e3, "Hz", "change of it with lg luminance")};
  return kTable;
}

const SettingsTable<StelaSettings>& StelaSettings::table() {
  using S = StelaSettings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::sustained, "sustained", "mechanism of slow changes"},
      {&S::transient, "transient", "mechanism of fast changes"},
      {&S::drop, "drop", {0.0, 10.0}, "1/deg", "lg loss with eccentricity, nasal field"},
      {&S::dropPerCpd,
       "drop_per_cpd",
       {0.0, 10.0},
       "1/(deg cpd)",
       "lg loss with eccentricity and frequency"}};
  return kTable;
}

StelaSettings settingsOf(const StelaConstants& k) {
  const StelaChannel &s = k.sustained, &t = k.transient;
  StelaSettings out;
  out.sustained = {s.gain[0],      s.gain[1],      s.gain[2],        s.gain[3],          s.gain[4],
                   s.frequency[0], s.frequency[1], s.frequency[2],   s.bandwidth,        s.truncation,
                   s.area,         s.cornerCpd,    k.sustainedWidth, k.sustainedExponent};
  out.transient = {t.gain[0],   t.gain[2],        t.frequency[0],      t.bandwidth,   t.truncation,    t.area,
                   t.cornerCpd, k.transientWidth, k.transientExponent, k.transientHz, k.transientSlope};
  out.drop = k.drop;
  out.dropPerCpd = k.dropPerCpd;
  return out;
}

StelaConstants constantsOf(const StelaSettings& settings) {
  const SustainedSettings& s = settings.sustained;
  const TransientSettings& t = settings.transient;
  StelaConstants k{};
  k.sustained = {{s.gain1, s.gain2, s.gain3, s.gain4, s.gain5},
                 {s.frequency1, s.frequency2, s.frequency3},
                 s.bandwidth,
                 s.truncation,
                 s.areaLimit,
                 s.corner};
  k.transient = {{t.gain1, 0.0, t.gain3, 0.0, 0.0},
                 {t.frequency1, 0.0, 0.0},
                 t.bandwidth,
                 t.truncation,
                 t.areaLimit,
                 t.corner};
  k.sustainedWidth = s.width, k.sustainedExponent = s.exponent;
  k.transientWidth = t.width, k.transientExponent = t.exponent;
  k.transientHz = t.hz, k.transientSlope = t.slope;
  k.drop = settings.drop, k.dropPerCpd = settings.dropPerCpd;
  return k;
}

std::unique_ptr<Csf> make(const StelaSettings& settings) {
  return makeFunctionCsf(settings.gain, [k = constantsOf(settings)](const CsfPoint& p) {
    return csfStela(p.frequencyCpd, p.frequencyCpd * p.velocityDegS, p.luminanceCdM2, p.areaDeg2,
                    p.eccentricityDeg, k);
  });
}

std::vector<CsfArgument> stelaArguments() {
  return {frequencyArgument(0.0625, 64.0), velocityArgument(0.0, 1000.0), luminanceArgument(1e-3, 1e4),
          areaArgument(0.001, 1e4), CsfArgument{"eccentricity_deg", "deg", 0.0, 60.0}};
}

const RegisteredCsf<StelaSettings> kStela{
    {.name = "stelacsf",
     .summary =
         "Fit to 11 studies of spatial and temporal frequency (speed times frequency), luminance, area and "
         "eccentricity. Beyond its range extrapolated; luminance is clamped to [1e-3, 1e4] cd/m2; 0 for an "
         "area "
         "of 0.",
     .source = "Mantiuk, Ashraf and Chapiro 2022, constants published with the paper",
     .arguments = stelaArguments()},
    &make,
    settingsOf(kStela2022)};

const RegisteredCsf<StelaSettings> kCastle{
    {.name = "castlecsf",
     .summary =
         "Achromatic mechanism of castleCSF, fit to 18 studies like stelaCSF with other constants and a "
         "transient mechanism that slows in the dark. Beyond its range extrapolated; luminance is clamped to "
         "[1e-3, 1e4] cd/m2; 0 for an area of 0.",
     .source = "Ashraf, Mantiuk, Chapiro and Wuerger 2024, constants published with the paper",
     .arguments = stelaArguments()},
    &make,
    settingsOf(kCastle2024)};

}  // namespace
}  // namespace limen::perception
