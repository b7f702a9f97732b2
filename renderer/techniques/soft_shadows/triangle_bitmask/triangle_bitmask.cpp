// SPDX-License-Identifier: BSD-3-Clause
// Accurate soft shadows with triangle bitmasks (SS-09), the upper end of quality that the thesis's outlook
// calls for. The rasterising forms that it reviews (Eisemann and Décoret 2007, Sintorn et al. 2008) scatter
// each triangle to the receivers in its influence region; here each receiver gathers through a hierarchy of
// the triangles, which needs neither a planar receiver nor several passes.
//
// Whatever lies behind the receiver's own plane is hidden, and so is whatever lies behind a triangle: a
// triangle that extends behind the receiver or through the light's plane hides what its part between them
// hides.
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask_bindings.h"
#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bvh.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kTriangleShader =
                         "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask.comp.glsl",
                     *kTrianglePass = "soft_shadows/triangle_bitmask",
                     *kBvhPass = "soft_shadows/triangle_bvh";
/// A plane this near to a point, relative to the scene's reach, counts as passing through it. Corners and
/// point are rounded to 2^-25 of their coordinates on each axis, and the point is projected onto its plane by
/// a product of two such numbers: below 2^-22 together.
constexpr float kPlaneTolerance = 0x1p-22F;
/// As references::kLightMargin: what lies in the light's plane up to rounding hides nothing.
constexpr float kLightMargin = 1e-6F;

/// The scene's triangles in light space, relative to the largest finite coordinate.
struct LightSpaceTriangles {
  std::vector<Corners3> corners;
  std::vector<glm::vec4> planes;  ///< unit normal, and its product with a point of the plane; 0: no area
  double reach = 0.0;
};

LightSpaceTriangles lightSpaceTriangles(frame::Frame& frame) {
  const scene::Scene& scene = frame.scene();
  const glm::dvec3 anchor = frame.gpuScene().anchor();
  const glm::dmat4 toLight = scene.lights.at(0).toLightSpace(anchor);
  LightSpaceTriangles out;
  std::vector<glm::dvec3> places;
  places.reserve(scene.mesh.positions.size());
  for (const glm::dvec3& position : scene.mesh.positions) {
    // From the same float positions as everything else.
    places.emplace_back(toLight * glm::dvec4(glm::vec3(position - anchor), 1.0));
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(places.back()[axis])) out.reach = std::max(out.reach, std::abs(places.back()[axis]));
  }
  if (!(out.reach > 0.0)) out.reach = 1.0;
  out.corners.reserve(scene.mesh.triangles.size());
  out.planes.reserve(scene.mesh.triangles.size());
  for (const glm::uvec3& triangle : scene.mesh.triangles) {
    const glm::dvec3 a = places[triangle.x] / out.reach, b = places[triangle.y] / out.reach,
                     c = places[triangle.z] / out.reach;
    out.corners.push_back({glm::vec3(a), glm::vec3(b), glm::vec3(c)});
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    out.planes.push_back(length > 0.0 && std::isfinite(length)
                             ? glm::vec4(n / length, glm::dot(n / length, a))
                             : glm::vec4(0.0F));
  }
  return out;
}

std::vector<Counter> summariseTriangles(const std::vector<uint32_t>& counts) {
  std::array<double, ClassCount> pixels{};
  double nodes = 0.0, tested = 0.0, reached = 0.0;
  for (size_t i = 0; i < counts.size(); i += 4) {
    pixels.at(counts[i]) += 1.0;
    nodes += counts[i + 1], tested += counts[i + 2], reached += counts[i + 3];
  }
  if (pixels[CutShort] > 0.0)
    throw Error(shortestNumber(pixels[CutShort]) +
                    " pixels need more loop iterations than this software renderer allows",
                {}, "take a scene with fewer triangles, or run on a GPU");
  const double all = static_cast<double>(counts.size()) / 4.0, receivers = all - pixels[NotReceiver];
  const auto share = [&](double part) { return all > 0.0 ? part / all : 0.0; };
  const auto perReceiver = [&](double sum) { return receivers > 0.0 ? sum / receivers : 0.0; };
  return {{"nodes_per_receiver", perReceiver(nodes)},
          {"triangles_per_receiver", perReceiver(tested)},
          {"masks_per_receiver", perReceiver(reached)},
          {"receivers_share", share(receivers)},
          {"lit_share", share(pixels[Lit])},
          {"umbra_share", share(pixels[Umbra])},
          {"processed_share", share(pixels[Processed])}};
}

}  // namespace

const SettingsTable<TriangleBitmaskSettings>& TriangleBitmaskSettings::table() {
  static const SettingsTable<TriangleBitmaskSettings> kTable = {
      {&TriangleBitmaskSettings::pattern, "pattern",
       "Light samples: regular grids, or 16 x 16 in rotated pairs",
       "Schwarz 2009, sections 4.2.1 and 4.2.2"}};
  return kTable;
}

