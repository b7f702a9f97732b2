// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/scene/lod/height_field.h"

namespace limen::scene {

/// The open sky over a point of a terrain, as a cone: a spherical cap with the solid angle of the sky that
/// the horizon leaves free (above the horizontal) around that sky's mean direction. Ambient aperture lighting
/// (Oat and Sander 2007, which Schwarz 2009, section 10.3.5, names without formulas).
struct Aperture {
  glm::dvec3 axis{0.0, 1.0, 0.0};  ///< unit
  double angleRad = 0.0;           ///< half the cone's opening, 0 to pi/2
};

/// Horizon elevations in radians, at least 0, in `azimuths` directions around the point: direction k is
/// (cos, sin)(2 pi (k + 0.5) / azimuths) in (x, z). Heights are sampled at every grid spacing along each.
/// `highest`: field.highest().
std::vector<double> horizon(const HeightField& field, double highest, int i, int j, int azimuths);

/// The cap of a horizon, each direction representing its sector.
Aperture apertureOf(const std::vector<double>& horizonRad);

/// Apertures of all points of the field, in its order.
std::vector<Aperture> apertures(const HeightField& field, int azimuths);

/// Solid angle that two spherical caps share, with angular radii a and b and the angle d between their axes,
/// all in [0, pi].
double capIntersection(double a, double b, double d);

/// What an aperture lets through. Sun: the share of a disc of angular radius sunRadius that lies in the cone,
/// times the cosine to the surface. Sky: the irradiance of a uniform sky through the cone relative to that of
/// the whole sky: sin^2(angle) times the cosine to the axis.
struct ApertureLight {
  double sun = 0.0, sky = 0.0;
};
ApertureLight apertureLight(const Aperture& aperture, glm::dvec3 normal, glm::dvec3 toSun,
                            double sunRadiusRad);

}  // namespace limen::scene
