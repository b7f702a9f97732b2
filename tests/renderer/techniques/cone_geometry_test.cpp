// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cones/cone_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "renderer/techniques/reflections/cones/pixel_solid_angles.h"

namespace limen::techniques {
namespace {

constexpr double kPi = std::numbers::pi;

// A rectangle of half-extents a and b at distance 1 covers 4 asin(a b / sqrt((1 + a^2) (1 + b^2))): a formula
// other than the one of the corners. Sums of up to 10^4 terms are rounded to about 1e-13.
TEST(PixelSolidAngle, AddsUpToThatOfThePicture) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 3}, {97, 64}, {128, 33}})
    for (const double tangent : {0.1, 0.5, 3.0}) {
      const PixelSolidAngles angles(size, tangent);
      double sum = 0.0;
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) sum += angles.at({x, y});
      const double a = tangent * size.x / size.y, b = tangent;
      EXPECT_NEAR(sum, 4.0 * std::asin(a * b / std::sqrt((1.0 + a * a) * (1.0 + b * b))), 1e-12);
      EXPECT_EQ(angles.stored(), size_t((size.x + 1) / 2) * size_t((size.y + 1) / 2));
    }
}

// The integral of 1 / r^3 over the pixel. The midpoint rule errs by h^2 / 24 times the second derivatives, of at
// most 3 / r^3 along each axis: relatively by (1 / 300)^2 / 24 x 6 = 3e-6.
TEST(PixelSolidAngle, IsTheIntegralOverThePixel) {
  const PixelSolidAngles angles({8, 6}, 1.0);
  for (const glm::ivec2 pixel : {glm::ivec2(0, 0), {3, 2}, {7, 5}, {6, 1}}) {
    double sum = 0.0;
    const double pitch = 2.0 / 6.0, h = pitch / 100.0;
    for (int i = 0; i < 100; ++i)
      for (int k = 0; k < 100; ++k) {
        const double x = (pixel.x - 4.0) * pitch + (i + 0.5) * h, y = (pixel.y - 3.0) * pitch + (k + 0.5) * h;
        sum += h * h * std::pow(1.0 + x * x + y * y, -1.5);
      }
    EXPECT_NEAR(angles.at(pixel) / sum, 1.0, 1e-5);
  }
}

TEST(PixelSolidAngle, HasAConeOfTheSameSize) {
  for (const double angle : {1e-7, 1e-3, 0.5, 1.5, 3.0}) {
    const double half = std::sin(0.5 * angle);
    EXPECT_NEAR(coneHalfAngle(4.0 * kPi * half * half) / angle, 1.0, 1e-12);
  }
}

std::array<glm::dvec3, 3> onSphere(double radius, double size) {
  std::array<glm::dvec3, 3> out;
  for (int i = 0; i < 3; ++i)
    out[size_t(i)] =
        radius * glm::normalize(glm::dvec3(size * std::cos(2.1 * i), size * std::sin(2.1 * i), 1.0));
  return out;
}

TEST(MeanCurvature, OfASphereIsOneOverItsRadius) {
  for (const double radius : {0.1, 1.0, 25.0}) {
    const auto points = onSphere(radius, 0.2);
    std::array<glm::dvec3, 3> normals = points;
    for (glm::dvec3& normal : normals) normal /= radius;
    // Normals differ as points do, so that there is no error but rounding; interpolated normals are shorter
    // than 1 by up to 0.2^2, by which the curvature rises.
    EXPECT_NEAR(meanCurvature(points, normals, 0.0, 0.0) * radius, 1.0, 1e-12);
    EXPECT_NEAR(meanCurvature(points, normals, 0.3, 0.3) * radius, 1.0, 0.04);
    for (glm::dvec3& normal : normals) normal = -normal;
    EXPECT_NEAR(meanCurvature(points, normals, 0.0, 0.0) * radius, -1.0, 1e-12);
  }
}

// A triangle of 0.02 rad on a cylinder errs by that squared.
TEST(MeanCurvature, OfACylinderIsHalfOneOverItsRadius) {
  const double radius = 3.0;
  std::array<glm::dvec3, 3> points, normals;
  const double angles[] = {0.0, 0.02, 0.01}, heights[] = {0.0, 0.01, 0.05};
  for (size_t i = 0; i < 3; ++i) {
    normals[i] = {std::cos(angles[i]), std::sin(angles[i]), 0.0};
    points[i] = radius * normals[i] + glm::dvec3(0.0, 0.0, heights[i]);
  }
  EXPECT_NEAR(meanCurvature(points, normals, 0.3, 0.3) * radius, 0.5, 4e-4);
}

