// SPDX-License-Identifier: BSD-3-Clause
// Occlusion bitmasks (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30).
#include "renderer/techniques/soft_shadows/bitmask/bitmask.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"

namespace limen::techniques {
namespace {

constexpr const char *kBitmaskPass = "soft_shadows/bitmask", *kTables = "soft_shadows/mask_tables",
                     *kKept = "soft_shadows/kept_masks", *kJoin = "soft_shadows/join_masks";
constexpr uint32_t kRectangleUnit = 6, kHalfSpaceUnit = 7, kLightMaskBinding = 0;

/// Of masks: how many samples there are, and where.
gl::ShaderDefines maskDefinesOf(const SampleChoice& samples) {
  gl::ShaderDefines defines = {{"PATTERN", patternDefine(samples.pattern)}};
  if (isGridPattern(samples.pattern)) return defines;
  defines["SAMPLES"] = std::to_string(lightSamples(samples.pattern).size());
  defines["RECTANGLES"] = std::to_string(samples.rectangleTable);
  return defines;
}

gl::ShaderDefines bitmaskDefines(const BitmaskSettings& settings) {
  const QuadMaskChoice mask = quadMaskChoice(settings.occluders);
  gl::ShaderDefines defines = maskDefinesOf(sampleChoice(settings.pattern));
  defineEnum(defines, "QUAD_MASK", mask.mask);
  defines["TABLE_SIZE"] = std::to_string(mask.tableSize);
  return defines;
}

int halfSpaceSize(const MaskedOccluders& occluders) {
  const QuadMaskChoice choice = quadMaskChoice(occluders);
  return choice.mask == QuadMask::HalfSpaceTable ? choice.tableSize : 0;
}

}  // namespace

Bitmask::Bitmask(const BitmaskSettings& settings, bool keepsMasks)
    : OccluderSearch(settings.search, settings.levels, settings.passes, occluderChoice(settings.occluders),
                     "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl", kBitmaskPass,
                     bitmaskDefines(settings)),
      pattern_(sampleChoice(settings.pattern)),
      halfSpaceSize_(halfSpaceSize(settings.occluders)),
      rectangleSize_(isGridPattern(pattern_.pattern) || halfSpaceSize_ > 0 ? 0 : pattern_.rectangleTable),
      mapChoice_(settings.maps),
      keepsMasks_(keepsMasks),
      maskDefines_(maskDefinesOf(pattern_)) {}

void Bitmask::prepareSearch(frame::Frame& frame) {
  samples_ = lightSamples(pattern_.pattern, pattern_.seed);
  const scene::AreaLight& light = frame.scene().lights.at(0);
  if (light.shape != scene::LightShape::Rectangle) {
    const std::vector<uint32_t> mask = lightMask(light, samples_);
    maskDefines_["SHAPED_LIGHT"] = "1";
    maskDefines_["LIGHT_SAMPLES"] = std::to_string(bitCount(mask));
    lightMask_.emplace(mask);
  }
  for (const auto& [name, value] : maskDefines_) define(name, value);
  setMaps(lightMaps(mapChoice_, frame.scene(), mapSettings()));
  isDue_.assign(maps().size(), true);
  const size_t sets = perObject() ? maps().size() : 1;
  if (keepsMasks_ || maps().size() > 1) {
    define("KEEP_MASKS", "1");
    masks_.emplace(frame.sizePx(), samples_.size(), sets);
    frame.passes().setBytesHeld(kKept, masks_->bytes());
  }
  if (sets > 1)
    join_ = &frame.context().programs().compute(
        "renderer/techniques/soft_shadows/bitmask/join_masks.comp.glsl", maskDefines_);
  OccluderSearch::prepareSearch(frame);
  if (halfSpaceSize_ > 0) halfSpaces_.emplace(makeHalfSpaceTable(samples_, halfSpaceSize_));
  if (rectangleSize_ > 0) rectangles_.emplace(makeRectangleTable(samples_, rectangleSize_));
  const int64_t bytes = (halfSpaces_ ? halfSpaces_->bytes() : 0) + (rectangles_ ? rectangles_->bytes() : 0);
  if (bytes > 0) frame.passes().setBytesHeld(kTables, bytes);
}

void Bitmask::chooseMaps(const frame::Frame& frame) {
  const size_t due = mapsAtRest();
  const bool keeps = hasMasks_ && due < isDue_.size() && keptForS_ == frame.timeS();
  isDue_.assign(isDue_.size(), !keeps);
  for (size_t i = 0; keeps && i < due; ++i) isDue_[(nextUpdate_ + i) % isDue_.size()] = true;
  if (keeps) nextUpdate_ = (nextUpdate_ + due) % isDue_.size();
  hasMasks_ = true;
  keptForS_ = frame.timeS();
}

void Bitmask::render(frame::Frame& frame) {
  chooseMaps(frame);
  OccluderSearch::render(frame);
}

int Bitmask::bindMasks() const {
  masks_->bind();
  if (lightMask_) lightMask_->bindStorage(kLightMaskBinding);
  return perObject() ? static_cast<int>(isDue_.size()) : 1;
}

void Bitmask::configure(const gl::Program& program) const {
  OccluderSearch::configure(program);
  if (halfSpaces_) halfSpaces_->bindTexture(kHalfSpaceUnit);
  if (rectangles_) rectangles_->bindTexture(kRectangleUnit);
  if (lightMask_) lightMask_->bindStorage(kLightMaskBinding);
  if (!masks_) return;
  masks_->bind();
  const int map = static_cast<int>(currentMap());
  program.set("keptSet", perObject() ? map : 0);
  program.set("joins", !perObject() && map > 0 ? 1 : 0);
}

void Bitmask::finish(frame::Frame& frame) {
  if (!join_) return;
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const auto scope = frame.passes().open(kJoin);
  join_->set("sizePx", frame.sizePx());
  join_->set("sets", bindMasks());
  receivers.bindTexture(0);
  Bitmask::product().bindImage(0, gl::Access::Write);
  join_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

std::vector<Quantity> Bitmask::quantities() {
  std::vector<Quantity> all = OccluderSearch::quantities();
  all.insert(all.end(), {{"maps_read", "Shadow maps read", "", Direction::LowerIsBetter},
                         {"maps_with_casters", "Shadow maps with casters", "", Direction::Neither},
                         {"mask_bytes", "Memory of stored masks", "byte", Direction::LowerIsBetter}});
  return all;
}

size_t Bitmask::mapsAtRest() const {
  const auto* objects = std::get_if<ObjectMaps>(&mapChoice_);
  return objects && objects->updates > 0 ? std::min(static_cast<size_t>(objects->updates), maps().size())
                                         : maps().size();
}

int Bitmask::mapsWithCasters(frame::Frame& frame) const {
  int count = 0;
  for (const frame::ShadowMapSettings& map : maps()) {
    const auto& pyramid = frame.get<frame::MinMaxPyramid>(map);
    count += pyramid.minimum().read(pyramid.levels() - 1).at(0, 0) < frame::kEmptyDepth;
  }
  return count;
}

std::vector<Counter> Bitmask::count(frame::Frame& frame) {
  // Of a whole image, however few objects the last frame looked at.
  isDue_.assign(isDue_.size(), true);
  std::vector<Counter> all = OccluderSearch::count(frame);
  all.push_back({"maps_read", double(mapsAtRest())});
  all.push_back({"maps_with_casters", double(mapsWithCasters(frame))});
  all.push_back({"mask_bytes", masks_ ? double(masks_->bytes()) : 0.0});
  return all;
}

namespace {

/// The visibility itself, filtered if asked (SS-20).
class BitmaskVisibility : public Bitmask {
 public:
  explicit BitmaskVisibility(const BitmaskSettings& settings) : Bitmask(settings) {
    if (const auto* mean = std::get_if<SurfaceMean>(&settings.filter)) filter_.emplace(*mean);
  }

  const gl::Texture& product() const override { return filter_ ? filter_->filtered() : Bitmask::product(); }

 protected:
  void prepareSearch(frame::Frame& frame) override {
    Bitmask::prepareSearch(frame);
    if (filter_) filter_->prepare(frame);
  }
  void finish(frame::Frame& frame) override {
    Bitmask::finish(frame);
    if (filter_) filter_->run(frame, Bitmask::product());
  }

 private:
  std::optional<VisibilityFilter> filter_;
};

const RegisteredTechnique<BitmaskVisibility> kBitmaskRegistered{
    {.name = "soft_shadows/bitmask",
     .version = 1,
     .summary = "Micro-occluders backprojected onto a bit field of light samples",
     .source = "Schwarz 2009, sections 4.2 and 4.4 (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = Bitmask::quantities()}};

}  // namespace
}  // namespace limen::techniques
