// SPDX-License-Identifier: BSD-3-Clause
// Glossy and antialiased mirrors by one cone for each pixel, which encloses all that contributes to it (R-37
// to R-52). Source: Roger 2008, chapter 5.
//
// Departures. A cone is kept as its radius at the mirror and the growth of that radius, so that it needs no
// apex. Triangles are cut at the mirror's own plane too: what a cone has below it holds no light, and shares
// are those of the rest. Pairs end at tiles of pixels (traversal.leaf_side), each pixel tests its tile's
// triangles itself and keeps the nearest ones in a heap. A tile whose pairs found no room takes all
// triangles of the scene: slower, but no frame loses any. What hides all behind it ends the search. A
// software renderer, which limits the loop rounds of an invocation, takes the lists in several dispatches.
#include <epoxy/gl.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/frame/surface_point.h"
#include "renderer/techniques/reflections/cone_traced/cone_lists.h"
#include "renderer/techniques/reflections/cone_traced/cone_traced_bindings.h"
#include "renderer/techniques/reflections/cone_traced/cone_traced_settings.h"
#include "renderer/techniques/reflections/cone_traced/contribution_table.h"
#include "renderer/techniques/reflections/cone_traced/peeling.h"
#include "renderer/techniques/reflections/cones/cone_geometry.h"
#include "renderer/techniques/reflections/cones/pixel_solid_angles.h"
#include "renderer/techniques/reflections/environment_map/surroundings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kConesPass = "reflections/cones", *kConeListsPass = "reflections/lists",
                     *kConeCompositePass = "reflections/composite",
                     *kConeSurroundingsPass = "reflections/surroundings";
constexpr int kTableSide = 32, kTableLayers = 17;

gl::Texture solidAngleTexture(frame::Frame& frame) {
  const PixelSolidAngles angles(frame.sizePx(), frame.tanHalfFov());
  const glm::ivec2 size = (frame.sizePx() + 1) / 2;
  Image image(size.x, size.y, 1);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) image.at(x, y) = static_cast<float>(angles.at({x, y}));
  gl::Texture out(gl::Format::R32F, size);
  out.write(image);
  return out;
}

/// Places of equal shares of the unit disk: turned by the golden angle from one to the next.
gl::Texture maskTexture() {
  Image image(kConeMaskPoints, 1, 2);
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kConeMaskPoints; ++i) {
    const double radius = std::sqrt((i + 0.5) / kConeMaskPoints);
    image.at(i, 0, 0) = static_cast<float>(radius * std::cos(turn * i));
    image.at(i, 0, 1) = static_cast<float>(radius * std::sin(turn * i));
  }
  gl::Texture out(gl::Format::RG32F, {kConeMaskPoints, 1});
  out.write(image);
  return out;
}

gl::Texture contributionTexture() {
  gl::Texture out(gl::Format::R32F, glm::ivec2(kTableSide), 1, kTableLayers, gl::Sampling::Linear);
  for (int layer = 0; layer < kTableLayers; ++layer) {
    Image image(kTableSide, kTableSide, 1);
    image.data = contributionTable(kTableSide, layer / (kTableLayers - 1.0));
    out.view(layer).write(image);
  }
  return out;
}

