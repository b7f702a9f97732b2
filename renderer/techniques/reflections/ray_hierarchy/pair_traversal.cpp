// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

const std::string kHierarchyFolder = "renderer/techniques/reflections/ray_hierarchy/";
constexpr const char* kSpheresPass = "reflections/spheres";
/// Of triangles and first nodes in one batch, so that counts fit a word.
constexpr int64_t kMostFirstPairs = int64_t{1} << 31;

void storageBarrier() { glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT); }

void dispatchRows(const gl::Program& program, int64_t groups) {
  if (groups <= 0) return;
  program.use();
  const int64_t across = std::min<int64_t>(groups, kDispatchRow);
  glDispatchCompute(static_cast<GLuint>(across), static_cast<GLuint>((groups + across - 1) / across), 1);
}

int64_t groupsFor(int64_t items) { return (items + kTraversalGroup - 1) / kTraversalGroup; }

int log2Of(int power) {
  int out = 0;
  while ((1 << out) < power) ++out;
  return out;
}

gl::ShaderDefines with(gl::ShaderDefines defines, std::initializer_list<const char*> names) {
  for (const char* name : names) defines[name] = "1";
  return defines;
}

}  // namespace

const SettingsTable<HalvedBatches>& HalvedBatches::table() {
  static const SettingsTable<HalvedBatches> kTable = {{&HalvedBatches::mostBatches,
                                                       "most_batches",
                                                       {1, kHierarchyMostBatches},
                                                       "",
                                                       "Batches of triangles at most",
                                                       "Roger 2008, section 3.3.4"}};
  return kTable;
}
const SettingsTable<SpilledPairs>& SpilledPairs::table() {
  static const SettingsTable<SpilledPairs> kTable = {{&SpilledPairs::room,
                                                      "room",
                                                      {1, 1 << 25},
                                                      "pairs",
                                                      "Pairs that may wait for a later batch",
                                                      "Roger 2008, section 3.3.4"}};
  return kTable;
}
const SettingsTable<FixedBatches>& FixedBatches::table() {
  static const SettingsTable<FixedBatches> kTable = {{&FixedBatches::triangles,
                                                      "triangles",
                                                      {1, 1 << 25},
                                                      "",
                                                      "Triangles of a batch",
                                                      "Roger 2008, section 3.3.4"}};
  return kTable;
}

const SettingsTable<TraversalSettings>& TraversalSettings::table() {
  using S = TraversalSettings;
  static const SettingsTable<S> kTable = {
      {&S::merge, "merge", "How nodes enclose their children", "open in Roger 2008"},
      {&S::test, "test", "How a node is tested against a triangle's sphere",
       "Roger 2008, equation 3.1, corrected"},
      {&S::startNodes,
       "start_nodes",
       {1, 65536},
       "nodes",
       "Nodes at most on the level that all triangles are tested with first; 1 is the root",
       "1 in Roger 2008, section 3.3.3; more are the bench's own"},
      {&S::leafSide, "leaf_side", oneOf({1, 2, 4, 8}), "rays",
       "Side of the nodes whose rays are tested with a triangle itself",
       "1 in Roger 2008, section 3.3.3; more are the bench's own"},
      {&S::capacity,
       "capacity",
       {1, 1 << 25},
       "pairs",
       "Pairs of nodes and triangles that a stream has room for",
       "2048 x 2048 in Roger 2008, section 3.3.4"},
      {&S::overflow, "overflow", "What happens when pairs find no room"}};
  return kTable;
}

