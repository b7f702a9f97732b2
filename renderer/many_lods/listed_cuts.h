// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/context.h"
#include "renderer/many_lods/cut_finder.h"
#include "renderer/many_lods/cut_mode.h"
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/many_lods/tree_shape.h"

namespace limen::many_lods {

/// A buffer of storage; throws Error if the device does not allow one of that size.
gl::Buffer cutStorage(int64_t bytes);

/// Cuts by compute. A step says what becomes of entries and writes that; it is dispatched indirectly by what
/// the step before left, and nothing is read back. CutOrder::Free: in one dispatch, whose groups take room
/// for what they write by atomic additions. Kept: in three (events, sums over tiles of the list, writing), so
/// that entries stay in their order.
///
/// Basic and incremental cuts: what is finished is written once, behind what earlier steps have finished;
/// only entries that a step has split as far as it goes are left over for the next one. So the list of a
/// frame is copied once, however deep a few of its entries go down. It is in order of views where no step
/// after the first had anything to do.
///
/// The first step of incremental cuts of free order keeps, merges and drops, and leaves over what has to be
/// split. With margins, beside each entry stands how far eye and surface may move before a test of
/// it or of its parent can come out otherwise. While that lasts it is kept without a look at the tree.
///
/// Lazy cuts need siblings beside each other: their list is kept in order, by view and then from left to
/// right in the tree, and each step writes all of it.
class ListedCuts : public CutFinder {
 public:
  ListedCuts(gl::Context& context, uint32_t views, const TreeShape& shape, uint32_t capacity,
             const CutMode& mode);
  void update(const gl::Buffer& nodes, const gl::Buffer& views, bool counting) override;
  void restart() override { fresh_ = true; }
  const gl::Buffer& list() const override { return list_; }
  const gl::Buffer& control() const override { return control_; }
  int64_t bytes() const override;

 protected:
  /// One step; `rule` as kRule...
  virtual void step(uint32_t rule, uint32_t number, uint32_t last, bool counting);
  /// Binds what steps need, and starts a frame with the roots or with the list as it is.
  void begin(const gl::Buffer& nodes, const gl::Buffer& views, bool fromRoot);
  void end();
  /// A part of a step, `offset` being that of its arguments in CutStep.
  void dispatch(const gl::Program& program, uint32_t number, size_t offset) const;
  /// Sets how far a step of a rule goes and when steps end, and returns the program that finds its events.
  const gl::Program& configure(uint32_t rule, uint32_t last, bool counting) const;

  CutMode mode_;
  TreeShape shape_;
  uint32_t viewCount_, capacity_, arityBits_;
  bool ordered_;          // lazy cuts
  bool free_;             // a dispatch a step
  bool margins_;          // entries are tested when something has moved too far
  uint32_t splitLevels_;  // of a step that goes as far as it can
  uint32_t fullSteps_;
  bool fresh_ = true;
  gl::Buffer list_, codes_, tiles_, control_;
  gl::Buffer marginList_, lastViews_, motions_;
  const gl::Program* motion_ = nullptr;
  const gl::Program *restart_, *begin_, *scan_, *emit_;
  std::vector<const gl::Program*> classify_;  // by rule, then with counting; a whole step where order is free

 private:
  void findMotions() const;
  void setShape(const gl::Program& program) const;
};

}  // namespace limen::many_lods
