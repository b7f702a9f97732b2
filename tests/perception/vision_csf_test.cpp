// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/csf.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/base/error.h"
#include "perception/vision/adaptation.h"
#include "perception/vision/csf_models.h"
#include "perception/vision/stela_csf.h"

namespace limen::perception {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = std::numbers::pi;

double relative(double got, double expected) { return std::abs(got - expected) / std::abs(expected); }

CsfPoint point(double cpd, double velocity = 0.15, double luminance = 100.0) {
  CsfPoint out;
  out.frequencyCpd = cpd, out.velocityDegS = velocity, out.luminanceCdM2 = luminance;
  return out;
}

TEST(Csf, AllPromisedModelsAreRegistered) {
  for (const char* name :
       {"barten89", "barten89_size", "barten03", "martin92", "martin92_rg", "martin92_by", "daly93",
        "kelly79", "daly98", "burbeck_kelly80", "kelly83", "laird06", "stelacsf", "castlecsf", "castlecsf_rg",
        "castlecsf_yv", "castlecsf_sustained", "castlecsf_transient"}) {
    const CsfInfo* info = CsfRegistry::instance().find(name);
    ASSERT_NE(info, nullptr) << name;
    EXPECT_FALSE(info->summary.empty() || info->source.empty() || info->arguments.empty()) << name;
    for (const CsfArgument& one : info->arguments) {
      EXPECT_LT(one.validLow, one.validHigh) << name;
      EXPECT_GT(argumentOf(CsfPoint(), one.name), -1.0) << name;
    }
  }
  EXPECT_THROW(makeCsf("daly89"), Error);
}

// Zero, negative, tiny, huge, infinite, no number: in one argument, and in two at once.
TEST(Csf, FiniteAndNotNegativeOnAnyArgument) {
  const double kBad[] = {0.0,  -0.0,  -1.0, 1e-320, 1e-300, 1e-100, 1e-9,    1e-4,      0.01,       1.0,
                         50.0, 400.0, 1e4,  1e9,    1e100,  1e300,  1.7e308, kInfinity, -kInfinity, kNan};
  for (const auto& [name, info] : CsfRegistry::instance().all()) {
    const std::unique_ptr<Csf> csf = makeCsf(name);
    for (const std::string& first : csfArgumentNames())
      for (const std::string& second : csfArgumentNames())
        for (const double a : kBad)
          for (const double b : kBad) {
            CsfPoint at;
            argumentOf(at, first) = a;
            argumentOf(at, second) = b;
            const double value = csf->sensitivity(at);
            ASSERT_TRUE(std::isfinite(value) && value >= 0.0)
                << name << " " << first << " " << a << ", " << second << " " << b << ": " << value;
          }
  }
}

TEST(Csf, NanInAnArgumentThatIsReadGivesZero) {
  for (const auto& [name, info] : CsfRegistry::instance().all())
    for (const CsfArgument& one : info.arguments) {
      CsfPoint at;
      argumentOf(at, one.name) = kNan;
      EXPECT_EQ(makeCsf(name)->sensitivity(at), 0.0) << name << " " << one.name;
    }
}

TEST(Csf, PeaksAreFiniteOnAnyArgument) {
  for (const auto& [name, info] : CsfRegistry::instance().all())
    for (const std::string& argument : csfArgumentNames())
      for (const double bad : {0.0, -1.0, 1e-300, 1e300, kInfinity, kNan}) {
        CsfPoint at;
        argumentOf(at, argument) = bad;
        const Csf::Peak peak = makeCsf(name)->peak(at);
        EXPECT_TRUE(std::isfinite(peak.frequencyCpd) && std::isfinite(peak.sensitivity))
            << name << " " << argument;
      }
}

// No frequency of a dense scan gives more than the peak.
TEST(Csf, NothingExceedsThePeak) {
  for (const auto& [name, info] : CsfRegistry::instance().all()) {
    const std::unique_ptr<Csf> csf = makeCsf(name);
    for (const double velocity : {0.1, 0.15, 1.0, 10.0})
      for (const double luminance : {0.01, 1.0, 100.0, 1000.0}) {
        const Csf::Peak peak = csf->peak(point(1.0, velocity, luminance));
        EXPECT_NEAR(csf->sensitivity(point(peak.frequencyCpd, velocity, luminance)), peak.sensitivity,
                    1e-9 * peak.sensitivity)
            << name;
        for (int i = 0; i <= 400; ++i) {
          const double cpd = 0.05 * std::pow(1200.0, i / 400.0);
          ASSERT_LE(csf->sensitivity(point(cpd, velocity, luminance)), peak.sensitivity * (1.0 + 1e-9))
              << name << " at " << cpd;
        }
      }
  }
}

// Figure 9.2 and its text: band-pass, with the peak between 1 and 6 cpd at 100 cd/m2.
TEST(Csf, LuminanceModelsAreBandPass) {
  for (const std::string& name : csfNames(Channel::Achromatic)) {
    if (name == "castlecsf_transient") continue;  // one mechanism, which does not see what rests
    const std::unique_ptr<Csf> csf = makeCsf(name);
    const Csf::Peak peak = csf->peak(point(1.0));
    EXPECT_GT(peak.frequencyCpd, 1.0) << name;
    EXPECT_LT(peak.frequencyCpd, 6.0) << name;
    EXPECT_LT(csf->sensitivity(point(0.2)), 0.5 * peak.sensitivity) << name;
    EXPECT_LT(csf->sensitivity(point(40.0)), 0.1 * peak.sensitivity) << name;
  }
}

TEST(Csf, Martin92ChromaticIsLowPass) {
  for (const char* name : {"martin92_rg", "martin92_by"}) {
    const std::unique_ptr<Csf> csf = makeCsf(name);
    double last = csf->sensitivity(point(0.0));
    EXPECT_EQ(last, csf->sensitivity(point(0.5))) << "the plateau ends at 0.53 cpd";
    for (double cpd = 0.1; cpd < 60.0; cpd *= 1.1) {
      const double value = csf->sensitivity(point(cpd));
      EXPECT_LE(value, last);
      last = value;
    }
  }
  // Sensitivity is down to 1 at 25.3 and 35.6 cpd.
  EXPECT_NEAR(csfMartin92RedGreen(25.3, 100.0), 1.0, 0.01);
  EXPECT_NEAR(csfMartin92BlueYellow(35.6, 100.0), 1.0, 0.01);
}

TEST(Csf, Martin92ChromaticIsContinuousAtItsKnots) {
  const double end = std::pow(10.0, -0.2664), bright = std::pow(10.0, 2.3);
  EXPECT_LT(relative(csfMartin92RedGreen(end * (1 + 1e-9), 50.0), csfMartin92RedGreen(end, 50.0)), 1e-12);
  EXPECT_LT(relative(csfMartin92RedGreen(1.0, bright * (1 + 1e-9)), csfMartin92RedGreen(1.0, bright)), 1e-8);
  EXPECT_EQ(csfMartin92RedGreen(1.0, 300.0), csfMartin92RedGreen(1.0, 3e5));
}

// The model runs wild outside: 8.7e6 at 60 cpd and 1e5 cd/m2 as printed.
TEST(Csf, Martin92IsHeldToItsRange) {
  const std::unique_ptr<Csf> csf = makeCsf("martin92");
  EXPECT_DOUBLE_EQ(csf->sensitivity(point(60.0, 0.15, 1e5)), csfMartin92Luminance(60.0, 1e3));
  EXPECT_DOUBLE_EQ(csf->sensitivity(point(0.01)), csfMartin92Luminance(0.5, 100.0));
  const CsfInfo& info = CsfRegistry::instance().get("martin92");
  EXPECT_EQ(outsideValidRange(info, point(0.01, 0.15, 1e5)),
            (std::vector<std::string>{"frequency_cpd", "luminance_cd_m2"}));
  EXPECT_TRUE(outsideValidRange(info, point(4.0)).empty());
}

// For w -> infinity only the height differs: 540 / 440.
TEST(Csf, Barten89OfAHugeDisplayIsThePlainOneTimesItsHeight) {
  for (const double cpd : {0.3, 3.0, 30.0})
    for (const double l : {0.1, 100.0})
      EXPECT_LT(relative(csfBarten89Size(cpd, l, 1e13), csfBarten89(cpd, l) * 540.0 / 440.0), 1e-12);
}

// b rho = 0.3 (1e5 + 1)^0.15 60 = 101 at 1e-3 cd/m2, where exp(b rho) is past what a float holds.
TEST(Csf, Barten89IsStableWhereItsExponentialOverflows) {
  const double cpd = 60.0, l = 1e-3, b = 0.3 * std::pow(1.0 + 100.0 / l, 0.15);
  // With c exp(b rho) >> 1: a rho sqrt(c) exp(-b rho / 2).
  const double limit =
      440.0 * std::pow(1.0 + 0.7 / l, -0.2) * cpd * std::sqrt(0.06) * std::exp(-0.5 * b * cpd);
  EXPECT_LT(relative(csfBarten89(cpd, l), limit), 1e-12);
}

// 1 - exp(-0.02 rho^2) -> 0.02 rho^2, and all else -> its value at 0: 5200 rho sqrt(0.02 / (1 + 144 / A)).
TEST(Csf, Barten03IsExactAtLowFrequencies) {
  for (const double cpd : {1e-3, 1e-6, 1e-100})
    EXPECT_LT(relative(csfBarten03(cpd, 1e8, 144.0), 5200.0 * cpd * std::sqrt(0.02 / 2.0)), 1e-5) << cpd;
}

TEST(Csf, Daly93LosesToOrientationEccentricityAndNearness) {
  const auto at = [](double orientation, double eccentricity, double distance) {
    return csfDaly93(8.0, orientation, 100.0, 187.0, distance, eccentricity);
  };
  EXPECT_LT(at(45.0, 0.0, 0.6), at(0.0, 0.0, 0.6));
  EXPECT_DOUBLE_EQ(at(90.0, 0.0, 0.6), at(0.0, 0.0, 0.6));
  EXPECT_NEAR(at(135.0, 0.0, 0.6), at(45.0, 0.0, 0.6), 1e-9);
  EXPECT_LT(at(0.0, 5.0, 0.6), at(0.0, 0.0, 0.6));
  EXPECT_LT(at(0.0, 0.0, 0.3), at(0.0, 0.0, 0.6));
}

// Negative test: 2 pi dropped leaves the height and moves the peak from 3.398 to 21.35 cpd.
TEST(Csf, Kelly79PeaksWhereItShouldAndNotWithout2Pi) {
  const struct {
    double v, cpd, value;
  } kRows[] = {{0.15, 3.398, 205.2},
               {1.0, 2.435, 218.4},
               {3.0, 1.461, 208.7},
               {10.0, 0.609, 141.4},
               {32.0, 0.215, 110.7}};
  for (const auto& row : kRows) {
    const Csf::Peak peak = makeCsf("kelly79")->peak(point(1.0, row.v));
    EXPECT_NEAR(peak.frequencyCpd, row.cpd, 0.00051);
    EXPECT_NEAR(peak.sensitivity, row.value, 0.051);
  }
  class Without2Pi : public Csf {
    double sensitivity(const CsfPoint& p) const override {
      return csfKelly79(p.frequencyCpd / (2.0 * kPi), p.velocityDegS);
    }
  };
  const Csf::Peak wrong = Without2Pi().peak(point(1.0));
  EXPECT_NEAR(wrong.frequencyCpd, 21.35, 0.0051);
  EXPECT_NEAR(wrong.sensitivity, 205.2, 0.051) << "the height alone would not find the slip";
  EXPECT_GT(relative(wrong.frequencyCpd, makeCsf("kelly79")->peak(point(1.0)).frequencyCpd), 0.1);
}

TEST(Csf, MovingModelsVanishAtRestAndAtZeroFrequency) {
  for (const char* name : {"kelly79", "daly98", "laird06", "burbeck_kelly80", "kelly83"}) {
    EXPECT_EQ(makeCsf(name)->sensitivity(point(3.0, 0.0)), 0.0) << name;
    EXPECT_EQ(makeCsf(name)->sensitivity(point(0.0, 1.0)), 0.0) << name;
    EXPECT_EQ(makeCsf(name)->sensitivity(point(3.0, -1.0)), makeCsf(name)->sensitivity(point(3.0, 1.0)))
        << name;
    const CsfInfo& info = CsfRegistry::instance().get(name);
    const auto held = info.make(ParameterValues(info.parameters, {{"least_velocity", 0.15}}));
    EXPECT_EQ(held->sensitivity(point(3.0, 0.0)), makeCsf(name)->sensitivity(point(3.0, 0.15))) << name;
  }
}

// (9.4) is (9.3) with frequency, velocity and height scaled.
TEST(Csf, Daly98IsKelly79Scaled) {
  for (const double cpd : {0.1, 1.0, 5.0, 20.0})
    for (const double v : {0.1, 1.0, 3.0 / 1.7, 30.0}) {
      const double lg = std::abs(std::log10(1.7 * v / 3.0));
      const double printed = (6.1 + 7.3 * lg * lg * lg) * 1.14 * 1.7 * v *
                             std::pow(2.0 * kPi * 0.67 * cpd, 2.0) *
                             std::exp(-4.0 * kPi * 0.67 * cpd * (1.7 * v + 2.0) / 45.9);
      EXPECT_LT(relative(csfDaly98(cpd, v), printed), 1e-12);
    }
}

// d ln csf / d rho = 2 / rho - 4 pi c1 (c2 v + 2) / 45.9 vanishes at the peak, and the value there is the
// peak's.
TEST(Csf, ClosedPeakOfDaly98) {
  for (const double v : {0.05, 0.15, 0.926, 3.0, 80.0}) {
    const double cpd = daly98PeakFrequencyCpd(v);
    EXPECT_LT(relative(2.0 / cpd, 4.0 * kPi * 0.67 * (1.7 * v + 2.0) / 45.9), 1e-12);
    EXPECT_LT(relative(csfDaly98(cpd, v), daly98PeakSensitivity(v)), 1e-12);
  }
  EXPECT_NEAR(daly98PeakSensitivity(0.926), 250.75, 0.0051) << "largest over all velocities";
  EXPECT_LT(daly98PeakSensitivity(0.9), daly98PeakSensitivity(0.926));
  EXPECT_LT(daly98PeakSensitivity(0.95), daly98PeakSensitivity(0.926));
}

TEST(Csf, Daly98FollowsLuminanceAsBarten03Does) {
  const std::unique_ptr<Csf> csf = makeCsf("daly98");
  for (const double cpd : {0.5, 4.0, 20.0})
    EXPECT_DOUBLE_EQ(csf->sensitivity(point(cpd)), csfDaly98(cpd, 0.15)) << "at 100 cd/m2";
  for (const double l : {0.01, 1.0, 1000.0}) {
    const Csf::Peak peak = csf->peak(point(1.0, 0.5, l)), reference = csf->peak(point(1.0, 0.5));
    const Csf::Peak barten = makeCsf("barten03")->peak(point(1.0, 0.5, l));
    const Csf::Peak bartenReference = makeCsf("barten03")->peak(point(1.0, 0.5));
    // Barten's peak found by search, Daly's from the closed form.
    EXPECT_LT(relative(peak.frequencyCpd / reference.frequencyCpd,
                       barten.frequencyCpd / bartenReference.frequencyCpd),
              1e-7);
    EXPECT_LT(
        relative(peak.sensitivity / reference.sensitivity, barten.sensitivity / bartenReference.sensitivity),
        1e-10);
  }
  const CsfInfo& info = CsfRegistry::instance().get("daly98");
  const auto fixed = info.make(ParameterValues(info.parameters, {{"adapt", false}}));
  EXPECT_DOUBLE_EQ(fixed->sensitivity(point(4.0, 0.15, 0.01)), csfDaly98(4.0, 0.15));
}

// The identities that the construction has by design.
TEST(BurbeckKelly, Identities) {
  for (const double v : {0.02, 0.15, 1.0, 5.0, 38.0, 60.0})
    EXPECT_LT(relative(csfBurbeckKelly80(0.5, v), csfKelly79(0.5, v)), 1e-12) << v;
  for (const double v : {0.02, 0.15, 1.0, 1.9})
    EXPECT_LT(relative(csfBurbeckKelly80(10.0, v), csfKelly79(10.0, v)), 1e-12);
  for (const double cpd : {10.0, 12.0, 40.0}) EXPECT_EQ(burbeckKellySpatialInhibition(cpd), 0.0);
  for (const double hertz : {19.0, 25.0, 60.0}) EXPECT_EQ(burbeckKellyTemporalInhibition(hertz), 0.0);
  EXPECT_LT(
      relative(burbeckKellySpatialExcitation(10.0 * (1.0 + 1e-14)), burbeckKellySpatialExcitation(10.0)),
      1e-12);
  EXPECT_LT(
      relative(burbeckKellyTemporalExcitation(19.0 * (1.0 + 1e-14)), burbeckKellyTemporalExcitation(19.0)),
      1e-12);
}

TEST(BurbeckKelly, PartsHaveTheirPrintedValues) {
  EXPECT_NEAR(burbeckKellySpatialExcitation(10.0), 37.252, 5.1e-4);
  EXPECT_NEAR(burbeckKellySpatialExcitation(0.5), 872.76, 5.1e-3);
  EXPECT_NEAR(burbeckKellySpatialInhibition(0.5), 802.67, 5.1e-3);
  EXPECT_NEAR(burbeckKellyTemporalExcitation(1.0), 872.76, 5.1e-3);
  EXPECT_NEAR(burbeckKellyTemporalInhibition(1.0), 802.67, 5.1e-3);
  EXPECT_NEAR(burbeckKellyTemporalExcitation(19.0), 24.953, 5.1e-4);
}

TEST(BurbeckKelly, ChromaticPeaksOverVelocity) {
  const CsfInfo& info = CsfRegistry::instance().get("kelly83");
  const auto csf = info.make(ParameterValues(info.parameters, {{"adapt", false}}));
  const struct {
    double v, cpd, value;
  } kRows[] = {{0.1, 1.551, 27.52}, {0.15, 1.421, 32.46}, {0.5, 0.958, 47.05},
               {1.0, 0.693, 53.16}, {2.0, 0.473, 55.90},  {4.0, 0.307, 54.62},
               {8.0, 0.192, 49.62}, {16.0, 0.115, 42.05}, {32.0, 0.066, 33.49}};
  for (const auto& row : kRows) {
    const Csf::Peak peak = csf->peak(point(1.0, row.v));
    EXPECT_NEAR(peak.frequencyCpd, row.cpd, 5.1e-4);
    EXPECT_NEAR(peak.sensitivity, row.value, 5.1e-3);
  }
  // sqrt(E(100) / E(35)) = 1.51698; 1 at 35 cd/m2.
  EXPECT_NEAR(makeCsf("kelly83")->sensitivity(point(1.0)) / csfKelly83(1.0, 0.15), 1.51698, 5.1e-6);
  EXPECT_DOUBLE_EQ(makeCsf("kelly83")->sensitivity(point(1.0, 0.15, 35.0)), csfKelly83(1.0, 0.15));
}

TEST(Adaptation, IsClampedAndMonotone) {
  EXPECT_EQ(daly98C0(0.0, 187.0), daly98C0(1e-4, 187.0));
  EXPECT_EQ(daly98C1(kNan, 187.0), daly98C1(1e-4, 187.0));
  EXPECT_EQ(daly98C1(kInfinity, 187.0), daly98C1(1e4, 187.0));
  EXPECT_TRUE(std::isfinite(daly98C0(10.0, 0.0)) && std::isfinite(daly98C1(10.0, kInfinity)));
  for (const double area : {1e-4, 1.0, 187.0, 1e6})
    for (double l = 1e-4; l < 9e3; l *= 1.3) {
      EXPECT_LT(daly98C0(l, area), daly98C0(1.3 * l, area));
      EXPECT_GT(daly98C1(l, area), daly98C1(1.3 * l, area));
    }
  EXPECT_TRUE(std::isfinite(chromaticScale(0.0)) && std::isfinite(retinalIlluminanceTd(kNan)));
}

// The peak's place is found from the slope; a search for the largest value must agree to half its digits.
TEST(Adaptation, PeakOfBarten03AgreesWithSearch) {
  for (const double l : {1e-4, 0.01, 1.0, 100.0, 1e4})
    for (const double area : {0.1, 187.0, 3600.0}) {
      double best = 0.0, at = 0.0;
      for (double cpd = 0.01; cpd < 10.0; cpd *= 1.0001)
        if (const double value = csfBarten03(cpd, l, area); value > best) best = value, at = cpd;
      const Csf::Peak peak = barten03Peak(l, area);
      EXPECT_LT(relative(peak.frequencyCpd, at), 2e-4);
      EXPECT_LT(relative(peak.sensitivity, best), 1e-7);
      EXPECT_GE(peak.sensitivity, best * (1.0 - 1e-14));
    }
}

// Tables for a GPU ask for 256 x 64 entries a level.
TEST(Adaptation, TablesAreFilledInNoTime) {
  const std::unique_ptr<Csf> csf = makeCsf("daly98");
  const auto start = std::chrono::steady_clock::now();
  double sum = 0.0;
  for (int v = 0; v < 256; ++v)
    for (int l = 0; l < 64; ++l)
      sum += csf->sensitivity(point(4.0, 0.05 + 0.1 * v, std::pow(10.0, 0.1 * l - 3.0)));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GT(sum, 0.0);
  // 1e-5 s an entry for the search and as much again for slow machines and sanitizers.
  EXPECT_LT(seconds, 16384 * 2e-5 * 5.0);
}

// At 0 Hz the transient mechanism rests. At the sustained one's peak frequency its log-parabola is 1, and a
// large patch is integrated over A0 / (1 + (f / f0)^2). At 100 cd/m2, by hand: gain 68.9501
// (1.595023)^-0.164274 = 63.8595 (its second factor is 1 - e^-58), f = 1.62144 (1.366565)^-0.255823
// = 1.496937 cpd, area 270 / (1 + 2.302980^2) = 42.8319 deg2: 63.8595 x 1.496937 x sqrt(42.8319) = 625.62.
// For castleCSF 55.9037 x 1.507443 x 5.293525 = 446.09.
TEST(Stela, SustainedPeakByHand) {
  EXPECT_NEAR(csfStela(1.496937, 0.0, 100.0, 1e11, 0.0, kStela2022), 625.62, 0.02);
  EXPECT_NEAR(csfStela(1.507443, 0.0, 100.0, 1e11, 0.0, kCastle2024), 446.09, 0.02);
}

// Rovamo et al. 1993: sensitivity grows as the root of a small area and saturates at a large one.
TEST(Stela, AreaIsIntegrated) {
  const auto at = [](double area) { return csfStela(4.0, 1.0, 100.0, area, 0.0, kStela2022); };
  EXPECT_NEAR(at(4e-6) / at(1e-6), 2.0, 1e-4);
  EXPECT_NEAR(at(4e6) / at(1e6), 1.0, 1e-4);
}

TEST(Stela, DropsWithEccentricityAndFlicker) {
  for (const StelaConstants& k : {kStela2022, kCastle2024}) {
    // lg loss (drop + rho per cpd) e.
    EXPECT_NEAR(std::log10(csfStela(4.0, 1.0, 100.0, 1.0, 0.0, k) / csfStela(4.0, 1.0, 100.0, 1.0, 10.0, k)),
                10.0 * (k.drop + 4.0 * k.dropPerCpd), 1e-12);
    EXPECT_LT(csfStela(4.0, 40.0, 100.0, 1.0, 0.0, k), 0.1 * csfStela(4.0, 2.0, 100.0, 1.0, 0.0, k));
    // Coarse patterns are seen best when they flicker: Robson 1966.
    EXPECT_GT(csfStela(0.5, 8.0, 100.0, 6.0, 0.0, k), csfStela(0.5, 0.5, 100.0, 6.0, 0.0, k));
  }
}

TEST(Stela, TemporalFrequencyIsSpeedTimesFrequency) {
  CsfPoint at = point(4.0, 2.5);
  EXPECT_DOUBLE_EQ(makeCsf("stelacsf")->sensitivity(at), csfStela(4.0, 10.0, 100.0, 187.0, 0.0, kStela2022));
  at.velocityDegS = 0.0;
  EXPECT_DOUBLE_EQ(makeCsf("castlecsf")->sensitivity(at), csfStela(4.0, 0.0, 100.0, 187.0, 0.0, kCastle2024));
}

TEST(Csf, ConstantsAreParameters) {
  for (const auto& [name, info] : CsfRegistry::instance().all()) {
    const auto doubled = info.make(ParameterValues(info.parameters, {{"gain", 2.0}}));
    EXPECT_DOUBLE_EQ(doubled->sensitivity(point(2.0)), 2.0 * makeCsf(name)->sensitivity(point(2.0))) << name;
    // Each constant does something somewhere.
    for (const DeclaredAt& declared : flatten(info.parameters)) {
      const Parameter& parameter = *declared.parameter;
      if (parameter.type != ParameterType::Real) continue;
      const double value = std::get<double>(parameter.defaultValue);
      const double other = value == 0.0 ? 0.1 : 0.9 * value;
      const auto changed = info.make(ParameterValues(info.parameters, {{declared.path, other}}));
      bool differs = false;
      for (const double cpd : {1e-4, 0.3, 2.0, 4.0, 12.0})
        for (const double v : {0.01, 0.15, 4.0})
          for (const double l : {1e-6 * 1.001, 2e-3, 1.0, 30.0, 1e3}) {
            CsfPoint at = point(cpd, v, l);
            at.orientationDeg = 30.0, at.eccentricityDeg = 3.0;
            differs = differs || changed->sensitivity(at) != makeCsf(name)->sensitivity(at);
          }
      EXPECT_TRUE(differs) << name << " " << declared.path;
    }
  }
}

}  // namespace
}  // namespace limen::perception