PairTraversal::PairTraversal(frame::Frame& frame, const TraversalSettings& settings, bool shadows)
    : settings_(settings),
      sizePx_(frame.sizePx()),
      triangleCount_(frame.gpuScene().triangleCount()),
      mostIterations_(frame.context().device().software ? 60000 : 0x7fffffff),
      hits_((int64_t{sizePx_.x} * sizePx_.y + 1) * 8, nullptr),
      readback_(sizeof(HierarchyControl)) {
  if (std::max(sizePx_.x, sizePx_.y) > kHierarchyMostSide)
    throw Error("a hierarchy over rays takes pictures of at most 16384 pixels a side", {},
                "render a smaller picture");
  uint32_t nodes = 0;
  for (uint32_t level = 0; level < kHierarchyLevels; ++level) {
    levelFirst_.push_back(nodes);
    const glm::ivec2 size = levelSize(level);
    nodes += static_cast<uint32_t>(size.x) * static_cast<uint32_t>(size.y);
    if (size == glm::ivec2(1)) break;
  }
  leafLevel_ = static_cast<uint32_t>(log2Of(settings.leafSide));
  leafLevel_ = std::min(leafLevel_, static_cast<uint32_t>(levelFirst_.size() - 1));
  startLevel_ = leafLevel_;
  const auto nodesAt = [&](uint32_t level) { return levelSize(level).x * levelSize(level).y; };
  while (nodesAt(startLevel_) > settings.startNodes) ++startLevel_;

  const int64_t most = kMostFirstPairs / (4 * nodesAt(startLevel_));
  int64_t batch = std::min<int64_t>(std::max(triangleCount_, 1U), most);
  if (const auto* fixed = std::get_if<FixedBatches>(&settings.overflow))
    batch = std::min<int64_t>(batch, fixed->triangles);
  if (const auto* halved = std::get_if<HalvedBatches>(&settings.overflow))
    mostBatches_ = static_cast<uint32_t>(halved->mostBatches);
  for (int64_t first = 0; first < triangleCount_; first += batch)
    batches_.push_back({static_cast<uint32_t>(first),
                        static_cast<uint32_t>(std::min<int64_t>(batch, triangleCount_ - first))});
  if (batches_.size() > kHierarchyMostBatches)
    throw Error("a hierarchy over rays with " + std::to_string(batches_.size()) +
                    " batches of triangles; at most " + std::to_string(kHierarchyMostBatches) + " are kept",
                {}, "let a batch have more triangles");

  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  const int64_t pairBytes = int64_t{settings.capacity} * 2 * 8;
  if (pairBytes > largest)
    throw Error("two streams of pairs take " + std::to_string(pairBytes) +
                    " bytes in one buffer; this device allows " + std::to_string(largest),
                {}, "lower the capacity");
  nodes_.emplace(int64_t{nodes} * kConeSphereBytes, nullptr);
  spheres_.emplace(int64_t{triangleCount_} * 16, nullptr);
  pairs_.emplace(pairBytes, nullptr);
  control_.emplace(int64_t{sizeof(HierarchyControl)}, nullptr);
  const glm::ivec2 above = levelSize(startLevel_ + 1);
  left_.emplace(
      std::max(groupsFor(settings.capacity), groupsFor(batch) * int64_t{above.x} * above.y) * int64_t{4},
      nullptr);
  hits_.clearUint(0);

  gl::ShaderDefines defines;
  defineEnum(defines, "MERGE", settings.merge);
  defineEnum(defines, "TEST", settings.test);
  gl::ProgramCache& cache = frame.context().programs();
  spheresProgram_ = &cache.compute(kHierarchyFolder + "spheres.comp.glsl");
  buildProgram_ = &cache.compute(kHierarchyFolder + "build.comp.glsl", defines);
  controlProgram_ = &cache.compute(kHierarchyFolder + "control.comp.glsl");
  const std::string expand = kHierarchyFolder + "expand.comp.glsl";
  nearest_ = {&cache.compute(expand, with(defines, {"START"})), &cache.compute(expand, defines),
              &cache.compute(expand, with(defines, {"START", "FINISH"})),
              &cache.compute(expand, with(defines, {"FINISH"})),
              &cache.compute(kHierarchyFolder + "resolve.comp.glsl", defines)};
  if (shadows) {
    shadow_ = nearest_;
    shadow_.finishStart = &cache.compute(expand, with(defines, {"START", "FINISH", "SHADOW"}));
    shadow_.finish = &cache.compute(expand, with(defines, {"FINISH", "SHADOW"}));
    shadow_.resolve = &cache.compute(kHierarchyFolder + "resolve.comp.glsl", with(defines, {"SHADOW"}));
  }
  frame.passes().setBytesHeld(kSpheresPass, spheres_->bytes());
}

