// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/centre_samples.h"

#include <epoxy/gl.h>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"

namespace limen::frame {

CentreSamples::CentreSamples(Frame& frame, std::vector<glm::vec2> places, const SameSurface& surface)
    : places_(std::move(places)),
      surface_(surface),
      empty_(frame.context().programs().compute("renderer/frame/sample_list_groups.comp.glsl",
                                                {{"EMPTY", "1"}, {"NO_QUEUE", "1"}})),
      mark_(frame.context().programs().compute(
          "renderer/frame/sample_marks.comp.glsl",
          {{"SAMPLES", std::to_string(places_.size())}, {"CENTRES", "1"}})),
      groups_(frame.context().programs().compute("renderer/frame/sample_list_groups.comp.glsl",
                                                 {{"NO_QUEUE", "1"}})),
      list_(int64_t{sizeof(SampleListHeader)} + int64_t{4} * frame.sizePx().x * frame.sizePx().y, nullptr),
      ids_(int64_t{4} * frame.sizePx().x * frame.sizePx().y * static_cast<int64_t>(places_.size()), nullptr),
      marks_(gl::Format::R32UI, frame.sizePx()) {}

void CentreSamples::draw(Frame& frame, const std::string& pass) const {
  const gl::Texture& centreIds = frame.get<TriangleIds>().texture();
  const auto scope = frame.passes().open(pass);
  setMarkUniforms(mark_, frame, places_, surface_);
  frame.geometry().bindStorage();
  ids_.bindStorage(kRasterIdsBuffer);
  list_.bindStorage(kSampleRasterListBuffer);
  centreIds.bindTexture(kSampleRasterCentreIdsUnit);
  marks_.bindImage(kSampleRasterMarksImage, gl::Access::Write);
  empty_.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  mark_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  groups_.dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::frame