class ConeTraced : public Technique {
 public:
  using Settings = ConeTracedSettings;
  explicit ConeTraced(const Settings& settings) : settings_(settings), picture_(settings.shading) {}

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/reflections/cone_traced/";
    gl::ProgramCache& cache = frame.context().programs();
    gl::ShaderDefines cones = frame::surfaceDefines(frame, true);
    if (settings_.reflection == ConeReflection::EdgeRays) cones["EDGE_RAYS"] = "1";
    cones_ = &cache.compute(folder + "cones.comp.glsl", cones);
    traversal_.emplace(frame, settings_.traversal, false, HierarchyLeaves::Cones);
    setFarthest(frame);
    lists_.emplace(frame, *traversal_);
    gl::ShaderDefines defines = compositeDefines(frame);
    if (const auto* peeled = std::get_if<PeeledLayers>(&settings_.backEnd)) {
      peeling_.emplace(frame, peeled->room);
      gl::ShaderDefines items = defines;
      items["PEEL"] = "1";
      items_ = &cache.compute(folder + "composite.comp.glsl", items);
      finish_ = &cache.compute(folder + "peel_finish.comp.glsl", fillDefines());
    } else {
      composite_ = &cache.compute(folder + "composite.comp.glsl", defines);
    }
    defines["COUNT"] = "1";
    countComposite_ = &cache.compute(folder + "composite.comp.glsl", defines);
    const glm::ivec2 size = frame.sizePx();
    origins_.emplace(gl::Format::RGBA32F, size);
    directions_.emplace(gl::Format::RGBA32F, size);
    shapes_.emplace(gl::Format::RG32F, size);
    reflected_.emplace(gl::Format::RGBA32F, size);
    solidAngles_.emplace(solidAngleTexture(frame));
    mask_.emplace(maskTexture());
    if (settings_.contribution == ConeContribution::Table) table_.emplace(contributionTexture());
    if (const auto* fill = std::get_if<FillEnvironment>(&settings_.fill)) {
      surroundings_.emplace(frame, fill->resolution, true, settings_.shading);
      frame.passes().setBytesHeld(kConeSurroundingsPass, surroundings_->bytes());
    }
    if (lists_->rounds() > 1) state_.emplace(gl::Format::RG32UI, size, 1, settings_.layers + 2);
    frame.passes().setBytesHeld(kConesPass, origins_->bytes() + directions_->bytes() + shapes_->bytes());
    frame.passes().setBytesHeld(kConeListsPass, lists_->bytes() + traversal_->bytes());
    frame.passes().setBytesHeld(kConeCompositePass, reflected_->bytes() + (state_ ? state_->bytes() : 0));
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    if (surroundings_) {
      const auto scope = frame.passes().open(kConeSurroundingsPass);
      surroundings_->draw(frame);
    }
    makeCones(frame, ids);
    traversal_->beginFrame(frame);
    traversal_->trace(frame, {&*origins_, &*directions_, &ids}, "1");
    {
      const auto scope = frame.passes().open(kConeListsPass);
      lists_->make(*traversal_);
    }
    if (peeling_) {
      peel(frame, ids);
    } else {
      const auto scope = frame.passes().open(kConeCompositePass);
      composite(frame, ids, *composite_);
    }
    traversal_->endFrame();
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const gl::Texture counts(gl::Format::RGBA32F, frame.sizePx());
    counts.bindImage(kConeCountsImage, gl::Access::Write);
    composite(frame, frame.get<frame::TriangleIds>().texture(), *countComposite_);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    const Image of = counts.read(), shapes = shapes_->read();
    double cones = 0.0, met = 0.0, mostMet = 0.0, kept = 0.0, dropped = 0.0, error = 0.0, uncovered = 0.0;
    std::array<double, 4> kinds{};
    for (size_t i = 0; i < of.pixels(); ++i) {
      kinds[std::min(static_cast<size_t>(shapes.data[2 * i + 1]), size_t{3})] += 1.0;
      const float* px = &of.data[4 * i];
      if (px[0] < 0.0F) continue;
      cones += 1.0, met += px[0], kept += px[1], dropped += px[2];
      mostMet = std::max<double>(mostMet, px[0]);
      uncovered += 1.0 - px[3];
      error += std::abs(1.0 - px[3]);
    }
    const double each = cones > 0.0 ? 1.0 / cones : 0.0;
    const PairTraversal::Counts pairs = traversal_->counts();
    return {{"cones", cones},
            {"triangles_per_cone", met * each},
            {"triangles_per_cone_max", mostMet},
            {"kept_per_cone", kept * each},
            {"dropped_share", dropped * each},
            {"uncovered_share", uncovered * each},
            {"coverage_error", error * each},
            {"converging_cones", kinds[kConeConverging]},
            {"clamped_cones", kinds[kConeClamped]},
            {"cone_sphere_tests", static_cast<double>(pairs.tests)},
            {"tile_pairs", double(pairs.control.leafPairs)},
            {"groups_without_room", double(pairs.control.leftEver)},
            {"items_without_room", peeling_ ? std::max(double(peeling_->items()) - room(), 0.0) : 0.0}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter, neither = Direction::Neither;
    const std::string source = "Roger 2008, section 5.2";
    return {{"cones", "Pixels whose mirror sends a cone", "px", neither},
            {"triangles_per_cone", "Triangles that a cone meets", "triangles", neither, source},
            {"triangles_per_cone_max", "Triangles that the fullest cone meets", "triangles", neither, source},
            {"kept_per_cone", "Triangles of a cone that are kept", "triangles", lower, source},
            {"dropped_share", "Share of a cone that triangles left out fill, summed over them", "", lower,
             source},
            {"uncovered_share", "Share of a cone that nothing covers", "", neither, source},
            {"coverage_error", "Distance of a cone's coverage from 1", "", lower, source},
            {"converging_cones", "Cones that converge in front of the mirror", "px", neither,
             "Roger 2008, figure 5.3"},
            {"clamped_cones", "Cones that are too wide or miss the mirror with an edge", "px", lower, source},
            {"cone_sphere_tests", "Tests of nodes with spheres", "tests", lower, source},
            {"tile_pairs", "Pairs of tiles and triangles", "pairs", lower, source},
            {"groups_without_room", "Groups of pairs that found no room", "groups", lower, source},
            {"items_without_room", "Pairs of pixels and triangles without room to be peeled", "pairs", lower,
             source}};
  }

