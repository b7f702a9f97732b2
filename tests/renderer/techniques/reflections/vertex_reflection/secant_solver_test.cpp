// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/secant_solver.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "renderer/techniques/reflections/vertex_reflection/extremum.h"

namespace limen::reflections {
namespace {

const glm::dvec3 kAxes(1.0, 1.5, 0.7);
// Of the numerical checks of equation 2.2.
const glm::dvec3 kCheckEye(3.0, 1.0, 2.0), kCheckVertex(-1.0, 2.5, 2.2);
const glm::dvec3 kCheckDirection = glm::normalize(glm::dvec3(0.3, 0.7, 0.6));

SolverSettings byGradient(GradientForm form, int cap) {
  return {.gradient = form,
          .guess = FirstGuess::Projections,
          .safeguard = Safeguard::None,
          .cap = cap,
          .areaPx2 = 0.0,
          .gradientTolerance = 1e-6};
}

double pathLength(const StarSurface& surface, glm::dvec3 direction, glm::dvec3 eye, glm::dvec3 vertex) {
  const glm::dvec3 u = glm::normalize(direction), p = surface(u).radius * u;
  return glm::length(p - eye) + glm::length(p - vertex);
}

/// Figures to four digits: they were computed outside the bench. Central differences know no gradient form;
/// with steps of 1e-5 they are right to 1e-10 of the third derivatives.
TEST(VertexReflectionGradient, IsThatOfThePathLength) {
  const StarSurface surface = ellipsoidSurface(kAxes);
  const glm::dvec3 gradient =
      pathSample(surface, kCheckDirection, kCheckEye, kCheckVertex, GradientForm::Corrected).gradient;
  const glm::dvec3 expected(-0.04175, -0.37868, 0.46267);
  EXPECT_LT(glm::length(gradient - expected), 1e-5);
  constexpr double kStep = 1e-5;
  const double radius = surface(kCheckDirection).radius;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = kStep;
    const double slope = (pathLength(surface, kCheckDirection + step, kCheckEye, kCheckVertex) -
                          pathLength(surface, kCheckDirection - step, kCheckEye, kCheckVertex)) /
                         (2.0 * kStep);
    // The path's length as a function of direction alone: its gradient at the surface is over the radius.
    EXPECT_NEAR(slope / radius, gradient[axis], 1e-8) << axis;
  }
}

TEST(VertexReflectionGradient, PrintedFormsAreOthers) {
  const StarSurface surface = ellipsoidSurface(kAxes);
  const glm::dvec3 directionsOnly =
      pathSample(surface, kCheckDirection, kCheckEye, kCheckVertex, GradientForm::DirectionsOnly).gradient;
  EXPECT_LT(glm::length(directionsOnly - glm::dvec3(0.0610, 0.3404, -0.1014)), 1e-4);
  const Reflection wrong =
      reflectVertex(surface, kCheckEye, kCheckVertex, byGradient(GradientForm::DirectionsOnly, 60));
  EXPECT_LT(wrong.gradientLength, 1e-6);
  EXPECT_NEAR(glm::degrees(halfVectorAngle(surface, wrong.point, kCheckEye, kCheckVertex)), 29.5, 0.05);
  const Reflection never =
      reflectVertex(surface, kCheckEye, kCheckVertex, byGradient(GradientForm::Printed, 60));
  EXPECT_EQ(never.iterations, 60);
  EXPECT_GT(never.gradientLength, 1e-6);
}

struct Case {
  glm::dvec3 vertex;
  bool hidden;  ///< from the eye, by the ellipsoid
};

const glm::dvec3 kEye(6.0, 1.0, 2.0);

std::vector<Case> randomCases(int count) {
  scene::Random random(7);
  std::vector<Case> out;
  while (out.size() < static_cast<size_t>(count)) {
    const glm::dvec3 v(random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0));
    // Where the ellipsoid is the unit sphere.
    const glm::dvec3 a = kEye / kAxes, b = v / kAxes, d = b - a;
    if (glm::length(b) <= 1.0) continue;
    const double t = -glm::dot(a, d) / glm::dot(d, d);
    out.push_back({v, t > 0.0 && t < 1.0 && glm::length(a + t * d) < 1.0});
  }
  return out;
}

struct Outcomes {
  double right = 0.0, stuck = 0.0, median = 0.0, p95 = 0.0, falseRoots = 0.0, medianAngleDeg = 0.0;
  int hidden = 0, hiddenFound = 0;
};

