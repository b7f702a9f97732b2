// SPDX-License-Identifier: BSD-3-Clause
//
// Registration of the models without motion.
#include <algorithm>
#include <cmath>

#include "perception/vision/adaptation.h"
#include "perception/vision/csf_arguments.h"
#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

const char* const kSection = "Schwarz 2009, section 9.1.1";

// Constants with the gain on one level.
struct Barten89Settings {
  CsfGain gain;
  double a = Barten89Constants{}.a, b = Barten89Constants{}.b, c = Barten89Constants{}.c;
  static const SettingsTable<Barten89Settings>& table();
  Barten89Constants constants() const { return {a, b, c}; }
};

const SettingsTable<Barten89Settings>& Barten89Settings::table() {
  using S = Barten89Settings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::a, "a", {0.0, 1e6}, "", "height", kSection},
      {&S::b, "b", {1e-3, 10.0}, "deg", "decay with frequency", kSection},
      {&S::c, "c", {0.0, 10.0}, "", "share that decays half as fast", kSection}};
  return kTable;
}

const RegisteredCsf<Barten89Settings> kBarten89{
    {.name = "barten89",
     .summary =
         "Band-pass over frequency, rising with luminance. Beyond its range extrapolated; luminance is "
         "clamped to [1e-4, 1e8] cd/m2.",
     .source = "Barten 1989; Schwarz 2009, (9.1)",
     .arguments = {frequencyArgument(0.1, 60.0), luminanceArgument(1e-3, 1e3)}},
    [](const Barten89Settings& settings) {
      return makeFunctionCsf(settings.gain, [k = settings.constants()](const CsfPoint& p) {
        return csfBarten89(p.frequencyCpd, p.luminanceCdM2, k);
      });
    }};

const RegisteredCsf<Barten89Settings> kBarten89Size{
    {.name = "barten89_size",
     .summary = "Barten 1989 with the display's angular width: small displays lose low frequencies. Beyond "
                "its range "
                "extrapolated; luminance is clamped to [1e-4, 1e8] cd/m2; 0 for a width of 0.",
     .source = "Barten 1990; Schwarz 2009, (9.1), footnote",
     .arguments = {frequencyArgument(0.1, 60.0),
                   luminanceArgument(1e-3, 1e3),
                   {"width_deg", "deg", 0.5, 60.0}}},
    [](const Barten89Settings& settings) {
      return makeFunctionCsf(settings.gain, [k = settings.constants()](const CsfPoint& p) {
        return csfBarten89Size(p.frequencyCpd, p.luminanceCdM2, p.widthDeg, k.a, k);
      });
    },
    {.gain = {}, .a = kBarten89SizeGain}};

struct Barten03Settings {
  CsfGain gain;
  double height = Barten03Constants{}.gain, optics = Barten03Constants{}.optics,
         areaLimit = Barten03Constants{}.area, cycles = Barten03Constants{}.cycles,
         photonNoise = Barten03Constants{}.photonNoise, photonExponent = Barten03Constants{}.photonExponent,
         lateral = Barten03Constants{}.lateralInhibition;
  static const SettingsTable<Barten03Settings>& table();
};

const SettingsTable<Barten03Settings>& Barten03Settings::table() {
  using S = Barten03Settings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::height, "height", {0.0, 1e7}, "", "height", kSection},
      {&S::optics, "optics", {0.0, 1.0}, "deg2", "blur by the eye's optics", kSection},
      {&S::areaLimit, "area_limit", {0.0, 1e5}, "deg2", "largest area that is integrated over", kSection},
      {&S::cycles,
       "cycles",
       {0.0, 100.0},
       "deg2",
       "limit on the number of cycles that are integrated",
       kSection},
      {&S::photonNoise,
       "photon_noise",
       {0.0, 1e6},
       "",
       "photon noise over neural noise at 1 cd/m2",
       kSection},
      {&S::photonExponent,
       "photon_exponent",
       {0.0, 2.0},
       "",
       "how fast photon noise falls with luminance",
       kSection},
      {&S::lateral, "lateral", {1e-6, 10.0}, "deg2", "reach of lateral inhibition", kSection}};
  return kTable;
}

const RegisteredCsf<Barten03Settings> kBarten03{
    {.name = "barten03",
     .summary =
         "Barten's physical model for a typical viewer, simplified: luminance and stimulus area. Beyond "
         "its range extrapolated; luminance is clamped to [1e-4, 1e8] cd/m2; 0 for an area of 0.",
     .source = "Barten 2003; Schwarz 2009, (9.2)",
     .arguments = {frequencyArgument(0.1, 60.0), luminanceArgument(1e-3, 1e3), areaArgument(0.05, 3600.0)}},
    [](const Barten03Settings& s) {
      const Barten03Constants constants{s.height,      s.optics,         s.areaLimit, s.cycles,
                                        s.photonNoise, s.photonExponent, s.lateral};
      return makeFunctionCsf(s.gain, [constants](const CsfPoint& p) {
        return csfBarten03(p.frequencyCpd, p.luminanceCdM2, p.areaDeg2, constants);
      });
    }};

