// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/compute_raster.h"

#include <epoxy/gl.h>

#include <cassert>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

/// Capacity for row bands of large triangles; any more are rasterised on the spot, one invocation each.
constexpr int kQueueCapacity = 1 << 19;
constexpr int64_t kQueueBytes = int64_t{sizeof(RasterQueueHeader)} + int64_t{kQueueCapacity} * 8;
constexpr uint32_t kNoTriangle = 0xffffffffU;
constexpr int kLargeGroups = 4096;
/// That take one listed triangle after another: twice what an NVIDIA H200 runs at once. Only the GPU knows
/// how many there are.
constexpr int64_t kListedInvocations = 2 * 132 * 2048;
/// Invocations that share a triangle whose bounding box has at most `pixels`; larger ones are queued, and
/// cost a group each at least.
struct Sharing {
  int lanes, pixels;
};
constexpr Sharing kShared = {8, 256}, kAlone = {1, 32};

/// Triangles much smaller than a few pixels have nothing to share, and all invocations of one read its
/// vertices: on an NVIDIA H200 8.4 million triangles at 1024 x 768 take 1.9 ms with eight invocations each.
Sharing sharingOf(uint32_t triangles, glm::ivec2 sizePx) {
  return int64_t{kShared.lanes} * triangles <= int64_t{2} * sizePx.x * sizePx.y ? kShared : kAlone;
}

int64_t storageAligned(int64_t bytes) {
  return (bytes + gl::Buffer::kStorageAlignment - 1) / gl::Buffer::kStorageAlignment *
         gl::Buffer::kStorageAlignment;
}

/// What a pass over the triangles gathers.
enum class Gathers { Depths, Ids, Packed };

const gl::Program& program(gl::Context& context, bool large, Gathers gathers,
                           const ComputeRasterSettings& settings, const Sharing& sharing) {
  gl::ShaderDefines defines = {{"QUEUE_CAPACITY", std::to_string(kQueueCapacity) + "u"},
                               {"SMALL_LANES", std::to_string(sharing.lanes)},
                               {"SMALL_PIXELS", std::to_string(sharing.pixels)}};
  if (large) defines["LARGE"] = "1";
  if (gathers == Gathers::Ids) defines["IDS"] = "1";
  if (gathers == Gathers::Packed) defines["PACKED"] = "1";
  if (settings.sharesWith) defines["SHARES"] = "1";
  if (settings.peels) defines["PEEL"] = "1";
  if (settings.listedVertexWords > 0) {
    defines["LISTED"] = "1";
    defines["FEW_LANES"] = std::to_string(kShared.lanes) + "u";
    defines["FEW_PIXELS"] = std::to_string(kShared.pixels);
    defines["POSITION_WORDS"] = std::to_string(settings.listedVertexWords) + "u";
  }
  return context.programs().compute("renderer/frame/compute_raster.comp.glsl", defines);
}

gl::ShaderDefines finishDefines(bool ids, bool packed) {
  gl::ShaderDefines defines;
  if (ids) defines["IDS"] = "1";
  if (packed) defines["PACKED"] = "1";
  return defines;
}

}  // namespace

Raster chosenRaster(Raster raster, const gl::Context& context) {
  if (raster != Raster::Auto) return raster;
  return context.device().software ? Raster::Hardware : Raster::Compute;
}

ComputeRaster::ComputeRaster(gl::Context& context, glm::ivec2 sizePx, const ComputeRasterSettings& settings)
    : sizePx_(sizePx),
      packed_(
          settings.ids &&
          (settings.search == TriangleSearch::Auto ? canPack() : settings.search == TriangleSearch::Packed)),
      smallDepth_{&program(context, false, packed_ ? Gathers::Packed : Gathers::Depths, settings, kShared),
                  &program(context, false, packed_ ? Gathers::Packed : Gathers::Depths, settings, kAlone)},
      largeDepth_(program(context, true, packed_ ? Gathers::Packed : Gathers::Depths, settings, kShared)),
      finish_(context.programs().compute("renderer/frame/compute_raster_finish.comp.glsl",
                                         finishDefines(settings.ids, packed_))),
      requeue_(context.programs().compute("renderer/frame/compute_raster_requeue.comp.glsl")),
      queueAt_(settings.sharesWith ? settings.sharesWith->queueAt_ + storageAligned(kQueueBytes)
                                   : storageAligned(int64_t{packed_ ? 8 : 4} * sizePx.x * sizePx.y)) {
  assert(!settings.sharesWith || (packed_ && settings.sharesWith->packed_ && !settings.textures));
  if (settings.sharesWith) {
    pixels_ = settings.sharesWith->pixels_;
    return;
  }
  // Every frame leaves the buffers cleared for the next; the first needs them cleared too.
  const int queues = packed_ && !settings.textures ? 2 : 1;
  pixels_ = std::make_shared<gl::Buffer>(queueAt_ + queues * storageAligned(kQueueBytes), nullptr);
  pixels_->clearUint(0);
  if (settings.textures) depth_.emplace(gl::Format::R32F, sizePx);
  if (!settings.ids) return;
  if (settings.textures) ids_.emplace(gl::Format::R32UI, sizePx);
  if (packed_) return;
  smallIds_ = {&program(context, false, Gathers::Ids, settings, kShared),
               &program(context, false, Gathers::Ids, settings, kAlone)};
  largeIds_ = &program(context, true, Gathers::Ids, settings, kShared);
  idBits_.emplace(int64_t{4} * sizePx.x * sizePx.y, nullptr);
  idBits_->clearUint(kNoTriangle);
}

