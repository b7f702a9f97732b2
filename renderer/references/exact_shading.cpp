// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/exact_shading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/base/error.h"

namespace limen::references {
namespace {

/// Value of a lattice point: "pcg3d" of Jarzynski and Olano 2020, its first word.
double latticeWord(std::array<int64_t, 3> at) {
  std::array<uint32_t, 3> word{};
  for (size_t i = 0; i < 3; ++i) word[i] = static_cast<uint32_t>(at[i]) * 1664525U + 1013904223U;
  word[0] += word[1] * word[2];
  word[1] += word[2] * word[0];
  word[2] += word[0] * word[1];
  for (uint32_t& each : word) each ^= each >> 16;
  word[0] += word[1] * word[2];
  return 2.0 * double(word[0] >> 8) / 16777215.0 - 1.0;
}

/// Quintic interpolation of the eight values around.
double smoothNoise(glm::dvec3 at) {
  const glm::dvec3 low = glm::floor(at), part = at - low;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1.0;
    std::array<int64_t, 3> place{};
    for (int axis = 0; axis < 3; ++axis) {
      const int upper = corner >> axis & 1;
      const double t = part[axis], rise = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
      weight *= upper == 1 ? rise : 1.0 - rise;
      place[static_cast<size_t>(axis)] = static_cast<int64_t>(low[axis]) + upper;
    }
    sum += weight * latticeWord(place);
  }
  return sum;
}

double patternValue(const scene::Pattern& pattern, glm::dvec3 at) {
  if (pattern.kind == scene::Pattern::Kind::Checker) {
    const glm::dvec3 cell = glm::floor(at);
    return std::fmod(std::abs(cell.x + cell.y + cell.z), 2.0) == 0.0 ? 1.0 : -1.0;
  }
  double sum = 0.0, total = 0.0;
  for (int octave = 0; octave < pattern.octaves; ++octave) {
    // Shifted after the doubling of the position.
    const double amplitude = std::pow(0.5, octave);
    sum +=
        amplitude * smoothNoise(at * std::pow(2.0, octave) + double(octave) * glm::dvec3(17.31, 7.67, 31.13));
    total += amplitude;
  }
  return total > 0.0 ? sum / total : 0.0;
}

/// Beckmann's density of slopes over the projected solid angle, times pi / 4: the share of facets that a
/// direction's surroundings see.
double beckmann(double cosine, double roughness) {
  const double tangent = std::tan(std::acos(std::min(cosine, 1.0)));
  return std::exp(-std::pow(tangent / roughness, 2.0)) /
         (4.0 * roughness * roughness * std::pow(cosine, 4.0));
}

}  // namespace

double exactHighlight(const frame::ShadedSetting& setting, glm::dvec3 normal, glm::dvec3 light,
                      glm::dvec3 view) {
  if (std::holds_alternative<frame::PhongHighlight>(setting.highlight)) {
    const double cosine = glm::dot(glm::reflect(-view, normal), light);
    return cosine > 0.0 ? std::pow(cosine, setting.shininess) : 0.0;
  }
  const glm::dvec3 sum = light + view;
  if (!(glm::length(sum) > 0.0)) return 0.0;
  const glm::dvec3 half = glm::normalize(sum);
  const double nh = glm::dot(normal, half);
  if (!(nh > 0.0)) return 0.0;
  const auto* facets = std::get_if<frame::CookTorranceHighlight>(&setting.highlight);
  if (!facets) return std::pow(nh, setting.shininess);
  const double nv = glm::dot(normal, view), nl = glm::dot(normal, light), vh = glm::dot(view, half);
  if (!(nv > 0.0 && nl > 0.0 && vh > 0.0)) return 0.0;
  const double fresnel =
      facets->reflectance + (1.0 - facets->reflectance) * std::pow(1.0 - std::min(vh, 1.0), 5.0);
  const double visible = std::min({1.0, 2.0 * nh * nv / vh, 2.0 * nh * nl / vh});
  return fresnel * beckmann(nh, facets->roughness) * visible / (nv * nl) * nl;
}

ExactShading::ExactShading(const scene::Scene& scene, const Triangles& triangles, const TriangleTree& tree,
                           glm::dvec3 anchor, const frame::ShadedSetting& setting)
    : scene_(scene),
      triangles_(triangles),
      tree_(tree),
      anchor_(anchor),
      setting_(setting),
      materialOf_(triangles.count(), 0) {
  for (const scene::Part& part : scene.parts)
    std::fill_n(materialOf_.begin() + part.firstTriangle, part.triangleCount, part.material);
  for (const scene::Material& material : scene.materials)
    if (material.surface != scene::SurfaceKind::Mesh)
      throw Error(
          "this reference knows plain meshes alone; '" + material.name + "' is lit by its patch or aperture",
          {}, "use another scene");
}