constexpr double kMartinLowCpd = 0.5, kMartinHighCpd = 60.0, kMartinLow = 1e-3, kMartinHigh = 1e3;

/// sLF: factor of (lg L)^L (lg rho)^F.
struct Martin92Settings {
  CsfGain gain;
  double s00 = kMartin92Luminance[0][0], s01 = kMartin92Luminance[0][1], s02 = kMartin92Luminance[0][2];
  double s10 = kMartin92Luminance[1][0], s11 = kMartin92Luminance[1][1], s12 = kMartin92Luminance[1][2];
  double s20 = kMartin92Luminance[2][0], s21 = kMartin92Luminance[2][1], s22 = kMartin92Luminance[2][2];
  double s30 = kMartin92Luminance[3][0], s31 = kMartin92Luminance[3][1], s32 = kMartin92Luminance[3][2];
  static const SettingsTable<Martin92Settings>& table();
  MartinCoefficients coefficients() const {
    return {{{s00, s01, s02}, {s10, s11, s12}, {s20, s21, s22}, {s30, s31, s32}}};
  }
};

const SettingsTable<Martin92Settings>& Martin92Settings::table() {
  using S = Martin92Settings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::s00, "s00", {-10.0, 10.0}, "", "factor of (lg L)^0 (lg rho)^0", kSection},
      {&S::s01, "s01", {-10.0, 10.0}, "", "factor of (lg L)^0 (lg rho)^1", kSection},
      {&S::s02, "s02", {-10.0, 10.0}, "", "factor of (lg L)^0 (lg rho)^2", kSection},
      {&S::s10, "s10", {-10.0, 10.0}, "", "factor of (lg L)^1 (lg rho)^0", kSection},
      {&S::s11, "s11", {-10.0, 10.0}, "", "factor of (lg L)^1 (lg rho)^1", kSection},
      {&S::s12, "s12", {-10.0, 10.0}, "", "factor of (lg L)^1 (lg rho)^2", kSection},
      {&S::s20, "s20", {-10.0, 10.0}, "", "factor of (lg L)^2 (lg rho)^0", kSection},
      {&S::s21, "s21", {-10.0, 10.0}, "", "factor of (lg L)^2 (lg rho)^1", kSection},
      {&S::s22, "s22", {-10.0, 10.0}, "", "factor of (lg L)^2 (lg rho)^2", kSection},
      {&S::s30, "s30", {-10.0, 10.0}, "", "factor of (lg L)^3 (lg rho)^0", kSection},
      {&S::s31, "s31", {-10.0, 10.0}, "", "factor of (lg L)^3 (lg rho)^1", kSection},
      {&S::s32, "s32", {-10.0, 10.0}, "", "factor of (lg L)^3 (lg rho)^2", kSection}};
  return kTable;
}

const RegisteredCsf<Martin92Settings> kMartin92{
    {.name = "martin92",
     .summary =
         "Fit to measurements of van Nes and Bouman, a cubic in lg luminance that diverges outside its data: "
         "frequency is clamped to [0.5, 60] cpd, luminance to [1e-3, 1e3] cd/m2.",
     .source = "Martin, Ahumada and Larimer 1992; Schwarz 2009, section 9.1.1",
     .arguments = {frequencyArgument(kMartinLowCpd, kMartinHighCpd),
                   luminanceArgument(kMartinLow, kMartinHigh)}},
    [](const Martin92Settings& settings) {
      return makeFunctionCsf(settings.gain, [s = settings.coefficients()](const CsfPoint& p) {
        if (std::isnan(p.frequencyCpd) || std::isnan(p.luminanceCdM2)) return 0.0;
        return csfMartin92Luminance(std::clamp(p.frequencyCpd, kMartinLowCpd, kMartinHighCpd),
                                    std::clamp(p.luminanceCdM2, kMartinLow, kMartinHigh), s);
      });
    }};

struct MartinChromaticSettings {
  CsfGain gain;
  double aberration = 1.0;  ///< what chromatic aberration leaves
  double a = kMartin92RedGreen.a, b = kMartin92RedGreen.b, c = kMartin92RedGreen.c, d = kMartin92RedGreen.d;
  static const SettingsTable<MartinChromaticSettings>& table();
};