bool ComputeRaster::canPack() {
  return epoxy_has_gl_extension("GL_NV_shader_atomic_int64") &&
         epoxy_has_gl_extension("GL_ARB_gpu_shader_int64");
}

int64_t ComputeRaster::bytes() const {
  int64_t bytes = pixels_->bytes();
  for (const auto* texture : {&depth_, &ids_})
    if (*texture) bytes += (*texture)->bytes();
  return bytes + (idBits_ ? idBits_->bytes() : 0);
}

void ComputeRaster::bindGathered(const GatheredBindings& bindings) const {
  pixels_->bindStorage(bindings.depths);
  if (idBits_) idBits_->bindStorage(bindings.ids);
  pixels_->bindStorage(bindings.queue, queueAt_, kQueueBytes);
}

glm::uvec2 ComputeRaster::queuePlaces() const {
  const auto first = static_cast<uint32_t>(queueAt_ / 8);
  return {first, first + static_cast<uint32_t>(storageAligned(kQueueBytes) / 8)};
}

void ComputeRaster::bindTargets() const {
  pixels_->bindStorage(kRasterQueueBuffer, queueAt_, kQueueBytes);
  pixels_->bindStorage(kRasterDepthsBuffer);
}

template <class Action>
void ComputeRaster::forAll(const Action& action) const {
  for (const gl::Program* each :
       {smallDepth_[0], smallDepth_[1], &largeDepth_, smallIds_[0], smallIds_[1], largeIds_})
    if (each) action(*each);
}

void ComputeRaster::setView(const glm::mat4& clip, double near) const {
  forAll([&](const gl::Program& each) {
    each.set("anchorToClip", clip);
    each.set("near", static_cast<float>(near));
    each.set("sizePx", sizePx_);
  });
}

void ComputeRaster::dispatchSmall(const Programs& small, uint32_t triangleCount) const {
  constexpr int64_t kPerRow = kRasterRowInvocations;
  const int lanes = sharingOf(triangleCount, sizePx_).lanes;
  const int64_t invocations = int64_t{lanes} * triangleCount;
  small[lanes == kShared.lanes ? 0 : 1]->dispatch({static_cast<int>(std::min(invocations, kPerRow)),
                                                   static_cast<int>((invocations + kPerRow - 1) / kPerRow)},
                                                  {kRasterGroup, 1});
}

template <class Small>
void ComputeRaster::run(const glm::mat4& clip, double near, const Small& small) const {
  bindTargets();
  setView(clip, near);
  const auto pass = [&](const Programs& programs, const gl::Program& large) {
    small(programs);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    large.dispatch({kLargeGroups, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  pass(smallDepth_, largeDepth_);
  if (idBits_) {
    idBits_->bindStorage(kRasterIdsBuffer);
    requeue_.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    pass(smallIds_, *largeIds_);
  }
  if (depth_) finish();
}

void ComputeRaster::finish() const {
  depth_->bindImage(kRasterDepthImage, gl::Access::Write);
  if (ids_) ids_->bindImage(kRasterIdsImage, gl::Access::Write);
  finish_.set("sizePx", sizePx_);
  finish_.dispatch(sizePx_, {kRasterGroup, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ComputeRaster::setTriangles(const Geometry& geometry, const DepthPeel& peel) const {
  geometry.bindStorage();
  if (geometry.ranges) geometry.ranges->ranges().bindStorage(kRasterRangesBuffer);
  if (peel.previous) peel.previous->bindTexture(kRasterPreviousDepthUnit);
  forAll([&](const gl::Program& each) {
    each.set("peelBias", static_cast<float>(peel.bias));
    each.set("triangleCount", geometry.triangleCount());
    each.set("rangeCount", geometry.ranges ? geometry.ranges->rangeCount() : 0);
  });
}

void ComputeRaster::draw(const Geometry& geometry, const glm::mat4& clip, double near,
                         const DepthPeel& peel) const {
  setTriangles(geometry, peel);
  run(clip, near, [&](const Programs& programs) { dispatchSmall(programs, geometry.triangleCount()); });
}

void ComputeRaster::drawStep(const Geometry& geometry, const glm::mat4& clip, double near, Step step) const {
  assert(packed_ && !depth_);
  setTriangles(geometry, {});
  bindTargets();
  setView(clip, near);
  if (step == Step::Small)
    dispatchSmall(smallDepth_, geometry.triangleCount());
  else
    largeDepth_.dispatch({kLargeGroups, 1}, {1, 1});
}

void ComputeRaster::dispatchListed(const gl::Program& program, const ListedTriangles& triangles) const {
  program.dispatch({static_cast<int>(std::min(kShared.lanes * triangles.most, kListedInvocations)), 1},
                   {kRasterGroup, 1});
}

void ComputeRaster::drawListed(const ListedTriangles& triangles, const glm::mat4& clip, double near) const {
  triangles.vertices.bindStorage(kScenePositionsBuffer);
  triangles.indices.bindStorage(kSceneIndicesBuffer);
  triangles.count.bindStorage(kRasterCountBuffer);
  run(clip, near, [&](const Programs& programs) { dispatchListed(*programs[1], triangles); });
}

void ComputeRaster::drawListedStep(const ListedTriangles& triangles, const glm::mat4& clip, double near,
                                   Step step) const {
  assert(packed_ && !depth_);
  triangles.vertices.bindStorage(kScenePositionsBuffer);
  triangles.indices.bindStorage(kSceneIndicesBuffer);
  triangles.count.bindStorage(kRasterCountBuffer);
  bindTargets();
  setView(clip, near);
  if (step == Step::Small)
    dispatchListed(*smallDepth_[1], triangles);
  else
    largeDepth_.dispatch({kLargeGroups, 1}, {1, 1});
}

}  // namespace limen::frame
