// SPDX-License-Identifier: BSD-3-Clause
// Backprojection with depth peeling (SS-07): of a texel's layers, the farthest that is still nearer to the
// light than the receiver becomes its micropatch, which closes leaks where a near blocker hides the rest of
// the surface in front of the receiver. Source: Schwarz 2009, section 3.2.1 (after Bavoil et al. 2008).
//
// Areas are summed, one micropatch per texel, however many layers there are; micropatches are not stretched
// to their neighbours, so that the remedies can be compared. Pyramids of layers behind the first would not
// help a budget: which layer is the farthest before a receiver is known of single texels alone. Cells read
// these.
#include <variant>

#include "renderer/techniques/soft_shadows/occluder_kinds.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

struct WholeTexels {
  static constexpr const char *kKind = "texels", *kSummary = "every texel of the map";
};
struct PeeledCells {
  static constexpr const char *kKind = SearchCells::kKind, *kSummary = SearchCells::kSummary;
  int budget = 256;  ///< micropatches per pixel; 0: no limit
  SearchCells cells;
  static const SettingsTable<PeeledCells>& table() {
    static const SettingsTable<PeeledCells> kTable = {
        {&PeeledCells::budget,
         "budget",
         {0, 1 << 24},
         "",
         "Micropatches allowed per pixel; the square root is the number per axis; 0: no limit",
         "Schwarz 2009, sections 4.1 and 4.5"},
        included(&PeeledCells::cells)};
    return kTable;
  }
};

struct PeeledSettings {
  MapSettings map;
  ReceiverBiasSettings bias = PlaneBias{};
  int layers = 2;
  double peelBias = 1e-5;
  int refinements = 2;
  std::variant<WholeTexels, PeeledCells> division;
  static const SettingsTable<PeeledSettings>& table() {
    using S = PeeledSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::layers,
         "layers",
         {1, 4},
         "",
         "Number of surfaces behind one another stored per texel",
         "Schwarz 2009, section 3.2.1 (after Bavoil et al. 2008)"},
        {&S::peelBias,
         "peel_bias",
         {0, 0.1},
         "",
         "A surface lies behind another if it is farther by more than this share"},
        {&S::refinements,
         "refinements",
         {0, 3},
         "",
         "Number of times that the search area is narrowed by its depth range",
         "Schwarz 2009, section 4.1"},
        {&S::division, "division",
         "Division of the search area into micropatches: every texel, as in the thesis, or cells of any size",
         "Schwarz 2009, section 3.2.1 (texels); cells: own form"}};
    return kTable;
  }
};

class Peeled : public VisibilityTechnique {
 public:
  using Settings = PeeledSettings;
  explicit Peeled(const PeeledSettings& settings)
      : VisibilityTechnique(settings.map, anyBias(settings.bias),
                            "renderer/techniques/soft_shadows/peeled/peeled.comp.glsl", "soft_shadows/peeled",
                            definesOf(settings)),
        settings_(settings) {}

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    static_assert(kThirdLayerUnit == kSecondLayerUnit + 1 && kFourthLayerUnit == kSecondLayerUnit + 2);
    // Before any is bound, since making the inputs binds textures too.
    for (int layer = 1; layer < settings_.layers; ++layer) frame.get<frame::ShadowMap>(layerMap(layer));
    frame.get<frame::MinMaxPyramid>(mapSettings());
    for (int layer = 1; layer < settings_.layers; ++layer)
      frame.get<frame::ShadowMap>(layerMap(layer))
          .texture()
          .bindTexture(kSecondLayerUnit + static_cast<uint32_t>(layer) - 1);
    maxIterations_ = maxIterations(frame);
    return bindPyramid(frame);
  }

  void configure(const gl::Program& program) const override {
    program.set("levels", pyramidLevels());
    program.set("refinements", settings_.refinements);
    program.set("maxIterations", maxIterations_);
    if (const auto* cells = std::get_if<PeeledCells>(&settings_.division)) {
      program.set("allowedPerAxis", allowedPerAxis(cells->budget));
      cells->cells.configure(program);
    }
  }

 private:
  static gl::ShaderDefines definesOf(const PeeledSettings& settings) {
    gl::ShaderDefines defines = {{"LAYERS", std::to_string(settings.layers)}};
    if (std::holds_alternative<PeeledCells>(settings.division)) defines["SEARCH_CELLS"] = "1";
    return defines;
  }
  frame::ShadowMapSettings layerMap(int layer) const {
    frame::ShadowMapSettings map = mapSettings();
    map.layer = layer;
    map.peelBias = settings_.peelBias;
    return map;
  }

  PeeledSettings settings_;
  int maxIterations_ = 0;
};

const RegisteredTechnique<Peeled> kPeeledRegistered{
    {.name = "soft_shadows/peeled",
     .version = 2,
     .summary = "Backprojection of each texel's farthest layer that is nearer than the receiver",
     .source = "Schwarz 2009, section 3.2.1 (SS-07)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = VisibilityTechnique::quantities()}};

}  // namespace
}  // namespace limen::techniques
