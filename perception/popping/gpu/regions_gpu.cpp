// SPDX-License-Identifier: BSD-3-Clause
#include "perception/popping/gpu/regions_gpu.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <string>

#include "perception/popping/gpu/open_pass.h"
#include "perception/popping/gpu/popping_bindings.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;

constexpr glm::ivec2 kStatsTile{kStatsGroupX, kStatsGroupY* kStatsRows};
constexpr int64_t kHeaderBytes = sizeof(RegionTableHeader), kChunk = kRegionChunk;
const char* const kFolder = "perception/popping/gpu/";

/// Regions of 8 neighbours need a free pixel around, those of 4 one beside.
int64_t mostRegions(glm::ivec2 size, int connectivity) {
  const int64_t pixels = int64_t{size.x} * size.y;
  return connectivity == 8 ? ((int64_t{size.x} + 1) / 2) * ((int64_t{size.y} + 1) / 2) : (pixels + 1) / 2;
}

int64_t pixelsOf(glm::ivec2 size) { return int64_t{size.x} * size.y; }

/// Runs one invocation for each element, in groups spread over two dimensions where one has not
/// enough.
void dispatchLinear(const gl::Program& program, int64_t elements) {
  constexpr int64_t kMostGroups = 32768;
  const int64_t groups = (elements + kRegionGroup - 1) / kRegionGroup;
  const int64_t across = std::min(groups, kMostGroups), down = (groups + across - 1) / across;
  program.dispatch({static_cast<int>(across), static_cast<int>(down)}, {1, 1});
}

}  // namespace

RegionsGpu::RegionsGpu(gl::Context& context, glm::ivec2 sizePx, const PoppingSettings& settings)
    : context_(context),
      sizePx_(sizePx),
      settings_(settings),
      defines_{{"CONNECTIVITY", std::to_string(settings.regions.connectivity)}},
      labels_(Format::R32UI, sizePx),
      parents_(pixelsOf(sizePx) * 4, nullptr),
      roots_(pixelsOf(sizePx) * 4, nullptr),
      table_(
          kHeaderBytes + mostRegions(sizePx, settings.regions.connectivity) * int64_t{sizeof(RegionRecord)},
          nullptr),
      chunks_((pixelsOf(sizePx) + kChunk - 1) / kChunk * 4, nullptr) {
  for (const char* name : {"tile", "merge", "flatten", "count", "assign", "stats", "finish"})
    context_.programs().compute(std::string(kFolder) + name + ".comp.glsl", defines_);
}

void RegionsGpu::run(const gl::Texture& jnd, const gl::Texture& seeds, gl::PassList* passes) {
  assert(jnd.sizePx() == sizePx_ && seeds.sizePx() == sizePx_);
  const auto program = [&](const char* name) -> const gl::Program& {
    return context_.programs().compute(std::string(kFolder) + name + ".comp.glsl", defines_);
  };
  const auto pixels = static_cast<uint32_t>(pixelsOf(sizePx_));
  const int chunks = static_cast<int>((int64_t{pixels} + kChunk - 1) / kChunk);
  const auto threshold = static_cast<float>(settings_.regions.thresholdJnd);
  const auto exponent = static_cast<float>(settings_.minkowskiExponent);

  parents_.bindStorage(kRegionParentsBuffer);
  roots_.bindStorage(kRegionRootsBuffer);
  table_.bindStorage(kRegionTableBuffer);
  chunks_.bindStorage(kRegionChunksBuffer);
  jnd.bindTexture(kRegionJndUnit);
  seeds.bindTexture(kRegionSeedsUnit);
  {
    const auto pass = openPass(passes, "popping/regions_tile");
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    const gl::Program& tile = program("tile");
    tile.set("threshold", threshold);
    tile.dispatch((sizePx_ + kRegionTile - 1) / kRegionTile, {1, 1});
  }
  {
    const auto pass = openPass(passes, "popping/regions_merge");
    const glm::ivec2 edges = (sizePx_ - 1) / kRegionTile;
    const int64_t elements = int64_t{edges.y} * sizePx_.x + int64_t{edges.x} * sizePx_.y;
    if (elements > 0) {
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
      const gl::Program& merge = program("merge");
      merge.set("sizePx", sizePx_);
      dispatchLinear(merge, elements);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const gl::Program& flatten = program("flatten");
    flatten.set("pixelCount", pixels);
    dispatchLinear(flatten, pixels);
  }
  {
    const auto pass = openPass(passes, "popping/regions_number");
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const gl::Program& count = program("count");
    count.set("pixelCount", pixels);
    count.dispatch({chunks, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const gl::Program& assign = program("assign");
    assign.set("pixelCount", pixels);
    assign.dispatch({chunks, 1}, {1, 1});
  }
  {
    const auto pass = openPass(passes, "popping/regions_sum");
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    const gl::Program& stats = program("stats");
    labels_.bindImage(kRegionLabelsImage, Access::Write);
    stats.set("threshold", threshold);
    stats.set("exponent", exponent);
    stats.dispatch((sizePx_ + kStatsTile - 1) / kStatsTile, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    const gl::Program& finish = program("finish");
    finish.set("threshold", threshold);
    finish.set("exponent", exponent);
    finish.set("ratingScale", static_cast<float>(settings_.rating.scale));
    finish.set("ratingBase", static_cast<float>(settings_.rating.base));
    finish.dispatch({32, 1}, {1, 1});
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

RegionMap RegionsGpu::read() const {
  RegionMap map;
  map.width = sizePx_.x, map.height = sizePx_.y;
  map.labels = labels_.readUint();
  const uint32_t count = table_.read<RegionTableHeader>(0, 1).front().regionCount;
  const std::vector<RegionRecord> records = table_.read<RegionRecord>(kHeaderBytes, count);
  for (uint32_t i = 0; i < count; ++i) {
    const RegionRecord& record = records[i];
    PoppingRegion region;
    region.label = i + 1;
    region.sizePx = record.sizePx;
    double sum = 0.0;
    for (int word = 3; word >= 0; --word) sum = sum * 0x1p32 + record.sum[word];
    region.sigma =
        settings_.regions.thresholdJnd * std::pow(sum * 0x1p-16, 1.0 / settings_.minkowskiExponent);
    region.rating = poppingRating(region.sigma, settings_);
    region.least = glm::ivec2(record.leastX, record.leastY);
    region.most = glm::ivec2(record.mostX, record.mostY);
    region.largestJnd = std::bit_cast<float>(record.largestBits);
    const glm::dvec2 coordinates(record.x1 * 0x1p32 + record.x0, record.y1 * 0x1p32 + record.y0);
    region.centroidPx = coordinates / static_cast<double>(record.sizePx) + 0.5;
    region.coverage = static_cast<double>(record.sizePx) / static_cast<double>(map.labels.size());
    region.detectionProbability = settings_.detection.probability(region.rating);
    map.regions.push_back(region);
  }
  return map;
}

int64_t RegionsGpu::bytesHeld() const {
  return labels_.bytes() + parents_.bytes() + roots_.bytes() + table_.bytes() + chunks_.bytes();
}

}  // namespace limen::perception
