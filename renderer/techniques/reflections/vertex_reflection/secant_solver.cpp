// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/secant_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limen::reflections {
namespace {

using Triple = std::array<PathSample, 3>;

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

glm::dvec3 unitOr(glm::dvec3 v, glm::dvec3 otherwise) {
  const double length = glm::length(v);
  return length > 1e-300 && std::isfinite(length) ? v / length : otherwise;
}

glm::dvec3 anyTangent(glm::dvec3 direction) {
  const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(direction, axis));
}

/// Directions of an equilateral triangle of side `side` (in radii) around `middle`.
std::array<glm::dvec3, 3> triangleAround(glm::dvec3 middle, double side) {
  const glm::dvec3 x = anyTangent(middle), y = glm::cross(middle, x);
  const double reach = side / std::numbers::sqrt3;
  std::array<glm::dvec3, 3> out;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 3.0;
    out[static_cast<size_t>(i)] =
        glm::normalize(middle + reach * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return out;
}

/// A and B, the projections of vertex and eye, and C, which completes an equilateral triangle with them.
std::array<glm::dvec3, 3> projections(glm::dvec3 eye, glm::dvec3 vertex, double leastSide) {
  const glm::dvec3 b = unitOr(eye, {0.0, 0.0, 1.0});
  glm::dvec3 a = unitOr(vertex, b);
  if (glm::length(a - b) < leastSide) {
    // Vertex, eye and centre on one line: A is moved aside.
    const glm::dvec3 aside = glm::cross(b, unitOr(glm::cross(a, b), anyTangent(b)));
    a = glm::normalize(b + leastSide * aside);
  }
  const glm::dvec3 middle = 0.5 * (a + b);
  // Opposite directions: any tangent.
  const glm::dvec3 t = unitOr(glm::cross(b - a, middle), anyTangent(b));
  return {a, b, unitOr(middle + 0.5 * std::numbers::sqrt3 * glm::length(a - b) * t, t)};
}

size_t best(const Triple& samples) {
  size_t at = 0;
  for (size_t i = 1; i < 3; ++i)
    if (samples[i].length < samples[at].length) at = i;
  return at;
}

double projectedSize(const Triple& samples, const ToScreen& toScreen, StopMeasure measure) {
  std::array<glm::dvec2, 3> places;
  for (size_t i = 0; i < 3; ++i) {
    const auto place = toScreen(samples[i].point);
    if (!place) return HUGE_VAL;
    places[i] = *place;
  }
  const glm::dvec2 u = places[1] - places[0], v = places[2] - places[0], w = v - u;
  if (measure == StopMeasure::Area) return 0.5 * std::abs(u.x * v.y - u.y * v.x);
  return 0.5 * std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
}

class Solver {
 public:
  Solver(const StarSurface& surface, glm::dvec3 eye, glm::dvec3 vertex, const SolverSettings& settings,
         const ToScreen& toScreen, bool inside)
      : surface_(surface),
        eye_(eye),
        vertex_(vertex),
        settings_(settings),
        toScreen_(toScreen),
        inside_(inside) {}

  Reflection run(std::optional<glm::dvec3> previous) {
    begin(firstDirections(previous));
    while (!done() && out_.iterations < settings_.cap) step();
    converged_ = converged_ || done();
    found_ = samples_[best(samples_)];
    if (settings_.safeguard != Safeguard::None && everBest_.length < found_.length) found_ = everBest_;
    out_.point = found_.point;
    out_.gradientLength = found_.length;
    return out_;
  }
  bool converged() const { return converged_; }
  const PathSample& found() const { return found_; }

 private:
  std::array<glm::dvec3, 3> firstDirections(std::optional<glm::dvec3> previous) const {
    if (settings_.guess == FirstGuess::PreviousFrame && previous && glm::length(*previous) > 0.0)
      return triangleAround(glm::normalize(*previous), settings_.leastSide);
    if (settings_.guess != FirstGuess::Projections)
      return triangleAround(unitOr(inside_ ? -eye_ : eye_, {0.0, 0.0, 1.0}), 10.0 * settings_.leastSide);
    return projections(eye_, vertex_, settings_.leastSide);
  }

  PathSample sample(glm::dvec3 direction) const {
    return pathSample(surface_, direction, eye_, vertex_, settings_.gradient);
  }

  void begin(const std::array<glm::dvec3, 3>& directions) {
    for (size_t i = 0; i < 3; ++i) samples_[i] = sample(directions[i]);
    everBest_ = samples_[best(samples_)];
    newest_ = 2;
  }

  bool done() const {
    const double least = samples_[best(samples_)].length;
    if (settings_.gradientTolerance > 0.0 && least < settings_.gradientTolerance) return true;
    return settings_.areaPx2 > 0.0 && toScreen_ &&
           projectedSize(samples_, toScreen_, settings_.stop) < settings_.areaPx2;
  }

  void step() {
    ++out_.iterations;
    const auto& [sa, sb, sc] = samples_;
    const glm::dvec3 a = sa.gradient - sc.gradient, b = sb.gradient - sc.gradient, c = sc.gradient;
    const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > settings_.determinantShare * aa * bb) && backTrack()) return;
    const double ac = glm::dot(a, c), bc = glm::dot(b, c);
    const double alpha = (ab * bc - bb * ac) / determinant, beta = (ab * ac - aa * bc) / determinant;
    const glm::dvec3 d = alpha * sa.point + beta * sb.point + (1.0 - alpha - beta) * sc.point;
    const double length = glm::length(d);
    if (!(length > 0.0) || !std::isfinite(length)) return;
    replaceWorst(sample(d / length));
  }

  /// Exchanges the worst sample, but never the newest, for the one discarded last; false if there is none.
  bool backTrack() {
    if (!discarded_) return false;
    size_t at = newest_ == 0 ? 1 : 0;
    for (size_t i = 0; i < 3; ++i)
      if (i != newest_ && samples_[i].length > samples_[at].length) at = i;
    std::swap(samples_[at], *discarded_);
    ++out_.backTracks;
    // The same two samples would be exchanged back and forth.
    newest_ = at;
    return true;
  }

  void replaceWorst(const PathSample& fresh) {
    size_t at = 0;
    for (size_t i = 1; i < 3; ++i)
      if (!(samples_[i].length <= samples_[at].length)) at = i;
    discarded_ = samples_[at];
    samples_[at] = fresh;
    newest_ = at;
    if (fresh.length < everBest_.length) everBest_ = fresh;
  }

  const StarSurface& surface_;
  glm::dvec3 eye_, vertex_;
  const SolverSettings& settings_;
  const ToScreen& toScreen_;
  bool inside_;
  Reflection out_;
  Triple samples_;
  PathSample everBest_, found_;
  std::optional<PathSample> discarded_;
  size_t newest_ = 2;
  bool converged_ = false;
};

}  // namespace

