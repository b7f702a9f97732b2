// SPDX-License-Identifier: BSD-3-Clause
//
// Registration of the models that know no motion.
#include <algorithm>
#include <cmath>

#include "perception/vision/adaptation.h"
#include "perception/vision/csf_arguments.h"
#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

const char* const kSection = "Schwarz 2009, section 9.1.1";

Parameter constant(const char* name, double value, double low, double high, const char* unit,
                   const char* description) {
  return realParameter(name, value, low, high, unit, description, kSection);
}

std::vector<Parameter> barten89Parameters(double a) {
  return {gainParameter(), constant("a", a, 0.0, 1e6, "", "height"),
          constant("b", 0.3, 1e-3, 10.0, "deg", "decay with frequency"),
          constant("c", 0.06, 0.0, 10.0, "", "share that decays half as fast")};
}

Barten89Constants barten89Constants(const ParameterValues& values) {
  return {values.real("a"), values.real("b"), values.real("c")};
}

// Barten fitted both to data of several observers from about 0.1 to 60 cpd and 1e-3 to 1e3 cd/m2.
const Registered<CsfInfo> kBarten89{CsfInfo{
    "barten89",
    1,
    "Band-pass over frequency, rising with luminance. Beyond its range extrapolated; luminance is held to "
    "[1e-4, 1e8] cd/m2.",
    "Barten 1989; Schwarz 2009, (9.1)",
    Channel::Achromatic,
    {frequencyArgument(0.1, 60.0), luminanceArgument(1e-3, 1e3)},
    barten89Parameters(Barten89Constants{}.a),
    [](const ParameterValues& values) {
      return makeFunctionCsf(values, [k = barten89Constants(values)](const CsfPoint& p) {
        return csfBarten89(p.frequencyCpd, p.luminanceCdM2, k);
      });
    }}};

const Registered<CsfInfo> kBarten89Size{CsfInfo{
    "barten89_size",
    1,
    "Barten 1989 with the display's angular width: small displays lose low frequencies. Beyond its range "
    "extrapolated; luminance is held to [1e-4, 1e8] cd/m2; 0 for a width of 0.",
    "Barten 1990; Schwarz 2009, (9.1), footnote",
    Channel::Achromatic,
    {frequencyArgument(0.1, 60.0), luminanceArgument(1e-3, 1e3), {"width_deg", "deg", 0.5, 60.0}},
    barten89Parameters(kBarten89SizeGain),
    [](const ParameterValues& values) {
      return makeFunctionCsf(values, [k = barten89Constants(values)](const CsfPoint& p) {
        return csfBarten89Size(p.frequencyCpd, p.luminanceCdM2, p.widthDeg, k.a, k);
      });
    }}};

class Barten03 : public Csf {
 public:
  explicit Barten03(const ParameterValues& values)
      : gain_(values.real("gain")), constants_{values.real("height"),       values.real("optics"),
                                               values.real("area_limit"),   values.real("cycles"),
                                               values.real("photon_noise"), values.real("photon_exponent"),
                                               values.real("lateral")} {}
  double sensitivity(const CsfPoint& p) const override {
    return gain_ * csfBarten03(p.frequencyCpd, p.luminanceCdM2, p.areaDeg2, constants_);
  }

 private:
  double gain_;
  Barten03Constants constants_;
};

const Registered<CsfInfo> kBarten03{CsfInfo{
    "barten03",
    1,
    "Barten's physical model for a typical viewer, simplified: luminance and stimulus area. Beyond its range "
    "extrapolated; luminance is held to [1e-4, 1e8] cd/m2; 0 for an area of 0.",
    "Barten 2003; Schwarz 2009, (9.2)",
    Channel::Achromatic,
    {frequencyArgument(0.1, 60.0), luminanceArgument(1e-3, 1e3), areaArgument(0.05, 3600.0)},
    {gainParameter(), constant("height", 5200.0, 0.0, 1e7, "", "height"),
     constant("optics", 0.0016, 0.0, 1.0, "deg2", "blur by the eye's optics"),
     constant("area_limit", 144.0, 0.0, 1e5, "deg2", "largest area that is integrated over"),
     constant("cycles", 0.64, 0.0, 100.0, "deg2", "limit on the number of cycles that are integrated"),
     constant("photon_noise", 63.0, 0.0, 1e6, "", "photon noise over neural noise at 1 cd/m2"),
     constant("photon_exponent", 0.83, 0.0, 2.0, "", "how fast photon noise falls with luminance"),
     constant("lateral", 0.02, 1e-6, 10.0, "deg2", "reach of lateral inhibition")},
    [](const ParameterValues& values) -> std::unique_ptr<Csf> {
      return std::make_unique<Barten03>(values);
    }}};

constexpr double kMartinLowCpd = 0.5, kMartinHighCpd = 60.0, kMartinLow = 1e-3, kMartinHigh = 1e3;

std::string martinName(size_t luminancePower, size_t frequencyPower) {
  return "s" + std::to_string(luminancePower) + std::to_string(frequencyPower);
}

std::vector<Parameter> martinParameters() {
  std::vector<Parameter> out = {gainParameter()};
  for (size_t l = 0; l < 4; ++l)
    for (size_t f = 0; f < 3; ++f)
      out.push_back(realParameter(martinName(l, f), kMartin92Luminance[l][f], -10.0, 10.0, "",
                                  "factor of (lg L)^" + std::to_string(l) + " (lg rho)^" + std::to_string(f),
                                  kSection));
  return out;
}

