// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/rebuilt_tree.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <string>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/rebuilt_tree_bindings.h"
#include "renderer/ray_tracing/wide_bvh.h"

namespace limen::ray_tracing {
namespace {

constexpr uint32_t kTile = kTreeGroup * kTreeSortRounds;
/// Dispatches that take a level each, after a group alone has taken those of few nodes and before one alone
/// takes what is left: in a tree of millions nothing, unless it is degenerate.
constexpr int kLevelDispatches = 10;

/// Nodes, the root aside, have eight children or leaves of one triangle alone, 4 at least. Of n triangles b
/// nodes of the second kind hold 4 b or more, and f of the first have 8 f <= f + b - 1 + n - 4 b children,
/// nodes and other leaves: f + b <= (n + 4 b) / 7 <= 2 n / 7.
uint32_t mostWideNodes(uint32_t triangles) { return static_cast<uint32_t>(uint64_t{triangles} * 2 / 7) + 2; }

gl::Buffer roomFor(int64_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > most)
    throw Error("a tree that is built on the GPU takes " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                {}, "use a smaller scene");
  return {bytes, nullptr};
}

void dispatchGroups(const gl::Program& program, uint32_t groups) {
  program.use();
  // Rows of groups, as no dimension has more than 65,535.
  const uint32_t rows = std::max((groups + 65534) / 65535, 1U);
  glDispatchCompute((groups + rows - 1) / rows, rows, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

uint32_t groupsOf(uint32_t triangles) { return (triangles + kTreeGroup - 1) / kTreeGroup; }

}  // namespace

RebuiltTree::RebuiltTree(gl::Context& context, uint32_t triangles, int axisBits)
    : triangles_(triangles),
      axisBits_(axisBits),
      mostIterations_(context.device().software ? 60000 : 0x7fffffff),
      scan_(context, tiles() * kTreeDigits),
      control_(sizeof(TreeControl), nullptr),
      keys_(roomFor(8 * int64_t{triangles})),
      keysOther_(roomFor(8 * int64_t{triangles})),
      order_(roomFor(4 * int64_t{triangles})),
      orderOther_(roomFor(4 * int64_t{triangles})),
      counts_(roomFor(compute::PrefixSum::bytesFor(tiles() * kTreeDigits, 1))),
      sums_(roomFor(compute::PrefixSum::bytesFor(tiles() * kTreeDigits, 1))),
      nodes_(roomFor(2 * int64_t{triangles} * int64_t{sizeof(BinaryNode)})),
      ranges_(roomFor(4 * int64_t{triangles})),
      tasks_(roomFor(4 * int64_t{mostWideNodes(triangles)})),
      wideNodes_(roomFor(int64_t{mostWideNodes(triangles)} * int64_t{sizeof(WideNode)})),
      wideTriangles_(roomFor(int64_t{triangles} * int64_t{sizeof(LeafTriangle)})) {
  assert(axisBits == 10 || axisBits == 16 || axisBits == 21);
  const std::string folder = "renderer/ray_tracing/";
  gl::ProgramCache& cache = context.programs();
  extent_ = &cache.compute(folder + "tree_extent.comp.glsl");
  codes_ = &cache.compute(folder + "tree_codes.comp.glsl", {{"AXIS_BITS", std::to_string(axisBits)}});
  count_ = &cache.compute(folder + "tree_sort.comp.glsl", {{"COUNT", "1"}});
  scatter_ = &cache.compute(folder + "tree_sort.comp.glsl");
  merge_ = &cache.compute(folder + "tree_merge.comp.glsl");
  alone_ = &cache.compute(folder + "tree_collapse.comp.glsl", {{"ALONE", "1"}});
  level_ = &cache.compute(folder + "tree_collapse.comp.glsl");
}

uint32_t RebuiltTree::tiles() const { return (triangles_ + kTile - 1) / kTile; }

int64_t RebuiltTree::bytes() const {
  int64_t bytes = scan_.bytes();
  for (const gl::Buffer* buffer : {&control_, &keys_, &keysOther_, &order_, &orderOther_, &counts_, &sums_,
                                   &nodes_, &ranges_, &tasks_, &wideNodes_, &wideTriangles_})
    bytes += buffer->bytes();
  return bytes;
}

void RebuiltTree::sort(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const {
  {
    const auto scope = passes.open(kExtentPass);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    control_.clearUint(0);
    positions.bindStorage(kTreePositionsBuffer);
    indices.bindStorage(kTreeIndicesBuffer);
    control_.bindStorage(kTreeControlBuffer);
    keys_.bindStorage(kTreeKeysBuffer);
    order_.bindStorage(kTreeOrderBuffer);
    for (const gl::Program* program : {extent_, codes_}) {
      program->set("triangleCount", triangles_);
      dispatchGroups(*program, groupsOf(triangles_));
    }
  }
  const auto scope = passes.open(kSortPass);
  const gl::Buffer *keys = &keys_, *keysOther = &keysOther_, *order = &order_, *orderOther = &orderOther_;
  for (const gl::Program* program : {count_, scatter_}) {
    program->set("triangleCount", triangles_);
    program->set("tileCount", tiles());
  }
  // 8 bits a pass; an even number of passes.
  const int sortPasses = (3 * axisBits_ + 7) / 8;
  for (int pass = 0; pass < sortPasses; ++pass) {
    keys->bindStorage(kTreeKeysBuffer);
    counts_.bindStorage(kTreeCountsBuffer);
    count_->set("shift", static_cast<uint32_t>(8 * pass));
    dispatchGroups(*count_, tiles());
    scan_.run(counts_, sums_, tiles() * kTreeDigits);
    keys->bindStorage(kTreeKeysBuffer);
    order->bindStorage(kTreeOrderBuffer);
    keysOther->bindStorage(kTreeKeysOutBuffer);
    orderOther->bindStorage(kTreeOrderOutBuffer);
    sums_.bindStorage(kTreeCountsBuffer);
    scatter_->set("shift", static_cast<uint32_t>(8 * pass));
    dispatchGroups(*scatter_, tiles());
    std::swap(keys, keysOther);
    std::swap(order, orderOther);
  }
  assert(keys == &keys_);
}

void RebuiltTree::build(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const {
  passes.setBytesHeld(kExtentPass, control_.bytes());
  passes.setBytesHeld(kSortPass, scan_.bytes() + keys_.bytes() + keysOther_.bytes() + order_.bytes() +
                                     orderOther_.bytes() + counts_.bytes() + sums_.bytes());
  sort(passes, positions, indices);
  refit(passes, positions, indices);
}

void RebuiltTree::refit(gl::PassList& passes, const gl::Buffer& positions, const gl::Buffer& indices) const {
  passes.setBytesHeld(kMergePass, nodes_.bytes() + ranges_.bytes());
  passes.setBytesHeld(kCollapsePass, tasks_.bytes() + wideNodes_.bytes() + wideTriangles_.bytes());
  positions.bindStorage(kTreePositionsBuffer);
  indices.bindStorage(kTreeIndicesBuffer);
  control_.bindStorage(kTreeControlBuffer);
  order_.bindStorage(kTreeOrderBuffer);
  nodes_.bindStorage(kTreeNodesBuffer);
  {
    const auto scope = passes.open(kMergePass);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    ranges_.clearUint(kTreeNone);
    keys_.bindStorage(kTreeKeysBuffer);
    ranges_.bindStorage(kTreeRangesBuffer);
    merge_->set("triangleCount", triangles_);
    dispatchGroups(*merge_, groupsOf(triangles_));
  }
  const auto scope = passes.open(kCollapsePass);
  tasks_.bindStorage(kTreeTasksBuffer);
  wideNodes_.bindStorage(kTreeWideNodesBuffer);
  wideTriangles_.bindStorage(kTreeWideTrianglesBuffer);
  alone_->set("begins", 1);
  alone_->set("most", static_cast<uint32_t>(kTreeAloneGroup / 8));
  dispatchGroups(*alone_, 1);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, control_.id());
  level_->use();
  for (int i = 0; i < kLevelDispatches; ++i) {
    glDispatchComputeIndirect(offsetof(TreeControl, groupsX));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  alone_->set("begins", 0);
  alone_->set("most", kTreeNone);
  dispatchGroups(*alone_, 1);
}

void RebuiltTree::bind(const gl::Program& program) const {
  wideNodes_.bindStorage(kRayNodesBuffer);
  wideTriangles_.bindStorage(kRayTrianglesBuffer);
  program.set("rayNodeCount", 1U);  // there is a root always
  program.set("maxRayIterations", mostIterations_);
}

RebuiltTree::Counts RebuiltTree::counts() const {
  const TreeControl control = control_.read<TreeControl>(0, 1)[0];
  return {control.valid, control.nodes, control.valid > 0 ? static_cast<int>(control.level) + 1 : 0};
}

}  // namespace limen::ray_tracing
