// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/reflection_counts.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <numeric>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/reflections/vertex_reflection/extremum.h"

namespace limen::techniques {
namespace {

constexpr double kTrueAngle = 1e-6;

/// 0 of none.
double shareOf(int64_t part, size_t whole) { return whole ? double(part) / double(whole) : 0.0; }

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<size_t>(share * double(values.size())))];
}

std::optional<glm::dvec2> placeOf(glm::dvec3 fromAnchor, const frame::Frame& frame) {
  const glm::dvec3 seen(frame.anchorToCamera() * glm::dvec4(fromAnchor, 1.0));
  if (!(seen.z < 0.0)) return std::nullopt;
  return glm::dvec2(seen) / -seen.z * (0.5 * frame.sizePx().y / frame.tanHalfFov());
}

}  // namespace

void ReflectionStatistics::add(const StarReflector& reflector, const reflections::ReflectedMesh& mesh,
                               const frame::Frame& frame, const SecantSettings& settings,
                               const std::vector<glm::vec4>& reflected) {
  const uint32_t firstOwn = reflector.triangles.first * static_cast<uint32_t>(mesh.perTriangle);
  const uint32_t countOwn = reflector.triangles.count * static_cast<uint32_t>(mesh.perTriangle);
  const auto outcomeAt = [&](uint32_t vertex) {
    return std::bit_cast<uint32_t>(reflected[vertex].w) >> kStatusOutcomeShift & 7U;
  };
  // Vertices that no triangle to be reflected has do not count.
  std::vector<uint8_t> used(reflected.size(), 0);
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i >= firstOwn && i - firstOwn < countOwn) continue;
    size_t without = 0;
    for (int k = 0; k < 3; ++k) {
      used[mesh.triangles[i][k]] = 1;
      if (outcomeAt(mesh.triangles[i][k]) > kOutcomeUnconverged) ++without;
    }
    ++triangles_[without];
  }
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < reflected.size(); ++i) {
    if (!used[i]) continue;
    const auto status = std::bit_cast<uint32_t>(reflected[i].w);
    const uint32_t outcome = outcomeAt(i);
    ++outcomes_[std::min<size_t>(outcome, 4)];
    iterations_.push_back(static_cast<int>(status & 255U));
    exchanges_ += status >> 8 & 255U;
    if (status & kStatusRestarted) ++restarts_;
    if (static_cast<int>(status & 255U) >= settings.cap) ++atCap_;
    if (outcome <= kOutcomeUnconverged) found.push_back(i);
  }
  const reflections::StarSurface surface = reflections::StarMesh::surface(reflector.mesh);
  const glm::dvec3 anchor = frame.gpuScene().anchor(), centre = reflector.centre.position;
  const glm::dvec3 eye = frame.camera().eye - centre;
  const reflections::SolverSettings truth{.guess = reflections::FirstGuess::PreviousFrame,
                                          .safeguard = reflections::Safeguard::Restart,
                                          .cap = 60,
                                          .areaPx2 = 0.0,
                                          .gradientTolerance = 1e-9,
                                          .leastSide = 0.01};
  const size_t step = std::max<size_t>(1, found.size() / kTruths);
  for (size_t i = 0; i < found.size(); i += step) {
    const glm::dvec3 vertex = glm::dvec3(mesh.positions[found[i]]) + anchor - centre;
    const glm::dvec3 point = glm::dvec3(reflected[found[i]]) + anchor - centre;
    const reflections::Reflection exact =
        reflections::reflectVertex(surface, eye, vertex, truth, {}, point, reflector.centre.inside);
    if (exact.outcome != reflections::Outcome::Found) continue;
    const double sign = reflector.centre.inside ? 1.0 : 0.0;
    const auto angleAt = [&](glm::dvec3 at) {
      return std::abs(sign * std::numbers::pi - reflections::halfVectorAngle(surface, at, eye, vertex));
    };
    if (!(angleAt(exact.point) < kTrueAngle)) continue;
    const auto where = placeOf(point + centre - anchor, frame),
               right = placeOf(exact.point + centre - anchor, frame);
    if (!where || !right) continue;
    // Facets are flat: over steps of a facet or more the surface is what they stand for.
    const double facet = std::sqrt(4.0 * std::numbers::pi / std::max(1U, reflector.triangles.count));
    const auto kind = reflections::extremumAt(surface, glm::normalize(exact.point), eye, vertex, facet);
    ++extrema_[static_cast<size_t>(kind)];
    angles_.push_back(glm::degrees(angleAt(point)));
    distances_.push_back(glm::length(*where - *right));
  }
}

