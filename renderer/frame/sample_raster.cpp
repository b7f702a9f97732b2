// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/sample_raster.h"

#include <epoxy/gl.h>

#include <cmath>
#include <stdexcept>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"

namespace limen::frame {
namespace {

/// As for ComputeRaster: row bands of large triangles.
constexpr int kSampleQueueCapacity = 1 << 19;
constexpr int kSampleLargeGroups = 4096;
/// Invocations that share a triangle of few pixels, and how many these are in its bounding box: each pixel
/// waits for what is known of it.
constexpr int kSmallLanes = 4, kSmallPixels = 32;

const gl::Program& sampleProgram(Frame& frame, const std::string& name, size_t samples,
                                 const gl::ShaderDefines& more = {}) {
  gl::ShaderDefines defines = {{"SAMPLES", std::to_string(samples)},
                               {"QUEUE_CAPACITY", std::to_string(kSampleQueueCapacity) + "u"},
                               {"SMALL_LANES", std::to_string(kSmallLanes)},
                               {"SMALL_PIXELS", std::to_string(kSmallPixels)}};
  defines.insert(more.begin(), more.end());
  return frame.context().programs().compute("renderer/frame/" + name, defines);
}

gl::ShaderDefines searchDefines(SampleSearch search, bool small) {
  if (search == SampleSearch::Triangles) return {};
  return small ? gl::ShaderDefines{{"MARKED", "1"}, {"KEPT", "1"}} : gl::ShaderDefines{{"MARKED", "1"}};
}

gl::ShaderDefines with(gl::ShaderDefines defines, const gl::ShaderDefines& more) {
  defines.insert(more.begin(), more.end());
  return defines;
}

void dispatchOverTriangles(const gl::Program& program, int64_t invocations) {
  constexpr int64_t kPerRow = kRasterRowInvocations;  // a dispatch has at most 65,535 groups per dimension
  program.dispatch({static_cast<int>(std::min(invocations, kPerRow)),
                    static_cast<int>((invocations + kPerRow - 1) / kPerRow)},
                   {kRasterGroup, 1});
}

}  // namespace

std::vector<glm::vec2> standardSamplePlaces(int samples) {
  // In sixteenths of a pixel from its centre.
  std::vector<glm::vec2> places;
  switch (samples) {
    case 2:
      places = {{4, 4}, {-4, -4}};
      break;
    case 4:
      places = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
      break;
    case 8:
      places = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
      break;
    default:
      throw std::logic_error("no standard pattern of this many samples");
  }
  for (glm::vec2& place : places) place = 0.5F + place / 16.0F;
  return places;
}

SampleRaster::SampleRaster(Frame& frame, std::vector<glm::vec2> places, SampleSearch search,
                           const SameSurface& surface)
    : places_(std::move(places)),
      clear_(sampleProgram(frame, "sample_finish.comp.glsl", places_.size(), {{"CLEAR", "1"}})),
      empty_(sampleProgram(frame, "sample_list_groups.comp.glsl", 1, {{"EMPTY", "1"}})),
      reachOf_(sampleProgram(frame, "sample_reach.comp.glsl", places_.size())),
      smallDepth_(
          sampleProgram(frame, "compute_raster.comp.glsl", places_.size(), searchDefines(search, true))),
      largeDepth_(sampleProgram(frame, "compute_raster.comp.glsl", places_.size(),
                                with(searchDefines(search, false), {{"LARGE", "1"}}))),
      groups_(sampleProgram(frame, "sample_list_groups.comp.glsl", 1)),
      smallIds_(sampleProgram(frame, "compute_raster.comp.glsl", places_.size(),
                              with(searchDefines(search, true), {{"IDS", "1"}}))),
      largeIds_(sampleProgram(frame, "compute_raster.comp.glsl", places_.size(),
                              with(searchDefines(search, false), {{"IDS", "1"}, {"LARGE", "1"}}))),
      finish_(sampleProgram(frame, "sample_finish.comp.glsl", places_.size())),
      reach_(gl::Format::R32F, frame.sizePx()),
      marks_(gl::Format::R32UI, frame.sizePx()),
      queue_(int64_t{sizeof(RasterQueueHeader)} + int64_t{kSampleQueueCapacity} * 8, nullptr),
      list_(int64_t{sizeof(SampleListHeader)} + int64_t{4} * frame.sizePx().x * frame.sizePx().y, nullptr),
      depths_(int64_t{4} * frame.sizePx().x * frame.sizePx().y * static_cast<int64_t>(places_.size()),
              nullptr),
      ids_(depths_.bytes(), nullptr) {
  // Every frame begins by clearing what the one before listed.
  queue_.clearUint(0);
  list_.clearUint(0);
  depths_.clearUint(0);
  ids_.clearUint(TriangleIds::kNone);
  marks_.clearUint(glm::uvec4(0));
  if (search == SampleSearch::Triangles) return;
  const gl::ShaderDefines keeping = {{"MARKED", "1"}, {"KEEP", "1"}};
  neighbours_.emplace(
      Neighbours{surface, sampleProgram(frame, "sample_marks.comp.glsl", places_.size()),
                 sampleProgram(frame, "sample_kept_groups.comp.glsl", places_.size(), {{"EMPTY", "1"}}),
                 sampleProgram(frame, "compute_raster.comp.glsl", places_.size(), keeping),
                 sampleProgram(frame, "sample_kept_groups.comp.glsl", places_.size()),
                 gl::Texture(gl::Format::R32UI, (frame.sizePx() + kGroupSide - 1) / kGroupSide),
                 gl::Buffer(int64_t{sizeof(SampleListHeader)} + int64_t{4} * frame.gpuScene().triangleCount(),
                            nullptr)});
}

int64_t SampleRaster::bytes() const {
  return reach_.bytes() + marks_.bytes() + queue_.bytes() + list_.bytes() + depths_.bytes() + ids_.bytes() +
         (neighbours_ ? neighbours_->tiles.bytes() + neighbours_->kept.bytes() : 0);
}

void SampleRaster::overTriangles(Frame& frame, const gl::Program& small, const gl::Program& large) const {
  if (neighbours_) {
    small.use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, neighbours_->kept.id());
    glDispatchComputeIndirect(static_cast<GLintptr>(offsetof(SampleListHeader, groupsX)));
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  } else {
    dispatchOverTriangles(small, int64_t{kSmallLanes} * frame.geometry().triangleCount());
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  large.dispatch({kSampleLargeGroups, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void SampleRaster::listByTriangles(Frame& frame) const {
  reachOf_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
  overTriangles(frame, smallDepth_, largeDepth_);
  groups_.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void SampleRaster::listByNeighbours(Frame& frame) const {
  const Neighbours& with = *neighbours_;
  setMarkUniforms(with.mark, frame, places_, with.surface);
  with.tiles.bindImage(kSampleRasterTilesImage, gl::Access::Write);
  with.mark.dispatch(frame.sizePx());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
  groups_.dispatch({1, 1}, {1, 1});
  with.tiles.bindTexture(kSampleRasterTilesUnit);
  with.kept.bindStorage(kSampleRasterKeptBuffer);
  with.empty.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  dispatchOverTriangles(with.keep, frame.geometry().triangleCount());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  with.groups.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  ids_.bindStorage(kRasterIdsBuffer);
  with.kept.bindStorage(kSampleRasterKeptTrianglesBuffer);
  overTriangles(frame, smallDepth_, largeDepth_);
}

void setMarkUniforms(const gl::Program& program, const Frame& frame, const std::vector<glm::vec2>& places,
                     const SameSurface& surface) {
  const glm::dmat4& toCamera = frame.anchorToCamera();
  const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
  program.set("anchorToClip", anchorToClip(frame));
  program.set("near", static_cast<float>(nearPlane(frame)));
  program.set("sizePx", frame.sizePx());
  for (size_t i = 0; i < places.size(); ++i)
    program.set(("samplePlaces[" + std::to_string(i) + "]").c_str(), places[i]);
  program.set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
  program.set("anchorToCamera", glm::mat4(toCamera));
  program.set("cameraToLight", glm::mat4(toLight * glm::inverse(toCamera)));
  program.set("tolerance", static_cast<float>(surface.tolerance));
  program.set("cosine", static_cast<float>(std::cos(glm::radians(surface.angleDeg))));
}

void dispatchOverSampleList(const gl::Program& program, const gl::Buffer& list) {
  list.bindStorage(kSampleRasterListBuffer);
  program.use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list.id());
  glDispatchComputeIndirect(static_cast<GLintptr>(offsetof(SampleListHeader, groupsX)));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void SampleRaster::overList(const gl::Program& program) const {
  dispatchOverSampleList(program, list_);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

void SampleRaster::draw(Frame& frame, const std::string& pass) const {
  const gl::Texture& centreIds = frame.get<TriangleIds>().texture();
  const auto scope = frame.passes().open(pass);
  const Geometry geometry = frame.geometry();
  for (const gl::Program* each : {&clear_, &reachOf_, &smallDepth_, &largeDepth_, &smallIds_, &largeIds_,
                                  &finish_, neighbours_ ? &neighbours_->keep : nullptr}) {
    if (!each) continue;
    each->set("anchorToClip", anchorToClip(frame));
    each->set("near", static_cast<float>(nearPlane(frame)));
    each->set("sizePx", frame.sizePx());
    each->set("triangleCount", geometry.triangleCount());
    each->set("rangeCount", geometry.ranges ? geometry.ranges->rangeCount() : 0);
    for (size_t i = 0; i < places_.size(); ++i)
      each->set(("samplePlaces[" + std::to_string(i) + "]").c_str(), places_[i]);
  }
  geometry.bindStorage();
  if (geometry.ranges) geometry.ranges->ranges().bindStorage(kRasterRangesBuffer);
  queue_.bindStorage(kRasterQueueBuffer);
  depths_.bindStorage(kRasterDepthsBuffer);
  ids_.bindStorage(kRasterIdsBuffer);
  list_.bindStorage(kSampleRasterListBuffer);
  centreIds.bindTexture(kSampleRasterCentreIdsUnit);
  reach_.bindTexture(kSampleRasterReachUnit);
  marks_.bindImage(kSampleRasterMarksImage, gl::Access::ReadWrite);
  reach_.bindImage(kSampleRasterReachImage, gl::Access::Write);

  overList(clear_);
  empty_.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (neighbours_)
    listByNeighbours(frame);
  else
    listByTriangles(frame);
  overTriangles(frame, smallIds_, largeIds_);
  overList(finish_);
}

}  // namespace limen::frame