 private:
  double room() const { return std::get<PeeledLayers>(settings_.backEnd).room; }
  gl::ShaderDefines compositeDefines(frame::Frame& frame) const {
    gl::ShaderDefines defines = frame::mirrorTraceDefines(settings_.shading, frame);
    defines["LAYERS"] = std::to_string(settings_.layers);
    if (settings_.contribution == ConeContribution::Table) defines["TABLE"] = "1";
    if (settings_.coverage == ConeCoverage::Masked) defines["MASKED"] = "1";
    if (settings_.filterPatterns) defines["FILTERED"] = "1";
    if (lists_->rounds() > 1) defines["RESUMED"] = "1";
    defines.merge(fillDefines());
    return defines;
  }

  gl::ShaderDefines fillDefines() const {
    if (std::holds_alternative<FillNothing>(settings_.fill)) return {{"UNFILLED", "1"}};
    if (std::holds_alternative<FillRescaled>(settings_.fill)) return {{"RESCALED", "1"}};
    if (std::holds_alternative<FillEnvironment>(settings_.fill)) return {{"ENVIRONMENT", "1"}};
    return {};
  }

  void peel(frame::Frame& frame, const gl::Texture& ids) const {
    {
      const auto scope = frame.passes().open(kConeCompositePass);
      peeling_->begin();
      peeling_->configure(*items_);
      composite(frame, ids, *items_);
    }
    peeling_->peel(frame, settings_.layers);
    const auto scope = frame.passes().open("reflections/fill");
    finish_->set("sizePx", frame.sizePx());
    peeling_->configure(*finish_);
    bindEnvironment(*finish_);
    origins_->bindTexture(kConeOriginsUnit);
    directions_->bindTexture(kConeDirectionsUnit);
    peeling_->result().bindTexture(kPeelLayerUnit);
    reflected_->bindImage(kConeImage, gl::Access::Write);
    finish_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  void bindEnvironment(const gl::Program& program) const {
    if (!surroundings_) return;
    surroundings_->map().bindCube(kConeEnvironmentUnit);
    program.set("environmentTexels", float(surroundings_->map().resolution()));
  }

  /// No cone is longer than one of the smallest gloss.
  void setFarthest(frame::Frame& frame) {
    if (!(settings_.farRadius > 0.0)) return;
    double least = kWidestCone;
    for (const scene::Material& material : frame.scene().materials)
      if (material.reflects()) least = std::min(least, settings_.glossScale * material.glossRad);
    const double radius = settings_.farRadius * frame.gpuScene().diagonal();
    if (least > 0.0) traversal_->setFarthest(static_cast<float>(std::min(radius / std::tan(least), 1e37)));
  }

  void makeCones(frame::Frame& frame, const gl::Texture& ids) const {
    const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
    const auto scope = frame.passes().open(kConesPass);
    frame::configureSurfacePoints(*cones_, frame, frame.camera());
    cones_->set("glossScale", static_cast<float>(settings_.glossScale));
    cones_->set("widest", static_cast<float>(kWidestCone));
    rays.origins().bindTexture(kConeRayOriginsUnit);
    rays.directions().bindTexture(kConeRayDirectionsUnit);
    ids.bindTexture(kConeIdsUnit);
    solidAngles_->bindTexture(kConeSolidAnglesUnit);
    origins_->bindImage(kConeOriginsImage, gl::Access::Write);
    directions_->bindImage(kConeDirectionsImage, gl::Access::Write);
    shapes_->bindImage(kConeShapesImage, gl::Access::Write);
    cones_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  void composite(frame::Frame& frame, const gl::Texture& ids, const gl::Program& program) const {
    frame::configureShading(program, frame, settings_.shading);
    frame::configureRayOrigins(program, frame.gpuScene());
    program.set("flatShading", settings_.shading.smoothNormals ? 0 : 1);
    program.set("tileCount", traversal_->tileCount());
    program.set("triangleCount", frame.gpuScene().triangleCount());
    program.set("leafLevel", traversal_->leafLevel());
    program.set("leastShare", static_cast<float>(settings_.leastShare));
    program.set("farRadius", static_cast<float>(settings_.farRadius * frame.gpuScene().diagonal()));
    program.set("tableSide", float(kTableSide));
    program.set("tableLayers", float(kTableLayers));
    origins_->bindTexture(kConeOriginsUnit);
    directions_->bindTexture(kConeDirectionsUnit);
    ids.bindTexture(kConeIdsUnit);
    shapes_->bindTexture(kConeShapesUnit);
    bindEnvironment(program);
    if (table_) table_->bindTexture(kConeTableUnit);
    mask_->bindTexture(kConeMaskUnit);
    traversal_->spheres().bindStorage(kConeSpheresBuffer);
    lists_->lists().bindStorage(kConeListsBuffer);
    reflected_->bindImage(kConeImage, gl::Access::Write);
    if (state_)
      compositeInRounds(program, frame.sizePx());
    else
      program.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  /// The first round and the last one take all pixels; those between them only what lists are long enough
  /// for.
  void compositeInRounds(const gl::Program& program, glm::ivec2 sizePx) const {
    state_->bindImage(kConeStateImage, gl::Access::ReadWrite);
    const uint32_t rounds = lists_->rounds();
    for (uint32_t r = 0; r < rounds; ++r) {
      program.set("firstEntry", r * kConeEntriesPerRound);
      program.set("finishing", r + 1 == rounds ? 1 : 0);
      if (r == 0 || r + 1 == rounds) {
        program.dispatch(sizePx);
      } else {
        program.use();
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, lists_->roundDispatches().id());
        glDispatchComputeIndirect(GLintptr{12} * r);
      }
      glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  Settings settings_;
  ReflectionPicture picture_;
  const gl::Program *cones_ = nullptr, *composite_ = nullptr, *countComposite_ = nullptr, *items_ = nullptr,
                    *finish_ = nullptr;
  std::optional<ConePeeling> peeling_;
  std::optional<Surroundings> surroundings_;
  std::optional<PairTraversal> traversal_;
  std::optional<ConeLists> lists_;
  std::optional<gl::Texture> origins_, directions_, shapes_, reflected_, solidAngles_, mask_, table_, state_;
};

const RegisteredTechnique<ConeTraced> kConeTracedRegistered{
    {.name = "reflections/cone_traced",
     .version = 2,
     .summary = "Glossy and antialiased mirrors by one cone for each pixel",
     .source = "Roger 2008, chapter 5 (R-37 to R-52)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .counters = ConeTraced::quantities()}};

}  // namespace
}  // namespace limen::techniques