glm::ivec2 PairTraversal::levelSize(uint32_t level) const {
  return (sizePx_ + (1 << level) - 1) >> static_cast<int>(level);
}

int64_t PairTraversal::bytes() const {
  return nodes_->bytes() + pairs_->bytes() + control_->bytes() + left_->bytes() + hits_.bytes();
}

void PairTraversal::setLevels(const gl::Program& program) const {
  program.set("sizePx", sizePx_);
  for (size_t level = 0; level < levelFirst_.size(); ++level)
    program.set(("levelFirst[" + std::to_string(level) + "]").c_str(), levelFirst_[level]);
}

void PairTraversal::beginFrame(frame::Frame& frame) {
  halveBatches();
  testsOfFrame_ = 0;
  traces_ = 0;
  const auto scope = frame.passes().open(kSpheresPass);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  control_->clearUint(0);
  frame.geometry().bindStorage();
  spheres_->bindStorage(kHierarchySpheresBuffer);
  spheresProgram_->set("triangleCount", triangleCount_);
  dispatchRows(*spheresProgram_, groupsFor(triangleCount_));
  storageBarrier();
}

void PairTraversal::build(const RayTextures& rays, bool clears) {
  nodes_->bindStorage(kHierarchyNodesBuffer);
  hits_.bindStorage(kHierarchyHitsBuffer);
  rays.origins->bindTexture(kHierarchyOriginsUnit);
  rays.directions->bindTexture(kHierarchyDirectionsUnit);
  setLevels(*buildProgram_);
  buildProgram_->set("lastLevel", startLevel_);
  for (uint32_t from = 0; from == 0 || from < startLevel_; from += kBuildLevels) {
    buildProgram_->set("fromLevel", from);
    buildProgram_->set("clears", from == 0 && clears ? 1 : 0);
    buildProgram_->dispatch(levelSize(from), glm::ivec2(kBuildSide));
    storageBarrier();
  }
}

void PairTraversal::step(uint32_t level, uint32_t batch, bool begins) const {
  controlProgram_->set("capacity", static_cast<uint32_t>(settings_.capacity));
  controlProgram_->set("level", level);
  controlProgram_->set("batch", batch);
  controlProgram_->set("begins", begins ? 1 : 0);
  controlProgram_->set("isLeaf", level == leafLevel_ ? 1 : 0);
  controlProgram_->set("raysPerLeaf", 1U << (2 * leafLevel_));
  dispatchRows(*controlProgram_, 1);
  storageBarrier();
}

void PairTraversal::traverse(const Batch& batch, uint32_t number, const Programs& programs) {
  const glm::ivec2 above = levelSize(startLevel_ + 1);
  const auto capacity = static_cast<uint32_t>(settings_.capacity);
  for (const gl::Program* program :
       {programs.start, programs.finishStart, programs.expand, programs.finish}) {
    setLevels(*program);
    program->set("capacity", capacity);
    program->set("leafLevel", leafLevel_);
    program->set("mostIterations", mostIterations_);
    program->set("firstTriangle", batch.first);
    program->set("triangleCount", batch.count);
    program->set("fromLevel", startLevel_);
  }
  const auto indirect = [&](const gl::Program& program, size_t offset) {
    program.use();
    glDispatchComputeIndirect(static_cast<GLintptr>(offset));
    storageBarrier();
  };
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_->id());
  step(startLevel_, number, true);
  programs.start->set("outFirst", 0U);
  dispatchRows(*programs.start, groupsFor(batch.count) * int64_t{above.x} * above.y);
  storageBarrier();
  step(startLevel_, number, false);
  indirect(*programs.finishStart, offsetof(HierarchyControl, finishX));
  uint32_t region = 0;
  for (uint32_t level = startLevel_; level > leafLevel_; --level) {
    for (const gl::Program* program : {programs.expand, programs.finish}) {
      program->set("inFirst", region * capacity);
      program->set("outFirst", (1 - region) * capacity);
    }
    indirect(*programs.expand, offsetof(HierarchyControl, expandX));
    step(level - 1, number, false);
    indirect(*programs.finish, offsetof(HierarchyControl, finishX));
    region = 1 - region;
  }
  testsOfFrame_ += uint64_t{batch.count} * static_cast<uint64_t>(levelSize(startLevel_).x) *
                   static_cast<uint64_t>(levelSize(startLevel_).y);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void PairTraversal::resolve(const Programs& programs, uint32_t region) {
  programs.resolve->set("sizePx", sizePx_);
  programs.resolve->set("inFirst", region * static_cast<uint32_t>(settings_.capacity));
  programs.resolve->set("leafLevel", leafLevel_);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_->id());
  programs.resolve->use();
  glDispatchComputeIndirect(offsetof(HierarchyControl, resolveX));
  storageBarrier();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