PathSample pathSample(const StarSurface& surface, glm::dvec3 direction, glm::dvec3 eye, glm::dvec3 vertex,
                      GradientForm form) {
  PathSample out;
  out.direction = direction;
  out.length = HUGE_VAL;
  const RadialPoint at = surface(direction);
  if (!(at.radius > 0.0)) return out;
  out.point = at.radius * direction;
  // In contact the direction is undefined; none is as good as any.
  const glm::dvec3 fromEye = unitOr(out.point - eye, glm::dvec3(0.0));
  const glm::dvec3 fromVertex = unitOr(out.point - vertex, glm::dvec3(0.0));
  out.e = fromEye + fromVertex;
  out.normal = outwardNormal(direction, at);
  const glm::dvec3 e = form == GradientForm::Printed ? fromVertex - fromEye : out.e;
  // The derivative of P along a tangent t of the sphere of directions is (gradient . t) u + t, so that the
  // gradient takes the component of e along u, not along the gradient of the radius (as equation 2.2 has it).
  const glm::dvec3 across = e - glm::dot(direction, e) * direction;
  out.gradient = across + (form == GradientForm::Corrected ? glm::dot(direction, e) * at.gradient
                                                           : glm::dot(at.gradient, e) * direction);
  if (finite(out.gradient)) out.length = glm::length(out.gradient);
  return out;
}

