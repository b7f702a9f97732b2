// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/cpu_field.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <thread>

#include "renderer/visibility_fields/map_functions.h"

namespace limen::visibility_fields {
namespace {

constexpr size_t kPacketRays = 16;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// An object as Embree has it.
class ObjectRays {
 public:
  explicit ObjectRays(const RigidObject& object) : device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::runtime_error("Embree cannot be started");
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), object.vertices.size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), object.triangles.size()));
    if (!vertices || !indices) throw std::runtime_error("Embree has no memory for an object");
    std::copy(object.vertices.begin(), object.vertices.end(), vertices);
    std::copy(object.triangles.begin(), object.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
  }

  /// Distances along `count` unit directions, at most a packet; -1: none.
  void trace(glm::vec3 from, const glm::vec3* directions, size_t count, float* distances) const {
    RTCRayHit16 rays;
    alignas(64) std::array<int, kPacketRays> valid{};
    for (size_t i = 0; i < kPacketRays; ++i) {
      const glm::vec3 direction = directions[std::min(i, count - 1)];
      valid[i] = i < count ? -1 : 0;
      rays.ray.org_x[i] = from.x, rays.ray.org_y[i] = from.y, rays.ray.org_z[i] = from.z;
      rays.ray.dir_x[i] = direction.x, rays.ray.dir_y[i] = direction.y, rays.ray.dir_z[i] = direction.z;
      rays.ray.tnear[i] = 0.0F, rays.ray.tfar[i] = 3.0F, rays.ray.time[i] = 0.0F;
      rays.ray.mask[i] = 0xffffffffU, rays.ray.id[i] = static_cast<unsigned>(i), rays.ray.flags[i] = 0;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene_.get(), &context, &rays);
    for (size_t i = 0; i < count; ++i)
      distances[i] = rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? -1.0F : rays.ray.tfar[i];
  }

 private:
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene_;
};

void traceMap(const ObjectRays& rays, const FieldForm& form, glm::vec3 position, float* shares) {
  const glm::vec3 z = -position, x = fieldTangent(z), y = fieldBitangent(z);
  const int side = form.directions, code = static_cast<int>(form.directionMap);
  std::array<glm::vec3, kPacketRays> directions;
  std::array<float*, kPacketRays> targets;
  std::array<float, kPacketRays> distances{};
  size_t filled = 0;
  const auto flush = [&] {
    if (filled == 0) return;
    rays.trace(position, directions.data(), filled, distances.data());
    for (size_t i = 0; i < filled; ++i) *targets[i] = distances[i] < 0.0F ? -1.0F : 0.5F * distances[i];
    filled = 0;
  };
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      float* const share = shares + (row * side + column);
      *share = -1.0F;
      if (!fieldTexelUsed({column, row}, side, code)) continue;
      const glm::vec3 local = fieldDirection((glm::vec2(column, row) + 0.5F) / float(side), code);
      directions[filled] = local.x * x + local.y * y + local.z * z;
      targets[filled] = share;
      if (++filled == kPacketRays) flush();
    }
  flush();
}

}  // namespace

std::vector<float> traceFieldOnCpu(const RigidObject& object, const FieldForm& form) {
  const ObjectRays rays(object);
  const std::vector<glm::vec3> positions = PositionMap(form.positionMap, form.positions).points();
  const size_t perMap = static_cast<size_t>(form.directions) * static_cast<size_t>(form.directions);
  std::vector<float> shares(positions.size() * perMap);
  const size_t threads = std::max(std::thread::hardware_concurrency(), 1U);
  const auto work = [&](size_t thread) {
    for (size_t i = thread; i < positions.size(); i += threads)
      traceMap(rays, form, positions[i], shares.data() + i * perMap);
  };
  std::vector<std::jthread> helpers;
  for (size_t thread = 1; thread < threads; ++thread) helpers.emplace_back(work, thread);
  work(0);
  helpers.clear();
  return shares;
}

}  // namespace limen::visibility_fields
