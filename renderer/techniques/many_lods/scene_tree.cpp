// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/scene_tree.h"

#include <epoxy/gl.h>

#include <chrono>
#include <string>

#include "experiments/base/error.h"
#include "renderer/frame/surface_point.h"
#include "renderer/many_lods/unbalanced_tree.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines leafDefines(const frame::ShadedSetting& shading, const frame::Frame& frame, bool linked) {
  gl::ShaderDefines defines = frame::shadingDefines(shading, frame);
  defines.merge(frame::surfaceDefines(frame, shading.smoothNormals));
  defines.erase("SHADOW");
  if (linked) defines["LINKED"] = "1";
  return defines;
}

}  // namespace

const SettingsTable<TreeSettings>& TreeSettings::table() {
  using S = TreeSettings;
  static const SettingsTable<S> kTable = {
      {&S::levels,
       "levels",
       {4, 21},
       "",
       "Levels of the tree below its root: 2^levels points",
       "Holländer 2013, section 3.5.3 (n = 2^d; 2^19 to 2^21)"},
      {&S::leafScale,
       "leaf_scale",
       {0.5, 8.0},
       "",
       "Radius of points over that of a disc of the area that each stands for; larger closes holes",
       "Holländer 2013, section 3.5.3 (a radius from the density; the factor is not given)"},
      {&S::seed, "seed", {0, 1000000}, "", "Seed of the points' places"},
      {&S::update, "update", "Bring the tree up to date in each frame even if nothing moves",
       "Holländer 2013, section 3.5.3"},
      {&S::discs, "discs", "What stands for a node in a view",
       "Holländer 2013, section 3.4.1 (cones of normals); the thesis draws points as large as spheres"}};
  return kTable;
}

const SettingsTable<CutLimits>& CutLimits::table() {
  using S = CutLimits;
  static const SettingsTable<S> kTable = {
      {&S::epsilonPx,
       "epsilon",
       {0.25, 64.0},
       "px",
       "Diameter on the screen below which a node is fine enough",
       "Holländer 2013, table 3.2 (1, 2 and 4)"},
      {&S::room,
       "room",
       {1, 4194304},
       "",
       "Nodes that a cut may have on average over the views; splits beyond are not done, and counted",
       "Holländer 2013, section 3.7.2 (worst case: views x leaves)"}};
  return kTable;
}

uint32_t CutLimits::capacity(uint32_t views) const {
  const int64_t entries = room * views;
  if (entries > int64_t{1} << 31)
    throw Error("cuts of " + std::to_string(views) + " views with " + std::to_string(room) +
                    " nodes each are more than lists hold",
                "room", "lower the room or the number of views");
  return static_cast<uint32_t>(entries);
}

SceneTree::SceneTree(frame::Frame& frame, const TreeSettings& settings, bool balanced) : settings_(settings) {
  const auto start = std::chrono::steady_clock::now();
  const scene::Scene& scene = frame.scene();
  const auto build = balanced ? &many_lods::buildSphereTree : &many_lods::buildUnbalancedTree;
  const many_lods::SphereTree tree =
      build(scene.mesh.positions, scene.mesh.triangles, frame.gpuScene().anchor(),
            {settings.levels, settings.leafScale, static_cast<uint64_t>(settings.seed)});
  buildMs_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  tree_.emplace(frame.context(), tree);
  frame.passes().setBytesHeld(kUpdatePass, tree_->bytes());
}

many_lods::MultiCut SceneTree::cutsFor(frame::Frame& frame, uint32_t views, const CutLimits& limits,
                                       const many_lods::CutMode& mode) {
  if (many_lods::wantsTravel(mode)) tree_->keepTravel(frame.context(), !frame.scene().motions.empty());
  return {frame.context(), views, tree_->shape(), limits.capacity(views), mode};
}

void SceneTree::update(frame::Frame& frame) const {
  if (!settings_.update && frame.scene().motions.empty()) return;
  const auto scope = frame.passes().open(kUpdatePass);
  tree_->update(frame.positions(), frame.gpuScene().indices(), settings_.discs == many_lods::Discs::Oriented);
}

many_lods::ViewAtlas::Settings SceneTree::discs(double nearest, float radiusScale) const {
  return {.nearest = static_cast<float>(nearest) * tree_->leafRadius(),
          .radiusScale = radiusScale,
          .cones = settings_.discs == many_lods::Discs::Oriented ? &tree_->cones() : nullptr};
}

TreeLight::TreeLight(frame::Frame& frame, const many_lods::GpuTree& tree, const frame::ShadedSetting& shading)
    : shading_(shading),
      program_(
          frame.context().programs().compute("renderer/techniques/many_lods/leaf_colours.comp.glsl",
                                             leafDefines(shading, frame, tree.shape().links != nullptr))),
      values_(frame.context(), tree) {
  frame.passes().setBytesHeld(kLightPass, values_.values().bytes());
}

void TreeLight::make(frame::Frame& frame, const many_lods::GpuTree& tree) const {
  const auto scope = frame.passes().open(kLightPass);
  frame::configureShading(program_, frame, shading_);
  // Of a tree that is not complete, all nodes, of which the inner ones have no sample.
  const uint32_t leaves = (tree.shape().links ? 2U : 1U) << tree.depth();
  program_.set("leaves", leaves);
  tree.samples().bindStorage(kLeafSamplesBuffer);
  values_.values().bindStorage(kLeafColoursBuffer);
  program_.use();
  glDispatchCompute((leaves + kLeafColoursGroup - 1) / kLeafColoursGroup, 1, 1);
  values_.average();
}

std::vector<Counter> cutCounters(const many_lods::CutControl& control, uint32_t views,
                                 const SceneTree& tree) {
  std::vector<Counter> out = {{"cut_nodes", double(control.count)},
                              {"cut_nodes_per_view", double(control.count) / views},
                              {"refused_splits", double(control.refused)},
                              {"points", double(1U << tree.tree().depth())},
                              {"tree_build_ms", tree.buildMs()}};
  // Every cut takes a test; forms that count none leave this out.
  if (control.tests > 0) {
    out.push_back({"predicates", double(control.tests)});
    out.push_back({"splits", double(control.splits)});
    out.push_back({"merges", double(control.merges)});
  }
  return out;
}

std::vector<Quantity> cutQuantities() {
  const Direction lower = Direction::LowerIsBetter;
  return {{"cut_nodes", "Nodes of all cuts", "", lower},
          {"cut_nodes_per_view", "Nodes of a cut", "", lower},
          {"points", "Points of the tree", "", Direction::Neither},
          {"predicates", "Nodes tested in a frame", "", lower},
          {"splits", "Nodes split in a frame", "", lower},
          {"merges", "Pairs merged in a frame", "", lower},
          {"refused_splits", "Splits in a frame that the list had no room for", "", lower},
          {"tree_build_ms", "Time to build the tree, once, on the CPU", "ms", lower}};
}

}  // namespace limen::techniques
