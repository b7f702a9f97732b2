// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "experiments/base/error.h"
#include "renderer/frame/mirror_rays.h"

namespace limen::techniques {
namespace {

const std::string kHierarchyFolder = "renderer/techniques/reflections/ray_hierarchy/";
constexpr const char* kSpheresPass = "reflections/spheres";
/// Of triangles and first nodes in one batch, so that counts fit a word.
constexpr int64_t kMostFirstPairs = int64_t{1} << 31;
constexpr int64_t kPairBytes = 8;

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

std::unique_ptr<gl::PassList::Scope> opened(frame::Frame& frame, const std::string& name) {
  return std::unique_ptr<gl::PassList::Scope>(new gl::PassList::Scope(frame.passes().open(name)));
}

gl::ShaderDefines with(gl::ShaderDefines defines, std::initializer_list<const char*> names) {
  for (const char* name : names) defines[name] = "1";
  return defines;
}

}  // namespace

PairTraversal::PairTraversal(frame::Frame& frame, const TraversalSettings& settings, bool shadows,
                             HierarchyLeaves leaves)
    : settings_(settings),
      leaves_(leaves),
      sizePx_(frame.sizePx()),
      triangleCount_(frame.gpuScene().triangleCount()),
      mostIterations_(frame.context().device().software ? 60000 : 0x7fffffff),
      // Of cones: two words for each tile, of which there are no more than pixels, and the tail.
      hits_((int64_t{sizePx_.x} * sizePx_.y + 1) * 8 + int64_t{sizeof(GatheredTail)}, nullptr),
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
  if (frame.context().device().software) {
    regionLevel_ = kHierarchyRegionLevel;
    // No dimension of a dispatch has more groups.
    while (levelSize(regionLevel_).x * levelSize(regionLevel_).y > 65535) ++regionLevel_;
    regions_ = levelSize(regionLevel_);
  }
  leafLevel_ = static_cast<uint32_t>(log2Of(settings.leafSide));
  leafLevel_ = std::min(leafLevel_, static_cast<uint32_t>(levelFirst_.size() - 1));
  tileCount_ =
      static_cast<uint32_t>(levelSize(leafLevel_).x) * static_cast<uint32_t>(levelSize(leafLevel_).y);
  startLevel_ = leafLevel_;
  const auto nodesAt = [&](uint32_t level) { return levelSize(level).x * levelSize(level).y; };
  while (nodesAt(startLevel_) > settings.startNodes) ++startLevel_;

  const auto parentsAt = [&](uint32_t level) {
    return int64_t{levelSize(level + 1).x} * levelSize(level + 1).y;
  };
  // A separate reduction needs four places for each pair that is tested, the first ones included.
  capacity_ = separate() ? groupsFor(settings.capacity) * kTraversalGroup : settings.capacity;
  while (separate() && parentsAt(startLevel_) * kTraversalGroup > capacity_) ++startLevel_;
  const int64_t parents = parentsAt(startLevel_);
  int64_t batch = std::min<int64_t>(std::max(triangleCount_, 1U), kMostFirstPairs / (4 * parents));
  if (separate()) batch = std::min(batch, capacity_ / parents / kTraversalGroup * kTraversalGroup);
  if (const auto* fixed = std::get_if<FixedBatches>(&settings.overflow))
    batch = std::min<int64_t>(batch, fixed->triangles);
  if (const auto* halved = std::get_if<HalvedBatches>(&settings.overflow))
    mostBatches_ = static_cast<uint32_t>(halved->mostBatches);
  for (int64_t first = 0; first < triangleCount_; first += batch)
    batches_.push_back({static_cast<uint32_t>(first),
                        static_cast<uint32_t>(std::min<int64_t>(batch, triangleCount_ - first))});
  if (batches_.size() > kHierarchyMostBatches)
    throw Error("a hierarchy over rays would take " + std::to_string(batches_.size()) +
                    " batches of triangles; at most " + std::to_string(kHierarchyMostBatches) + " are kept",
                {}, "let a batch have more triangles, or give streams more room");

  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  const int64_t streamBytes = capacity_ * kPairBytes * (separate() ? 4 : 1);
  if (streamBytes > largest)
    throw Error("a stream of pairs takes " + std::to_string(streamBytes) +
                    " bytes in one buffer; this device allows " + std::to_string(largest),
                {}, "lower the capacity");
  nodes_.emplace(int64_t{nodes} * kConeSphereBytes, nullptr);
  spheres_.emplace(int64_t{triangleCount_} * 16, nullptr);
  for (auto& stream : streams_) stream.emplace(streamBytes, nullptr);
  control_.emplace(int64_t{sizeof(HierarchyControl)}, nullptr);
  left_.emplace(std::max(groupsFor(capacity_), groupsFor(batch) * parents) * int64_t{4}, nullptr);
  hits_.clearUint(0);
  if (leaves_ == HierarchyLeaves::Cones) gathered_.emplace(capacity_ * kGatheredBytes, nullptr);
  if (spills())
    for (auto& waiting : waiting_) waiting.emplace(spills()->room * kPairBytes);
  if (separate()) {
    sparse_.emplace(streamBytes, nullptr);
    reduced_.emplace(int64_t{sizeof(compute::ReducedCount)}, nullptr);
    reduction_.emplace(frame.context(), static_cast<uint32_t>(4 * capacity_),
                       compute::ReductionSettings{.form = separate()->form, .lanes = 2});
  }
  compilePrograms(frame.context().programs(), shadows);
  frame.passes().setBytesHeld(kSpheresPass, spheres_->bytes());
}