Outcomes solveAll(const SolverSettings& settings) {
  const StarSurface surface = ellipsoidSurface(kAxes);
  Outcomes out;
  std::vector<double> iterations, angles;
  int right = 0, stuck = 0, falseRoots = 0, visible = 0;
  for (const auto& [vertex, hidden] : randomCases(4000)) {
    const Reflection found = reflectVertex(surface, kEye, vertex, settings);
    if (hidden) {
      ++out.hidden;
      if (found.outcome == Outcome::Found) ++out.hiddenFound;
      if (found.outcome == Outcome::FalseRoot) ++falseRoots;
      continue;
    }
    ++visible;
    const double angle = halfVectorAngle(surface, found.point, kEye, vertex);
    if (found.outcome == Outcome::Found && angle < 1e-3) ++right;
    if (!(found.gradientLength < 1e-6)) ++stuck;
    iterations.push_back(found.iterations);
    angles.push_back(glm::degrees(angle));
  }
  std::sort(iterations.begin(), iterations.end());
  std::sort(angles.begin(), angles.end());
  out.right = double(right) / visible;
  out.stuck = double(stuck) / visible;
  out.median = iterations[iterations.size() / 2];
  out.p95 = iterations[iterations.size() * 95 / 100];
  out.medianAngleDeg = angles[angles.size() / 2];
  out.falseRoots = double(falseRoots) / std::max(1, out.hidden);
  return out;
}

/// Against figures found outside the bench with other vertices and the other of the two corners C: 96.4 %
/// right, 3.5 % at the cap, median 8. One in 4000 is 0.3 % at one standard deviation; the choice of C is
/// worth another percent.
TEST(VertexReflectionSolver, WandersAsOftenAsItIsKnownTo) {
  const Outcomes plain = solveAll(byGradient(GradientForm::Corrected, 40));
  EXPECT_NEAR(plain.right, 0.964, 0.02);
  EXPECT_NEAR(plain.stuck, 0.035, 0.02);
  EXPECT_NEAR(plain.median, 8.0, 1.0);
  EXPECT_LT(plain.p95, 22.0);
  EXPECT_LT(plain.medianAngleDeg, 1e-4);
  // 73 of 109 outside the bench; with either corner C half of them here, the others wander. What matters is
  // that false roots are common.
  EXPECT_GT(plain.falseRoots, 1.0 / 3.0);
  // What is hidden has no reflection: none may be taken for one.
  EXPECT_GT(plain.hidden, 60);
  EXPECT_EQ(plain.hiddenFound, 0);
}

/// Median 21 degrees for the form with only the directions mended.
TEST(VertexReflectionSolver, PrintedGradientMissesByDegrees) {
  EXPECT_NEAR(solveAll(byGradient(GradientForm::DirectionsOnly, 40)).medianAngleDeg, 21.0, 4.0);
}

/// A body that is convex has one reflection of what is not hidden: all must be found but those so near the
/// shadow's edge that they count as false roots, of length 1e-3: an angle of 1e-3 rad around an outline of
/// 0.3 rad across, seen from 6, among a volume of directions: less than one in a thousand.
TEST(VertexReflectionSolver, SafeguardAndBetterGuessFindAll) {
  SolverSettings guarded = byGradient(GradientForm::Corrected, 40);
  guarded.safeguard = Safeguard::Restart;
  EXPECT_GT(solveAll(guarded).right, 0.998);
  SolverSettings facing = byGradient(GradientForm::Corrected, 40);
  facing.guess = FirstGuess::FacingEye;
  const Outcomes better = solveAll(facing);
  EXPECT_GT(better.right, 0.998);
  EXPECT_EQ(better.hiddenFound, 0);
  EXPECT_LE(better.median, 8.0);
  EXPECT_LE(better.p95, 12.0);
}

/// Back-tracking at large determinants only costs steps (outside figures: 34 % at the cap at 1e-3).
TEST(VertexReflectionSolver, BackTrackingCuresNothing) {
  SolverSettings never = byGradient(GradientForm::Corrected, 40), often = never;
  often.determinantShare = 1e-3;
  EXPECT_LE(solveAll(often).right, solveAll(never).right + 0.005);
}

