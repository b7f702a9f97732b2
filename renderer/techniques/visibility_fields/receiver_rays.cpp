// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/receiver_rays.h"

#include <cmath>
#include <string>
#include <vector>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/visibility_fields/field_bindings.h"

namespace limen::techniques {
namespace vf = visibility_fields;
namespace {

const frame::GBufferChannel& channelOf(frame::Frame& frame, frame::Channel channel) {
  return frame.get<frame::GBufferChannel>(frame::ChannelSetting{channel});
}

}  // namespace

void checkObjectCount(const std::vector<vf::RigidObject>& objects, const char* mend) {
  if (objects.size() > vf::kMostFieldObjects)
    throw Error("the scene has " + std::to_string(objects.size()) +
                    " objects or pieces of objects; at most " + std::to_string(vf::kMostFieldObjects) +
                    " can have visibility fields",
                "objects", mend);
}

vf::RigidObjects objectsOf(const frame::Frame& frame, const vf::ObjectSetting& setting) {
  vf::RigidObjects objects = vf::rigidObjectsOf(frame.scene(), setting);
  checkObjectCount(objects.objects, "use 'auto' or 'parts', or a smaller scene");
  return objects;
}

const SettingsTable<ReceiverRays>& ReceiverRays::table() {
  using S = ReceiverRays;
  static const SettingsTable<S> kTable = {
      {&S::rays, "rays", {1, 1024}, "rays", "Rays per pixel, a square number", "Gaitatzes 2012, section 4.7"},
      {&S::pattern, "pattern", "Where the rays of a pixel lie in their cells", "bench"},
      {&S::selfOcclusion, "self_occlusion", "Objects block their own rays, and not only those of others",
       "Gaitatzes 2012, section 4.4.2"},
      objectsBinding(&S::objects)};
  return kTable;
}

int ReceiverRays::side() const { return static_cast<int>(std::lround(std::sqrt(double(rays)))); }

void ReceiverRays::check() const {
  if (int64_t{side()} * side() != rays)
    throw Error("'rays' is " + std::to_string(rays) + ", not a square number", "rays",
                "give " + std::to_string(side() * side()));
}

int ReceiverRays::interleave() const {
  const auto* interleaved = std::get_if<InterleavedPattern>(&pattern);
  return interleaved ? interleaved->side : 1;
}

void ReceiverRays::makeInputs(frame::Frame& frame) {
  channelOf(frame, frame::Channel::Position);
  channelOf(frame, frame::Channel::Normal);
  frame.get<frame::TriangleIds>();
}

void ReceiverRays::configure(const gl::Program& program, frame::Frame& frame) const {
  channelOf(frame, frame::Channel::Position).texture().bindTexture(kFieldPositionUnit);
  channelOf(frame, frame::Channel::Normal).texture().bindTexture(kFieldNormalUnit);
  frame.get<frame::TriangleIds>().texture().bindTexture(kFieldIdsUnit);
  program.set("sizePx", frame.sizePx());
  program.set("raySide", side());
  const auto* turned = std::get_if<TurnedPattern>(&pattern);
  program.set("turned", turned ? 1 : 0);
  program.set("seed", turned ? static_cast<uint32_t>(turned->seed) : 0U);
  program.set("interleave", interleave());
  program.set("selfOcclusion", selfOcclusion ? 1 : 0);
  program.set("eyePosition", glm::vec3(frame.camera().eye - frame.gpuScene().anchor()));
}

const SettingsTable<SamePattern>& SamePattern::table() {
  static const SettingsTable<SamePattern> kTable = {};
  return kTable;
}

const SettingsTable<TurnedPattern>& TurnedPattern::table() {
  static const SettingsTable<TurnedPattern> kTable = {
      {&TurnedPattern::seed, "seed", {0, 1000000}, "", "Seed of the choice"}};
  return kTable;
}

const SettingsTable<InterleavedPattern>& InterleavedPattern::table() {
  using S = InterleavedPattern;
  static const SettingsTable<S> kTable = {
      {&S::side,
       "side",
       {2, 8},
       "px",
       "Side of the tiles of pixels that share a grid of rays that is finer by as much",
       "Keller and Heidrich 2001 (bench)"},
      {&S::filter, "filter", "What is made of interleaved pixels", "bench"}};
  return kTable;
}

const SettingsTable<NoFilter>& NoFilter::table() {
  static const SettingsTable<NoFilter> kTable = {};
  return kTable;
}

const SettingsTable<BilateralFilter>& BilateralFilter::table() {
  static const SettingsTable<BilateralFilter> kTable = {
      {&BilateralFilter::angleDeg,
       "angle_deg",
       {0.1, 90.0},
       "deg",
       "Angle between normals, or between a surface and the way to another pixel's point, at which that "
       "counts no more"}};
  return kTable;
}

}  // namespace limen::techniques