void PairTraversal::compilePrograms(gl::ProgramCache& cache, bool shadows) {
  gl::ShaderDefines defines;
  if (spills()) defines["SPILL"] = "1";
  if (separate()) defines["SPARSE"] = "1";
  if (leaves_ == HierarchyLeaves::Cones) defines["CONES"] = "1";
  controlProgram_ = &cache.compute(kHierarchyFolder + "control.comp.glsl", defines);
  defineEnum(defines, "MERGE", settings_.merge);
  defineEnum(defines, "TEST", settings_.test);
  spheresProgram_ = &cache.compute(kHierarchyFolder + "spheres.comp.glsl");
  buildProgram_ = &cache.compute(kHierarchyFolder + "build.comp.glsl", defines);
  const std::string expand = kHierarchyFolder + "expand.comp.glsl";
  const std::string resolve = kHierarchyFolder + "resolve.comp.glsl";
  nearest_ = {&cache.compute(expand, with(defines, {"START"})), &cache.compute(expand, defines),
              &cache.compute(expand, with(defines, {"START", "FINISH"})),
              &cache.compute(expand, with(defines, {"FINISH"})), &cache.compute(resolve, defines)};
  if (!shadows) return;
  shadow_ = nearest_;
  shadow_.finishStart = &cache.compute(expand, with(defines, {"START", "FINISH", "SHADOW"}));
  shadow_.finish = &cache.compute(expand, with(defines, {"FINISH", "SHADOW"}));
  shadow_.resolve = &cache.compute(resolve, with(defines, {"SHADOW"}));
}

glm::ivec2 PairTraversal::levelSize(uint32_t level) const {
  return (sizePx_ + (1 << level) - 1) >> static_cast<int>(level);
}

void PairTraversal::setLevels(const gl::Program& program) const {
  program.set("sizePx", sizePx_);
  for (size_t level = 0; level < levelFirst_.size(); ++level)
    program.set(("levelFirst[" + std::to_string(level) + "]").c_str(), levelFirst_[level]);
}

void PairTraversal::beginFrame(frame::Frame& frame) {
  halveBatches();
  testsOfFrame_ = 0;
  const auto scope = frame.passes().open(kSpheresPass);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  control_->clearUint(0);
  frame.geometry().bindStorage();
  spheres_->bindStorage(kHierarchySpheresBuffer);
  spheresProgram_->set("triangleCount", triangleCount_);
  dispatchRows(*spheresProgram_, groupsFor(triangleCount_));
  storageBarrier();
}

void PairTraversal::build(const RayTextures& rays, const glm::vec3* light) {
  nodes_->bindStorage(kHierarchyNodesBuffer);
  hits_.bindStorage(kHierarchyHitsBuffer);
  rays.origins->bindTexture(kHierarchyOriginsUnit);
  rays.directions->bindTexture(kHierarchyDirectionsUnit);
  setLevels(*buildProgram_);
  buildProgram_->set("reversed", light ? 1 : 0);
  if (light) buildProgram_->set("lightAt", *light);
  buildProgram_->set("lastLevel", startLevel_);
  for (uint32_t from = 0; from == 0 || from < startLevel_; from += kBuildLevels) {
    buildProgram_->set("fromLevel", from);
    buildProgram_->set("clears", from == 0 && !light && !gathered_ ? 1 : 0);
    buildProgram_->dispatch(levelSize(from), glm::ivec2(kBuildSide));
    storageBarrier();
  }
}

