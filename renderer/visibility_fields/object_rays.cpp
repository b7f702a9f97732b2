// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/object_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace limen::visibility_fields {

void ObjectRays::ReleaseDevice::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void ObjectRays::ReleaseScene::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

ObjectRays::ObjectRays(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles)
    : device_(rtcNewDevice(nullptr)) {
  if (!device_) throw std::runtime_error("Embree cannot be started");
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  if (!triangles.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* to = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertices.size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size()));
    if (!to || !indices) throw std::runtime_error("Embree has no memory for an object");
    std::copy(vertices.begin(), vertices.end(), to);
    std::copy(triangles.begin(), triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_.get());
}

void ObjectRays::trace(glm::vec3 from, std::span<const glm::vec3> directions, float far,
                       float* distances) const {
  RTCRayHit16 rays;
  alignas(64) std::array<int, kPacketRays> valid{};
  for (size_t i = 0; i < kPacketRays; ++i) {
    const glm::vec3 direction = directions[std::min(i, directions.size() - 1)];
    valid[i] = i < directions.size() ? -1 : 0;
    rays.ray.org_x[i] = from.x, rays.ray.org_y[i] = from.y, rays.ray.org_z[i] = from.z;
    rays.ray.dir_x[i] = direction.x, rays.ray.dir_y[i] = direction.y, rays.ray.dir_z[i] = direction.z;
    rays.ray.tnear[i] = 0.0F, rays.ray.tfar[i] = far, rays.ray.time[i] = 0.0F;
    rays.ray.mask[i] = 0xffffffffU, rays.ray.id[i] = static_cast<unsigned>(i), rays.ray.flags[i] = 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), scene_.get(), &context, &rays);
  for (size_t i = 0; i < directions.size(); ++i)
    distances[i] = rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? -1.0F : rays.ray.tfar[i];
}

}  // namespace limen::visibility_fields
