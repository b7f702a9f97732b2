// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/multisample/pixel_samples.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"

namespace limen::techniques {

PixelSamples::PixelSamples(frame::Frame& frame, int samples, frame::Raster raster,
                           const SurfaceSamples* surfaces) {
  if (frame::chosenRaster(raster, frame.context()) == frame::Raster::Compute) {
    const SurfaceSamples given = surfaces ? *surfaces : SurfaceSamples{};
    const frame::SameSurface same{given.tolerance, given.angleDeg};
    std::vector<glm::vec2> places = frame::standardSamplePlaces(samples);
    if (given.search == frame::SampleSearch::Centres)
      centres_.emplace(frame, std::move(places), same);
    else
      compute_.emplace(frame, std::move(places), given.search, same);
    return;
  }
  driver_.emplace(frame, samples);
  if (!surfaces) return;
  gl::ProgramCache& programs = frame.context().programs();
  const int64_t pixels = int64_t{frame.sizePx().x} * frame.sizePx().y;
  listed_.emplace(Listed{programs.compute("renderer/frame/sample_list_groups.comp.glsl", {{"EMPTY", "1"}}),
                         programs.compute("renderer/techniques/soft_shadows/multisample/gather.comp.glsl",
                                          {{"SAMPLES", std::to_string(samples)}}),
                         programs.compute("renderer/frame/sample_list_groups.comp.glsl"),
                         gl::Buffer(int64_t{sizeof(frame::SampleListHeader)} + 4 * pixels, nullptr),
                         gl::Buffer(4 * pixels * samples, nullptr),
                         gl::Buffer(int64_t{sizeof(frame::RasterQueueHeader)}, nullptr),
                         gl::Texture(gl::Format::R32UI, frame.sizePx())});
}

gl::ShaderDefines PixelSamples::defines() const {
  gl::ShaderDefines defines = {{"SAMPLES", std::to_string(places().size())}};
  if (!driver_) defines["LISTED"] = "1";
  return defines;
}

int64_t PixelSamples::bytes() const {
  if (compute_) return compute_->bytes();
  if (centres_) return centres_->bytes();
  return driver_->bytes() +
         (listed_ ? listed_->list.bytes() + listed_->ids.bytes() + listed_->marks.bytes() : 0);
}

void PixelSamples::draw(frame::Frame& frame, const std::string& pass) const {
  if (compute_) {
    compute_->draw(frame, pass);
    return;
  }
  if (centres_) {
    centres_->draw(frame, pass);
    return;
  }
  if (listed_) frame.get<frame::TriangleIds>();
  const auto scope = frame.passes().open(pass);
  driver_->draw(frame);
  if (listed_) listDriverSamples(frame);
}

void PixelSamples::listDriverSamples(frame::Frame& frame) const {
  listed_->unusedQueue.bindStorage(frame::kRasterQueueBuffer);
  listed_->list.bindStorage(kSampleListBuffer);
  listed_->ids.bindStorage(kSampleIdsBuffer);
  listed_->empty.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  listed_->gather.set("sizePx", frame.sizePx());
  frame.get<frame::TriangleIds>().texture().bindTexture(kGatherCentreIdsUnit);
  driver_->bindTexture(kGatherSamplesUnit);
  listed_->marks.bindImage(kGatherMarksImage, gl::Access::Write);
  listed_->gather.dispatch(frame.sizePx());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  listed_->groups.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

void PixelSamples::bindForSampleIds(frame::Frame& frame) const {
  if (driver_) {
    driver_->bindTexture(kSampleIdsUnit);
    return;
  }
  frame.get<frame::TriangleIds>().texture().bindTexture(kSampleIdsUnit);
  marks().bindTexture(kSampleMarksUnit);
  ids().bindStorage(kSampleIdsBuffer);
}

}  // namespace limen::techniques
