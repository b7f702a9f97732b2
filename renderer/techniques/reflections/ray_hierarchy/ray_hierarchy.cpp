// SPDX-License-Identifier: BSD-3-Clause
// Reflections in fully dynamic scenes: a hierarchy over the rays that leave mirrors, none over the scene's
// triangles. Source: Roger 2008, chapter 3; Roger, Assarsson and Holzschuch 2007.
//
// Departures. A node stores the tangent of half its angle (cone_sphere.h). All triangles are tested with a
// level of up to `start_nodes` nodes at once. A group of invocations packs its pairs in its own memory and
// asks for room once, in place of a stream reduction. Groups without room follow their pairs to the rays at
// once, so that no frame loses any; the thesis shows wrong pictures until its batches have settled.
#include <epoxy/gl.h>

#include <array>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_path.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

enum class PrimaryRays { Raster, Traced };
constexpr EnumNames<PrimaryRays, 2> enumNames(PrimaryRays) {
  return {{{{PrimaryRays::Raster, "raster"}, {PrimaryRays::Traced, "traced"}}}};
}

struct RayHierarchySettings {
  frame::MirrorPathSettings path;
  PrimaryRays primary = PrimaryRays::Raster;
  bool refraction = false;
  TraversalSettings traversal;
  frame::ShadedSetting shading;
  static const SettingsTable<RayHierarchySettings>& table();
};

const SettingsTable<RayHierarchySettings>& RayHierarchySettings::table() {
  using S = RayHierarchySettings;
  static const SettingsTable<S> kTable = {
      included(&S::path),
      {&S::primary, "primary", "How the surfaces that pixels see are found",
       "raster in Roger 2008, section 3.2.2; both possible, section 3.3.5"},
      {&S::refraction, "refraction", frame::kRefractionText, frame::kRefractionSource},
      {&S::traversal, "traversal", "Rays against triangles"},
      shadingBinding(&S::shading)};
  return kTable;
}

/// Rays of one bounce, in textures of their own.
struct OwnRays {
  explicit OwnRays(glm::ivec2 size)
      : origins(gl::Format::RGBA32F, size),
        directions(gl::Format::RGBA32F, size),
        from(gl::Format::R32UI, size) {}
  RayTextures textures() const { return {&origins, &directions, &from}; }
  void bindImages() const {
    origins.bindImage(kHierarchyNextOriginsImage, gl::Access::Write);
    directions.bindImage(kHierarchyNextDirectionsImage, gl::Access::Write);
    from.bindImage(kHierarchyNextFromImage, gl::Access::Write);
  }
  int64_t bytes() const { return origins.bytes() + directions.bytes() + from.bytes(); }
  gl::Texture origins, directions, from;
};

void imageBarrier() { glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); }

class RayHierarchyReflections : public Technique {
 public:
  using Settings = RayHierarchySettings;
  explicit RayHierarchyReflections(const RayHierarchySettings& settings)
      : settings_(settings), picture_(settings.shading, settings.refraction) {}

  void prepare(frame::Frame& frame) override {
    const std::string folder = "renderer/techniques/reflections/ray_hierarchy/";
    gl::ProgramCache& cache = frame.context().programs();
    gl::ShaderDefines defines = frame::mirrorTraceDefines(settings_.shading, frame);
    if (settings_.refraction) defines["REFRACT"] = "1";
    shade_ = &cache.compute(folder + "shade.comp.glsl", defines);
    lit_ = !frame.scene().lights.empty();
    const bool shadows = lit_ && (settings_.path.shadows > 0 || (traced() && settings_.shading.shadow));
    if (shadows) {
      defines["POINTS"] = "1";
      points_ = &cache.compute(folder + "shade.comp.glsl", defines);
    }
    if (traced()) primary_ = &cache.compute(folder + "primary.comp.glsl");
    traversal_.emplace(frame, settings_.traversal, shadows);
    const glm::ivec2 size = frame.sizePx();
    // The first rays are the frame's, unless they are traced; then two in turn, and the shadows'.
    int64_t bytes = 0;
    for (std::optional<OwnRays>& rays : own_) bytes += rays.emplace(size).bytes();
    if (shadows) bytes += toLight_.emplace(size).bytes();
    sums_.emplace(gl::Format::RGBA32F, size);
    shares_.emplace(gl::Format::RGBA32F, size);
    frame.passes().setBytesHeld("reflections/shade_1",
                                bytes + sums_->bytes() + shares_->bytes() + traversal_->bytes());
    if (!traced()) picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    RayTextures rays{};
    if (traced()) {
      const auto scope = frame.passes().open("reflections/primary");
      primary_->set("sizePx", frame.sizePx());
      primary_->set("cameraToAnchor", glm::mat4(glm::inverse(frame.anchorToCamera())));
      primary_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
      own_[1]->bindImages();
      primary_->dispatch(frame.sizePx());
      imageBarrier();
      rays = own_[1]->textures();
    } else {
      const frame::MirrorRays& mirrors = frame::firstRays(frame, settings_.refraction);
      rays = {&mirrors.origins(), &mirrors.directions(), &frame.get<frame::TriangleIds>().texture()};
    }
    traversal_->beginFrame(frame);
    const int rounds = settings_.path.bounces + (traced() ? 1 : 0);
    for (int round = 0; round < rounds; ++round) {
      const std::string name = std::to_string(traced() ? round : round + 1);
      traversal_->trace(frame, rays, name);
      if (shadowed(round)) {
        {
          const auto scope = frame.passes().open("reflections/shadow_rays_" + name);
          shade(frame, *points_, rays, *toLight_, round, rounds);
        }
        const glm::vec3 light(frame.scene().lights[0].centre - frame.gpuScene().anchor());
        traversal_->trace(frame, toLight_->textures(), "shadows_" + name, &light);
      }
      const auto scope = frame.passes().open("reflections/shade_" + name);
      const OwnRays& next = *own_[static_cast<size_t>(round % 2)];
      shade(frame, *shade_, rays, next, round, rounds);
      rays = next.textures();
    }
    traversal_->endFrame();
    if (!traced()) picture_.compose(frame, *sums_);
  }