const scene::Material& ExactShading::material(uint32_t triangle) const {
  return scene_.materials[materialOf_[triangle]];
}

ExactPoint ExactShading::point(const ExactRay& ray, const ExactHit& hit) const {
  ExactPoint point;
  point.triangle = hit.triangle;
  point.view = -glm::normalize(ray.direction);
  const glm::dvec3 a = triangles_.corner(hit.triangle, 0), b = triangles_.corner(hit.triangle, 1),
                   c = triangles_.corner(hit.triangle, 2);
  point.position = hit.weights.x * a + hit.weights.y * b + hit.weights.z * c;
  point.flatNormal = glm::normalize(glm::cross(b - a, c - a));
  point.normal = point.flatNormal;
  const std::vector<glm::vec3>& normals = scene_.mesh.normals;
  if (!normals.empty()) {
    glm::dvec3 mean(0.0);
    for (int corner = 0; corner < 3; ++corner)
      mean += hit.weights[corner] * glm::dvec3(normals[scene_.mesh.triangles[hit.triangle][corner]]);
    if (glm::length(mean) > 0.0) point.normal = glm::normalize(mean);
  }
  // The triangle decides which side is seen.
  if (glm::dot(point.flatNormal, point.view) < 0.0) {
    point.isFront = false;
    point.flatNormal = -point.flatNormal;
    point.normal = -point.normal;
  }
  return point;
}

glm::dvec3 ExactShading::albedo(const scene::Material& material, glm::dvec3 position) const {
  const glm::dvec3 plain(material.albedo);
  const scene::Pattern& pattern = material.pattern;
  if (!setting_.pattern || pattern.kind == scene::Pattern::Kind::None) return plain;
  const double s = patternValue(pattern, (position + anchor_ - pattern.origin) / pattern.size);
  return glm::clamp(plain * (1.0 + pattern.contrast * s), 0.0, 1.0);
}

glm::dvec3 ExactShading::colour(const ExactPoint& point, bool shadow) const {
  const glm::dvec3 reflectance = albedo(material(point.triangle), point.position);
  glm::dvec3 sum = setting_.ambient * reflectance;
  if (scene_.lights.empty()) return sum;
  const glm::dvec3 toLight = scene_.lights[0].centre - anchor_ - point.position;
  if (!(glm::length(toLight) > 0.0)) return sum + setting_.diffuse * reflectance;
  if (shadow && (!(glm::dot(toLight, point.flatNormal) > 0.0) ||
                 tree_.any({point.position, toLight, point.triangle, 1.0})))
    return sum;
  const glm::dvec3 normal = setting_.smoothNormals ? point.normal : point.flatNormal;
  const glm::dvec3 light = glm::normalize(toLight);
  const double cosine = glm::dot(normal, light);
  if (cosine <= 0.0) return sum;
  sum += setting_.diffuse * cosine * reflectance;
  return sum + setting_.specular * exactHighlight(setting_, normal, light, point.view);
}

glm::dvec3 exactMirrored(const ExactPoint& point) {
  const glm::dvec3 about = glm::reflect(-point.view, point.normal);
  return glm::normalize(
      glm::dot(about, point.flatNormal) > 0.0 ? about : glm::reflect(-point.view, point.flatNormal));
}

ExactRefraction exactRefracted(const scene::Material& material, const ExactPoint& point) {
  // Sines: of the way out of this side, and on the other.
  const double index = material.refractiveIndex, quotient = point.isFront ? 1.0 / index : index;
  const double cosine = glm::dot(point.view, point.normal);
  const glm::dvec3 along = cosine * point.normal - point.view;  // in the surface, sine long
  const double sineBehind = quotient * glm::length(along);
  if (sineBehind > 1.0) return {exactMirrored(point), false};
  const glm::dvec3 through = quotient * along - std::sqrt(1.0 - sineBehind * sineBehind) * point.normal;
  return {glm::dot(through, point.flatNormal) < 0.0 ? glm::normalize(through) : -point.view, true};
}

glm::dvec3 exactMirrorShare(const scene::Material& material, const ExactPoint& point) {
  const glm::dvec3 atNormal(material.mirror);
  if (!material.fresnel) return atNormal;
  const double cosine = std::clamp(glm::dot(point.view, point.normal), 0.0, 1.0);
  return atNormal + (glm::dvec3(1.0) - atNormal) * std::pow(1.0 - cosine, 5.0);
}

}  // namespace limen::references