void PairTraversal::step(uint32_t level, uint32_t batch, uint32_t mode) const {
  controlProgram_->set("capacity", static_cast<uint32_t>(capacity_));
  controlProgram_->set("level", level);
  controlProgram_->set("batch", batch);
  controlProgram_->set("mode", mode);
  controlProgram_->set("regions", static_cast<uint32_t>(regions_.x * regions_.y));
  controlProgram_->set("isLeaf", level == leafLevel_ ? 1 : 0);
  controlProgram_->set("raysPerLeaf", 1U << (2 * leafLevel_));
  if (spills()) controlProgram_->set("spillCapacity", static_cast<uint32_t>(spills()->room));
  control_->bindStorage(kHierarchyControlBuffer);
  if (separate()) reduced_->bindStorage(kHierarchyReducedBuffer);
  dispatchRows(*controlProgram_, 1);
  storageBarrier();
}

void PairTraversal::configure(const frame::Frame& frame, const Programs& programs) const {
  for (const gl::Program* program :
       {programs.start, programs.finishStart, programs.expand, programs.finish}) {
    setLevels(*program);
    program->set("capacity", static_cast<uint32_t>(capacity_));
    program->set("leafLevel", leafLevel_);
    program->set("mostIterations", mostIterations_);
    program->set("regionLevel", regionLevel_);
    program->set("regionsAcross", regions_.x);
    program->set("fromLevel", startLevel_);
    if (spills()) program->set("spillCapacity", static_cast<uint32_t>(spills()->room));
  }
  for (const gl::Program* program :
       {programs.start, programs.finishStart, programs.expand, programs.finish, programs.resolve}) {
    program->set("farthest", farthest_);
    program->set("tileCount", tileCount_);
  }
  for (const gl::Program* program : {programs.finishStart, programs.finish, programs.resolve})
    frame::configureRayOrigins(*program, frame.gpuScene());
  programs.resolve->set("gatheredRoom", gatheredRoom());
  programs.resolve->set("sizePx", sizePx_);
  programs.resolve->set("leafLevel", leafLevel_);
}

void PairTraversal::bind(frame::Frame& frame, Buffers use, const gl::Buffer* out) const {
  nodes_->bindStorage(kHierarchyNodesBuffer);
  spheres_->bindStorage(kHierarchySpheresBuffer);
  control_->bindStorage(kHierarchyControlBuffer);
  left_->bindStorage(kHierarchyLeftBuffer);
  if (use == Buffers::Rays) {
    if (gathered_)
      gathered_->bindStorage(kHierarchyGatheredBuffer);
    else
      frame.geometry().bindStorage();
    hits_.bindStorage(kHierarchyHitsBuffer);
  } else {
    out->bindStorage(kHierarchyOutBuffer);
    if (waiting_[waitsIn_]) waiting_[waitsIn_]->bindStorage(kHierarchySpillBuffer);
  }
}

void PairTraversal::dispatchCounted(const gl::Program& program, size_t offset) const {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_->id());
  program.use();
  glDispatchComputeIndirect(static_cast<GLintptr>(offset));
  storageBarrier();
}

void PairTraversal::finish(frame::Frame& frame, const gl::Program& program) const {
  bind(frame, Buffers::Rays, nullptr);
  dispatchCounted(program, offsetof(HierarchyControl, finishX));
}

void PairTraversal::reduce(const gl::Buffer& into, uint32_t most, bool counted) const {
  compute::StreamInput in{*sparse_, most};
  if (counted) in.count = &*control_, in.countOffset = offsetof(HierarchyControl, sparseItems);
  reduction_->run(in, {into, static_cast<uint32_t>(4 * capacity_), *reduced_});
}

void PairTraversal::start(frame::Frame& frame, uint32_t number, const Programs& programs,
                          const std::string& name) {
  const Batch& batch = batches_[number];
  for (const gl::Program* program : {programs.start, programs.finishStart}) {
    program->set("firstTriangle", batch.first);
    program->set("triangleCount", batch.count);
  }
  const glm::ivec2 above = levelSize(startLevel_ + 1);
  const int64_t groups = groupsFor(batch.count) * above.x * above.y;
  {
    const auto scope = timedLevel(frame, "test_" + name, startLevel_);
    step(startLevel_, number, kControlBatch);
    bind(frame, Buffers::Streams, separate() ? &*sparse_ : &*streams_[0]);
    dispatchRows(*programs.start, groups);
    storageBarrier();
  }
  if (separate()) {
    const auto scope = timedLevel(frame, "reduce_" + name, startLevel_);
    reduce(*streams_[0], static_cast<uint32_t>(groups * kTraversalGroup * 4), false);
  }
  step(startLevel_, number, kControlStep);
  streams_[0]->bindStorage(kHierarchyPairsBuffer);
  finish(frame, separate() ? *programs.finish : *programs.finishStart);
  reading_ = 0;
  const glm::ivec2 size = levelSize(startLevel_);
  testsOfFrame_ += uint64_t{batch.count} * static_cast<uint64_t>(size.x) * static_cast<uint64_t>(size.y);
}

