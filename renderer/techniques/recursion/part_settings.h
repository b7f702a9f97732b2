// SPDX-License-Identifier: BSD-3-Clause
// What recursion on the GPU is told, by queues and by geometry shaders alike.
#pragma once

#include "renderer/frame/compute_raster.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

enum class PartFlatness { ControlToChord, ControlToCorresponding, Extent };
constexpr EnumNames<PartFlatness, 3> enumNames(PartFlatness) {
  return {{{{PartFlatness::ControlToChord, "control_to_chord"},
            {PartFlatness::ControlToCorresponding, "control_to_corresponding"},
            {PartFlatness::Extent, "extent"}}}};
}
enum class PartSplit { Halves, Quarters };
constexpr EnumNames<PartSplit, 2> enumNames(PartSplit) {
  return {{{{PartSplit::Halves, "halves"}, {PartSplit::Quarters, "quarters"}}}};
}

struct PartSettings {
  double tolerancePx = 0.25;
  PartFlatness flatness = PartFlatness::ControlToChord;
  PartSplit split = PartSplit::Quarters;
  int grid = 4;
  int mostSteps = 14;
  bool cull = true;
  frame::Raster raster = frame::Raster::Auto;
  int64_t capacity = 1 << 21;
  frame::ShadedSetting shading;
  static const SettingsTable<PartSettings>& table() {
    using S = PartSettings;
    static const SettingsTable<S> kTable = {
        {&S::tolerancePx,
         "tolerance_px",
         {0.05, 100},
         "px",
         "Flatness of a finished part's cells, or extent of the part",
         "Schwarz 2009 (flatness 0.5; extent 8)"},
        {&S::flatness, "flatness", "What of a part is measured", "Schwarz 2009, section 7.2.1"},
        {&S::split, "split", "How a rectangle is split; triangles always into four",
         "Schwarz 2009, section 7.2.2"},
        {&S::grid, "grid", oneOf({1, 2, 4, 8, 16}), "segments", "Segments of a finished part's sides",
         "Schwarz 2009, section 7.2.5 (split and dice: 16)"},
        {&S::mostSteps, "most_steps", {0, 20}, "steps", "Splits from a patch to a part at most"},
        {&S::cull, "cull", "Leave out parts outside the view"},
        {&S::raster, "raster", "How triangles become pixels: by the driver, or one by one in compute"},
        {&S::capacity,
         "capacity",
         {1024, 1 << 26},
         "vertices",
         "Vertices that the buffers hold; queues hold as many parts as these make"},
        frame::shadingBinding(&S::shading)};
    return kTable;
  }

  /// Of a part before it is diced: cells of a smooth surface deviate less by the square of their number along
  /// a side.
  double partTolerance() const {
    return flatness == PartFlatness::Extent ? tolerancePx : tolerancePx * grid * grid;
  }

  /// For part_flatness.glsl and shaders that split by it.
  gl::ShaderDefines defines(gl::ShaderDefines out) const {
    defineEnum(out, "FLATNESS", flatness);
    if (split == PartSplit::Halves) out["HALVES"] = "1";
    return out;
  }
  void setUniforms(const gl::Program& program, frame::Frame& frame) const {
    program.set("anchorToClip", frame::anchorToClip(frame));
    program.set("halfSize", 0.5F * glm::vec2(frame.sizePx()));
    program.set("nearest", static_cast<float>(frame::nearPlane(frame)));
    program.set("tolerance", static_cast<float>(partTolerance()));
    program.set("mostSteps", static_cast<uint32_t>(mostSteps));
    program.set("cull", cull ? 1 : 0);
  }
};

}  // namespace limen::techniques