void PairTraversal::trace(frame::Frame& frame, const RayTextures& rays, const std::string& name,
                          bool shadow) {
  ++traces_;
  const Programs& programs = shadow ? shadow_ : nearest_;
  frame.passes().setBytesHeld("reflections/build_" + name, nodes_->bytes());
  {
    const auto scope = frame.passes().open("reflections/build_" + name);
    build(rays, !shadow);
  }
  frame.geometry().bindStorage();
  nodes_->bindStorage(kHierarchyNodesBuffer);
  spheres_->bindStorage(kHierarchySpheresBuffer);
  pairs_->bindStorage(kHierarchyPairsBuffer);
  control_->bindStorage(kHierarchyControlBuffer);
  hits_.bindStorage(kHierarchyHitsBuffer);
  left_->bindStorage(kHierarchyLeftBuffer);
  rays.origins->bindTexture(kHierarchyOriginsUnit);
  rays.directions->bindTexture(kHierarchyDirectionsUnit);
  rays.from->bindTexture(kHierarchyFromUnit);
  const uint32_t region = (startLevel_ - leafLevel_) % 2;
  if (batches_.size() == 1) {
    {
      const auto scope = frame.passes().open("reflections/test_" + name);
      traverse(batches_[0], 0, programs);
    }
    const auto scope = frame.passes().open("reflections/resolve_" + name);
    resolve(programs, region);
    return;
  }
  const auto scope = frame.passes().open("reflections/test_" + name);
  for (size_t number = 0; number < batches_.size(); ++number) {
    traverse(batches_[number], static_cast<uint32_t>(number), programs);
    resolve(programs, region);
  }
}

void PairTraversal::endFrame() {
  if (std::holds_alternative<HalvedBatches>(settings_.overflow)) readback_.copy(*control_, batches_.size());
}

void PairTraversal::halveBatches() {
  uint64_t tag = 0;
  const auto* control = static_cast<const HierarchyControl*>(readback_.take(tag));
  if (!control || tag != batches_.size() || control->leftEver == 0) return;
  std::vector<Batch> out;
  auto more = static_cast<int64_t>(mostBatches_) - static_cast<int64_t>(batches_.size());
  for (size_t i = 0; i < batches_.size(); ++i) {
    const Batch& batch = batches_[i];
    if (control->batchLeft[i] == 0 || batch.count < 2 || more <= 0) {
      out.push_back(batch);
      continue;
    }
    --more;
    const uint32_t half = batch.count / 2;
    out.push_back({batch.first, half});
    out.push_back({batch.first + half, batch.count - half});
  }
  batches_ = std::move(out);
}

PairTraversal::Counts PairTraversal::counts() const {
  Counts out;
  out.control = control_->read<HierarchyControl>(0, 1)[0];
  out.tests = testsOfFrame_;
  for (uint32_t level = leafLevel_ + 1; level <= startLevel_; ++level)
    out.tests += 4 * uint64_t{out.control.pairsAt[level]};
  out.batches = static_cast<int>(batches_.size());
  out.traces = traces_;
  return out;
}

}  // namespace limen::techniques
