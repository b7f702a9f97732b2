// SPDX-License-Identifier: BSD-3-Clause
// Nodes of a hierarchy over rays: bundles of rays, how they merge, and which spheres they may meet. In the
// shaders' arithmetic (cone_sphere.glsl) for any type of number.
// Source: Roger 2008, sections 3.3.2 and 3.3.3, equation 3.1. An angle is stored as the tangent of its half,
// which keeps its precision from 0 to pi and needs no trigonometric functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <span>

namespace limen::techniques {

/// All rays whose origins lie within `radius` of `centre` and whose directions make an angle of at most alpha
/// with `axis`. Roger's node: its point is the centre of the sphere, not the apex of a cone.
template <class T>
struct ConeSphere {
  using Vector = glm::vec<3, T>;
  Vector centre{0};
  T radius = -1;  ///< < 0: no rays
  Vector axis{0, 0, 1};
  T spread = 0;  ///< tan(alpha / 2), alpha in 0..pi; from kAllDirections on: all directions

  static constexpr T kAllDirections = 1000;  ///< alpha of pi - 0.002
  bool empty() const { return !(radius >= 0); }
};

/// How the enclosing bundle of some bundles is chosen. Any choice contains them; the thesis states none.
enum class BundleMerge {
  Mean,     ///< centre and axis are the means
  Pairwise  ///< smallest sphere and smallest cone of two, one child after another
};

/// How a bundle is tested against a sphere.
enum class BundleTest {
  Robust,  ///< equation 3.1 times cos(alpha), right for all angles; beside the cone exact, loose behind it
  Tight,   ///< as Robust, and behind an apex of less than pi / 2 the distance to the apex
  Printed  ///< equation 3.1 as printed: misses bundles wider than pi / 2
};

namespace cone_sphere {

/// Rounding of a result of a few operations; and of the distance between two points, as its share.
template <class T>
constexpr T kInflation = 16 * std::numeric_limits<T>::epsilon();

/// A ray: normalising its direction, of any length, turns it by some roundings.
template <class T>
ConeSphere<T> ofRay(const glm::vec<3, T>& origin, const glm::vec<3, T>& direction) {
  return {origin, 0, glm::normalize(direction), kInflation<T>};
}

/// Tangent of half the angle between two unit vectors: no cancellation, however small or wide the angle.
template <class T>
T halfAngle(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
  const T sum = glm::length(a + b), difference = glm::length(a - b);
  if (!(sum > difference / ConeSphere<T>::kAllDirections)) return ConeSphere<T>::kAllDirections;
  return difference / sum;
}

/// Spread of a cone around an axis `turned` (tangent of half the angle) away from that of a cone of `spread`,
/// rounded up.
template <class T>
T widened(T turned, T spread) {
  // 1 - turned * spread is off by an epsilon of 1.
  const T rest = 1 - turned * spread - kInflation<T>;
  const T sum = (turned + spread) * (1 + kInflation<T>)+kInflation<T>;
  return rest * ConeSphere<T>::kAllDirections > sum ? sum / rest : ConeSphere<T>::kAllDirections;
}

/// Sphere and cone around the given centre and axis that contain `part`.
template <class T>
void include(ConeSphere<T>& whole, const ConeSphere<T>& part) {
  whole.radius =
      std::max(whole.radius, (glm::length(part.centre - whole.centre) + part.radius) * (1 + kInflation<T>));
  whole.spread = std::max(whole.spread, part.spread >= ConeSphere<T>::kAllDirections
                                            ? ConeSphere<T>::kAllDirections
                                            : widened(halfAngle(whole.axis, part.axis), part.spread));
}

template <class T>
ConeSphere<T> mergedMean(std::span<const ConeSphere<T>> parts) {
  ConeSphere<T> whole;
  glm::vec<3, T> centres(0), axes(0);
  T count = 0;
  for (const ConeSphere<T>& part : parts) {
    if (part.empty()) continue;
    centres += part.centre, axes += part.axis, count += 1;
  }
  if (count == 0) return whole;
  whole.centre = centres / count;
  const T length = glm::length(axes);
  if (length > T(1e-4))
    whole.axis = axes / length;
  else
    whole.spread = ConeSphere<T>::kAllDirections;
  for (const ConeSphere<T>& part : parts)
    if (!part.empty()) include(whole, part);
  return whole;
}

template <class T>
ConeSphere<T> mergedPair(const ConeSphere<T>& a, const ConeSphere<T>& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  ConeSphere<T> whole = a;
  const glm::vec<3, T> between = b.centre - a.centre;
  const T distance = glm::length(between);
  if (distance + a.radius <= b.radius)
    whole.centre = b.centre;
  else if (distance + b.radius > a.radius)
    whole.centre = a.centre + between * (T(0.5) * (distance + b.radius - a.radius) / distance);
  whole.radius = -1, whole.spread = 0;
  const T wideA = 2 * std::atan(a.spread), wideB = 2 * std::atan(b.spread);
  const T turn = 2 * std::atan(halfAngle(a.axis, b.axis));
  if (turn + wideA <= wideB) {
    whole.axis = b.axis;
  } else if (turn + wideB > wideA) {
    const glm::vec<3, T> across = b.axis - glm::dot(a.axis, b.axis) * a.axis;
    const T length = glm::length(across), by = T(0.5) * (wideB + turn - wideA);
    if (length > T(1e-6))
      whole.axis = glm::normalize(std::cos(by) * a.axis + std::sin(by) / length * across);
    else if (glm::dot(a.axis, b.axis) < 0)
      whole.spread = ConeSphere<T>::kAllDirections;
  }
  include(whole, a);
  include(whole, b);
  return whole;
}

/// The bundle that contains all of `parts`; empty if they all are. Rounded so that it does.
template <class T>
ConeSphere<T> merged(std::span<const ConeSphere<T>> parts, BundleMerge how) {
  if (how == BundleMerge::Mean) return mergedMean(parts);
  ConeSphere<T> whole;
  for (const ConeSphere<T>& part : parts) whole = mergedPair(whole, part);
  return whole;
}

/// Whether a ray of the bundle may meet the sphere: true for all that do (except BundleTest::Printed).
template <class T>
bool mayMeet(const ConeSphere<T>& node, const glm::vec<3, T>& centre, T radius, BundleTest how) {
  if (node.empty()) return false;
  if (node.spread >= ConeSphere<T>::kAllDirections) return true;
  const glm::vec<3, T> v = centre - node.centre;
  const T along = glm::dot(v, node.axis), beside = glm::length(glm::cross(v, node.axis));
  const T h = node.spread, one = 1 + h * h;
  // of the angle, times `one`
  const T cosine = 1 - h * h, sine = 2 * h;
  const T reach = node.radius + radius + kInflation<T> * (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  if (how == BundleTest::Printed) return along * (sine / cosine) + reach * (one / cosine) >= beside;
  if (how == BundleTest::Tight && h < 1 && along * cosine + beside * sine < 0)
    return glm::dot(v, v) <= reach * reach * (1 + kInflation<T>);
  return beside * cosine - along * sine <= reach * one;
}

}  // namespace cone_sphere
}  // namespace limen::techniques
