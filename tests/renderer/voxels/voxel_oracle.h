// SPDX-License-Identifier: BSD-3-Clause
// Attributes of voxels in double precision, voxel by voxel: entries found by clipping or by solving for
// middle lines, shadows by all triangles one after another, lobes by definition. Slow and simple.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/voxels/voxel_grid.h"
#include "renderer/voxels/voxelizer.h"
#include "tests/renderer/voxels/clipped_triangle.h"

namespace limen::voxels {

struct OracleVoxel {
  double entries = 0.0, opacity = 0.0;
  glm::dvec3 albedo{0.0}, normal{0.0}, light{0.0};
  glm::dvec4 grey{0.0};
  std::array<glm::dvec4, 3> colour{};
  double largestOpacity = 0.0;  // of entries
  glm::dvec3 largestAlbedo{0.0};
  bool close = false;  // to a decision that floats may take otherwise
};

class VoxelOracle {
 public:
  VoxelOracle(const scene::Scene& scene, const VoxelGrid& grid, const VoxelLamps& lamps)
      : scene_(scene), grid_(grid), lamps_(lamps) {
    for (const scene::Part& part : scene.parts)
      for (uint32_t i = 0; i < part.triangleCount; ++i) materialOf_.push_back(part.material);
  }

  OracleVoxel at(glm::ivec3 voxel, Coverage coverage, double slack) const {
    OracleVoxel out;
    for (size_t i = 0; i < scene_.mesh.triangles.size(); ++i) {
      const std::array<glm::dvec3, 3> corners = cornersOf(i);
      if (coverage == Coverage::Conservative) {
        const glm::dvec3 plain[3] = {corners[0], corners[1], corners[2]};
        const bool surely = clippedMeets(plain, voxel, -slack);
        if (surely != clippedMeets(plain, voxel, slack)) out.close = true;
        if (surely) enter(out, i, nearest(corners, glm::dvec3(voxel) + 0.5));
        continue;
      }
      const glm::dvec3 size = glm::abs(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      const int facing = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      for (int axis = 0; axis < 3; ++axis)
        if (coverage == Coverage::Thin || axis == facing) enterAlong(out, i, corners, voxel, axis, slack);
    }
    if (out.entries > 0.0) {
      const double share = 1.0 / out.entries;
      out.opacity *= share, out.albedo *= share, out.normal *= share, out.light *= share, out.grey *= share;
      for (glm::dvec4& lobe : out.colour) lobe *= share;
    }
    return out;
  }

 private:
  std::array<glm::dvec3, 3> cornersOf(size_t triangle) const {
    std::array<glm::dvec3, 3> out;
    for (int i = 0; i < 3; ++i)
      out[static_cast<size_t>(i)] = grid_.toVoxels(scene_.mesh.positions[scene_.mesh.triangles[triangle][i]]);
    return out;
  }

  static glm::dvec3 onSegment(glm::dvec3 a, glm::dvec3 b, glm::dvec3 p) {
    const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
    return a + glm::clamp(along, 0.0, 1.0) * (b - a);
  }
  /// Weights of the corners at a point of the triangle's plane.
  static glm::dvec3 weights(const std::array<glm::dvec3, 3>& t, glm::dvec3 p) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double whole = glm::dot(normal, normal);
    return {glm::dot(glm::cross(t[2] - t[1], p - t[1]), normal) / whole,
            glm::dot(glm::cross(t[0] - t[2], p - t[2]), normal) / whole,
            glm::dot(glm::cross(t[1] - t[0], p - t[0]), normal) / whole};
  }
  static glm::dvec3 nearest(const std::array<glm::dvec3, 3>& t, glm::dvec3 p) {
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const glm::dvec3 below = p - glm::dot(p - t[0], normal) * normal, w = weights(t, below);
    if (std::min({w.x, w.y, w.z}) >= 0.0) return below;
    glm::dvec3 best = t[0];
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3 candidate = onSegment(t[i], t[(i + 1) % 3], p);
      if (glm::distance(candidate, p) < glm::distance(best, p)) best = candidate;
    }
    return best;
  }

