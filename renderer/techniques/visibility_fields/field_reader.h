// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_forest.h"
#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/detail_by_size.h"
#include "renderer/techniques/visibility_fields/receiver_rays.h"
#include "renderer/techniques/visibility_fields/traced_triangles.h"
#include "renderer/visibility_fields/visibility_fields.h"

namespace limen::techniques {

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
  /// `smooth`: fields with normals have those of vertices. `traces`: the objects' triangles are kept as well,
  /// for shaders that trace rays (object_trace.glsl): in one tree or, where parts move, in one for each
  /// object, which moves with it.
  void prepare(frame::Frame& frame, const ReceiverRays& rays, bool smooth = true, bool traces = false);
  /// Puts objects where they are at the frame's time, if any move. Before bind(), in each frame.
  void place(const frame::Frame& frame);
  /// After prepare().
  gl::ShaderDefines defines() const;
  uint32_t objectCount() const { return fields_->objectCount(); }
  void bind(const gl::Program& program) const;
  /// Of shaders that trace rays, beside defines().
  gl::ShaderDefines traceDefines() const;
  /// Trees of such shaders.
  void bindTrees(const gl::Program& program) const;
  int64_t bytesHeld() const;
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
  void keepTriangles(frame::Frame& frame, const ReceiverRays& rays,
                     const std::vector<visibility_fields::RigidObject>& objects);
  /// `now_`, at a time.
  void move(double timeS);
  static gl::Buffer emptyCounts();
  std::vector<Counter> countersOf(const gl::Buffer& counts, const frame::Frame& frame) const;

  FieldReading settings_;
  std::optional<ChosenDetail> detail_;  ///< by size
  std::vector<std::string> names_;      ///< of the objects
  std::optional<visibility_fields::VisibilityFields> fields_;
  std::optional<gl::Buffer> objectOf_;
  std::optional<TracedTriangles> tree_;
  std::optional<ray_tracing::RayForest> forest_;     ///< in place of `tree_`, where parts move
  std::vector<visibility_fields::Pose> rest_, now_;  ///< of the objects
  std::vector<const scene::PartMotion*> motions_;    ///< of each object; null: it rests
};

}  // namespace limen::techniques
