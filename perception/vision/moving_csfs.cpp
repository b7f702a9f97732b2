// SPDX-License-Identifier: BSD-3-Clause
//
// Registration of the models of frequency and retinal velocity.
#include <algorithm>
#include <cmath>

#include "perception/vision/adaptation.h"
#include "perception/vision/csf_arguments.h"
#include "perception/vision/csf_models.h"

namespace limen::perception {
namespace {

const char* const kSection = "Schwarz 2009, section 9.1.1";
const char* const kAdaptSection = "Schwarz 2009, section 10.3";

// Kelly measured 0.1 to 32 deg/s with stabilised images; below and above his surface is extrapolated.
const std::vector<CsfArgument> kMotionArguments = {frequencyArgument(0.05, 60.0),
                                                   velocityArgument(0.1, 32.0)};

struct LeastVelocity {
  double degS = 0.0;
  static const SettingsTable<LeastVelocity>& table() {
    static const SettingsTable<LeastVelocity> kTable = {
        {&LeastVelocity::degS,
         "least_velocity",
         {0.0, 10.0},
         "deg/s",
         "slower motion is treated as this; 0: a stabilised image vanishes, as in the model",
         "Schwarz 2009, section 9.1.1: about 0.15 for fixation"}};
    return kTable;
  }
};

struct Kelly79Settings {
  CsfGain gain;
  LeastVelocity least;
  double k1 = Kelly79Constants{}.k1, k2 = Kelly79Constants{}.k2, k3 = Kelly79Constants{}.k3;
  static const SettingsTable<Kelly79Settings>& table() {
    using S = Kelly79Settings;
    static const SettingsTable<S> kTable = {
        included(&S::gain),
        included(&S::least),
        {&S::k1, "k1", {0.0, 1e3}, "", "height at 3 deg/s", kSection},
        {&S::k2, "k2", {0.0, 1e3}, "", "rise of the height away from 3 deg/s", kSection},
        {&S::k3, "k3", {0.1, 1e3}, "deg/s cpd", "band: frequency times speed", kSection}};
    return kTable;
  }
};

const RegisteredCsf<Kelly79Settings> kKelly79{
    {.name = "kelly79",
     .summary = "Spatio-velocity surface of stabilised vision. Beyond its range extrapolated; 0 at rest.",
     .source = "Kelly 1979; Schwarz 2009, (9.3)",
     .arguments = kMotionArguments},
    [](const Kelly79Settings& s) {
      const Kelly79Constants k = {s.k1, s.k2, s.k3};
      return makeFunctionCsf(s.gain, [k, least = s.least.degS](const CsfPoint& p) {
        return csfKelly79(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least), k);
      });
    }};

struct Daly98Settings {
  CsfGain gain;
  LeastVelocity least;
  double c0 = 1.14, c1 = 0.67, c2 = 1.7;
  bool adapt = true;
  double referenceCdM2 = 100.0;  ///< where c0 and c1 hold
  static const SettingsTable<Daly98Settings>& table() {
    using S = Daly98Settings;
    static const SettingsTable<S> kTable = {
        included(&S::gain),
        included(&S::least),
        {&S::c0, "c0", {0.0, 100.0}, "", "height, at the reference luminance"},
        {&S::c1, "c1", {0.01, 100.0}, "", "frequency scale, at the reference luminance"},
        {&S::c2, "c2", {0.01, 100.0}, "", "velocity scale"},
        {&S::adapt, "adapt", "c0 and c1 follow the luminance as the peak of Barten 2003 does", kAdaptSection},
        {&S::referenceCdM2,
         "reference_luminance",
         {1e-4, 1e4},
         "cd/m2",
         "luminance for which c0 and c1 apply"}};
    return kTable;
  }
};

class Daly98 : public Csf {
 public:
  explicit Daly98(const Daly98Settings& s)
      : gain_(s.gain.value),
        c0_(s.c0),
        c1_(s.c1),
        c2_(s.c2),
        least_(s.least.degS),
        reference_(s.referenceCdM2),
        adapt_(s.adapt) {}

  double sensitivity(const CsfPoint& p) const override {
    if (adapt_ && (std::isnan(p.luminanceCdM2) || std::isnan(p.areaDeg2))) return 0.0;
    const auto [height, squeeze] = scales(p);
    return gain_ * csfDaly98(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least_), c0_ * height,
                             c1_ * squeeze, c2_);
  }

  Peak peak(const CsfPoint& p) const override {
    const double v = std::max(std::abs(p.velocityDegS), least_);
    if (!std::isfinite(v) || (adapt_ && (std::isnan(p.luminanceCdM2) || std::isnan(p.areaDeg2))))
      return Csf::peak(p);
    const auto [height, squeeze] = scales(p);
    return {daly98PeakFrequencyCpd(v, c1_ * squeeze, c2_),
            gain_ * daly98PeakSensitivity(v, c0_ * height, c1_ * squeeze, c2_)};
  }

 private:
  struct Scales {
    double height = 1.0, squeeze = 1.0;
  };
  /// Of c0 and c1; exactly 1 at the reference luminance.
  Scales scales(const CsfPoint& p) const {
    if (!adapt_) return {};
    // Tables ask for many frequencies and velocities at one luminance.
    thread_local double lastLuminance = -1.0, lastArea = -1.0, lastReference = -1.0;
    thread_local Scales last;
    if (p.luminanceCdM2 != lastLuminance || p.areaDeg2 != lastArea || reference_ != lastReference) {
      const Peak here = barten03Peak(p.luminanceCdM2, p.areaDeg2);
      const Peak reference = barten03Peak(reference_, p.areaDeg2);
      last = {here.sensitivity / reference.sensitivity, reference.frequencyCpd / here.frequencyCpd};
      lastLuminance = p.luminanceCdM2, lastArea = p.areaDeg2, lastReference = reference_;
    }
    return last;
  }