std::vector<Counter> ReflectionStatistics::counters() const {
  std::vector<double> iterations(iterations_.begin(), iterations_.end());
  const size_t vertices = iterations_.size();
  const int64_t sum = std::accumulate(iterations_.begin(), iterations_.end(), int64_t{0});
  std::vector<Counter> out = {
      {"vertices_solved", double(vertices)},
      {"iterations_mean", shareOf(sum, vertices)},
      {"iterations_median", quantile(iterations, 0.5)},
      {"iterations_p95", quantile(iterations, 0.95)},
      {"at_cap_share", shareOf(atCap_, vertices)},
      {"exchanges_per_vertex", shareOf(exchanges_, vertices)},
      {"restarted_share", shareOf(restarts_, vertices)},
      {"vertices_found", double(outcomes_[kOutcomeFound])},
      {"vertices_unconverged", double(outcomes_[kOutcomeUnconverged])},
      {"vertices_false_root", double(outcomes_[kOutcomeFalseRoot])},
      {"vertices_facing_away", double(outcomes_[kOutcomeFacingAway])},
      {"vertices_no_surface", double(outcomes_[kOutcomeNoSurface])},
      {"triangles_complete", double(triangles_[0])},
      {"triangles_lacking_some", double(triangles_[1] + triangles_[2])},
      {"triangles_lacking_all", double(triangles_[3])},
      {"half_vector_median_deg", quantile(angles_, 0.5)},
      {"half_vector_p95_deg", quantile(angles_, 0.95)},
      {"screen_error_median_px", quantile(distances_, 0.5)},
      {"screen_error_p95_px", quantile(distances_, 0.95)},
      {"true_points", double(angles_.size())},
      {"true_points_minimum", double(extrema_[0])},
      {"true_points_maximum", double(extrema_[1])},
      {"true_points_between", double(extrema_[2])},
      {"vertices_tessellated", double(tessellated_.evaluated)},
      {"tessellated_iterations_mean", shareOf(tessellated_.iterations, tessellated_.evaluated)}};
  return out;
}

std::vector<Quantity> ReflectionStatistics::quantities() {
  constexpr Direction kLower = Direction::LowerIsBetter, kNeither = Direction::Neither;
  return {
      {"vertices_solved", "Vertices reflected, before tessellation", "", kNeither},
      {"iterations_mean", "Mean iterations of a vertex", "", kLower},
      {"iterations_median", "Median iterations of a vertex", "", kLower},
      {"iterations_p95", "95th percentile of a vertex's iterations", "", kLower},
      {"at_cap_share", "Share of vertices with as many iterations as the cap or more", "", kLower},
      {"exchanges_per_vertex", "Samples exchanged for discarded ones, of a vertex", "", kNeither},
      {"restarted_share", "Share of vertices whose search started again", "", kLower},
      {"vertices_found", "Vertices whose reflection was found", "", kNeither},
      {"vertices_unconverged", "Vertices drawn where the search was cut short", "", kLower},
      {"vertices_false_root", "Vertices that the reflector hides from the eye", "", kNeither},
      {"vertices_facing_away", "Vertices whose point found faces away", "", kNeither},
      {"vertices_no_surface", "Vertices without any point", "", kLower},
      {"triangles_complete", "Triangles with three reflected corners", "", kNeither},
      {"triangles_lacking_some", "Triangles that lack one or two reflected corners", "", kLower},
      {"triangles_lacking_all", "Triangles without a reflected corner", "", kNeither},
      {"half_vector_median_deg", "Median angle between half-vector and normal", "deg", kLower},
      {"half_vector_p95_deg", "95th percentile of the angle between half-vector and normal", "deg", kLower},
      {"screen_error_median_px", "Median distance to the true reflection point", "px", kLower},
      {"screen_error_p95_px", "95th percentile of the distance to the true reflection point", "px", kLower},
      {"true_points", "Vertices whose true reflection point was found", "", kNeither},
      {"true_points_minimum", "True points that are minima of the path (near zone)", "", kNeither},
      {"true_points_maximum", "True points that are maxima of the path (far zone)", "", kNeither},
      {"true_points_between", "True points that are neither (zone between)", "", kNeither},
      {"vertices_tessellated", "Vertices that the tessellator made", "", kNeither},
      {"tessellated_iterations_mean", "Mean iterations of vertices that the tessellator made", "", kLower}};
}

}  // namespace limen::techniques
