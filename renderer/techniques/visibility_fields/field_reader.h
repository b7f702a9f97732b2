// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_forest.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/ray_tracing/rebuilt_tree.h"
#include "renderer/ray_tracing/triangle_grid.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/detail_by_size.h"
#include "renderer/visibility_fields/visibility_fields.h"

namespace limen::techniques {

template <class S>
Binding<S> objectsBinding(visibility_fields::ObjectSetting S::*member) {
  return {member, "objects", "What of the scene is one rigid object", "bench (auto)"};
}

/// What is made of interleaved pixels.
struct NoFilter {
  static constexpr const char *kKind = "none", *kSummary = "each pixel has the mean of its own rays";
  static const SettingsTable<NoFilter>& table();
};
struct BilateralFilter {
  static constexpr const char
      *kKind = "bilateral",
      *kSummary =
          "means over a window as wide as a tile of interleaved pixels, of pixels on the "
          "same surface";
  double angleDeg = 20.0;
  static const SettingsTable<BilateralFilter>& table();
};
using FilterSetting = std::variant<NoFilter, BilateralFilter>;

/// Where the rays of a pixel lie in their cells.
struct SamePattern {
  static constexpr const char *kKind = "same", *kSummary = "in the middle, for all pixels alike";
  static const SettingsTable<SamePattern>& table();
};
struct TurnedPattern {
  static constexpr const char *kKind = "turned", *kSummary = "other rays for each pixel, at random";
  int64_t seed = 1;
  static const SettingsTable<TurnedPattern>& table();
};
struct InterleavedPattern {
  static constexpr const char *kKind = "interleaved",
                              *kSummary =
                                  "pixels of a tile have other rays of a finer grid, one in every "
                                  "cell of their own";
  int side = 4;
  FilterSetting filter;
  static const SettingsTable<InterleavedPattern>& table();
};
using PatternSetting = std::variant<SamePattern, TurnedPattern, InterleavedPattern>;

/// Rays a pixel, its receiver and the objects that may block them: the same for a field and for the tracer
/// that it is compared with.
struct ReceiverRays {
  int64_t rays = 64;
  PatternSetting pattern;
  bool selfOcclusion = true;
  visibility_fields::ObjectSetting objects;
  static const SettingsTable<ReceiverRays>& table();
  /// Throws Error unless `rays` is a square number.
  void check() const;

  int side() const;
  /// Pixels along the side of a tile that share a grid of rays; 1: none do.
  int interleave() const;
  /// Makes the inputs of field_receiver.glsl, before a pass is opened.
  static void makeInputs(frame::Frame& frame);
  /// Textures and uniforms of field_receiver.glsl and of the rays' cells; after makeInputs().
  void configure(const gl::Program& program, frame::Frame& frame) const;
};

/// How fields are placed around objects and read.
struct FieldUse {
  double slack = 1.0;
  int spheres = 1;
  static const SettingsTable<FieldUse>& table();
};

/// What of a field a look-up reads.
enum class FieldFetch { Nearest, Aimed, Positions, All };
constexpr EnumNames<FieldFetch, 4> enumNames(FieldFetch) {
  return {{{{FieldFetch::Nearest, "nearest"},
            {FieldFetch::Aimed, "aimed"},
            {FieldFetch::Positions, "positions"},
            {FieldFetch::All, "all"}}}};
}

/// The same where a look-up must tell one surface.
enum class HitFetch { Nearest, Aimed };
constexpr EnumNames<HitFetch, 2> enumNames(HitFetch) {
  return {{{{HitFetch::Nearest, "nearest"}, {HitFetch::Aimed, "aimed"}}}};
}
template <class S>
Binding<S> hitFetchBinding(HitFetch S::*member) {
  return {member, "fetch",
          "What a look-up reads: the nearest position's nearest direction, or, from the nearest position, "
          "the direction to where the "
          "ray is likely to meet the object; aimed ones from within its sphere tell the nearest surface "
          "where they can, the others the farthest",
          "Gaitatzes 2012, section 4.4.2 (nearest); after Gortler et al. 1996 (aimed)"};
}

/// How fine fields are.
struct GivenDetail {
  static constexpr const char *kKind = "given", *kSummary = "as given, wherever the objects are";
  static const SettingsTable<GivenDetail>& table();
};
struct BySizeDetail {
  static constexpr const char
      *kKind = "by_size",
      *kSummary =
          "for each object by its size in the picture when they are made, with few bytes for "
          "an error of the whole; what is given is the finest";
  double error = 0.02;
  static const SettingsTable<BySizeDetail>& table();
};
using DetailSetting = std::variant<GivenDetail, BySizeDetail>;

/// How fields are kept.
struct FieldStorage {
  std::string folder;
  int tolerance = 0;
  DetailSetting detail;
  static const SettingsTable<FieldStorage>& table();
};
template <class S>
Binding<S> folderBinding(std::string S::*member) {
  return {
      member, "folder",
      "Folder in which fields are kept by their content, so that the next run reads them: its preparation "
      "time is that of reading; none: made each time"};
}

/// How fields are made and read.
struct FieldReading {
  visibility_fields::FieldForm form;
  FieldUse use;
  FieldFetch fetch = FieldFetch::Aimed;
  FieldStorage storage;
  static const SettingsTable<FieldReading>& table();
  /// Throws Error if there is a tolerance for codes of other than 8 bits, or if a look-up between positions
  /// or directions has no neighbours.
  void check() const;
};

/// The fields of a frame's scene for shaders that include object_lookup.glsl.
class FieldReader {
 public:
  explicit FieldReader(const FieldReading& settings) : settings_(settings) {}
  /// Makes the fields. Throws Error if there are too many objects, or more rays than this device takes.
  /// `smooth`: fields with normals have those of vertices. `trees`: the objects' triangles are kept as well,
  /// for shaders that trace rays (near_trace.glsl).
  void prepare(frame::Frame& frame, const ReceiverRays& rays, bool smooth = true, bool trees = false);
  /// Puts objects where they are at the frame's time, if any move. Before bind(), in each frame.
  void place(const frame::Frame& frame);
  /// After prepare().
  gl::ShaderDefines defines() const;
  uint32_t objectCount() const { return fields_->objectCount(); }
  void bind(const gl::Program& program) const;
  /// RayForest of shaders that include near_trace.glsl.
  void bindTrees(const gl::Program& program) const { trees_->bind(program); }
  int64_t bytesHeld() const {
    return fields_->bytesHeld() + objectOf_->bytes() + (trees_ ? trees_->bytes() : 0);
  }
  /// Look-ups that run(counts) makes with a program compiled with COUNT and `counts` bound to
  /// kFieldCountsBuffer, and what the fields take.
  template <class Run>
  std::vector<Counter> count(frame::Frame& frame, const Run& run) const {
    const gl::Buffer counts = emptyCounts();
    run(counts);
    return countersOf(counts, frame);
  }
  static std::vector<Quantity> quantities();
  std::vector<std::string> remarks() const;

