// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/algebraic_functions.h"
#include "renderer/surfaces/ray_roots.h"

namespace limen::surfaces {

/// Algebraic surfaces f = 0 around the origin (Schwarz 2009, section 6.4; SC-27 to SC-29).
enum class Algebraic {
  Sphere = LIMEN_SPHERE,
  Hyperboloid = LIMEN_HYPERBOLOID,
  Torus = LIMEN_TORUS,
  Goursat = LIMEN_GOURSAT,
  Heart = LIMEN_HEART,
  BarthDecic = LIMEN_BARTH_DECIC
};
constexpr EnumNames<Algebraic, 6> enumNames(Algebraic) {
  return {{{{Algebraic::Torus, "torus"},
            {Algebraic::Goursat, "goursat"},
            {Algebraic::Heart, "heart"},
            {Algebraic::BarthDecic, "barth_decic"},
            {Algebraic::Sphere, "sphere"},
            {Algebraic::Hyperboloid, "hyperboloid"}}}};
}
int degreeOf(Algebraic surface);
/// Of the ball around the origin in which it is drawn; closed surfaces lie within.
double radiusOf(Algebraic surface);
double valueOf(Algebraic surface, const glm::dvec3& at);

/// First root along the ray with from <= t <= to, by interval arithmetic on f and its derivative along the ray: none
/// is missed. A place where the surface touches the ray without crossing it counts. Rounding is to the nearest, with a
/// margin for it.
std::optional<double> firstRoot(Algebraic surface, const Ray& ray, double from, double to);

}  // namespace limen::surfaces
