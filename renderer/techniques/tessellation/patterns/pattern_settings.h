// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/shaded.h"
#include "renderer/techniques/tessellation/factor_pass.h"

namespace limen::techniques {

/// Who issues what.
enum class PatternDraw { Immediate, Instanced, MultiDraw };
constexpr EnumNames<PatternDraw, 3> enumNames(PatternDraw) {
  return {{{{PatternDraw::Immediate, "immediate"},
            {PatternDraw::Instanced, "instanced"},
            {PatternDraw::MultiDraw, "multi_draw"}}}};
}

/// What passes after the first draw (SC-75).
enum class PatternReuse { Evaluate, Soup };
constexpr EnumNames<PatternReuse, 2> enumNames(PatternReuse) {
  return {{{{PatternReuse::Evaluate, "evaluate"}, {PatternReuse::Soup, "soup"}}}};
}

/// Who evaluates vertices (SC-64).
enum class PatternEvaluation { Vertex, Pixel };
constexpr EnumNames<PatternEvaluation, 2> enumNames(PatternEvaluation) {
  return {{{{PatternEvaluation::Pixel, "pixel"}, {PatternEvaluation::Vertex, "vertex"}}}};
}

/// Which patterns there are.
enum class PatternKind { Integer, Dyadic, Adapted, AdaptedInteger };
constexpr EnumNames<PatternKind, 4> enumNames(PatternKind) {
  return {{{{PatternKind::Adapted, "adapted"},
            {PatternKind::AdaptedInteger, "adapted_integer"},
            {PatternKind::Dyadic, "dyadic"},
            {PatternKind::Integer, "integer"}}}};
}

struct PatternSettings {
  FactorSettings tessellation;
  PatternKind patterns = PatternKind::Dyadic;
  PatternDraw draw = PatternDraw::Instanced;
  int64_t capacity = 1 << 20;
  bool coarseFirst = false;
  int passes = 1;
  PatternReuse reuse = PatternReuse::Evaluate;
  PatternEvaluation evaluation = PatternEvaluation::Vertex;
  frame::ShadedSetting shading;
  static const SettingsTable<PatternSettings>& table() {
    using S = PatternSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::patterns, "patterns",
         "One for each tuple of factors, of whole numbers or powers of two; or uniform ones of the largest "
         "factor, with "
         "samples on sides moved to the side's own",
         "Schwarz 2009, sections 7.5.1 and 7.5.4"},
        {&S::draw, "draw", "A call for each patch, for each pattern, or one for all",
         "Schwarz 2009, section 7.5.3"},
        {&S::capacity,
         "capacity",
         {4, 1 << 26},
         "vertices",
         "Vertices of all patterns that the buffers hold; indices: six times as many"},
        {&S::coarseFirst, "coarse_first",
         "Patches with one segment a side are drawn together, as a mesh whose other patches vanish",
         "Dyken, Reimers and Seland 2008; Schwarz 2009, section 7.5.3"},
        {&S::passes,
         "passes",
         {1, 8},
         "passes",
         "Passes over the same triangles in a frame. All but the last make depths alone",
         "Schwarz 2009, section 7.6.5"},
        {&S::reuse, "reuse",
         "Evaluate the patterns in each pass, or store their triangles in the first by transform feedback",
         "Lorenz and Döllner 2008; Schwarz 2009, section 7.6.5"},
        {&S::evaluation, "evaluation",
         "The vertex shader, in each pass; or once a frame the pixel shader, whose texels are copied into a "
         "buffer that the vertex shader reads",
         "Bolz and Schröder 2003; Schwarz 2009, section 7.5.1"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  bool adapted() const { return patterns == PatternKind::Adapted || patterns == PatternKind::AdaptedInteger; }
  bool dyadic() const { return patterns == PatternKind::Adapted || patterns == PatternKind::Dyadic; }
  int most() const { return tessellation.mostSegments(); }
  void check() const {
    if (draw == PatternDraw::MultiDraw && coarseFirst)
      throw Error("a single draw has no part of its own for coarse patches", "coarse_first",
                  "use draw: instanced or immediate");
    if (evaluation == PatternEvaluation::Pixel && (draw == PatternDraw::MultiDraw || coarseFirst))
      throw Error("texels are given out to patches that the host counts", "evaluation",
                  "use draw: instanced or immediate, and leave coarse_first off");
    if (evaluation == PatternEvaluation::Pixel && reuse == PatternReuse::Soup)
      throw Error("vertices are stored already", "evaluation", "use reuse: evaluate");
    if (reuse == PatternReuse::Soup && coarseFirst)
      throw Error("triangles are stored of one program alone", "coarse_first",
                  "leave it off, or use reuse: evaluate");
    if (draw == PatternDraw::MultiDraw && !dyadic())
      throw Error("a single draw needs patterns that are known before", "draw",
                  "use patterns: dyadic or adapted, or draw: instanced");
  }
};

}  // namespace limen::techniques
