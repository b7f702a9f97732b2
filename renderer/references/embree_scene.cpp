// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/embree_scene.h"

#include <stdexcept>
#include <string>

namespace limen::references {
namespace {

/// Hits nearer than this many plane tolerances are tested again in double precision. An origin rounded to
/// float can turn a miss into a hit as far away as the rounding (less than a tolerance) over the sine of the
/// angle between ray and surface; 32768 covers angles down to 3e-5, and is still less than a hundredth of the
/// scene.
constexpr double kNearTolerances = 32768.0;

struct ShadowQuery {
  RTCIntersectContext context;  // first: Embree hands it back
  const Triangles* triangles = nullptr;
  const ReceiverPoint* from = nullptr;
  glm::dvec3 direction;
  double nearLimit = 0.0;  // in units of `direction`
};

/// Signs of the volumes that the ray spans with each edge: all alike if it passes through the triangle.
bool crosses(glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const double u = glm::dot(direction, glm::cross(a, b)), v = glm::dot(direction, glm::cross(b, c)),
               w = glm::dot(direction, glm::cross(c, a));
  return (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
}

void filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const ShadowQuery*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const uint32_t triangle = reinterpret_cast<const RTCHit*>(arguments->hit)->primID;
  const ReceiverPoint& from = *query.from;
  const glm::dvec3 a = query.triangles->corner(triangle, 0) - from.position;
  const glm::dvec3 b = query.triangles->corner(triangle, 1) - from.position;
  const glm::dvec3 c = query.triangles->corner(triangle, 2) - from.position;
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double toPlane = glm::dot(n, a), tolerance = query.triangles->planeTolerance();
  const double advance = glm::dot(n, query.direction);
  bool counts = triangle != from.triangle && toPlane * toPlane > tolerance * tolerance * glm::dot(n, n);
  if (counts && double(ray->tfar) < query.nearLimit)
    counts = toPlane * advance > 0.0 && crosses(query.direction, a, b, c);
  if (!counts) arguments->valid[0] = 0;
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
  ShadowQuery query;
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  query.triangles = &triangles_;
  query.from = &from;
  query.direction = light - from.position;
  query.nearLimit = kNearTolerances * triangles_.planeTolerance() / glm::length(query.direction);
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.position.x);
  ray.org_y = static_cast<float>(from.position.y);
  ray.org_z = static_cast<float>(from.position.z);
  ray.dir_x = static_cast<float>(query.direction.x);
  ray.dir_y = static_cast<float>(query.direction.y);
  ray.dir_z = static_cast<float>(query.direction.z);
  ray.tnear = 0.0F;
  // Depth along the light's direction shrinks from p_z to 0 in step with t, so this is the margin in z.
  ray.tfar = static_cast<float>(1.0 - kLightMargin);
  ray.mask = 0xffffffffU;
  rtcOccluded1(scene_, &query.context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace limen::references
