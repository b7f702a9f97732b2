// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/region_raster.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"

namespace limen::frame {
namespace {

constexpr int kRegionBands = 1 << 19;  // as ComputeRaster's
constexpr int kBandGroups = 4096;

const gl::Program& rasterProgram(gl::Context& context, bool large, bool ids, int words) {
  gl::ShaderDefines defines = {{"QUEUE_CAPACITY", std::to_string(kRegionBands) + "u"},
                               {"REGIONS", std::to_string(words)}};
  if (large) defines["LARGE"] = "1";
  if (ids) defines["IDS"] = "1";
  return context.programs().compute("renderer/frame/compute_raster.comp.glsl", defines);
}

}  // namespace

struct RegionRaster::Compute {
  const gl::Program &smallDepth, &largeDepth, &requeue;
  const gl::Program *smallIds = nullptr, *largeIds = nullptr;
  gl::Buffer queue;
};

struct RegionRaster::Hardware {
  const gl::Program& import;
  struct Drawing {
    Drawing(Frame& parent, const std::string& name, ivec2 sizePx) : frame(parent, name, sizePx) {}
    Frame frame;
    std::optional<scene::LodSelection> shown;
  };
  std::vector<std::unique_ptr<Drawing>> drawings;
};

RegionRaster::RegionRaster(Frame& parent, const std::string& name, const LightFrustum* light, int resolution)
    : parent_(parent), name_(name), sizePx_(light ? ivec2(resolution) : parent.sizePx()) {
  if (light) light_ = *light;
  gl::Context& context = parent.context();
  const int words = wordsOfPixel();
  const Raster raster = light && parent.raster() == Raster::Hardware ? Raster::Auto : parent.raster();
  if (chosenRaster(raster, context) == Raster::Hardware) {
    hardware_.reset(new Hardware{context.programs().compute("renderer/frame/region_import.comp.glsl",
                                                            {{"REGIONS", std::to_string(words)}}),
                                 {}});
    hardware_->drawings.resize(kMostRasterRegions);
    return;
  }
  compute_.reset(new Compute{
      rasterProgram(context, false, false, words), rasterProgram(context, true, false, words),
      context.programs().compute("renderer/frame/compute_raster_requeue.comp.glsl"), nullptr, nullptr,
      gl::Buffer(int64_t{sizeof(RasterQueueHeader)} + int64_t{kRegionBands} * 8, nullptr)});
  compute_->queue.clearUint(0);
  if (light) return;
  compute_->smallIds = &rasterProgram(context, false, true, words);
  compute_->largeIds = &rasterProgram(context, true, true, words);
}

RegionRaster::~RegionRaster() = default;

int64_t RegionRaster::bytes() const { return compute_ ? compute_->queue.bytes() : 0; }

std::vector<glm::uvec4> RegionRaster::rangesOf(const std::vector<RegionContent>& regions, int first) const {
  std::vector<glm::uvec4> out;
  uint32_t triangles = 0;
  for (size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].pixels() == 0) continue;
    const auto region = static_cast<uint32_t>(first) + static_cast<uint32_t>(i);
    for (const scene::TriangleRange& range : scene::rangesOf(parent_.scene(), regions[i].selection)) {
      if (range.count == 0) continue;
      triangles += range.count;
      out.emplace_back(range.first, triangles, region, 0U);
    }
  }
  return out;
}

void RegionRaster::draw(Frame& view, const std::vector<RegionContent>& regions,
                        const std::vector<RasterRegion>& table, int first, const Ranges& ranges,
                        const gl::Buffer& words) {
  if (hardware_)
    drawByHardware(view, regions, table, first, words);
  else if (ranges.triangles > 0)
    drawByCompute(view, ranges, words);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void RegionRaster::drawByCompute(Frame& view, const Ranges& ranges, const gl::Buffer& words) {
  const auto scope = view.passes().open(name_);
  view.geometry().bindStorage();
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kRasterRangesBuffer, ranges.buffer.id(), ranges.offset,
                    ranges.count * int64_t{sizeof(glm::uvec4)});
  compute_->queue.bindStorage(kRasterQueueBuffer);
  words.bindStorage(kRasterDepthsBuffer);
  words.bindStorage(kRasterIdsBuffer);
  glm::mat4 clip = light_ ? glm::mat4(light_->clipFromLight() *
                                      view.scene().lights.at(0).toLightSpace(view.gpuScene().anchor()))
                          : anchorToClip(view);
  const double near = light_ ? light_->near : nearPlane(view);
  constexpr int kPerRow = 1 << 20;
  const int count = static_cast<int>(ranges.triangles);
  const auto pass = [&](const gl::Program& small, const gl::Program& large) {
    for (const gl::Program* each : {&small, &large}) {
      each->set("anchorToClip", clip);
      each->set("near", static_cast<float>(near));
      each->set("sizePx", sizePx_);
      each->set("triangleCount", ranges.triangles);
      each->set("rangeCount", static_cast<int>(ranges.count));
    }
    small.dispatch({std::min(count, kPerRow), (count + kPerRow - 1) / kPerRow}, {kRasterGroup, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    large.dispatch({kBandGroups, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    compute_->requeue.dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  pass(compute_->smallDepth, compute_->largeDepth);
  if (compute_->smallIds) pass(*compute_->smallIds, *compute_->largeIds);
}

void RegionRaster::drawByHardware(Frame& view, const std::vector<RegionContent>& regions,
                                  const std::vector<RasterRegion>& table, int first,
                                  const gl::Buffer& words) {
  for (size_t i = 0; i < regions.size(); ++i) {
    if (regions[i].pixels() == 0) continue;
    auto& made = hardware_->drawings.at(i);
    if (!made)
      made = std::make_unique<Hardware::Drawing>(parent_, name_ + "_" + std::to_string(i), parent_.sizePx());
    Hardware::Drawing& drawing = *made;
    drawing.frame.setTime(view.timeS());
    if (drawing.shown != regions[i].selection)
      drawing.frame.setLevels(*(drawing.shown = regions[i].selection));
    drawing.frame.begin();
    if (light_) {
      drawing.frame.get<ShadowDepth>(ShadowMapSettings{sizePx_.x, Raster::Hardware})
          .depth()
          .bindTexture(kRegionImportDepthUnit);
    } else {
      const auto& seen = drawing.frame.get<TriangleIds>();
      seen.depth().bindTexture(kRegionImportDepthUnit);
      seen.texture().bindTexture(kRegionImportIdsUnit);
    }
    words.bindStorage(kRasterDepthsBuffer);
    hardware_->import.set("regionIndex", first + static_cast<int>(i));
    const RasterRegion& region = table[static_cast<size_t>(first) + i];
    hardware_->import.dispatch(region.high - region.low);
  }
}

}  // namespace limen::frame
