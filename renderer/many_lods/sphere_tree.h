// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/surface_sampling.h"

namespace limen::many_lods {

/// Directions within `halfAngle` [rad] of the unit vector `axis`; all directions from pi on.
struct NormalCone {
  glm::dvec3 axis{0.0, 0.0, 1.0};
  double halfAngle = 0.0;
};
/// The smallest cone around two cones: as for spheres, on the sphere of directions.
NormalCone merged(const NormalCone& a, const NormalCone& b);

/// A cone in 8 bytes: the axis folded to an octahedron, 16 bits each, and the half-angle in pi / 65535,
/// rounded up together with what the axis lost.
struct PackedCone {
  uint32_t axis = 0, halfAngle = 0;
};
PackedCone pack(const NormalCone& cone);
NormalCone unpack(PackedCone cone);

/// Around two spheres (xyz centre, w radius): in floats as stored, and larger by kSphereSlack, so that it
/// contains them after all rounding with enough to spare for cuts to be exact. `update_tree.comp.glsl` is its
/// twin.
glm::vec4 mergedSphere(glm::vec4 a, glm::vec4 b);

struct TreeBuildSettings {
  int depth = 16;          ///< 2^depth points
  double leafScale = 1.5;  ///< radius of leaves: 1 is a disc of the area that a point stands for
  uint64_t seed = 1;
};

/// A complete binary tree over points of a scene's surface, in an array: node 1 is the root, node i has the
/// children 2 i and 2 i + 1, leaf j is node 2^depth + j. Each run of points is split at the median along the
/// axis for which the bounding spheres of the halves' boxes have the least volume in sum. Source: Holländer
/// 2013, section 3.4.1.
struct SphereTree {
  int depth = 0;
  std::vector<SurfaceSample> samples;  ///< of the leaves, in order
  std::vector<glm::vec4> spheres;      ///< 2^(depth + 1), [0] unused; relative to the anchor
  std::vector<PackedCone> cones;       ///< of the nodes' normals
  /// Of a tree that is not complete (buildUnbalancedTree()): its nodes' links, empty else, with `samples` in
  /// the places of the leaves' nodes, and the first node of each level, then the number of nodes' places.
  std::vector<TreeLink> links;
  std::vector<uint32_t> levelFirst;
  float leafRadius = 0.0F;  ///< world units
  double area = 0.0;        ///< of the surface

  uint32_t leafCount() const { return 1U << depth; }
  /// Edges from the root to the farthest leaf.
  int height() const { return links.empty() ? depth : static_cast<int>(links[kRootNode].height); }
};

/// Runs on all cores; the result does not depend on their number. Positions are world units, the tree is
/// relative to `anchor`. Throws Error if there is no surface.
SphereTree buildSphereTree(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
                           glm::dvec3 anchor, const TreeBuildSettings& settings);

/// Spheres and cones of the inner nodes from those of the leaves; heights of linked ones.
void mergeUpwards(SphereTree& tree);

/// For those that build trees: radius of leaves, room for all nodes; a leaf at a point, relative to the
/// anchor.
void prepareLeaves(SphereTree& tree, const std::vector<glm::dvec3>& positions,
                   const std::vector<glm::uvec3>& triangles, double leafScale);
void setLeaf(SphereTree& tree, uint32_t node, glm::dvec3 point, uint32_t triangle,
             const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles);

}  // namespace limen::many_lods