Reflection reflectVertex(const StarSurface& surface, glm::dvec3 eye, glm::dvec3 vertex,
                         const SolverSettings& settings, const ToScreen& toScreen,
                         std::optional<glm::dvec3> previous, bool inside) {
  if (!finite(eye) || !finite(vertex)) return {};
  const auto solve = [&](const SolverSettings& by) {
    Solver solver(surface, eye, vertex, by, toScreen, inside);
    Reflection out = solver.run(previous);
    const PathSample& found = solver.found();
    if (!std::isfinite(found.length)) return Reflection{.point = {}, .iterations = out.iterations};
    const glm::dvec3 normal = inside ? -found.normal : found.normal;
    if (glm::length(found.e) < by.falseRootLength)
      out.outcome = Outcome::FalseRoot;
    else if (glm::dot(normal, eye - found.point) <= 0.0 || glm::dot(normal, vertex - found.point) < 0.0)
      out.outcome = Outcome::FacingAway;
    else
      out.outcome = solver.converged() ? Outcome::Found : Outcome::Unconverged;
    return out;
  };
  Reflection first = solve(settings);
  if (settings.safeguard != Safeguard::Restart || settings.guess == FirstGuess::FacingEye ||
      first.outcome == Outcome::Found || first.outcome == Outcome::FalseRoot)
    return first;
  SolverSettings again = settings;
  again.guess = FirstGuess::FacingEye;
  Reflection second = solve(again);
  Reflection& better = second.outcome <= first.outcome ? second : first;
  better.iterations = first.iterations + second.iterations;
  better.backTracks = first.backTracks + second.backTracks;
  better.restarted = true;
  return better;
}

double halfVectorAngle(const StarSurface& surface, glm::dvec3 point, glm::dvec3 eye, glm::dvec3 vertex) {
  const glm::dvec3 direction = glm::normalize(point);
  const glm::dvec3 normal = outwardNormal(direction, surface(direction));
  const glm::dvec3 half = glm::normalize(eye - point) + glm::normalize(vertex - point);
  return std::atan2(glm::length(glm::cross(half, normal)), glm::dot(half, normal));
}

glm::dvec3 shortestPathPoint(const StarSurface& surface, glm::dvec3 eye, glm::dvec3 vertex) {
  constexpr int kFirst = 96, kNext = 4, kLevels = 28;
  glm::dvec3 bestDirection(0.0, 0.0, 1.0);
  double shortest = HUGE_VAL;
  const auto tryOut = [&](glm::dvec3 direction) {
    const glm::dvec3 point = surface(direction).radius * direction;
    const double length = glm::length(point - eye) + glm::length(point - vertex);
    if (length < shortest) shortest = length, bestDirection = direction;
  };
  for (int i = 0; i < kFirst; ++i)
    for (int j = 0; j < 2 * kFirst; ++j) {
      const double theta = std::numbers::pi * (i + 0.5) / kFirst, phi = std::numbers::pi * j / kFirst;
      tryOut({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  double reach = 2.0 / kFirst * std::numbers::pi;
  for (int level = 0; level < kLevels; ++level, reach *= 0.5) {
    const glm::dvec3 middle = bestDirection, x = anyTangent(middle), y = glm::cross(middle, x);
    for (int i = -kNext; i <= kNext; ++i)
      for (int j = -kNext; j <= kNext; ++j)
        tryOut(glm::normalize(middle + reach / kNext * (double(i) * x + double(j) * y)));
  }
  return surface(bestDirection).radius * bestDirection;
}

}  // namespace limen::reflections
