// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/base/error.h"
#include "perception/vision/masking.h"
#include "perception/vision/tvi.h"

namespace limen::perception {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double jump(double (*tvi)(double), double knot) {
  return std::log10(tvi(std::pow(10.0, knot + 1e-9)) / tvi(std::pow(10.0, knot - 1e-9)));
}

TEST(Tvi, WardStepsAtItsKnotsAsPrinted) {
  EXPECT_NEAR(jump(tviWard, -3.94), 7e-6, 5e-7);
  EXPECT_NEAR(jump(tviWard, -1.44), -0.0120, 5.1e-5);
  EXPECT_NEAR(jump(tviWard, -0.0184), -4e-7, 6e-8);
  EXPECT_NEAR(jump(tviWard, 1.9), -0.00314, 5.1e-6);
}

TEST(Tvi, WardIsMonotoneButForTwoSteps) {
  int falls = 0;
  for (double l = -6.0; l < 6.0; l += 1e-3)
    falls += tviWard(std::pow(10.0, l + 1e-3)) < tviWard(std::pow(10.0, l)) * (1.0 - 1e-12);
  EXPECT_EQ(falls, 2);
}

TEST(Tvi, SmoothedHasNoStepsAndIsMonotone) {
  for (const double knot : {-3.94, -1.44, -0.0184, 1.9}) EXPECT_NEAR(jump(tviWardSmoothed, knot), 0.0, 1e-8);
  for (double l = -6.0; l < 6.0; l += 1e-3)
    EXPECT_GE(tviWardSmoothed(std::pow(10.0, l + 1e-3)), tviWardSmoothed(std::pow(10.0, l)) * (1.0 - 1e-12));
  EXPECT_EQ(tviWardSmoothed(100.0), tviWard(100.0));
  // The shifts add up downwards: -0.00314, then -4e-7 more, then -0.0120 more.
  EXPECT_NEAR(std::log10(tviWardSmoothed(10.0) / tviWard(10.0)), -0.00314, 5.1e-6);
  EXPECT_NEAR(std::log10(tviWardSmoothed(0.01) / tviWard(0.01)), -0.00314 - 0.0120, 6e-5);
}

TEST(Tvi, DarknessAndNonsenseAreFinite) {
  for (const auto tvi : {tviWard, tviWardSmoothed}) {
    for (const double l : {0.0, -1.0, kNan, -kInfinity, 1e-300}) EXPECT_EQ(tvi(l), tvi(1e-6));
    EXPECT_TRUE(std::isfinite(tvi(kInfinity)) && std::isfinite(tvi(1e300)));
  }
  for (const std::string& name : tviNames())
    for (const double l : {0.0, -1.0, kNan, kInfinity, 1e-300, 1e300}) {
      const double value = makeTvi(name, makeCsf("barten89"), CsfPoint())(l);
      EXPECT_TRUE(std::isfinite(value) && value > 0.0) << name << " " << l;
    }
}

// Figure 9.3: Barten's curve times 29.194 meets Ward's at 100 cd/m2.
TEST(Tvi, FromACsfScaledToWard) {
  const std::shared_ptr<const Csf> csf = makeCsf("barten89");
  CsfPoint at;
  at.luminanceCdM2 = 1.0;
  EXPECT_NEAR(tviFromCsfScaled(*csf, at) / tviFromCsf(*csf, at), 29.194, 5.1e-4);
  EXPECT_NEAR(tviFromCsf(*csf, at), 0.00380795, 5.1e-9);
  for (const std::string& name : csfNames(Channel::Achromatic)) {
    const auto tvi = makeTvi("from_csf_scaled", makeCsf(name), CsfPoint());
    EXPECT_NEAR(tvi(100.0), tviWard(100.0), 1e-12 * tviWard(100.0)) << name;
  }
  EXPECT_THROW(makeTvi("wart", csf, at), Error);
}

TEST(FrequencyFactor, OriginalRuleAndActualLuminance) {
  EXPECT_EQ(frequencyFactorOriginal(3.999), 1.0);
  EXPECT_GT(frequencyFactorOriginal(4.0), 1.02);
  EXPECT_DOUBLE_EQ(frequencyFactorOriginal(9.0), frequencyFactorActual(9.0, 100.0));
  for (const double bad : {0.0, -1.0, 1e-300, 1e300, kInfinity, kNan})
    for (const double l : {0.0, 1.0, kNan, kInfinity}) {
      const double factor = frequencyFactorActual(bad, l);
      EXPECT_TRUE(factor >= 1.0 && factor <= 1e12) << bad << " " << l;
    }
}

TEST(Masking, RegisteredModelsAgreeInBothForms) {
  for (const char* name : {"none", "daly", "lubin", "self", "schwarz"}) {
    const Masking masking = makeMasking(name);
    for (double c = 1e-5; c < 1e13; c *= 3.0) {
      EXPECT_NEAR(masking.transducer(c) * masking.elevation(c), c, 1e-12 * c) << name << " " << c;
      EXPECT_EQ(masking.transducer(-c), -masking.transducer(c)) << name;
      EXPECT_EQ(masking.elevation(-c), masking.elevation(c)) << name;
      EXPECT_GT(masking.transducer(3.0 * c), masking.transducer(c)) << name << ": more is seen as more";
    }
    EXPECT_EQ(masking.transducer(0.0), 0.0) << name;
  }
  EXPECT_THROW(makeMasking("dali"), Error);
}

TEST(Masking, FiniteOnAnyArgument) {
  for (const auto& [name, info] : MaskingRegistry::instance().all()) {
    const Masking masking = makeMasking(name);
    for (const double c : {0.0, -0.0, 1e-320, 1e-300, 1e-30, 1e12, 1e100, 1.7e308, -1.7e308}) {
      EXPECT_TRUE(std::isfinite(masking.transducer(c))) << name << " " << c;
      EXPECT_TRUE(std::isfinite(masking.elevation(c)) && masking.elevation(c) >= 0.0) << name << " " << c;
    }
    for (const double c : {kNan, kInfinity, -kInfinity}) {
      EXPECT_EQ(masking.transducer(c), 0.0) << name;
      EXPECT_EQ(masking.elevation(c), 0.0) << name;
    }
  }
  for (const double mean : {kNan, kInfinity}) EXPECT_EQ(pointwiseExtendedMask(3.0, mean), 0.0);
  EXPECT_EQ(pointwiseExtendedMask(3.0, -1.0), selfMask(3.0));
  EXPECT_EQ(pointwiseExtendedMask(0.0, 1.0), 0.0);
}

// T_D elevates by c^0.7 (k1 k2^s = 1.00087), the thesis's transducer by c^0.3; both leave small contrasts
// alone.
TEST(Masking, Asymptotes) {
  EXPECT_NEAR(elevationDaly(1e9) / std::pow(1e9, 0.7), 1.00087, 1e-6);
  EXPECT_NEAR(transducerSchwarz(1e12) / std::pow(1e12, 0.7), 1.0, 1e-12);
  EXPECT_NEAR(transducerLubin(1e12) / (2.0 * std::pow(1e12, 0.2)), 1.0, 1e-12);
  EXPECT_NEAR(transducerLubin(1e-6) / (2.0 * std::pow(1e-6, 2.2)), 1.0, 1e-11);
  for (const double c : {1e-9, 1e-6}) {
    EXPECT_NEAR(elevationDaly(c), 1.0, 1e-9);
    EXPECT_NEAR(transducerSchwarz(c), c, 1e-12 * c);
  }
  EXPECT_NEAR(elevationDaly(1e-300), 1.0, 1e-12);
}

TEST(Masking, OnlyLubinFacilitates) {
  for (double c = 0.01; c < 1e6; c *= 1.07) {
    EXPECT_GE(elevationDaly(c), 1.0);
    EXPECT_GE(elevationSchwarz(c), 1.0);
  }
  EXPECT_GT(transducerLubin(1.2), 1.2);
  EXPECT_LT(transducerLubin(0.5), 0.5);
}

TEST(Masking, RegisteredConstantsAreThePublishedOnes) {
  for (const double c : {0.1, 1.0, 7.0, 1e6}) {
    EXPECT_DOUBLE_EQ(makeMasking("daly").elevation(c), elevationDaly(c));
    EXPECT_DOUBLE_EQ(makeMasking("lubin").transducer(c), transducerLubin(c));
    EXPECT_DOUBLE_EQ(makeMasking("self").transducer(c), selfMask(c));
    EXPECT_NEAR(makeMasking("schwarz").transducer(c), transducerSchwarz(c), 1e-14 * c);
  }
}

}  // namespace
}  // namespace limen::perception