/// On a sphere the reflection lies in the plane of eye, vertex and centre, at the angle where the normal
/// halves the other two: found there by bisection.
TEST(VertexReflectionSolver, SphereAgreesWithBisectionInThePlane) {
  const StarSurface surface = sphereSurface(0.8);
  scene::Random random(3);
  SolverSettings settings = byGradient(GradientForm::Corrected, 60);
  settings.guess = FirstGuess::FacingEye;
  settings.gradientTolerance = 1e-11;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 eye = random.uniform(1.5, 6.0) * random.direction();
    const glm::dvec3 vertex = random.uniform(0.9, 6.0) * random.direction();
    const glm::dvec3 d = vertex - eye;
    const double t = std::clamp(-glm::dot(eye, d) / glm::dot(d, d), 0.0, 1.0);
    if (glm::length(eye + t * d) < 0.82) continue;  // hidden, or nearly
    const glm::dvec3 x = glm::normalize(eye), y = glm::normalize(vertex - glm::dot(vertex, x) * x);
    const auto pointAt = [&](double angle) { return 0.8 * (std::cos(angle) * x + std::sin(angle) * y); };
    const auto excess = [&](double angle) {  // angle to the eye less that to the vertex
      const glm::dvec3 p = pointAt(angle), n = p / 0.8;
      return std::acos(std::clamp(glm::dot(n, glm::normalize(eye - p)), -1.0, 1.0)) -
             std::acos(std::clamp(glm::dot(n, glm::normalize(vertex - p)), -1.0, 1.0));
    };
    double low = 0.0, high = std::acos(std::clamp(glm::dot(glm::normalize(vertex), x), -1.0, 1.0));
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (excess(middle) < 0.0 ? low : high) = middle;
    }
    const Reflection found = reflectVertex(surface, eye, vertex, settings);
    ASSERT_EQ(found.outcome, Outcome::Found) << i;
    // Angles near a right one are known to 1e-8 by their cosine.
    EXPECT_LT(glm::length(found.point - pointAt(low)), 1e-6) << i;
  }
}

/// Length of the path by automatic differentiation.
struct PathCost : ceres::FirstOrderFunction {
  glm::dvec3 eye, vertex;
  PathCost(glm::dvec3 from, glm::dvec3 to) : eye(from), vertex(to) {}
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    using Jet = ceres::Jet<double, 2>;
    // Stereographic coordinates around the eye's direction cover all that the eye sees.
    const glm::dvec3 z = glm::normalize(eye), x = scene::perpendicular(z), y = glm::cross(z, x);
    const Jet a(parameters[0], 0), b(parameters[1], 1);
    const Jet square = a * a + b * b, scale = 1.0 / (1.0 + square);
    Jet u[3], form(0.0), toEye(0.0), toVertex(0.0);
    for (int i = 0; i < 3; ++i) {
      u[i] = scale * (2.0 * a * x[i] + 2.0 * b * y[i] + (1.0 - square) * z[i]);
      form += u[i] * u[i] / (kAxes[i] * kAxes[i]);
    }
    const Jet radius = 1.0 / sqrt(form);
    for (int i = 0; i < 3; ++i) {
      const Jet p = radius * u[i];
      toEye += (p - eye[i]) * (p - eye[i]);
      toVertex += (p - vertex[i]) * (p - vertex[i]);
    }
    const Jet total = sqrt(toEye) + sqrt(toVertex);
    *cost = total.a;
    if (gradient) gradient[0] = total.v[0], gradient[1] = total.v[1];
    return true;
  }
  int NumParameters() const override { return 2; }
};

glm::dvec3 byCeres(glm::dvec3 eye, glm::dvec3 vertex) {
  double parameters[2] = {0.0, 0.0};
  const ceres::GradientProblem problem(new PathCost(eye, vertex));
  ceres::GradientProblemSolver::Options options;
  options.max_num_iterations = 500;
  options.gradient_tolerance = 1e-12;
  options.function_tolerance = 0.0;
  options.parameter_tolerance = 0.0;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, parameters, &summary);
  const glm::dvec3 z = glm::normalize(eye), x = scene::perpendicular(z), y = glm::cross(z, x);
  const double a = parameters[0], b = parameters[1], square = a * a + b * b;
  const glm::dvec3 u = (2.0 * a * x + 2.0 * b * y + (1.0 - square) * z) / (1.0 + square);
  return u / std::sqrt(glm::dot(u / kAxes, u / kAxes));
}

/// Neither Ceres nor the search knows the solver's gradient. A minimum of a function known to 1e-16 is known
/// to about 1e-8 times the curvature's root; grazing reflections are flatter by some hundreds.
TEST(VertexReflectionSolver, EllipsoidAgreesWithCeresAndWithSearch) {
  const StarSurface surface = ellipsoidSurface(kAxes);
  SolverSettings settings = byGradient(GradientForm::Corrected, 60);
  settings.guess = FirstGuess::FacingEye;
  settings.gradientTolerance = 1e-10;
  int compared = 0;
  for (const auto& [vertex, hidden] : randomCases(120)) {
    if (hidden) continue;
    const Reflection found = reflectVertex(surface, kEye, vertex, settings);
    if (found.outcome != Outcome::Found) continue;
    ++compared;
    EXPECT_LT(glm::length(found.point - byCeres(kEye, vertex)), 1e-5);
    if (compared % 10 != 0) continue;
    EXPECT_LT(glm::length(found.point - shortestPathPoint(surface, kEye, vertex)), 1e-5);
  }
  EXPECT_GT(compared, 100);
}

