// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/ray_forest.h"

#include <chrono>

#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/tree_upload.h"
#include "renderer/ray_tracing/wide_bvh.h"

namespace limen::ray_tracing {

struct RayForest::Joined {
  std::vector<WideNode> nodes;
  std::vector<LeafTriangle> triangles;
  std::vector<uint32_t> roots;
  double buildS = 0.0;
};

RayForest::Joined RayForest::join(const std::vector<TreeTriangles>& objects) {
  const auto start = std::chrono::steady_clock::now();
  Joined out;
  for (const TreeTriangles& object : objects) {
    const WideBvh tree({object.vertices.begin(), object.vertices.end()},
                       {object.triangles.begin(), object.triangles.end()});
    const auto firstNode = static_cast<uint32_t>(out.nodes.size()),
               firstTriangle = static_cast<uint32_t>(out.triangles.size());
    out.roots.push_back(tree.nodes().empty() ? kRayNoRoot : firstNode);
    for (WideNode node : tree.nodes()) {
      node.firstNode += firstNode, node.firstTriangle += firstTriangle;
      out.nodes.push_back(node);
    }
    for (LeafTriangle triangle : tree.triangles()) {
      triangle.triangle = object.numbers[triangle.triangle];
      out.triangles.push_back(triangle);
    }
  }
  out.buildS = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

RayForest::RayForest(gl::Context& context, const Joined& joined)
    : mostIterations_(mostRayIterations(context)),
      buildS_(joined.buildS),
      roots_(joined.roots),
      nodeCount_(static_cast<uint32_t>(joined.nodes.size())),
      nodes_(uploadTree(joined.nodes)),
      triangles_(uploadTree(joined.triangles)) {}

RayForest::RayForest(gl::Context& context, const std::vector<TreeTriangles>& objects)
    : RayForest(context, join(objects)) {}

void RayForest::bind(const gl::Program& program) const {
  nodes_.bindStorage(kRayNodesBuffer);
  triangles_.bindStorage(kRayTrianglesBuffer);
  program.set("rayNodeCount", nodeCount_);
  program.set("maxRayIterations", mostIterations_);
}

}  // namespace limen::ray_tracing
