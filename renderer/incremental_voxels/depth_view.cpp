// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/depth_view.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "renderer/frame/g_buffer.h"
#include "renderer/incremental_voxels/incremental_bindings.h"

namespace limen::incremental_voxels {
namespace {

constexpr double kMostTangent = 3.7320508075688772;  // 75 degrees
constexpr double kNearShare = 1e-3;                  // of the farthest corner

std::vector<glm::dvec3> cornersOf(const scene::Bounds& box) {
  std::vector<glm::dvec3> out;
  for (int i = 0; i < 8; ++i)
    out.emplace_back(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                     i & 4 ? box.high.z : box.low.z);
  return out;
}

struct ViewNames {
  const char *fromVoxels, *toVoxels, *low, *extent, *sizePx, *near;
};
constexpr ViewNames kViewNames[kMostDepthViews] = {
    {"viewFromVoxels[0]", "voxelsFromView[0]", "viewLow[0]", "viewExtent[0]", "viewSizePx[0]", "viewNear[0]"},
    {"viewFromVoxels[1]", "voxelsFromView[1]", "viewLow[1]", "viewExtent[1]", "viewSizePx[1]",
     "viewNear[1]"}};

}  // namespace

DepthView cameraView(frame::Frame& frame) {
  const auto& ids = frame.get<frame::TriangleIds>();
  const double tangent = frame.tanHalfFov();
  DepthView view;
  view.fromAnchor = glm::scale(glm::dmat4(1.0), {1.0, -1.0, -1.0}) * frame.anchorToCamera();
  view.high = {tangent * frame.aspect(), tangent};
  view.low = -view.high;
  view.near = frame::nearPlane(frame);
  view.sizePx = frame.sizePx();
  view.depth = &ids.depth();
  view.triangles = &ids.texture();
  return view;
}

frame::LightFrustum fitted(const scene::AreaLight& light, const scene::Bounds& box) {
  frame::LightFrustum frustum;
  const glm::dmat4 toLight = light.toLightSpace();
  std::vector<glm::dvec3> corners = cornersOf(box);
  double farthest = 0.0;
  for (glm::dvec3& corner : corners) {
    corner = glm::dvec3(toLight * glm::dvec4(corner, 1.0));
    farthest = std::max(farthest, corner.z);
  }
  frustum.near = kNearShare * (farthest > 0.0 ? farthest : 1.0);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& corner : corners) {
    // What lies beside the light may be in any direction.
    const bool before = corner.z > frustum.near;
    const glm::dvec2 tangent =
        before ? glm::dvec2(corner) / corner.z : glm::sign(glm::dvec2(corner)) * kMostTangent;
    low = glm::min(low, tangent), high = glm::max(high, tangent);
  }
  frustum.low = glm::clamp(low, -kMostTangent, kMostTangent - 1e-3);
  frustum.high = glm::max(glm::clamp(high, -kMostTangent + 1e-3, kMostTangent), frustum.low + 1e-3);
  return frustum;
}

LightMap::LightMap(gl::Context& context, int resolution, frame::Raster raster)
    : resolution_(resolution), raster_(context, resolution, raster, frame::ShadowRaster::Extra::Ids) {}

void LightMap::draw(frame::Frame& frame, const scene::Bounds& box) {
  const scene::AreaLight& light = frame.scene().lights.at(0);
  const frame::LightFrustum frustum = fitted(light, box);
  view_.fromAnchor = light.toLightSpace(frame.gpuScene().anchor());
  view_.low = frustum.low, view_.high = frustum.high;
  view_.near = frustum.near;
  view_.sizePx = glm::ivec2(resolution_);
  view_.depth = &raster_.depth();
  view_.triangles = &raster_.ids();
  raster_.draw(frame, frame.geometry(), frustum);
}

void configureViews(const gl::Program& program, const std::vector<DepthView>& views,
                    const voxels::VoxelGrid& grid, glm::dvec3 anchor) {
  const glm::dmat4 fromVoxels =
      glm::scale(glm::translate(glm::dmat4(1.0), grid.origin - anchor), glm::dvec3(grid.voxelSize));
  for (size_t i = 0; i < views.size(); ++i) {
    const DepthView& view = views[i];
    const ViewNames& names = kViewNames[i];
    const glm::dmat4 viewFromVoxels = view.fromAnchor * fromVoxels;
    program.set(names.fromVoxels, glm::mat4(viewFromVoxels));
    program.set(names.toVoxels, glm::mat4(glm::inverse(viewFromVoxels)));
    program.set(names.low, glm::vec2(view.low));
    program.set(names.extent, glm::vec2(view.high - view.low));
    program.set(names.sizePx, view.sizePx);
    program.set(names.near, static_cast<float>(view.near));
    view.depth->bindTexture(kViewDepthsUnit + static_cast<uint32_t>(i));
    view.triangles->bindTexture(kViewTrianglesUnit + static_cast<uint32_t>(i));
  }
}

}  // namespace limen::incremental_voxels