const SettingsTable<MartinChromaticSettings>& MartinChromaticSettings::table() {
  using S = MartinChromaticSettings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::aberration,
       "aberration",
       {0.0, 1.0},
       "",
       "share that remains despite chromatic aberration; the blue-yellow measurements had been corrected for "
       "it",
       "Schwarz 2009, section 9.1.1, without a number"},
      {&S::a, "a", {-10.0, 10.0}, "", "lg height", kSection},
      {&S::b, "b", {-10.0, 10.0}, "", "lg height", kSection},
      {&S::c, "c", {0.0, 10.0}, "", "fall above the plateau", kSection},
      {&S::d, "d", {-3.0, 3.0}, "", "lg of the plateau's end [cpd]", kSection}};
  return kTable;
}

RegisteredCsf<MartinChromaticSettings> martinChromatic(const char* name, Channel channel,
                                                       const MartinChromaticConstants& k) {
  return {
      {.name = name,
       .summary = "Fit to measurements of Mullen: low-pass, rising with the root of luminance up to 200 "
                  "cd/m2. Beyond its range extrapolated; luminance is clamped to [1e-4, 1e8] cd/m2. With the "
                  "constants as printed blue-yellow exceeds red-green and luminance, which `gain` can "
                  "correct.",
       .source = "Martin, Ahumada and Larimer 1992; Schwarz 2009, section 9.1.1",
       .channel = channel,
       .arguments = {frequencyArgument(0.1, 30.0), luminanceArgument(1e-3, 1e3)}},
      [](const MartinChromaticSettings& s) {
        const MartinChromaticConstants constants = {s.a, s.b, s.c, s.d};
        return makeFunctionCsf(s.gain, [constants, factor = s.aberration](const CsfPoint& p) {
          return factor * csfMartin92Chromatic(p.frequencyCpd, p.luminanceCdM2, constants);
        });
      },
      {.gain = {}, .a = k.a, .b = k.b, .c = k.c, .d = k.d}};
}

const auto kRedGreen = martinChromatic("martin92_rg", Channel::RedGreen, kMartin92RedGreen);
const auto kBlueYellow = martinChromatic("martin92_by", Channel::BlueYellow, kMartin92BlueYellow);

struct Daly93Settings {
  CsfGain gain;
  double peak = Daly93Constants{}.peak, epsilon = Daly93Constants{}.epsilon,
         eccentric = Daly93Constants{}.eccentric, oblique = Daly93Constants{}.oblique;
  static const SettingsTable<Daly93Settings>& table();
};

const SettingsTable<Daly93Settings>& Daly93Settings::table() {
  using S = Daly93Settings;
  static const SettingsTable<S> kTable = {
      included(&S::gain),
      {&S::peak, "peak", {0.0, 1e6}, "", "P: absolute peak sensitivity", "Daly 1993"},
      {&S::epsilon, "epsilon", {0.01, 10.0}, "", "frequency scale of the luminance CSF", "Daly 1993"},
      {&S::eccentric,
       "eccentric",
       {0.0, 10.0},
       "1/deg",
       "loss with eccentricity; one public implementation uses 0.6 of it",
       "Daly 1993"},
      {&S::oblique, "oblique", {0.05, 1.0}, "", "frequency scale at 45 degrees", "Daly 1993"}};
  return kTable;
}

const RegisteredCsf<Daly93Settings> kDaly93{
    {.name = "daly93",
     .summary =
         "CSF of the visible differences predictor: orientation, luminance, image area, viewing distance and "
         "eccentricity. Beyond its range extrapolated; luminance is clamped to [1e-4, 1e8] cd/m2; 0 for an "
         "area "
         "or distance of 0.",
     .source = "Daly 1993; named in Schwarz 2009, section 9.1.1; formula reconstructed, as in public "
               "implementations",
     .arguments = {frequencyArgument(0.1, 60.0),
                   luminanceArgument(1e-3, 1e3),
                   areaArgument(0.05, 3600.0),
                   {"orientation_deg", "deg", -360.0, 360.0},
                   {"eccentricity_deg", "deg", 0.0, 40.0},
                   {"distance_m", "m", 0.1, 10.0}}},
    [](const Daly93Settings& s) {
      const Daly93Constants k = {s.peak, s.epsilon, s.eccentric, s.oblique};
      return makeFunctionCsf(s.gain, [k](const CsfPoint& p) {
        return csfDaly93(p.frequencyCpd, p.orientationDeg, p.luminanceCdM2, p.areaDeg2, p.distanceM,
                         p.eccentricityDeg, k);
      });
    }};

}  // namespace
}  // namespace limen::perception