void PairTraversal::descend(frame::Frame& frame, uint32_t level, uint32_t number, const Programs& programs,
                            const std::string& name) {
  const gl::Buffer& out = *streams_[1 - reading_];
  {
    const auto scope = timedLevel(frame, "test_" + name, level);
    bind(frame, Buffers::Streams, separate() ? &*sparse_ : &out);
    dispatchCounted(*programs.expand, offsetof(HierarchyControl, expandX));
  }
  if (separate()) {
    const auto scope = timedLevel(frame, "reduce_" + name, level);
    reduce(out, static_cast<uint32_t>(4 * capacity_), true);
  }
  step(level, number, kControlStep);
  reading_ = 1 - reading_;
  if (separate()) out.bindStorage(kHierarchyPairsBuffer);
  finish(frame, *programs.finish);  // of the stream that was read; of a separate reduction, of what it made
  out.bindStorage(kHierarchyPairsBuffer);
}

void PairTraversal::resolve(frame::Frame& frame, const Programs& programs) const {
  bind(frame, Buffers::Rays, nullptr);
  dispatchCounted(*programs.resolve, offsetof(HierarchyControl, resolveX));
}

void PairTraversal::runLaterBatches(frame::Frame& frame, uint32_t number, const Programs& programs) {
  // What waits has come down at least one level more than all that waited before.
  for (uint32_t top = startLevel_ + 1; top-- > leafLevel_;) {
    step(kHierarchyLevels, number, kControlLaterBatch);
    waiting_[waitsIn_]->bindStorage(kHierarchyPairsBuffer);
    waitsIn_ = 1 - waitsIn_;
    reading_ = 0;
    resolve(frame, programs);
    for (uint32_t level = top; level-- > leafLevel_;) {
      descend(frame, kHierarchyLevels, number, programs, "");
      resolve(frame, programs);
    }
  }
}

std::unique_ptr<gl::PassList::Scope> PairTraversal::timedLevel(frame::Frame& frame, const std::string& name,
                                                               uint32_t level) const {
  if (!timesLevels_) return nullptr;
  return opened(frame, "reflections/" + name + "/level_" + std::to_string(level));
}

void PairTraversal::trace(frame::Frame& frame, const RayTextures& rays, const std::string& name,
                          const glm::vec3* light) {
  const Programs& programs = light ? shadow_ : nearest_;
  const std::string folder = "reflections/";
  if (gathered_) hits_.clearUint(0);
  frame.passes().setBytesHeld(folder + "build_" + name, nodes_->bytes());
  {
    const auto scope = frame.passes().open(folder + "build_" + name);
    build(rays, light);
  }
  configure(frame, programs);
  rays.origins->bindTexture(kHierarchyOriginsUnit);
  rays.directions->bindTexture(kHierarchyDirectionsUnit);
  rays.from->bindTexture(kHierarchyFromUnit);
  const auto testAll = [&](uint32_t number) {
    start(frame, number, programs, name);
    for (uint32_t level = startLevel_; level-- > leafLevel_;) descend(frame, level, number, programs, name);
  };
  // Passes do not nest: a frame of one batch is timed by stages, and with a separate reduction by levels.
  const bool single = batches_.size() == 1;
  timesLevels_ = single && separate();
  if (single) {
    {
      const auto scope = timesLevels_ ? nullptr : opened(frame, folder + "test_" + name);
      testAll(0);
    }
    {
      const auto scope = frame.passes().open(folder + "resolve_" + name);
      resolve(frame, programs);
    }
    if (spills()) {
      const auto scope = frame.passes().open(folder + "later_batches_" + name);
      runLaterBatches(frame, 0, programs);
    }
    return;
  }
  const auto scope = frame.passes().open(folder + "test_" + name);
  for (uint32_t number = 0; number < batches_.size(); ++number) {
    testAll(number);
    resolve(frame, programs);
    if (spills()) runLaterBatches(frame, number, programs);
  }
}

}  // namespace limen::techniques
