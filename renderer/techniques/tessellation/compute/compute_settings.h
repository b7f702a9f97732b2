// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/compute/prefix_sum.h"
#include "renderer/frame/compute_raster.h"
#include "renderer/frame/shaded.h"
#include "renderer/techniques/tessellation/factor_pass.h"
#include "renderer/techniques/tessellation/trim_settings.h"

namespace limen::techniques {

/// Who makes vertices and indices.
struct PatchParallel {
  static constexpr const char *kKind = "patch_parallel", *kSummary = "some invocations for each patch";
  int lanes = 0, verticesEach = 16;
  static const SettingsTable<PatchParallel>& table() {
    static const SettingsTable<PatchParallel> kTable = {
        {&PatchParallel::lanes, "lanes", oneOf({0, 4, 8, 16, 32, 64, 128, 256, 512, 1024}), "invocations",
         "Invocations that share a patch. 0: the GPU decides, in each frame and for all patches, from the "
         "mean "
         "number of their vertices"},
        {&PatchParallel::verticesEach,
         "vertices_each",
         {1, 64},
         "vertices",
         "Vertices of an invocation that the GPU's choice aims at; fewer where few patches would not occupy "
         "a "
         "GPU"}};
    return kTable;
  }
};
struct VertexParallel {
  static constexpr const char *kKind = "vertex_parallel",
                              *kSummary = "an invocation for each vertex, which searches for its patch";
};
struct FourThreads {
  static constexpr const char *kKind = "four_threads",
                              *kSummary = "four invocations a patch, one for each component (the thesis's)";
};

struct EvaluateDirectly {
  static constexpr const char *kKind = "direct", *kSummary = "each sample for itself";
};
/// SC-72.
struct EvaluateByDifferences {
  static constexpr const char *kKind = "forward_differences",
                              *kSummary = "rows of samples by forward differences, of bicubic patches";
  int restart = 64;
  static const SettingsTable<EvaluateByDifferences>& table() {
    static const SettingsTable<EvaluateByDifferences> kTable = {
        {&EvaluateByDifferences::restart,
         "restart",
         {2, 64},
         "samples",
         "Samples after which a run starts anew; with patch_parallel, each run is an invocation's"}};
    return kTable;
  }
};

/// SC-76.
struct EvaluateInVertexShader {
  static constexpr const char
      *kKind = "vertex_shader",
      *kSummary = "by the vertex shader, in each pass, from a patch and a sample stored for each vertex";
};

/// Who makes the vertices of a side that two patches have in common (SC-74).
enum class SharedSides { Evaluated, Copied };
constexpr EnumNames<SharedSides, 2> enumNames(SharedSides) {
  return {{{{SharedSides::Copied, "copied"}, {SharedSides::Evaluated, "evaluated"}}}};
}

constexpr int64_t kMostVertices = 1 << 26;  // 2 GiB

struct ComputeTessellationSettings {
  FactorSettings tessellation;
  std::variant<PatchParallel, VertexParallel, FourThreads> form;
  Spacing spacing = Spacing::Integer;
  std::variant<EvaluateDirectly, EvaluateByDifferences, EvaluateInVertexShader> evaluation;
  SharedSides sides = SharedSides::Evaluated;
  compute::ScanForm scan = compute::ScanForm::Auto;
  frame::Raster raster = frame::Raster::Auto;
  int64_t capacity = 0;
  int passes = 1;
  TrimByTexture trims;
  frame::ShadedSetting shading;
  static const SettingsTable<ComputeTessellationSettings>& table() {
    using S = ComputeTessellationSettings;
    static const SettingsTable<S> kTable = {
        included(&S::tessellation),
        {&S::form, "form", "How vertices and indices are shared out to invocations",
         "Schwarz 2009, section 7.6.1"},
        {&S::spacing, "spacing", "How a side is divided whose factor is no whole number",
         "Schwarz 2009, section 7.3.3"},
        {&S::evaluation, "evaluation", "How samples of a patch are evaluated", "Schwarz 2009, section 7.6.2"},
        {&S::sides, "sides",
         "Vertices on common sides: evaluated by both patches, in an order that gives the same bits, or "
         "copied from one",
         "Schwarz 2009, section 7.6.1"},
        {&S::scan, "scan", "How offsets are summed"},
        {&S::raster, "raster",
         "How triangles become pixels: as strips by the driver, or one by one in compute"},
        {&S::capacity,
         "capacity",
         {0, kMostVertices},
         "vertices",
         "Vertices that the buffers hold; indices: six times as many. 0: twice what the first view takes. "
         "Patches that do not fit are left out and counted"},
        {&S::passes,
         "passes",
         {1, 8},
         "passes",
         "Passes over the same triangles in a frame. All but the last make depths alone; with more than one, "
         "or "
         "evaluation in the vertex shader, the driver makes pixels",
         "Schwarz 2009, section 7.6.1"},
        {&S::trims, "trims", "Where trimmed surfaces are looked up, which the driver makes pixels of",
         "Schwarz 2009, section 6.1.4"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }
  bool byDifferences() const { return std::holds_alternative<EvaluateByDifferences>(evaluation); }
  bool vertexParallel() const { return std::holds_alternative<VertexParallel>(form); }
  bool fourThreads() const { return std::holds_alternative<FourThreads>(form); }
  bool inVertexShader() const { return std::holds_alternative<EvaluateInVertexShader>(evaluation); }
  bool needsDriver() const { return passes > 1 || inVertexShader(); }
  void check() const {
    if (needsDriver() && raster == frame::Raster::Compute)
      throw Error("several passes, and vertex shaders, are for the driver's rasteriser", "raster",
                  "use raster: hardware");
    if (inVertexShader() && (fourThreads() || spacing > Spacing::Dyadic || sides == SharedSides::Copied))
      throw Error("the vertex shader takes equal steps, and each vertex for itself", "evaluation",
                  "use spacing: integer or dyadic, sides: evaluated, and another form than four_threads");
    if (vertexParallel() && byDifferences())
      throw Error("forward differences need invocations that go along rows", "evaluation",
                  "use form: patch_parallel or four_threads");
    if (spacing > Spacing::Dyadic && (fourThreads() || byDifferences()))
      throw Error("this form of evaluation takes equal steps", "spacing",
                  "use spacing: integer or dyadic, or another form and direct evaluation");
  }
};

}  // namespace limen::techniques
