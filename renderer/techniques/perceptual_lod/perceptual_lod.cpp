// SPDX-License-Identifier: BSD-3-Clause
// The interactive perceptual pipeline (SP-35 to SP-37): each frame is drawn in layers, the content of the
// other layers masks differences between levels of detail in a layer, and objects are tested in turn against
// their finest level. Source: Schwarz 2009, section 9.5.
//
// What the thesis leaves open, and the choices made here:
// - Layers: their number, and uniform, logarithmic or explicit distance borders (parameters).
// - Depth: the raster's own, so that the picture equals the ordinary one bit for bit.
// - Nothing is drawn twice: layers, and the versions of objects under test, each go into a rectangle of their
// own of one buffer in the same dispatches; what is not tested is neither drawn nor cleared nor shaded again.
// An object that is shown with its finest level needs no second drawing of it, and the next coarser level is
// drawn only if the object may go there.
// - Shadow mask M_i: surfaces of layer i that are shadowed by other layers, whether or not an object of the
// layer shadows them too. In C_i it darkens what lies behind the visible part of the layer by a constant
// factor.
// - Where only one of two levels covers a pixel, the other shows what the other layers have there; objects of
// the same layer behind it are ignored. An object of the same layer between the two levels' surfaces is taken
// to be part of the object.
// - The finest level is lit with the shadows that the scene has with the object at its finest level.
// - C_i leaves out the object (and its layer), as in the thesis, so the thresholds are not those of the
// picture seen; the oracle's counters quantify the effect.
// - An object of which no pixel is visible keeps its level. Objects entirely off screen are skipped.
#include <epoxy/gl.h>

#include <optional>

#include "renderer/techniques/perceptual_lod/oracle.h"
#include "renderer/techniques/perceptual_lod/pipeline.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

class PerceptualLod : public Technique {
 public:
  using Settings = PerceptualLodSettings;
  explicit PerceptualLod(const PerceptualLodSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    pipeline_.emplace(frame, settings_);
    pipeline_->prime(frame.timeS());
    for (int n = settings_.settleFrames; n > 0; --n)
      pipeline_->render(frame.timeS() - n * settings_.frameStepS, true);
    // All results are available when the first frame asks for them.
    glFinish();
  }

  void render(frame::Frame& frame) override {
    timeS_ = frame.timeS() + static_cast<double>(rendered_++) * settings_.frameStepS;
    pipeline_->render(timeS_, settings_.tests.wait);
  }

  const gl::Texture& product() const override { return pipeline_->picture(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    const std::vector<int>& levels = pipeline_->shown().levels;
    std::vector<Counter> out = countLevels(frame.scene(), levels);
    if (settings_.oracle)
      countOracle(frame, timeS_, settings_.shading, settings_.model.seenOn(), settings_.rule, levels, out);
    const TestedLevels& control = pipeline_->control();
    out.push_back({"triangles_tested", static_cast<double>(pipeline_->trianglesTested())});
    out.push_back({"objects_tested", static_cast<double>(control.tested())});
    out.push_back({"tests_dropped", static_cast<double>(control.dropped())});
    out.push_back({"level_switches", static_cast<double>(control.switches())});
    out.push_back({"level_reversals", static_cast<double>(control.reversals())});
    out.push_back({"layers_drawn", static_cast<double>(pipeline_->images().layersDrawn())});
    out.push_back({"threshold_maps", static_cast<double>(pipeline_->mapsMade())});
    return out;
  }

  std::map<std::string, const gl::Texture*> debugViews() const override { return pipeline_->debugViews(); }

 private:
  PerceptualLodSettings settings_;
  mutable std::optional<PerceptualPipeline> pipeline_;
  int64_t rendered_ = 0;
  double timeS_ = 0.0;
};

std::vector<Quantity> layeredQuantities() {
  std::vector<Quantity> out = levelQuantities();
  out.insert(out.end(),
             {{"triangles_tested", "Triangles drawn for tests", "triangles", Direction::LowerIsBetter},
              {"objects_tested", "Tests", "tests", Direction::LowerIsBetter},
              {"tests_dropped", "Tests that arrived too late", "tests", Direction::LowerIsBetter},
              {"level_switches", "Level switches", "switches", Direction::Neither},
              {"level_reversals", "Switches back to the previous level", "switches", Direction::Neither},
              {"layers_drawn", "Layers drawn", "layers", Direction::LowerIsBetter},
              {"threshold_maps", "Threshold maps computed", "maps", Direction::LowerIsBetter}});
  return out;
}

const RegisteredTechnique<PerceptualLod> kPerceptualLodRegistered{
    {.name = "lod/perceptual",
     .version = 3,
     .summary =
         "Levels by visible difference: layers, a threshold map of each layer's surroundings, tests in turn",
     .source = "Schwarz 2009, section 9.5 (SP-35 to SP-37)",
     .product = ProductKind::Colour,
     .needs = {"lod_sets"},
     .counters = layeredQuantities()}};

}  // namespace
}  // namespace limen::techniques