  double gain_, c0_, c1_, c2_, least_, reference_;
  bool adapt_;
};

std::vector<CsfArgument> daly98Arguments() {
  std::vector<CsfArgument> out = kMotionArguments;
  out.push_back(luminanceArgument(1e-4, 1e4));
  out.push_back(areaArgument(0.05, 3600.0));
  return out;
}

std::unique_ptr<Csf> makeDaly98(const Daly98Settings& settings) { return std::make_unique<Daly98>(settings); }

const RegisteredCsf<Daly98Settings> kDaly98{
    {.name = "daly98",
     .summary = "Kelly 1979 for natural viewing, adapted to luminance. Beyond its range extrapolated; 0 at "
                "rest; luminance is clamped to [1e-4, 1e4] cd/m2.",
     .source = "Daly 1998; Schwarz 2009, (9.4) and section 10.3",
     .arguments = daly98Arguments()},
    &makeDaly98};

// The height is that of (9.4); one public implementation multiplies it by c1 once more. Only `gain` would
// differ.
const RegisteredCsf<Daly98Settings> kLaird06{
    {.name = "laird06",
     .summary =
         "Daly 1998 refitted to unstabilised moving Gabor patches at 60 cd/m2, adapted to luminance from "
         "there. Beyond its range extrapolated; 0 at rest; luminance is clamped to [1e-4, 1e4] cd/m2.",
     .source = "Laird, Rosen, Pelz, Montag and Daly 2006 (doi 10.1117/12.647870)",
     .arguments = daly98Arguments()},
    &makeDaly98,
    {.gain = {}, .least = {}, .c0 = 0.6329, .c1 = 0.8404, .c2 = 0.7986, .referenceCdM2 = 60.0}};

struct BurbeckKellySettings {
  CsfGain gain;
  LeastVelocity least;
  static const SettingsTable<BurbeckKellySettings>& table() {
    static const SettingsTable<BurbeckKellySettings> kTable = {included(&BurbeckKellySettings::gain),
                                                               included(&BurbeckKellySettings::least)};
    return kTable;
  }
};

const RegisteredCsf<BurbeckKellySettings> kBurbeckKelly80{
    {.name = "burbeck_kelly80",
     .summary =
         "Excitation minus inhibition, each a product of a spatial and a temporal part. Beyond its range "
         "extrapolated; 0 at rest and where inhibition exceeds excitation.",
     .source = "Burbeck and Kelly 1980; Schwarz 2009, section 9.1.1",
     .arguments = kMotionArguments},
    [](const BurbeckKellySettings& s) {
      return makeFunctionCsf(s.gain, [least = s.least.degS](const CsfPoint& p) {
        return csfBurbeckKelly80(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least));
      });
    }};

struct Kelly83Settings {
  CsfGain gain;
  LeastVelocity least;
  bool adapt = true;
  double referenceCdM2 = 35.0;  ///< where the scale is 1
  static const SettingsTable<Kelly83Settings>& table() {
    using S = Kelly83Settings;
    static const SettingsTable<S> kTable = {
        included(&S::gain),
        included(&S::least),
        {&S::adapt, "adapt", "sensitivity follows the root of retinal illuminance", kAdaptSection},
        {&S::referenceCdM2,
         "reference_luminance",
         {1e-4, 1e4},
         "cd/m2",
         "luminance at which the scale is 1",
         kAdaptSection}};
    return kTable;
  }
};

class Kelly83 : public Csf {
 public:
  explicit Kelly83(const Kelly83Settings& s)
      : gain_(s.gain.value), least_(s.least.degS), reference_(s.referenceCdM2), adapt_(s.adapt) {}
  double sensitivity(const CsfPoint& p) const override {
    if (adapt_ && std::isnan(p.luminanceCdM2)) return 0.0;
    const double scale = adapt_ ? chromaticScale(p.luminanceCdM2, reference_) : 1.0;
    return gain_ * scale * csfKelly83(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least_));
  }

 private:
  double gain_, least_, reference_;
  bool adapt_;
};

// One function serves both chromatic axes; registered as red-green, which Kelly measured.
const RegisteredCsf<Kelly83Settings> kKelly83{
    {.name = "kelly83",
     .summary =
         "Chromatic: excitation plus inhibition, low-pass above 0.5 cpd, times the root of retinal "
         "illuminance. Serves red-green and blue-yellow alike. Beyond its range extrapolated; 0 at rest; "
         "luminance is clamped to [1e-4, 1e4] cd/m2.",
     .source = "Kelly 1983; Schwarz 2009, (9.5) and section 10.3",
     .channel = Channel::RedGreen,
     .arguments = {frequencyArgument(0.05, 60.0), velocityArgument(0.1, 32.0), luminanceArgument(1e-4, 1e4)}},
    [](const Kelly83Settings& settings) -> std::unique_ptr<Csf> {
      return std::make_unique<Kelly83>(settings);
    }};

}  // namespace
}  // namespace limen::perception
