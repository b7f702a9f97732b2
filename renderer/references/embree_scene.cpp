// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/embree_scene.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace limen::references {
namespace {

/// Depth along the light's direction shrinks from p_z to 0 in step with t, so this is the margin in z.
constexpr auto kFarEnd = static_cast<float>(1.0 - kLightMargin);

/// Rays from one receiver. Of ray i, by its id, directions[i] is the exact direction and nearLimits[i] the
/// distance up to which hits are tested again, in its units.
struct ShadowQuery {
  RTCIntersectContext context;  // first: Embree hands it back
  const Triangles* triangles = nullptr;
  const ReceiverPoint* from = nullptr;
  std::array<glm::dvec3, EmbreeScene::kPacket> directions;
  std::array<double, EmbreeScene::kPacket> nearLimits;

  ShadowQuery(const Triangles& of, const ReceiverPoint& point) : triangles(&of), from(&point) {
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void set(size_t ray, glm::dvec3 light) {
    directions[ray] = light - from->position;
    nearLimits[ray] = kNearTolerances * triangles->planeTolerance() / glm::length(directions[ray]);
  }
};

/// Signs of the volumes that the ray spans with each edge: all alike if it passes through the triangle.
bool crosses(glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const double u = glm::dot(direction, glm::cross(a, b)), v = glm::dot(direction, glm::cross(b, c)),
               w = glm::dot(direction, glm::cross(c, a));
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

bool counts(const ShadowQuery& query, uint32_t triangle, uint32_t ray, double t) {
  const ReceiverPoint& from = *query.from;
  if (triangle == from.triangle) return false;
  const glm::dvec3 a = query.triangles->corner(triangle, 0) - from.position;
  const glm::dvec3 b = query.triangles->corner(triangle, 1) - from.position;
  const glm::dvec3 c = query.triangles->corner(triangle, 2) - from.position;
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double toPlane = glm::dot(n, a), tolerance = query.triangles->planeTolerance();
  if (!(toPlane * toPlane > tolerance * tolerance * glm::dot(n, n))) return false;
  if (!(t < query.nearLimits[ray])) return true;
  const glm::dvec3 direction = query.directions[ray];
  return toPlane * glm::dot(n, direction) > 0.0 && crosses(direction, a, b, c);
}

void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const ShadowQuery*>(arguments->context);
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i)
    if (arguments->valid[i] != 0 &&
        !counts(query, RTCHitN_primID(arguments->hit, n, i), RTCRayN_id(arguments->ray, n, i),
                RTCRayN_tfar(arguments->ray, n, i)))
      arguments->valid[i] = 0;
}

[[noreturn]] void fail(RTCDevice device) {
  throw std::runtime_error("Embree reports error " + std::to_string(rtcGetDeviceError(device)));
}

}  // namespace

EmbreeScene::EmbreeScene(const Triangles& triangles) : triangles_(triangles) {
  device_ = rtcNewDevice(nullptr);
  if (!device_) fail(nullptr);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
  if (triangles.count() > 0) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Buffers of Embree's own: it reads up to 16 bytes past a shared one.
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                     RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                                                     triangles.vertices().size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.count()));
    if (!vertices || !indices) fail(device_);
    std::copy(triangles.vertices().begin(), triangles.vertices().end(), vertices);
    std::copy(triangles.indices().begin(), triangles.indices().end(), indices);
    rtcSetGeometryOccludedFilterFunction(geometry, &filter);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene_);
  if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot build the scene: error " + std::to_string(error));
}

EmbreeScene::~EmbreeScene() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

bool EmbreeScene::occluded(const ReceiverPoint& from, glm::dvec3 light) const {
  ShadowQuery query(triangles_, from);
  query.set(0, light);
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.position.x);
  ray.org_y = static_cast<float>(from.position.y);
  ray.org_z = static_cast<float>(from.position.z);
  ray.dir_x = static_cast<float>(query.directions[0].x);
  ray.dir_y = static_cast<float>(query.directions[0].y);
  ray.dir_z = static_cast<float>(query.directions[0].z);
  ray.tnear = 0.0F;
  ray.tfar = kFarEnd;
  ray.mask = 0xffffffffU;
  rtcOccluded1(scene_, &query.context, &ray);
  return ray.tfar < 0.0F;
}

uint32_t EmbreeScene::countOccluded(const ReceiverPoint& from, std::span<const glm::dvec3> lights) const {
  ShadowQuery query(triangles_, from);
  RTCRay16 rays;
  alignas(64) std::array<int, kPacket> valid{};
  if (lights.empty()) return 0;
  for (size_t i = 0; i < kPacket; ++i) {
    const size_t of = std::min(i, lights.size() - 1);
    valid[i] = i < lights.size() ? -1 : 0;
    query.set(i, lights[of]);
    rays.org_x[i] = static_cast<float>(from.position.x);
    rays.org_y[i] = static_cast<float>(from.position.y);
    rays.org_z[i] = static_cast<float>(from.position.z);
    rays.dir_x[i] = static_cast<float>(query.directions[i].x);
    rays.dir_y[i] = static_cast<float>(query.directions[i].y);
    rays.dir_z[i] = static_cast<float>(query.directions[i].z);
    rays.tnear[i] = 0.0F;
    rays.tfar[i] = kFarEnd;
    rays.time[i] = 0.0F;
    rays.mask[i] = 0xffffffffU;
    rays.id[i] = static_cast<unsigned>(i);
    rays.flags[i] = 0;
  }
  rtcOccluded16(valid.data(), scene_, &query.context, &rays);
  uint32_t occluded = 0;
  for (size_t i = 0; i < lights.size(); ++i) occluded += rays.tfar[i] < 0.0F;
  return occluded;
}

}  // namespace limen::references
