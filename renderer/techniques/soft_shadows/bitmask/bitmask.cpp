// SPDX-License-Identifier: BSD-3-Clause
// Occlusion bitmasks (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30).
#include "renderer/techniques/soft_shadows/bitmask/bitmask.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/half_space_table.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"
#include "renderer/techniques/soft_shadows/bitmask/visibility_filter.h"

namespace limen::techniques {
namespace {

constexpr const char *kBitmaskPass = "soft_shadows/bitmask", *kTables = "soft_shadows/mask_tables",
                     *kKept = "soft_shadows/kept_masks", *kJoin = "soft_shadows/join_masks";
constexpr uint32_t kRectangleUnit = 6, kHalfSpaceUnit = 7, kLightMaskBinding = 0;
constexpr const char *kDefaultTableSize = "256", *kDefaultRectangles = "128";
constexpr int64_t kDefaultSeed = 1;

/// Of masks: how many samples there are, and where.
gl::ShaderDefines maskDefinesOf(const ParameterValues& values) {
  const std::string& pattern = values.text("pattern");
  if (isGridPattern(pattern))
    return {{"PATTERN", pattern == "jittered_16" ? "160" : pattern.substr(pattern.rfind('_') + 1)}};
  return {{"PATTERN", "0"},
          {"SAMPLES", std::to_string(lightSamples(pattern).size())},
          {"RECTANGLES", values.text("rectangle_table")}};
}

gl::ShaderDefines bitmaskDefines(const ParameterValues& values) {
  const std::string& mask = values.text("quad_mask");
  gl::ShaderDefines defines = maskDefinesOf(values);
  defines["QUAD_MASK"] = mask == "approximate" ? "0" : mask == "half_space_table" ? "1" : "2";
  defines["TABLE_SIZE"] = values.text("table_size");
  return defines;
}

}  // namespace

void Bitmask::checkKept(const ParameterValues& values, const std::string& why) {
  const std::string& levels = values.text("levels");
  if (values.text("passes") != "single")
    throw Error(why + ", which is one pass's work", "passes", "leave it out, or give one map of one colour");
  if (levels != "finest_within" && levels != "coarsest_over")
    throw Error(why + ", and 'levels: " + levels + "' blends what masks come to", "levels",
                "give levels: finest_within, or one map of one colour");
}

void Bitmask::checkValues(const ParameterValues& values) {
  OccluderSearch::checkSearch(values);
  LightMaps::check(values);
  if (values.text("maps") != "centre" && values.text("bias_form") == "stored")
    throw Error("'bias_form: stored' knows the map from the light's centre alone", "bias_form",
                "give another form, or maps: centre");
  if (values.text("maps") != "centre") checkKept(values, "several maps are joined mask by mask");
  const std::string &occluders = values.text("occluders"), &mask = values.text("quad_mask"),
                    &pattern = values.text("pattern");
  if (!occluders.starts_with("microquads") && mask != "approximate")
    throw Error("'quad_mask' is about microquads, and there are none", "quad_mask",
                "leave it out, or give occluders: microquads");
  if (occluders == "microquads_microtris" && mask == "approximate")
    throw Error("'quad_mask: approximate' says nothing about a triangle, and microtris are triangles",
                "quad_mask", "give quad_mask: arithmetic or half_space_table, or occluders: microquads");
  if (mask == "arithmetic" && !isGridPattern(pattern))
    throw Error("'quad_mask: arithmetic' needs samples in rows, which " + pattern + " has not", "quad_mask",
                "give quad_mask: half_space_table, or a regular or jittered pattern");
  if (mask != "half_space_table" && values.text("table_size") != kDefaultTableSize)
    throw Error("'table_size' is about the table of half-spaces, and there is none", "table_size",
                "leave it out, or give quad_mask: half_space_table");
  if (isGridPattern(pattern) && values.text("rectangle_table") != kDefaultRectangles)
    throw Error("'rectangle_table' is about patterns without a grid, and " + pattern + " has one",
                "rectangle_table", "leave it out, or give another pattern");
  if (!pattern.starts_with("random_") && !pattern.starts_with("stratified_") &&
      values.integer("pattern_seed") != kDefaultSeed)
    throw Error("'pattern_seed' is about random patterns, and " + pattern + " is none", "pattern_seed",
                "leave it out, or give another pattern");
}

Bitmask::Bitmask(const ParameterValues& values, bool keepsMasks)
    : OccluderSearch(values, "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl", kBitmaskPass,
                     bitmaskDefines(values)),
      pattern_(values.text("pattern")),
      seed_(values.integer("pattern_seed")),
      halfSpaceSize_(values.text("quad_mask") == "half_space_table" ? std::stoi(values.text("table_size"))
                                                                    : 0),
      rectangleSize_(
          isGridPattern(pattern_) || halfSpaceSize_ > 0 ? 0 : std::stoi(values.text("rectangle_table"))),
      lightMaps_(values),
      keepsMasks_(keepsMasks),
      maskDefines_(maskDefinesOf(values)) {
  checkValues(values);
}

void Bitmask::prepareSearch(frame::Frame& frame) {
  samples_ = lightSamples(pattern_, seed_);
  const scene::AreaLight& light = frame.scene().lights.at(0);
  if (light.shape != scene::LightShape::Rectangle) {
    const std::vector<uint32_t> mask = lightMask(light, samples_);
    maskDefines_["SHAPED_LIGHT"] = "1";
    maskDefines_["LIGHT_SAMPLES"] = std::to_string(bitCount(mask));
    lightMask_.emplace(mask);
  }
  for (const auto& [name, value] : maskDefines_) define(name, value);
  setMaps(lightMaps_.of(frame.scene(), mapSettings()));
  isDue_.assign(maps().size(), true);
  const size_t sets = lightMaps_.perObject() ? maps().size() : 1;
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
  return lightMaps_.perObject() ? static_cast<int>(isDue_.size()) : 1;
}

void Bitmask::configure(const gl::Program& program) const {
  OccluderSearch::configure(program);
  if (halfSpaces_) halfSpaces_->bindTexture(kHalfSpaceUnit);
  if (rectangles_) rectangles_->bindTexture(kRectangleUnit);
  if (lightMask_) lightMask_->bindStorage(kLightMaskBinding);
  if (!masks_) return;
  masks_->bind();
  const int map = static_cast<int>(currentMap());
  program.set("keptSet", lightMaps_.perObject() ? map : 0);
  program.set("joins", !lightMaps_.perObject() && map > 0 ? 1 : 0);
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

std::vector<Quantity> Bitmask::counterNames() {
  std::vector<Quantity> names = OccluderSearch::counterNames();
  names.insert(names.end(), {"maps_read", "maps_with_casters", "mask_bytes"});
  return names;
}

size_t Bitmask::mapsAtRest() const {
  const bool inTurn = lightMaps_.perObject() && lightMaps_.updates() > 0;
  return inTurn ? std::min(lightMaps_.updates(), maps().size()) : maps().size();
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
  all.push_back({"maps_read", double(mapsAtRest()), "maps", true});
  all.push_back({"maps_with_casters", double(mapsWithCasters(frame)), "maps", false});
  all.push_back({"mask_bytes", masks_ ? double(masks_->bytes()) : 0.0, "byte", true});
  return all;
}

std::vector<Parameter> Bitmask::parameters() {
  std::vector<Parameter> all =
      OccluderSearch::searchParameters({"micropatches", "microquads", "microquads_microtris", "microrects"});
  all.push_back(
      choiceParameter("pattern", "jittered_16", lightSamplePatterns(),
                      "Light samples: regular grids, 16 x 16 in rotated pairs, or places without a grid",
                      "Schwarz 2009, sections 4.2.1 and 4.2.2"));
  all.push_back(integerParameter("pattern_seed", kDefaultSeed, 0, 1000000, "",
                                 "Seed of random and stratified patterns"));
  all.push_back(choiceParameter("rectangle_table", kDefaultRectangles, {"16", "32", "64", "128", "256"},
                                "Steps on either axis of the table of rectangles for patterns without a grid",
                                "Schwarz 2009, section 4.2.1 (value not given there)"));
  all.push_back(
      choiceParameter("quad_mask", "approximate", {"approximate", "half_space_table", "arithmetic"},
                      "Samples that a microquad covers: those of a rectangle in its place, or those "
                      "of its convex hull by a table or by arithmetic",
                      "Schwarz 2009, sections 4.4.2 and 4.4.4"));
  all.push_back(choiceParameter(
      "table_size", kDefaultTableSize, {"64", "128", "256", "512", "1024"},
      "Angles, and distances, of lines that the table of half-spaces holds; its memory grows by the square",
      "Schwarz 2009, section 4.4.4 (value not given there)"));
  for (Parameter& parameter : LightMaps::parameters()) all.push_back(std::move(parameter));
  return all;
}

namespace {

/// The visibility itself, filtered if asked (SS-20).
class BitmaskVisibility : public Bitmask {
 public:
  explicit BitmaskVisibility(const ParameterValues& values) : Bitmask(values), filter_(values) {
    VisibilityFilter::check(values);
  }

  static std::vector<Parameter> parameters() {
    std::vector<Parameter> all = Bitmask::parameters();
    for (Parameter& parameter : VisibilityFilter::parameters()) all.push_back(std::move(parameter));
    return all;
  }
  static void checkValues(const ParameterValues& values) {
    Bitmask::checkValues(values);
    VisibilityFilter::check(values);
  }

  const gl::Texture& product() const override {
    return filter_.isOn() ? filter_.filtered() : Bitmask::product();
  }

 protected:
  void prepareSearch(frame::Frame& frame) override {
    Bitmask::prepareSearch(frame);
    if (filter_.isOn()) filter_.prepare(frame);
  }
  void finish(frame::Frame& frame) override {
    Bitmask::finish(frame);
    if (filter_.isOn()) filter_.run(frame, Bitmask::product());
  }

 private:
  VisibilityFilter filter_;
};

const Registered<TechniqueInfo> kBitmaskRegistered{
    {.name = "soft_shadows/bitmask",
     .version = 1,
     .summary = "Micro-occluders backprojected onto a bit field of light samples",
     .source = "Schwarz 2009, sections 4.2 and 4.4 (SS-12 to SS-16, SS-19, SS-20, SS-27 to SS-30)",
     .product = ProductKind::Visibility,
     .parameters = BitmaskVisibility::parameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<BitmaskVisibility>(values); },
     .errorBound = {},
     .counters = Bitmask::counterNames(),
     .check = &BitmaskVisibility::checkValues}};

}  // namespace
}  // namespace limen::techniques