// z = k (x^2 - y^2) / 2 has normals (-k x, k y, 1); the corners' mean is the middle, whose normal is (0, 0,
// 1).
TEST(MeanCurvature, OfASaddleAndOfNothingIsZero) {
  const double k = 0.7;
  std::array<glm::dvec3, 3> points, normals;
  const glm::dvec2 corners[] = {{0.3, 0.1}, {-0.2, 0.2}, {-0.1, -0.3}};
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec2 c = corners[i];
    points[i] = {c.x, c.y, 0.5 * k * (c.x * c.x - c.y * c.y)};
    normals[i] = {-k * c.x, k * c.y, 1.0};
  }
  EXPECT_NEAR(meanCurvature(points, normals, 1.0 / 3.0, 1.0 / 3.0), 0.0, 1e-12);
  EXPECT_EQ(meanCurvature({}, normals, 0.3, 0.3), 0.0);
  EXPECT_EQ(meanCurvature(points, {}, 0.3, 0.3), 0.0);
}

// The figures of the specification: 0.02 % at 0.001 rad.
TEST(ReflectedCones, AgreeParaxiallyWithEdgeRays) {
  for (const double degrees : {17.0, 57.0})
    for (const double curvature : {0.0, 0.3, 2.0, -0.05}) {
      const double cosine = std::cos(degrees * kPi / 180.0), distance = 2.0;
      const ReflectedCone paraxial = reflectParaxially(distance, cosine, curvature, 1e-3);
      const ReflectedCone exact = reflectEdgeRays(distance, cosine, curvature, 1e-3);
      EXPECT_EQ(paraxial.kind, ReflectedCone::Kind::Diverging);
      EXPECT_EQ(exact.kind, ReflectedCone::Kind::Diverging);
      EXPECT_NEAR(paraxial.halfAngle / exact.halfAngle, 1.0, 2e-4) << degrees << ", " << curvature;
      // The apex of edge rays of 0.001 rad is off by that times a small factor.
      EXPECT_NEAR(paraxial.apexDistance / exact.apexDistance, 1.0, 1e-2) << degrees << ", " << curvature;
    }
}

TEST(ReflectedCones, OfAMirrorAreMirrored) {
  const ReflectedCone cone = reflectEdgeRays(3.0, 0.6, 0.0, 0.1);
  EXPECT_NEAR(cone.halfAngle, 0.1, 1e-12);
  // The eye behind the mirror, seen along the middle of the edge rays, which is the axis.
  EXPECT_NEAR(cone.apexDistance, 3.0, 1e-12);
}

// Rays in the plane of incidence, reflected in space at a sphere by ordinary vector algebra, stay within the
// cone of the edge rays around their middle.
TEST(ReflectedCones, EncloseTheBundle) {
  for (const double radius : {0.5, 4.0})
    for (const double incidence : {0.2, 0.9}) {
      const double alpha = 0.03, distance = 2.0;
      const glm::dvec3 centre(0.0, -radius, 0.0);
      const glm::dvec3 eye = distance * glm::dvec3(-std::sin(incidence), std::cos(incidence), 0.0);
      const ReflectedCone cone = reflectEdgeRays(distance, std::cos(incidence), 1.0 / radius, alpha);
      ASSERT_EQ(cone.kind, ReflectedCone::Kind::Diverging);
      std::vector<glm::dvec3> reflected;
      for (int i = -10; i <= 10; ++i) {
        const double turn = std::atan2(-eye.y, -eye.x) + alpha * i / 10.0;
        const glm::dvec3 direction(std::cos(turn), std::sin(turn), 0.0), from = eye - centre;
        const double along = glm::dot(from, direction);
        const double hit = -along - std::sqrt(along * along - glm::dot(from, from) + radius * radius);
        ASSERT_TRUE(std::isfinite(hit));
        reflected.push_back(glm::reflect(direction, glm::normalize(from + hit * direction)));
      }
      const glm::dvec3 middle = glm::normalize(reflected.front() + reflected.back());
      double widest = 0.0;
      for (const glm::dvec3& direction : reflected)
        widest = std::max(widest, std::acos(std::min(glm::dot(direction, middle), 1.0)));
      // acos near 1 is good to about 1e-8.
      EXPECT_NEAR(widest, cone.halfAngle, 1e-7);
    }
}