/// Of the ends by size in the picture, that by area alone may leave a long thin triangle (the thesis), that
/// by the longest side may not.
TEST(VertexReflectionSolver, AreaEndsTooEarlyAndTheLongestSideDoesNot) {
  const StarSurface surface = ellipsoidSurface(kAxes);
  const glm::dvec3 back = glm::normalize(kEye), right = scene::perpendicular(back),
                   up = glm::cross(back, right);
  constexpr double kPixels = 500.0;
  const ToScreen toScreen = [&](glm::dvec3 p) -> std::optional<glm::dvec2> {
    const double distance = glm::dot(kEye - p, back);
    return kPixels / distance * glm::dvec2(glm::dot(p, right), glm::dot(p, up));
  };
  const auto worst = [&](StopMeasure measure) {
    SolverSettings settings{.cap = 40, .stop = measure, .areaPx2 = 0.01};
    settings.guess = FirstGuess::FacingEye;
    SolverSettings exact = byGradient(GradientForm::Corrected, 60);
    exact.guess = FirstGuess::FacingEye;
    exact.gradientTolerance = 1e-10;
    std::vector<double> errors;
    for (const auto& [vertex, hidden] : randomCases(1000)) {
      if (hidden) continue;
      const Reflection truth = reflectVertex(surface, kEye, vertex, exact);
      const Reflection found = reflectVertex(surface, kEye, vertex, settings, toScreen);
      if (truth.outcome != Outcome::Found || found.outcome != Outcome::Found) continue;
      errors.push_back(glm::length(*toScreen(truth.point) - *toScreen(found.point)));
    }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() * 98 / 100];
  };
  // Sides below 0.14 px, and the best sample inside or next to the triangle.
  EXPECT_LT(worst(StopMeasure::LongestSide), 0.15);
  EXPECT_GT(worst(StopMeasure::Area), worst(StopMeasure::LongestSide));
}

TEST(VertexReflectionSolver, HardInputsStayFinite) {
  const StarSurface surface = sphereSurface(1.0);
  const SolverSettings settings{.areaPx2 = 0.0, .gradientTolerance = 1e-6};
  const double nan = std::nan("");
  // Vertex, eye and centre on one line; vertex on the surface, at the centre, at the eye; not finite.
  for (const glm::dvec3 vertex :
       {glm::dvec3(2.0, 0.0, 0.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0), glm::dvec3(4.0, 0.0, 0.0),
        glm::dvec3(-3.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(nan, 0.0, 0.0)})
    for (const FirstGuess guess : {FirstGuess::Projections, FirstGuess::FacingEye}) {
      SolverSettings with = settings;
      with.guess = guess;
      const Reflection found = reflectVertex(surface, {4.0, 0.0, 0.0}, vertex, with);
      EXPECT_TRUE(std::isfinite(found.point.x) && std::isfinite(found.point.y) &&
                  std::isfinite(found.point.z));
      EXPECT_LE(found.iterations, 2 * with.cap);
    }
  // On the line, the nearest point.
  const Reflection on = reflectVertex(surface, {4.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, settings);
  EXPECT_EQ(on.outcome, Outcome::Found);
  EXPECT_LT(glm::length(on.point - glm::dvec3(1.0, 0.0, 0.0)), 1e-5);
}

/// Mirror equation: on the axis of a concave mirror of radius R, a vertex at distance d and an eye at s have
/// a path of minimal length if 1 / d + 1 / s > 2 / R and of maximal length otherwise.
TEST(VertexReflectionZones, FollowTheMirrorEquation) {
  const StarSurface surface = sphereSurface(1.0);
  const glm::dvec3 down(0.0, -1.0, 0.0);
  for (const double s : {0.7, 1.5, 3.0})
    for (const double d : {0.1, 0.3, 0.45, 0.62, 0.9, 1.7, 4.0}) {
      const double excess = 1.0 / d + 1.0 / s - 2.0;
      if (std::abs(excess) < 0.05) continue;
      EXPECT_EQ(extremumAt(surface, down, (1.0 - s) * down, (1.0 - d) * down),
                excess > 0.0 ? Extremum::Minimum : Extremum::Maximum)
          << s << " " << d;
    }
  // Off the axis the two curvatures change sign at different distances: 2 / (R cos) and 2 cos / R.
  const double cosine = std::cos(1.0), between = 1.0 / (0.5 * (2.0 / cosine + 2.0 * cosine) - 1.0 / 3.0);
  const glm::dvec3 towardsEye(std::sin(1.0), cosine, 0.0), towardsVertex(-std::sin(1.0), cosine, 0.0);
  EXPECT_EQ(extremumAt(surface, down, down + 3.0 * towardsEye, down + between * towardsVertex),
            Extremum::Between);
}

}  // namespace
}  // namespace limen::reflections
