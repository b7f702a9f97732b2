// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/summed_area_table.h"

#include <epoxy/gl.h>

#include "experiments/base/error.h"
#include "renderer/frame/frame_bindings.h"

namespace limen::frame {
namespace {

constexpr const char* kScan = "renderer/frame/summed_area_table.comp.glsl";
constexpr const char* kMean = "renderer/frame/summed_area_mean.comp.glsl";

gl::Texture allocateSums(int resolution, int layers, int channels, SumForm form) {
  const gl::Format format = form == SumForm::Fixed ? (channels == 1 ? gl::Format::R32UI : gl::Format::RG32UI)
                                                   : (channels == 1 ? gl::Format::R32F : gl::Format::RG32F);
  try {
    return {format, glm::ivec2(resolution), 1, layers};
  } catch (const Error& error) {
    throw Error("the summed-area table does not fit: " + error.message(), {},
                "choose a smaller map, or fewer terms or slices");
  }
}

gl::ShaderDefines scanDefines(int channels, SumForm form, bool columns) {
  gl::ShaderDefines defines{{"TEXEL", SummedAreaTable::texelLayout(channels, form)}};
  if (form == SumForm::Fixed) defines["FIXED"] = "1";
  if (columns)
    defines["COLUMNS"] = "1";
  else if (form == SumForm::FloatMean)
    defines["MEAN"] = "1";
  return defines;
}

}  // namespace

const char* SummedAreaTable::texelLayout(int channels, SumForm form) {
  if (form == SumForm::Fixed) return channels == 1 ? "r32ui" : "rg32ui";
  return channels == 1 ? "r32f" : "rg32f";
}

gl::ShaderDefines SummedAreaTable::defines(SumForm form) {
  if (form == SumForm::Fixed) return {{"SUMS_FIXED", "1"}};
  if (form == SumForm::FloatMean) return {{"SUMS_MEAN", "1"}};
  return {};
}

// Along each axis log2(kSumsTile) additions within a tile, plus one for each tile before it.
int SummedAreaTable::additions(int resolution) { return 2 * (5 + (resolution + kSumsTile - 1) / kSumsTile); }

SummedAreaTable::SummedAreaTable(gl::Context& context, int resolution, int layers, int channels, SumForm form)
    : resolution_(resolution),
      layers_(layers),
      texture_(allocateSums(resolution, layers, channels, form)),
      rows_(context.programs().compute(kScan, scanDefines(channels, form, false))),
      columns_(context.programs().compute(kScan, scanDefines(channels, form, true))) {
  if (form != SumForm::FloatMean) return;
  means_.emplace(int64_t{8} * layers, nullptr);
  findMeans_ = &context.programs().compute(kMean, {{"TEXEL", texelLayout(channels, form)}});
}

int64_t SummedAreaTable::bytes() const { return texture_.bytes() + (means_ ? means_->bytes() : 0); }

void SummedAreaTable::build() const {
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  if (findMeans_) {
    means_->bindStorage(kSumsMeansBuffer);
    texture_.bindImage(kSumsValuesImage, gl::Access::Read);
    findMeans_->set("resolution", resolution_);
    findMeans_->dispatch({layers_, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  texture_.bindImage(kSumsImage, gl::Access::ReadWrite);
  for (const gl::Program* program : {&rows_, &columns_}) {
    program->set("resolution", resolution_);
    program->dispatch({resolution_, layers_}, {kSumsLines, 1});
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void SummedAreaTable::bind(uint32_t unit) const {
  texture_.bindTexture(unit);
  if (means_) means_->bindStorage(kSumsMeansBuffer);
}

}  // namespace limen::frame