  const gl::Texture& product() const override { return traced() ? *sums_ : picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const PairTraversal::Counts counts = traversal_->counts();
    const HierarchyControl& control = counts.control;
    if (control.cutShort > 0)
      throw Error(
          "a triangle whose pairs found no room meets more nodes than this software renderer's loops allow",
          "traversal.capacity",
          "raise 'capacity', 'start_nodes' or 'leaf_side', render a smaller picture, or use a GPU");
    const double rays = static_cast<double>(raysOf(frame));
    const double tests = static_cast<double>(counts.tests), leaves = control.leafPairs;
    const double perLeaf = static_cast<double>(1U << (2 * traversal_->leafLevel()));
    double pairs = 0.0, most = 0.0;
    for (const uint32_t each : control.pairsAt) pairs += each, most = std::max<double>(most, each);
    return {{"cone_sphere_tests", tests},
            {"pairs", pairs},
            {"pairs_max", most},
            {"leaf_pairs", leaves},
            {"triangles_per_ray", rays > 0.0 ? leaves * perLeaf / rays : 0.0},
            {"mirror_rays", rays},
            {"batches", double(counts.batches)},
            {"groups_without_room", double(control.leftEver)},
            {"pairs_spilled", double(control.spilledEver)},
            {"later_batches", double(control.laterBatches)}};
  }

  static std::vector<Quantity> quantities() {
    const Direction lower = Direction::LowerIsBetter;
    const std::string source = "Roger 2008, section 3.5";
    return {{"cone_sphere_tests", "Tests of nodes with spheres, but of pairs without room", "tests", lower,
             source},
            {"pairs", "Pairs of nodes and triangles, all levels", "pairs", lower, source},
            {"pairs_max", "Pairs of the level with the most", "pairs", lower, source},
            {"leaf_pairs", "Pairs at the last level, but of those without room", "pairs", lower, source},
            {"triangles_per_ray", "Triangles tested per mirrored ray of the first bounce", "triangles", lower,
             source},
            {"mirror_rays", "Rays of the first bounce", "rays", Direction::Neither},
            {"batches", "Batches of triangles", "", lower, source},
            {"groups_without_room", "Groups of pairs that found no room", "groups", lower, source},
            {"pairs_spilled", "Pairs that waited for a later batch", "pairs", lower, source},
            {"later_batches", "Later batches that had pairs", "", lower, source}};
  }

 private:
  bool traced() const { return settings_.primary == PrimaryRays::Traced; }
  /// What traced primary rays meet is shadowed as Shaded would, but by rays.
  bool shadowed(int round) const {
    if (!lit_) return false;
    if (!traced()) return round < settings_.path.shadows;
    return round == 0 ? settings_.shading.shadow : round <= settings_.path.shadows;
  }

  void shade(frame::Frame& frame, const gl::Program& program, const RayTextures& rays, const OwnRays& next,
             int round, int rounds) const {
    frame::configureShading(program, frame, settings_.shading);
    program.set("first", round == 0 ? 1 : 0);
    program.set("last", round + 1 == rounds ? 1 : 0);
    program.set("traced", traced() ? 1 : 0);
    program.set("leastShare", static_cast<float>(settings_.path.leastShare));
    program.set("flatShading", settings_.shading.smoothNormals ? 0 : 1);
    configureRayOrigins(program, frame.gpuScene());
    if (!traced()) {
      frame::firstRays(frame, settings_.refraction).directions().bindTexture(kHierarchySeenUnit);
      frame.get<frame::TriangleIds>().texture().bindTexture(kHierarchySeenIdsUnit);
    }
    traversal_->hits().bindStorage(kHierarchyHitsBuffer);
    rays.origins->bindTexture(kHierarchyOriginsUnit);
    rays.directions->bindTexture(kHierarchyDirectionsUnit);
    rays.from->bindTexture(kHierarchyFromUnit);
    next.bindImages();
    sums_->bindImage(kHierarchySumsImage, gl::Access::ReadWrite);
    shares_->bindImage(kHierarchySharesImage, gl::Access::ReadWrite);
    program.dispatch(frame.sizePx());
    imageBarrier();
  }

  int64_t raysOf(frame::Frame& frame) const {
    if (traced()) return int64_t{frame.sizePx().x} * frame.sizePx().y;
    const Image origins = frame::firstRays(frame, settings_.refraction).origins().read();
    int64_t rays = 0;
    for (size_t i = 3; i < origins.data.size(); i += 4) rays += origins.data[i] > 0.0F;
    return rays;
  }

  RayHierarchySettings settings_;
  ReflectionPicture picture_;
  const gl::Program *shade_ = nullptr, *points_ = nullptr, *primary_ = nullptr;
  bool lit_ = false;
  std::optional<PairTraversal> traversal_;
  std::array<std::optional<OwnRays>, 2> own_;
  std::optional<OwnRays> toLight_;
  std::optional<gl::Texture> sums_, shares_;
};

const RegisteredTechnique<RayHierarchyReflections> kRayHierarchyRegistered{
    {.name = "reflections/ray_hierarchy",
     .version = 3,
     .summary = "Mirrors by a hierarchy over the rays, for scenes without a structure over their triangles",
     .source = "Roger 2008, chapter 3 (R-13 to R-26)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = RayHierarchyReflections::quantities()}};

}  // namespace
}  // namespace limen::techniques