 private:
  /// `now_`, at a time.
  void move(double timeS);
  static gl::Buffer emptyCounts();
  std::vector<Counter> countersOf(const gl::Buffer& counts, const frame::Frame& frame) const;

  FieldReading settings_;
  std::optional<ChosenDetail> detail_;  ///< by size
  std::vector<std::string> names_;      ///< of the objects
  std::optional<visibility_fields::VisibilityFields> fields_;
  std::optional<gl::Buffer> objectOf_;
  std::optional<ray_tracing::RayForest> trees_;
  std::vector<visibility_fields::Pose> rest_, now_;  ///< of the objects
  std::vector<const scene::PartMotion*> motions_;    ///< of each object; null: it rests
};

/// How rays find triangles.
struct TreeTracer {
  static constexpr const char *kKind = "tree", *kSummary = "through a wide hierarchy of bounding boxes";
  static const SettingsTable<TreeTracer>& table();
};
struct GridTracer {
  static constexpr const char *kKind = "grid", *kSummary = "through the cells of a uniform grid";
  double density = 4.0;
  static const SettingsTable<GridTracer>& table();
};
using TracerSetting = std::variant<TreeTracer, GridTracer>;
template <class S>
Binding<S> tracerBinding(TracerSetting S::*member) {
  return {member, "tracer", "How rays find triangles",
          "Gaitatzes 2012, sections 4.7.1 (grid) and 4.7.2 (tree)"};
}

/// The objects' triangles for shaders that include object_trace.glsl.
class ObjectTracer {
 public:
  void prepare(frame::Frame& frame, const ReceiverRays& rays, const TracerSetting& tracer);
  static gl::ShaderDefines defines(const TracerSetting& tracer);
  /// Where parts move, builds the tree anew from where vertices are, whatever poses fields are placed in.
  /// Before a pass is opened, in each frame.
  void update(frame::Frame& frame);
  void bind(const gl::Program& program) const;
  int64_t bytesHeld() const {
    return rays_->bytes() + objectOf_->bytes() + (indices_ ? indices_->bytes() : 0);
  }
  /// Dispatches `program` over the frame for all rows of the rays' cells: at once, or one by one on a
  /// software renderer, which limits the steps of an invocation.
  static void dispatchRows(const gl::Program& program, frame::Frame& frame, int rows);

 private:
  std::unique_ptr<ray_tracing::RayTree> rays_;
  const ray_tracing::RebuiltTree* rebuilt_ = nullptr;  ///< `rays_`, if parts move
  std::optional<gl::Buffer> indices_;                  ///< of the objects' triangles, for it
  std::optional<gl::Buffer> objectOf_;
};

/// The scene's objects. Throws Error if there are too many.
visibility_fields::RigidObjects objectsOf(const frame::Frame& frame,
                                          const visibility_fields::ObjectSetting& setting);

/// The triangles that belong to no object, numbered as in the scene.
ray_tracing::RayScene raysWithoutObjects(frame::Frame& frame, const ReceiverRays& rays);

}  // namespace limen::techniques