TriangleBitmask::TriangleBitmask(const TriangleBitmaskSettings& settings) : pattern_(settings.pattern) {
  defineSamples(defines_, lightPattern(pattern_));
}

void TriangleBitmask::prepare(frame::Frame& frame) {
  program_ = &frame.context().programs().compute(kTriangleShader, defines_);
  visibility_.emplace(gl::Format::R32F, frame.sizePx());
  frame.passes().setBytesHeld(kTrianglePass, visibility_->bytes());

  const std::vector<uint32_t> shape =
      lightMask(frame.scene().lights.at(0), lightSamples(lightPattern(pattern_)));
  lightSamples_ = bitCount(shape);
  lightShape_.emplace(shape);

  const LightSpaceTriangles scene = lightSpaceTriangles(frame);
  reach_ = scene.reach;
  triangleCount_ = static_cast<uint32_t>(scene.corners.size());
  const TriangleBvh bvh = buildTriangleBvh(scene.corners);
  nodes_.emplace(bvh.nodes), triangles_.emplace(bvh.triangles), planes_.emplace(scene.planes);
  frame.passes().setBytesHeld(kBvhPass, nodes_->bytes() + triangles_->bytes() + planes_->bytes());
}

void TriangleBitmask::run(frame::Frame& frame, const gl::Program& program, const Work* work) {
  const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  const auto scope = frame.passes().open(kTrianglePass);
  program.set("sizePx", frame.sizePx());
  program.set("lightSize", glm::vec2(frame.scene().lights[0].size / reach_));
  const glm::dmat4 toLight = frame.scene().lights[0].toLightSpace(frame.gpuScene().anchor());
  program.set("eye",
              glm::vec3(toLight * glm::inverse(frame.anchorToCamera()) * glm::dvec4(0, 0, 0, 1) / reach_));
  program.set("reach", static_cast<float>(reach_));
  program.set("planeTolerance", kPlaneTolerance);
  program.set("lightMargin", kLightMargin);
  program.set("lightSamples", lightSamples_);
  program.set("triangleCount", triangleCount_);
  program.set("maxIterations", frame.context().device().software ? 60000 : 0x7fffffff);
  receivers.bindTexture(kTriangleBitmaskReceiversUnit);
  ids.bindTexture(kTriangleBitmaskIdsUnit);
  nodes_->bindStorage(kTriangleBitmaskNodesBuffer);
  triangles_->bindStorage(kTriangleBitmaskTrianglesBuffer);
  planes_->bindStorage(kTriangleBitmaskPlanesBuffer);
  lightShape_->bindStorage(kTriangleBitmaskLightShapeBuffer);
  visibility_->bindImage(kTriangleBitmaskVisibilityImage, gl::Access::Write);
  if (work) {
    work->counts.bindImage(kTriangleBitmaskCountsImage, gl::Access::Write);
    work->masks.bindStorage(kTriangleBitmaskMasksBuffer);
  }
  program.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

void TriangleBitmask::render(frame::Frame& frame) { run(frame, *program_, nullptr); }

std::vector<Quantity> TriangleBitmask::counters() {
  std::vector<Quantity> all = {
      {"nodes_per_receiver", "Nodes visited per receiver", "1/px", Direction::LowerIsBetter},
      {"triangles_per_receiver", "Triangles tested per receiver", "1/px", Direction::LowerIsBetter},
      {"masks_per_receiver", "Triangles that cover light samples, per receiver", "1/px",
       Direction::LowerIsBetter}};
  for (Quantity& share : pixelShares()) all.push_back(std::move(share));
  all.push_back(structureBytes());
  return all;
}

std::vector<Counter> TriangleBitmask::count(frame::Frame& frame) {
  gl::ShaderDefines defines = defines_;
  defines["COUNT"] = "1";
  const int64_t pixels = int64_t{frame.sizePx().x} * frame.sizePx().y;
  const Work work{gl::Texture(gl::Format::RGBA32UI, frame.sizePx()),
                  gl::Buffer(pixels * lightShape_->bytes(), nullptr)};
  frame.begin();
  run(frame, frame.context().programs().compute(kTriangleShader, defines), &work);
  frame.end();
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  masks_ = work.masks.read<uint32_t>();
  std::vector<Counter> all = summariseTriangles(work.counts.readUint());
  all.push_back(
      {structureBytes().name, static_cast<double>(nodes_->bytes() + triangles_->bytes() + planes_->bytes())});
  return all;
}

namespace {

const RegisteredTechnique<TriangleBitmask> kTriangleBitmaskRegistered{
    {.name = "soft_shadows/triangle_bitmask",
     .version = 1,
     .summary = "Light samples hidden by the scene's own triangles, found through a hierarchy",
     .source = "Schwarz 2009, section 3.3 and outlook (SS-09)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = TriangleBitmask::counters()}};

}  // namespace
}  // namespace limen::techniques
