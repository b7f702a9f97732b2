// SPDX-License-Identifier: BSD-3-Clause
//
// Two mechanisms add up: a sustained and a transient one, each with its response to temporal frequency, a
// log-parabola over spatial frequency cut off below its peak, and spatial integration after Rovamo, Luntinen
// and Nasanen 1993. Written from the equations of the papers; the constants are those published with them.
//
// One departure: the transient mechanism's best temporal frequency falls with luminance in castleCSF and
// passes 0 near 0.011 cd/m2. Below it is held at 0; what a negative frequency would mean is not said.
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

double channel(double rho, double l, double area, const StelaChannel& c) {
  const double gain = c.gain[1] > 0.0 ? c.gain[0] * hyperbola(c.gain[1], c.gain[2], l) *
                                            (1.0 - hyperbola(c.gain[3], c.gain[4], l))
                                      : c.gain[0] * std::pow(l, c.gain[2]);
  const double peak = c.frequency[0] * hyperbola(c.frequency[1], c.frequency[2], l);
  const double octave = std::log10(rho / peak);
  double shape = std::pow(10.0, -octave * octave / std::exp2(c.bandwidth));
  if (rho < peak) shape = std::max(shape, 1.0 - c.truncation);
  const double relative = rho / c.cornerCpd;
  const double critical = c.area / (1.0 + relative * relative);
  return gain * shape * rho * std::sqrt(critical * (area / (area + critical)));
}

}  // namespace

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
  return std::pow(10.0, -drop) * (sustained * channel(rho, l, areaDeg2, k.sustained) +
                                  transient * channel(rho, l, areaDeg2, k.transient));
}

namespace {

std::string numbered(const std::string& name, size_t i) { return name + std::to_string(i + 1); }

/// Declares the constants or, given values, reads them: one list serves both, so that they cannot drift
/// apart.
template <class Visit>
void visitConstants(StelaConstants& k, Visit&& visit) {
  const auto channelConstants = [&](const std::string& prefix, StelaChannel& c) {
    // The transient mechanism has a power law instead of hyperbolas, and one peak frequency at all
    // luminances.
    for (size_t i = 0; i < c.gain.size(); ++i)
      if (c.gain[1] > 0.0 || i == 0 || i == 2)
        visit(numbered(prefix + "gain", i), c.gain[i], 1e12, "", "gain over luminance");
    for (size_t i = 0; i < c.frequency.size(); ++i)
      if (c.frequency[1] > 0.0 || i == 0)
        visit(numbered(prefix + "frequency", i), c.frequency[i], 1e6, "", "peak frequency over luminance");
    visit(prefix + "bandwidth", c.bandwidth, 20.0, "", "lg 2 of the log-parabola's width");
    visit(prefix + "truncation", c.truncation, 1.0, "", "largest fall below the peak frequency");
    visit(prefix + "area_limit", c.area, 1e6, "deg2", "largest area that is integrated over");
    visit(prefix + "corner", c.cornerCpd, 1e3, "cpd", "frequency above which that area shrinks");
  };
  channelConstants("sustained_", k.sustained);
  visit("sustained_width", k.sustainedWidth, 1e6, "", "decay with temporal frequency");
  visit("sustained_exponent", k.sustainedExponent, 10.0, "", "decay with temporal frequency");
  channelConstants("transient_", k.transient);
  visit("transient_width", k.transientWidth, 1e6, "", "width around its best temporal frequency");
  visit("transient_exponent", k.transientExponent, 10.0, "", "width around its best temporal frequency");
  visit("transient_hz", k.transientHz, 1e3, "Hz", "best temporal frequency at 1 cd/m2");
  visit("transient_slope", k.transientSlope, 1e3, "Hz", "change of it with lg luminance");
  visit("drop", k.drop, 10.0, "1/deg", "lg loss with eccentricity, nasal field");
  visit("drop_per_cpd", k.dropPerCpd, 10.0, "1/(deg cpd)", "lg loss with eccentricity and frequency");
}

CsfInfo info(const char* name, const StelaConstants& constants, const char* summary, const char* source) {
  CsfInfo out;
  out.name = name;
  out.summary = summary;
  out.source = source;
  out.arguments = {frequencyArgument(0.0625, 64.0), velocityArgument(0.0, 1000.0),
                   luminanceArgument(1e-3, 1e4), areaArgument(0.001, 1e4),
                   CsfArgument{"eccentricity_deg", "deg", 0.0, 60.0}};
  out.parameters = {gainParameter()};
  StelaConstants declared = constants;
  visitConstants(declared, [&](const std::string& constant, double& value, double high, const char* unit,
                               const char* description) {
    out.parameters.push_back(realParameter(constant, value, 0.0, high, unit, description, source));
  });
  out.make = [constants](const ParameterValues& values) {
    StelaConstants k = constants;
    visitConstants(k, [&](const std::string& constant, double& value, double, const char*, const char*) {
      value = values.real(constant);
    });
    return makeFunctionCsf(values, [k](const CsfPoint& p) {
      return csfStela(p.frequencyCpd, p.frequencyCpd * p.velocityDegS, p.luminanceCdM2, p.areaDeg2,
                      p.eccentricityDeg, k);
    });
  };
  return out;
}

const Registered<CsfInfo> kStela{
    info("stelacsf", kStela2022,
         "Fit to 11 studies of spatial and temporal frequency (speed times frequency), luminance, area and "
         "eccentricity. Beyond its range extrapolated; luminance is held to [1e-3, 1e4] cd/m2; 0 for an area "
         "of 0.",
         "Mantiuk, Ashraf and Chapiro 2022, constants published with the paper")};

const Registered<CsfInfo> kCastle{info(
    "castlecsf", kCastle2024,
    "Achromatic mechanism of castleCSF, fit to 18 studies like stelaCSF with other constants and a transient "
    "mechanism that slows in the dark. Beyond its range extrapolated; luminance is held to [1e-3, 1e4] "
    "cd/m2; "
    "0 for an area of 0.",
    "Ashraf, Mantiuk, Chapiro and Wuerger 2024, constants published with the paper")};

}  // namespace
}  // namespace limen::perception
