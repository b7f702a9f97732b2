// SPDX-License-Identifier: BSD-3-Clause
// Mirrored rays through the tree of the scene's triangles, on the GPU: what modern ray tracers do, and the
// rival of all others. The tree is built on the CPU before the first frame, or by the GPU in each frame, or
// is refitted in each. Source of the light model: Roger 2008, sections 1.2.2 and 3.1.
#include <epoxy/gl.h>

#include <optional>
#include <variant>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_path.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/frame/mirror_trace.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/ray_tracing/rebuilt_tree.h"
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kTracePass = "reflections/trace";

struct KeptTree {
  static constexpr const char *kKind = "kept",
                              *kSummary = "built on the CPU before the first frame, for scenes at rest";
  static const SettingsTable<KeptTree>& table() {
    static const SettingsTable<KeptTree> kTable = {};
    return kTable;
  }
};
constexpr const char* kCodeBitsText = "Of the Morton codes by which triangles are sorted";
struct TreeOfFrame {
  static constexpr const char *kKind = "rebuilt", *kSummary = "built by the GPU in every frame";
  int codeBits = 48;
  static const SettingsTable<TreeOfFrame>& table() {
    static const SettingsTable<TreeOfFrame> kTable = {
        {&TreeOfFrame::codeBits, "code_bits", oneOf({30, 48, 63}), "bits", kCodeBitsText, "Karras 2012"}};
    return kTable;
  }
};
struct RefittedTree {
  static constexpr const char *kKind = "refitted",
                              *kSummary = "shape built by the GPU in the first frame, boxes in every frame";
  int codeBits = 48;
  static const SettingsTable<RefittedTree>& table() {
    static const SettingsTable<RefittedTree> kTable = {
        {&RefittedTree::codeBits, "code_bits", oneOf({30, 48, 63}), "bits", kCodeBitsText, "Karras 2012"}};
    return kTable;
  }
};
using MirrorTree = std::variant<KeptTree, TreeOfFrame, RefittedTree>;

struct RayTracedSettings {
  frame::MirrorPathSettings path;
  MirrorTree tree;
  bool refraction = false;
  frame::ShadedSetting shading;
  static const SettingsTable<RayTracedSettings>& table() {
    using S = RayTracedSettings;
    static const SettingsTable<S> kTable = {
        included(&S::path),
        {&S::tree, "tree", "Where the tree over the triangles comes from"},
        {&S::refraction, "refraction", frame::kRefractionText, frame::kRefractionSource},
        shadingBinding(&S::shading)};
    return kTable;
  }
};

class RayTracedReflections : public Technique {
 public:
  using Settings = RayTracedSettings;
  explicit RayTracedReflections(const RayTracedSettings& settings)
      : settings_(settings), picture_(settings.shading, settings.refraction) {}

  void prepare(frame::Frame& frame) override {
    gl::ShaderDefines defines = frame::mirrorTraceDefines(settings_.shading, frame);
    if (settings_.refraction) defines["REFRACT"] = "1";
    program_ = &frame.context().programs().compute(
        "renderer/techniques/reflections/ray_traced/ray_traced.comp.glsl", defines);
    reflected_.emplace(gl::Format::RGBA32F, frame.sizePx());
    const int bits = codeBits();
    if (bits > 0) device_.emplace(frame.context(), frame.gpuScene().triangleCount(), bits / 3);
    frame.passes().setBytesHeld(
        kTracePass, reflected_->bytes() + (device_ ? 0 : frame.gpuScene().rays(frame.context()).bytes()));
    picture_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    const frame::MirrorRays& rays = frame::firstRays(frame, settings_.refraction);
    const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
    if (device_) buildTree(frame);
    {
      const auto scope = frame.passes().open(kTracePass);
      frame::configureMirrorTrace(*program_, frame, settings_.shading, device_ ? &*device_ : nullptr);
      program_->set("bounces", settings_.path.bounces);
      program_->set("shadows", settings_.path.shadows);
      program_->set("leastShare", static_cast<float>(settings_.path.leastShare));
      rays.origins().bindTexture(kReflectionOriginsUnit);
      rays.directions().bindTexture(kReflectionDirectionsUnit);
      ids.bindTexture(kReflectionIdsUnit);
      reflected_->bindImage(kReflectionImage, gl::Access::Write);
      program_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    picture_.compose(frame, *reflected_);
  }

  const gl::Texture& product() const override { return picture_.texture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    if (device_) {
      const ray_tracing::RebuiltTree::Counts counts = device_->counts();
      return {{"tree_nodes", double(counts.nodes)}, {"tree_levels", double(counts.levels)}};
    }
    const ray_tracing::RayScene& tree = frame.gpuScene().rays(frame.context());
    return {{"tree_build_ms", 1e3 * tree.buildS()},
            {"tree_nodes", double(tree.nodeCount())},
            {"tree_levels", double(tree.levels())}};
  }

 private:
  /// 0: the tree is kept.
  int codeBits() const {
    if (const auto* tree = std::get_if<TreeOfFrame>(&settings_.tree)) return tree->codeBits;
    if (const auto* tree = std::get_if<RefittedTree>(&settings_.tree)) return tree->codeBits;
    return 0;
  }

  void buildTree(frame::Frame& frame) {
    const gl::Buffer& positions = frame.positions();
    const gl::Buffer& indices = frame.gpuScene().indices();
    if (std::holds_alternative<RefittedTree>(settings_.tree) && isBuilt_)
      device_->refit(frame.passes(), positions, indices);
    else
      device_->build(frame.passes(), positions, indices);
    isBuilt_ = true;
  }

  RayTracedSettings settings_;
  ReflectionPicture picture_;
  const gl::Program* program_ = nullptr;
  std::optional<gl::Texture> reflected_;
  std::optional<ray_tracing::RebuiltTree> device_;
  bool isBuilt_ = false;
};

const RegisteredTechnique<RayTracedReflections> kRegistered{
    {.name = "reflections/ray_traced",
     .version = 2,
     .summary = "Mirrors by rays through a tree of the scene's triangles",
     .source = "Roger 2008, sections 1.2.2 and 3.1 (R-59)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = {
         {"tree_build_ms", "Time to build the tree, once, on the CPU", "ms", Direction::LowerIsBetter},
         {"tree_nodes", "Nodes of the tree, eight children each at most", "", Direction::LowerIsBetter},
         {"tree_levels", "Levels of the tree", "", Direction::LowerIsBetter}}}};

}  // namespace
}  // namespace limen::techniques