const Registered<CsfInfo> kMartin92{CsfInfo{
    "martin92",
    1,
    "Fit to measurements of van Nes and Bouman, a cubic in lg luminance that runs wild outside its data: "
    "frequency is held to [0.5, 60] cpd, luminance to [1e-3, 1e3] cd/m2.",
    "Martin, Ahumada and Larimer 1992; Schwarz 2009, section 9.1.1",
    Channel::Achromatic,
    {frequencyArgument(kMartinLowCpd, kMartinHighCpd), luminanceArgument(kMartinLow, kMartinHigh)},
    martinParameters(),
    [](const ParameterValues& values) {
      MartinCoefficients s{};
      for (size_t l = 0; l < 4; ++l)
        for (size_t f = 0; f < 3; ++f) s[l][f] = values.real(martinName(l, f));
      return makeFunctionCsf(values, [s](const CsfPoint& p) {
        if (std::isnan(p.frequencyCpd) || std::isnan(p.luminanceCdM2)) return 0.0;
        return csfMartin92Luminance(std::clamp(p.frequencyCpd, kMartinLowCpd, kMartinHighCpd),
                                    std::clamp(p.luminanceCdM2, kMartinLow, kMartinHigh), s);
      });
    }}};

CsfInfo martinChromatic(const char* name, Channel channel, const MartinChromaticConstants& k,
                        const char* aberration) {
  CsfInfo info;
  info.name = name;
  info.summary =
      "Fit to measurements of Mullen: low-pass, rising with the root of luminance up to 200 cd/m2. Beyond "
      "its "
      "range extrapolated; luminance is held to [1e-4, 1e8] cd/m2. With the constants as printed blue-yellow "
      "exceeds red-green and luminance; `gain` mends that.";
  info.source = "Martin, Ahumada and Larimer 1992; Schwarz 2009, section 9.1.1";
  info.channel = channel;
  info.arguments = {frequencyArgument(0.1, 30.0), luminanceArgument(1e-3, 1e3)};
  info.parameters = {gainParameter(),
                     realParameter("aberration", 1.0, 0.0, 1.0, "", aberration,
                                   "Schwarz 2009, section 9.1.1, without a number"),
                     constant("a", k.a, -10.0, 10.0, "", "lg height"),
                     constant("b", k.b, -10.0, 10.0, "", "lg height"),
                     constant("c", k.c, 0.0, 10.0, "", "fall above the plateau"),
                     constant("d", k.d, -3.0, 3.0, "", "lg of the plateau's end [cpd]")};
  info.make = [](const ParameterValues& values) {
    const MartinChromaticConstants constants = {values.real("a"), values.real("b"), values.real("c"),
                                                values.real("d")};
    const double aberrationFactor = values.real("aberration");
    return makeFunctionCsf(values, [constants, aberrationFactor](const CsfPoint& p) {
      return aberrationFactor * csfMartin92Chromatic(p.frequencyCpd, p.luminanceCdM2, constants);
    });
  };
  return info;
}

const Registered<CsfInfo> kRedGreen{martinChromatic("martin92_rg", Channel::RedGreen, kMartin92RedGreen,
                                                    "left over by chromatic aberration")};
const Registered<CsfInfo> kBlueYellow{
    martinChromatic("martin92_by", Channel::BlueYellow, kMartin92BlueYellow,
                    "left over by chromatic aberration, which the measurements had corrected for")};

const Registered<CsfInfo> kDaly93{CsfInfo{
    "daly93",
    1,
    "CSF of the visible differences predictor: orientation, luminance, image area, viewing distance and "
    "eccentricity. Beyond its range extrapolated; luminance is held to [1e-4, 1e8] cd/m2; 0 for an area or "
    "distance of 0.",
    "Daly 1993; named in Schwarz 2009, section 9.1.1; formula reconstructed, as public implementations have "
    "it",
    Channel::Achromatic,
    {frequencyArgument(0.1, 60.0),
     luminanceArgument(1e-3, 1e3),
     areaArgument(0.05, 3600.0),
     {"orientation_deg", "deg", -360.0, 360.0},
     {"eccentricity_deg", "deg", 0.0, 40.0},
     {"distance_m", "m", 0.1, 10.0}},
    {gainParameter(), realParameter("peak", 250.0, 0.0, 1e6, "", "P: absolute peak sensitivity", "Daly 1993"),
     realParameter("epsilon", 0.9, 0.01, 10.0, "", "frequency scale of the luminance CSF", "Daly 1993"),
     realParameter("eccentric", 0.24, 0.0, 10.0, "1/deg",
                   "loss with eccentricity; one public implementation has 0.6 of it", "Daly 1993"),
     realParameter("oblique", 0.78, 0.05, 1.0, "", "frequency scale at 45 degrees", "Daly 1993")},
    [](const ParameterValues& values) {
      const Daly93Constants k = {values.real("peak"), values.real("epsilon"), values.real("eccentric"),
                                 values.real("oblique")};
      return makeFunctionCsf(values, [k](const CsfPoint& p) {
        return csfDaly93(p.frequencyCpd, p.orientationDeg, p.luminanceCdM2, p.areaDeg2, p.distanceM,
                         p.eccentricityDeg, k);
      });
    }}};

}  // namespace
}  // namespace limen::perception
