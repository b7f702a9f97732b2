// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/castle_csf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "perception/vision/colour.h"
#include "perception/vision/csf.h"

namespace limen::perception {
namespace {

// Computed in another language from the paper's equations and published constants.
TEST(CastleCsf, MechanismsMatchASecondImplementation) {
  const struct {
    CastleMechanism mechanism;
    double rho, omega, luminance, area, sensitivity;
  } kValues[] = {{CastleMechanism::Sustained, 0.5, 0, 10, 1, 23.32123117},
                 {CastleMechanism::Sustained, 2, 4, 100, 7.07, 132.9076288},
                 {CastleMechanism::Sustained, 8, 0.5, 300, 0.785, 102.4064555},
                 {CastleMechanism::Sustained, 1, 12, 0.5, 50, 11.19022838},
                 {CastleMechanism::Transient, 0.5, 0, 10, 1, 7.086568215e-10},
                 {CastleMechanism::Transient, 2, 4, 100, 7.07, 53.72582161},
                 {CastleMechanism::Transient, 8, 0.5, 300, 0.785, 0.1174345424},
                 {CastleMechanism::Transient, 1, 12, 0.5, 50, 17.63319692},
                 {CastleMechanism::RedGreen, 0.5, 0, 10, 1, 64.55742148},
                 {CastleMechanism::RedGreen, 2, 4, 100, 7.07, 218.0372032},
                 {CastleMechanism::RedGreen, 8, 0.5, 300, 0.785, 101.4416407},
                 {CastleMechanism::RedGreen, 1, 12, 0.5, 50, 25.73049397},
                 {CastleMechanism::YellowViolet, 0.5, 0, 10, 1, 7.819668039},
                 {CastleMechanism::YellowViolet, 2, 4, 100, 7.07, 17.55357024},
                 {CastleMechanism::YellowViolet, 8, 0.5, 300, 0.785, 9.347311858},
                 {CastleMechanism::YellowViolet, 1, 12, 0.5, 50, 1.943445909}};
  for (const auto& v : kValues)
    EXPECT_NEAR(csfCastle(v.mechanism, v.rho, v.omega, v.luminance, v.area), v.sensitivity,
                1e-9 * v.sensitivity)
        << toText(v.mechanism) << " " << v.rho;
}

// Values of the sensitivity table that ColorVideoVDP 0.5.6 (MIT) ships, made by castleCSF's authors for
// static patches of sigma 1.5 degrees. They are not exactly those of the paper's constants: 1.5 dB.
TEST(CastleCsf, RedGreenFollowsTheAuthorsTable) {
  const double kValues[][3] = {
      {0.349246, 14.2683, 189.572}, {1.85058, 14.2683, 191.293},  {6.46307, 14.2683, 80.0816},
      {14.8774, 14.2683, 35.8243},  {0.349246, 92.7705, 299.689}, {1.85058, 92.7705, 302.409},
      {6.46307, 92.7705, 126.599},  {14.8774, 92.7705, 56.6336},  {0.349246, 603.178, 342.58},
      {1.85058, 603.178, 345.689},  {6.46307, 603.178, 144.717},  {14.8774, 603.178, 64.7389}};
  for (const auto& [rho, luminance, sensitivity] : kValues) {
    const double own = castleSpatial(CastleMechanism::RedGreen, rho, luminance, 2.25 * std::numbers::pi);
    EXPECT_LT(std::abs(20.0 * std::log10(own / sensitivity)), 1.5) << rho << " " << luminance;
  }
}

TEST(CastleCsf, AchromaticIsTheSumOfBothMechanisms) {
  for (const double rho : {0.3, 2.0, 11.0})
    for (const double omega : {0.0, 3.0, 20.0})
      for (const double luminance : {0.1, 30.0, 500.0}) {
        const double sum = csfCastle(CastleMechanism::Sustained, rho, omega, luminance, 3.0, 5.0) +
                           csfCastle(CastleMechanism::Transient, rho, omega, luminance, 3.0, 5.0);
        EXPECT_NEAR(csfCastleAchromatic(rho, omega, luminance, 3.0, 5.0), sum, 1e-12 * sum);
        CsfPoint point;
        point.frequencyCpd = rho, point.velocityDegS = omega / rho, point.luminanceCdM2 = luminance;
        point.areaDeg2 = 3.0, point.eccentricityDeg = 5.0;
        EXPECT_NEAR(makeCsf("castlecsf")->sensitivity(point), sum, 1e-12 * sum);
      }
}

TEST(CastleCsf, TemporalResponsesPeakAtOne) {
  for (const CastleMechanism mechanism :
       {CastleMechanism::Sustained, CastleMechanism::RedGreen, CastleMechanism::YellowViolet}) {
    EXPECT_EQ(castleTemporal(mechanism, 0.0, 100.0), 1.0);
    EXPECT_LT(castleTemporal(mechanism, 20.0, 100.0), 0.2);
  }
  for (const double luminance : {0.1, 1.0, 100.0}) {
    const double best = castleTransientHz(luminance);
    EXPECT_DOUBLE_EQ(castleTemporal(CastleMechanism::Transient, best, luminance), 1.0);
    EXPECT_LT(castleTemporal(CastleMechanism::Transient, 0.5 * best, luminance), 1.0);
    EXPECT_LT(castleTemporal(CastleMechanism::Transient, 2.0 * best, luminance), 1.0);
    EXPECT_LT(castleTemporal(CastleMechanism::Transient, 0.0, luminance), 1e-3);
  }
  EXPECT_NEAR(castleTransientHz(1.0), 4.7036, 1e-12);
  EXPECT_NEAR(castleTransientHz(100.0), 4.7036 + 2.0 * 2.41482, 1e-12);
  EXPECT_EQ(castleTransientHz(1e-9), 0.0);
}

TEST(CastleCsf, HostileArgumentsGiveZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const CastleMechanism mechanism : {CastleMechanism::Sustained, CastleMechanism::YellowViolet}) {
    for (const double rho : {0.0, -1.0, nan, infinity}) EXPECT_EQ(csfCastle(mechanism, rho, 1, 100, 1), 0.0);
    for (const double area : {0.0, -1.0, nan}) EXPECT_EQ(csfCastle(mechanism, 2, 1, 100, area), 0.0);
    EXPECT_EQ(csfCastle(mechanism, 2, nan, 100, 1), 0.0);
    EXPECT_EQ(csfCastle(mechanism, 2, 1, nan, 1), 0.0);
    EXPECT_EQ(csfCastle(mechanism, 2, 1, 100, 1, nan), 0.0);
    EXPECT_EQ(csfCastle(mechanism, 2, infinity, 100, 1), 0.0);
  }
}

TEST(DklSpace, GreysHaveOnlyLuminance) {
  for (const double grey : {0.01, 1.0, 250.0}) {
    const glm::dvec3 dkl = dklFromXyz(grey * whiteXyz());
    EXPECT_NEAR(dkl.x, grey, 1e-12 * grey);
    EXPECT_NEAR(dkl.y, 0.0, 1e-12 * grey);
    EXPECT_NEAR(dkl.z, 0.0, 1e-12 * grey);
  }
  // Reddish, greenish, bluish, yellowish: signs of L - M and S - (L + M).
  EXPECT_GT(dklFromXyz(xyzFromLinearRgb({1, 0.5, 0.5})).y, 0.0);
  EXPECT_LT(dklFromXyz(xyzFromLinearRgb({0.5, 1, 0.5})).y, 0.0);
  EXPECT_GT(dklFromXyz(xyzFromLinearRgb({0.5, 0.5, 1})).z, 0.0);
  EXPECT_LT(dklFromXyz(xyzFromLinearRgb({1, 1, 0.5})).z, 0.0);
}

}  // namespace
}  // namespace limen::perception