TEST(ReflectedCones, FlagWhatConverges) {
  using Kind = ReflectedCone::Kind;
  // A hollow of radius 1 seen from 2: the focus lies in front of it.
  EXPECT_EQ(reflectParaxially(2.0, 1.0, -1.0, 0.01).kind, Kind::Double);
  EXPECT_EQ(reflectEdgeRays(2.0, 1.0, -1.0, 0.01).kind, Kind::Double);
  // 1 / (1 / 2 - 2) = -2 / 3.
  EXPECT_NEAR(reflectEdgeRays(2.0, 1.0, -1.0, 1e-4).apexDistance, -2.0 / 3.0, 1e-6);
  EXPECT_NEAR(reflectEdgeRays(3.0, 1.0, -1.0, 1e-4).apexDistance, -1.0 / (2.0 - 1.0 / 3.0), 1e-6);
  // From within half the radius the bundle still diverges; from the focus it is parallel.
  EXPECT_EQ(reflectEdgeRays(0.4, 1.0, -1.0, 0.01).kind, Kind::Diverging);
  const ReflectedCone parallel = reflectParaxially(0.5, 1.0, -1.0, 0.01);
  EXPECT_EQ(parallel.kind, Kind::Parallel);
  EXPECT_EQ(parallel.halfAngle, 0.0);
  EXPECT_TRUE(std::isinf(parallel.apexDistance));
  // Almost along the surface of a sphere the outer edge misses it.
  EXPECT_EQ(reflectEdgeRays(2.0, 0.01, 1.0, 0.1).kind, Kind::Grazing);
}

TEST(ReflectedCones, AreWidenedByGloss) {
  EXPECT_DOUBLE_EQ(combinedHalfAngle(0.02, 0.1), 0.12);
  EXPECT_EQ(combinedHalfAngle(1.0, 1.0), kWidestCone);
}

class ConeProjection : public testing::Test {
 protected:
  Cone cone_{{1.0, 2.0, 3.0}, glm::normalize(glm::dvec3(0.3, -0.5, 0.8)), 0.2, 0.5};
};

// A point lies in the cone if its angle to the axis is below the cone's: a triangle around it must hold it in
// the disk.
TEST_F(ConeProjection, PutsTheConesInsideIntoTheDisk) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 point =
        cone_.apex + 5.0 * cone_.axis + glm::dvec3(number(random), number(random), number(random)) * 2.0;
    const auto projected = projectedToDisk(cone_, {point, point, point});
    ASSERT_EQ(projected.size(), 3U);
    const bool within = std::acos(glm::dot(glm::normalize(point - cone_.apex), cone_.axis)) < cone_.halfAngle;
    EXPECT_EQ(glm::length(projected[0]) < 1.0, within);
    inside += within;
  }
  EXPECT_GT(inside, 100);
}

TEST_F(ConeProjection, DoesNotDependOnScale) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  for (int i = 0; i < 200; ++i) {
    std::array<glm::dvec3, 3> triangle;
    for (glm::dvec3& corner : triangle)
      corner = cone_.apex + glm::dvec3(number(random), number(random), number(random));
    const auto expected = projectedToDisk(cone_, triangle);
    for (const double scale : {1e-4, 1e4}) {
      Cone scaled = cone_;
      scaled.apex *= scale, scaled.nearPlane *= scale;
      std::array<glm::dvec3, 3> other = triangle;
      for (glm::dvec3& corner : other) corner *= scale;
      const auto found = projectedToDisk(scaled, other);
      ASSERT_EQ(found.size(), expected.size());
      for (size_t k = 0; k < found.size(); ++k)
        // Coordinates reach 5 / (0.5 tan 0.2) = 50, and cancellation against the apex costs a digit.
        EXPECT_NEAR(glm::length(found[k] - expected[k]), 0.0, 1e-11);
    }
  }
}

TEST_F(ConeProjection, CutsAtTheNearPlane) {
  const auto at = [&](double along, double across) {
    return cone_.apex + along * cone_.axis +
           across * glm::normalize(glm::cross(cone_.axis, glm::dvec3(1.0, 0.0, 0.0)));
  };
  EXPECT_EQ(projectedToDisk(cone_, {at(1.0, 0.0), at(1.0, 1.0), at(2.0, 1.0)}).size(), 3U);
  EXPECT_EQ(projectedToDisk(cone_, {at(0.1, 0.0), at(1.0, 1.0), at(2.0, 1.0)}).size(), 4U);
  EXPECT_EQ(projectedToDisk(cone_, {at(0.1, 0.0), at(-1.0, 1.0), at(2.0, 1.0)}).size(), 3U);
  EXPECT_TRUE(projectedToDisk(cone_, {at(0.1, 0.0), at(-1.0, 1.0), at(0.4, 1.0)}).empty());
  // Where the edge from 0.1 to 2 at distance 1 passes the plane at 0.5: it is 1 away from the axis.
  const auto cut = projectedToDisk(cone_, {at(0.1, 1.0), at(2.0, 1.0), at(2.0, 2.0)});
  ASSERT_EQ(cut.size(), 4U);
  EXPECT_NEAR(glm::length(cut[0]), 1.0 / (0.5 * std::tan(0.2)), 1e-9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(projectedToDisk(cone_, {glm::dvec3(nan), at(2.0, 1.0), at(2.0, 2.0)}).empty());
}

}  // namespace
}  // namespace limen::techniques
