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

Parameter leastVelocity() {
  return realParameter("least_velocity", 0.0, 0.0, 10.0, "deg/s",
                       "slower motion counts as this; 0: a stabilised image vanishes, as the model says",
                       "Schwarz 2009, section 9.1.1: about 0.15 for fixation");
}

const Registered<CsfInfo> kKelly79{CsfInfo{
    "kelly79",
    1,
    "Spatio-velocity surface of stabilised vision. Beyond its range extrapolated; 0 at rest.",
    "Kelly 1979; Schwarz 2009, (9.3)",
    Channel::Achromatic,
    kMotionArguments,
    {gainParameter(), leastVelocity(), realParameter("k1", 6.1, 0.0, 1e3, "", "height at 3 deg/s", kSection),
     realParameter("k2", 7.3, 0.0, 1e3, "", "rise of the height away from 3 deg/s", kSection),
     realParameter("k3", 45.9, 0.1, 1e3, "deg/s cpd", "band: frequency times speed", kSection)},
    [](const ParameterValues& values) {
      const Kelly79Constants k = {values.real("k1"), values.real("k2"), values.real("k3")};
      const double least = values.real("least_velocity");
      return makeFunctionCsf(values, [k, least](const CsfPoint& p) {
        return csfKelly79(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least), k);
      });
    }}};

class Daly98 : public Csf {
 public:
  explicit Daly98(const ParameterValues& values)
      : gain_(values.real("gain")),
        c0_(values.real("c0")),
        c1_(values.real("c1")),
        c2_(values.real("c2")),
        least_(values.real("least_velocity")),
        reference_(values.real("reference_luminance")),
        adapt_(values.boolean("adapt")) {}

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

CsfInfo daly98(const char* name, const char* summary, const char* source, double c0, double c1, double c2,
               const char* constantsSource, double referenceCdM2) {
  CsfInfo info;
  info.name = name;
  info.summary = summary;
  info.source = source;
  info.arguments = kMotionArguments;
  info.arguments.push_back(luminanceArgument(1e-4, 1e4));
  info.arguments.push_back(areaArgument(0.05, 3600.0));
  info.parameters = {
      gainParameter(),
      leastVelocity(),
      realParameter("c0", c0, 0.0, 100.0, "", "height, at the reference luminance", constantsSource),
      realParameter("c1", c1, 0.01, 100.0, "", "frequency scale, at the reference luminance",
                    constantsSource),
      realParameter("c2", c2, 0.01, 100.0, "", "velocity scale", constantsSource),
      booleanParameter("adapt", true, "c0 and c1 follow the luminance as Barten 2003 moves its peak",
                       kAdaptSection),
      realParameter("reference_luminance", referenceCdM2, 1e-4, 1e4, "cd/m2", "where c0 and c1 hold",
                    constantsSource)};
  info.make = [](const ParameterValues& values) -> std::unique_ptr<Csf> {
    return std::make_unique<Daly98>(values);
  };
  return info;
}

const Registered<CsfInfo> kDaly98{daly98("daly98",
                                         "Kelly 1979 for natural viewing, adapted to luminance. Beyond its "
                                         "range extrapolated; 0 at rest; luminance "
                                         "is held to [1e-4, 1e4] cd/m2.",
                                         "Daly 1998; Schwarz 2009, (9.4) and section 10.3", 1.14, 0.67, 1.7,
                                         kSection, 100.0)};

// The height is that of (9.4); one public implementation multiplies it by c1 once more. Only `gain` would
// differ.
const Registered<CsfInfo> kLaird06{
    daly98("laird06",
           "Daly 1998 fitted anew to unstabilised moving Gabor patches at 60 cd/m2, adapted to luminance "
           "from there. "
           "Beyond its range extrapolated; 0 at rest; luminance is held to [1e-4, 1e4] cd/m2.",
           "Laird, Rosen, Pelz, Montag and Daly 2006 (doi 10.1117/12.647870)", 0.6329, 0.8404, 0.7986,
           "Laird et al. 2006", 60.0)};

const Registered<CsfInfo> kBurbeckKelly80{
    CsfInfo{"burbeck_kelly80",
            1,
            "Excitation less inhibition, each a product of a spatial and a temporal part. Beyond its range "
            "extrapolated; 0 at rest and where inhibition exceeds excitation.",
            "Burbeck and Kelly 1980; Schwarz 2009, section 9.1.1",
            Channel::Achromatic,
            kMotionArguments,
            {gainParameter(), leastVelocity()},
            [](const ParameterValues& values) {
              const double least = values.real("least_velocity");
              return makeFunctionCsf(values, [least](const CsfPoint& p) {
                return csfBurbeckKelly80(p.frequencyCpd, std::max(std::abs(p.velocityDegS), least));
              });
            }}};

class Kelly83 : public Csf {
 public:
  explicit Kelly83(const ParameterValues& values)
      : gain_(values.real("gain")),
        least_(values.real("least_velocity")),
        reference_(values.real("reference_luminance")),
        adapt_(values.boolean("adapt")) {}
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
const Registered<CsfInfo> kKelly83{CsfInfo{
    "kelly83",
    1,
    "Chromatic: excitation plus inhibition, low-pass above 0.5 cpd, times the root of retinal illuminance. "
    "Serves red-green and blue-yellow alike. Beyond its range extrapolated; 0 at rest; luminance is held to "
    "[1e-4, 1e4] cd/m2.",
    "Kelly 1983; Schwarz 2009, (9.5) and section 10.3",
    Channel::RedGreen,
    {frequencyArgument(0.05, 60.0), velocityArgument(0.1, 32.0), luminanceArgument(1e-4, 1e4)},
    {gainParameter(), leastVelocity(),
     booleanParameter("adapt", true, "sensitivity follows the root of retinal illuminance", kAdaptSection),
     realParameter("reference_luminance", 35.0, 1e-4, 1e4, "cd/m2", "where the scale is 1", kAdaptSection)},
    [](const ParameterValues& values) -> std::unique_ptr<Csf> { return std::make_unique<Kelly83>(values); }}};

}  // namespace
}  // namespace limen::perception