  void enterAlong(OracleVoxel& out, size_t triangle, const std::array<glm::dvec3, 3>& t, glm::ivec3 voxel,
                  int axis, double slack) const {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const glm::dvec3 middle = glm::dvec3(voxel) + 0.5;
    glm::dvec3 line(0.0);
    line[axis] = 1.0;
    const double slope = glm::dot(normal, line);
    if (std::abs(slope) < 1e-9 * glm::length(normal)) {
      // Along the middle line: whether it meets the triangle is rounding, if it lies in its plane at all.
      if (std::abs(glm::dot(middle - t[0], glm::normalize(normal))) < slack) out.close = true;
      return;
    }
    const glm::dvec3 met = middle + line * (glm::dot(t[0] - middle, normal) / slope);
    const glm::dvec3 w = weights(t, met);
    const double inside = std::min({w.x, w.y, w.z}), off = std::abs(met[axis] - middle[axis]);
    // A weight's distance from 0 in voxels is at least its share of the triangle's smallest height.
    const double height = smallestHeight(t), tilt = std::abs(slope) / glm::length(normal);
    const double blur = slack / (height * tilt);
    if (inside < -blur || off > 0.5 + slack) return;
    if (inside < blur || std::abs(off - 0.5) < slack) {
      out.close = true;
      return;
    }
    enter(out, triangle, met);
  }
  static double smallestHeight(const std::array<glm::dvec3, 3>& t) {
    const double twice = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    return twice /
           std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
  }

  /// Share of light along a segment in voxels; `close`: near a silhouette.
  glm::dvec3 share(glm::dvec3 from, glm::dvec3 to, size_t own, bool& close) const {
    glm::dvec3 out(1.0);
    const glm::dvec3 along = to - from;
    for (size_t i = 0; i < scene_.mesh.triangles.size(); ++i) {
      if (i == own) continue;
      const std::array<glm::dvec3, 3> t = cornersOf(i);
      const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
      const double speed = glm::dot(along, normal);
      if (speed == 0.0) continue;
      const double when = glm::dot(t[0] - from, normal) / speed;
      const glm::dvec3 w = weights(t, from + when * along);
      const double inside = std::min({w.x, w.y, w.z});
      if (inside > -0.01 && when > -0.01 && when < 1.01 &&
          (inside < 0.01 || std::abs(when) < 0.001 || std::abs(when - 1.0) < 0.01))
        close = true;
      if (inside >= 0.0 && when > 0.0 && when <= 1.0)
        out *= glm::dvec3(scene_.materials[materialOf_[i]].transmittance);
    }
    return out;
  }

  void enter(OracleVoxel& out, size_t triangle, glm::dvec3 place) const {
    const scene::Material& material = scene_.materials[materialOf_[triangle]];
    const std::array<glm::dvec3, 3> t = cornersOf(triangle);
    const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    const glm::dvec3 albedo(material.albedo);
    out.entries += 1.0;
    out.opacity +=
        1.0 - (material.transmittance.x + material.transmittance.y + material.transmittance.z) / 3.0;
    out.albedo += albedo;
    out.largestOpacity = std::max(
        out.largestOpacity,
        1.0 - (material.transmittance.x + material.transmittance.y + material.transmittance.z) / 3.0);
    out.largestAlbedo = glm::max(out.largestAlbedo, albedo);
    out.normal += normal;
    leave(out, glm::dvec3(material.emission), normal);
    for (size_t i = 0; i < (lamps_.all ? scene_.lights.size() : 1); ++i) {
      const glm::dvec3 lamp = grid_.toVoxels(scene_.lights[i].centre);
      const double cosine = glm::dot(normal, glm::normalize(lamp - place));
      if (std::abs(cosine) < 1e-3) out.close = true;
      const glm::dvec3 lit = cosine > 0.0 ? normal : -normal;
      const glm::dvec3 arrives =
          lamps_.shadows ? share(place + 0.0078125 * lit, lamp, triangle, out.close) : glm::dvec3(1.0);
      leave(out, lamps_.strength * std::abs(cosine) * albedo * arrives, lit);
    }
  }

  /// Radiance from the side of `normal`. The coefficients of max(0, cos) about n are its integrals with the
  /// harmonics: 2 pi / sqrt(4 pi) times 1/2, and sqrt(3 / 4 pi) n times 2 pi / 3.
  static void leave(OracleVoxel& out, glm::dvec3 radiance, glm::dvec3 normal) {
    const double pi = std::acos(-1.0);
    const double zero = std::sqrt(1.0 / (4.0 * pi)) * pi, one = std::sqrt(3.0 / (4.0 * pi)) * 2.0 * pi / 3.0;
    const glm::dvec4 lobe(zero, one * normal.y, one * normal.z, one * normal.x);
    out.light += radiance;
    out.grey += (0.2126 * radiance.x + 0.7152 * radiance.y + 0.0722 * radiance.z) * lobe;
    for (int c = 0; c < 3; ++c) out.colour[static_cast<size_t>(c)] += radiance[c] * lobe;
  }

  const scene::Scene& scene_;
  const VoxelGrid& grid_;
  VoxelLamps lamps_;
  std::vector<uint32_t> materialOf_;
};

}  // namespace limen::voxels
