// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/surfaces/factors.h"
#include "renderer/surfaces/spacing.h"
#include "renderer/techniques/tessellation/patch_buffers.h"

namespace limen::techniques {

/// Which bound gives the factors of cubic triangles.
enum class TriangleRule {
  Sides,       ///< three factors from second derivatives (SC-57)
  PnEstimate,  ///< one from the distances of tangent points, constant 9/4: an estimate (SC-58)
  PnTied,      ///< constant 39/4: a bound for PN triangles
  PnSafe       ///< constant 45/4: a bound for any inner control point within 1.5 distances
};
constexpr EnumNames<TriangleRule, 4> enumNames(TriangleRule) {
  return {{{{TriangleRule::PnEstimate, "pn_estimate"},
            {TriangleRule::PnSafe, "pn_safe"},
            {TriangleRule::PnTied, "pn_tied"},
            {TriangleRule::Sides, "sides"}}}};
}

/// Where a patch's deviation is bounded (SC-59).
enum class FactorSpace {
  Lighting,  ///< eye coordinates, a rigid transform away from the scene's, with a tolerance for each patch
  Object,    ///< the scene's coordinates, with one tolerance for all, that of the anchor's distance
  Screen     ///< pixels: of the projected patch, which perspective makes rational
};
constexpr EnumNames<FactorSpace, 3> enumNames(FactorSpace) {
  return {{{{FactorSpace::Lighting, "lighting"},
            {FactorSpace::Object, "object"},
            {FactorSpace::Screen, "screen"}}}};
}

/// How sides are divided; the numbers of spacing.h.
enum class Spacing {
  Integer = surfaces::kSpacingInteger,
  Dyadic = surfaces::kSpacingDyadic,
  FractionalEven = surfaces::kSpacingFractionalEven,
  FractionalOdd = surfaces::kSpacingFractionalOdd,
  Moreton = surfaces::kSpacingMoreton,
  Geomorph = surfaces::kSpacingGeomorph
};
constexpr EnumNames<Spacing, 6> enumNames(Spacing) {
  return {{{{Spacing::Dyadic, "dyadic"},
            {Spacing::FractionalEven, "fractional_even"},
            {Spacing::FractionalOdd, "fractional_odd"},
            {Spacing::Geomorph, "geomorph"},
            {Spacing::Integer, "integer"},
            {Spacing::Moreton, "moreton"}}}};
}
constexpr bool isFractional(Spacing spacing) {
  return spacing == Spacing::FractionalEven || spacing == Spacing::FractionalOdd ||
         spacing == Spacing::Moreton;
}

/// Factors from bounds on the deviation (Schwarz 2009, sections 7.4.2 to 7.4.4; SC-55 to SC-57).
struct ByDeviation {
  static constexpr const char *kKind = "deviation", *kSummary = "from a bound on the distance to the surface";
  double tolerancePx = 0.5;
  surfaces::FactorRule rule = surfaces::FactorRule::AbiEzziShirman;
  TriangleRule triangleRule = TriangleRule::Sides;
  FactorSpace space = FactorSpace::Lighting;
  bool strict = false;
  int most = 64;
  static const SettingsTable<ByDeviation>& table();
};

/// Factors from sizes on the screen, of the projected control points (section 7.4.1; SC-54). None of them
/// bounds the deviation, and a flat patch gets as many segments as a curved one.
struct BySize {
  static constexpr const char *kKind = "size", *kSummary = "from sizes on the screen";
  surfaces::CurveSize measure = surfaces::CurveSize::Rockwood;
  double segmentPx = 8.0;
  int most = 64;
  static const SettingsTable<BySize>& table();
};

/// The same factor on all sides of all patches.
struct BySegments {
  static constexpr const char *kKind = "uniform", *kSummary = "the same for all";
  int segments = 16;
  static const SettingsTable<BySegments>& table();
};

struct FactorSettings {
  std::variant<ByDeviation, BySegments, BySize> factors;
  bool cull = true;
  bool cornerFix = true;
  bool precompute = false;
  static const SettingsTable<FactorSettings>& table();
  int mostSegments() const;  ///< that a side may get
};

/// Phases 1 and 2 of CudaTess (Schwarz 2009, section 7.6): factors of each patch, of common sides the larger
/// one, and how many vertices and indices each patch's pattern takes.
class FactorPass {
 public:
  /// `lists`: triangles are counted, not indices of strips.
  FactorPass(frame::Frame& frame, const PatchBuffers& patches, const FactorSettings& settings,
             bool lists = false, Spacing spacing = Spacing::Integer);
  /// Opens the passes tessellation/factors and tessellation/counts, and before them tessellation/motion,
  /// which moves the control points, where surfaces move. Ends with barriers for shader storage.
  void run(frame::Frame& frame) const;
  /// All before tessellation/counts.
  void runFirst(frame::Frame& frame) const;
  gl::ShaderDefines countDefines() const { return countDefines_; }

  /// Patches whose bound asks for more segments than a side may have, or of which no bound is known: those
  /// may deviate by more than the tolerance. Computes the last frame's factors again and waits for the GPU.
  int64_t countCapped(frame::Frame& frame) const;

  const gl::Buffer& factors() const { return factors_; }  ///< kFactorsBuffer: PatchFactors
  const gl::Buffer& ownFactors() const {
    return own_;
  }  ///< kOwnFactorsBuffer, before neighbours are looked at
  const gl::Buffer& counts() const { return counts_; }  ///< uvec2 per patch, and one more
  int64_t bytes() const { return own_.bytes() + factors_.bytes() + counts_.bytes() + bounds_.bytes(); }

 private:
  const PatchBuffers& patches_;
  FactorSettings settings_;
  void requireBounds(const scene::Scene& scene) const;
  void movePoints(frame::Frame& frame) const;
  void dispatch(const gl::Program& program) const;
  void runFactors(frame::Frame& frame, const gl::Program& program) const;

  gl::ShaderDefines countDefines_;
  const gl::Program &factorsProgram_, &countsProgram_;
  const gl::Program* moveProgram_ = nullptr;  // where surfaces move
  gl::Buffer own_, factors_, counts_, bounds_;
};

}  // namespace limen::techniques
