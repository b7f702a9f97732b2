// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical traversal of the min/max pyramid (SS-07): each receiver walks the quadtree over the shadow map
// down to the texels that hide the light; a tile in the shaft to the light, all of whose texels are nearer
// than the receiver, is treated as one block. Source: Schwarz 2009, sections 3.2.1 and 4.3.3 (after Dmitriev
// 2007, who keeps a stack; here the order of the tiles needs none).
//
// A block has one depth, which the thesis leaves open: declared as 'blocks'. Tiles cut by the shaft's sides
// are subdivided, so blocks are the only approximation besides micropatches.
#include <bit>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

/// Depth of a tile that counts as one block.
enum class BlockDepth { None, Minimum, Mean, Maximum };
constexpr EnumNames<BlockDepth, 4> enumNames(BlockDepth) {
  return {{{{BlockDepth::None, "none"},
            {BlockDepth::Minimum, "minimum"},
            {BlockDepth::Mean, "mean"},
            {BlockDepth::Maximum, "maximum"}}}};
}

struct SummedArea {
  static constexpr const char *kKind = "area", *kSummary = "hidden areas of the light are summed";
};
struct JoinedMask {
  static constexpr const char *kKind = "bitmask", *kSummary = "hidden samples of the light are combined";
  GridPattern pattern = GridPattern::Jittered16;
  static const SettingsTable<JoinedMask>& table() {
    static const SettingsTable<JoinedMask> kTable = {
        Binding(&JoinedMask::pattern, "pattern", "Light samples", "Schwarz 2009, sections 4.2.1 and 4.2.2")
            .formerly({"pattern"})};
    return kTable;
  }
};

struct TraversalSettings {
  MapSettings map;
  ReceiverBiasSettings bias = PlaneBias{};
  std::variant<SummedArea, JoinedMask> accumulation;
  BlockDepth blocks = BlockDepth::Mean;
  int finestLevel = 0;

  static const SettingsTable<TraversalSettings>& table() {
    using S = TraversalSettings;
    static const SettingsTable<S> kTable = {
        included(&S::map),
        Binding(&S::bias, "bias", "Bias that keeps a surface from shadowing itself").shorthand("constant"),
        {&S::accumulation, "accumulation", "What is accumulated from tiles that hide the light",
         "Schwarz 2009, sections 3.2.1 and 4.2"},
        Binding(&S::blocks, "blocks",
                "Depth of a tile that lies within the shaft to the light, is nearer than the receiver "
                "everywhere and so counts as one block; none: every texel is visited",
                "Schwarz 2009, section 3.2.1 (after Dmitriev 2007)")
            .formerly({"block_depth"}),
        {&S::finestLevel,
         "finest_level",
         {0, 12},
         "",
         "Finest level of the pyramid to which tiles are subdivided; 0: texels"}};
    return kTable;
  }

  void check() const {
    const int coarsest = std::bit_width(static_cast<unsigned>(map.resolution)) - 1;
    if (finestLevel > coarsest)
      throw Error("a map of " + std::to_string(map.resolution) + " texels has no level " +
                      std::to_string(finestLevel),
                  "finest_level", "give at most " + std::to_string(coarsest) + ", or raise 'resolution'");
  }
};

gl::ShaderDefines traversalDefines(const TraversalSettings& settings) {
  gl::ShaderDefines defines;
  if (const auto* mask = std::get_if<JoinedMask>(&settings.accumulation)) {
    defines["BITMASK"] = "1";
    defineSamples(defines, lightPattern(mask->pattern));
  }
  if (settings.blocks != BlockDepth::None) {
    defines["BLOCKS"] = "1";
    defineEnum(defines, "BLOCK_DEPTH", settings.blocks);
  }
  return defines;
}

class HsmTraversal : public VisibilityTechnique {
 public:
  using Settings = TraversalSettings;
  explicit HsmTraversal(const TraversalSettings& settings)
      : VisibilityTechnique(settings.map, anyBias(settings.bias),
                            "renderer/techniques/soft_shadows/hsm_traversal/hsm_traversal.comp.glsl",
                            "soft_shadows/hsm_traversal", traversalDefines(settings)),
        finestLevel_(settings.finestLevel) {}

  static std::vector<Quantity> quantities() {
    std::vector<Quantity> names = VisibilityTechnique::quantities();
    names.emplace_back("nodes_per_px", "Tiles visited per pixel", "1/px", Direction::LowerIsBetter,
                       "Schwarz 2009, section 4.3.3");
    return names;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = VisibilityTechnique::count(frame);
    double nodes = 0.0, processed = 0.0;
    for (size_t i = 0; i < counted().work.size(); i += 4) {
      if (counted().work[i] != Processed) continue;
      nodes += counted().search[i + 1], processed += 1.0;
    }
    all.push_back({"nodes_per_px", processed > 0.0 ? nodes / processed : 0.0});
    return all;
  }

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    // A tile costs one iteration of the loop and at most one more on the way back up.
    maxIterations_ = maxIterations(frame) / 2;
    return bindPyramid(frame);
  }

  void configure(const gl::Program& program) const override {
    program.set("levels", pyramidLevels());
    program.set("finestLevel", finestLevel_);
    program.set("maxIterations", maxIterations_);
  }

 private:
  int finestLevel_, maxIterations_ = 0;
};

const RegisteredTechnique<HsmTraversal> kHsmTraversalRegistered{
    {.name = "soft_shadows/hsm_traversal",
     .version = 2,
     .summary = "Each receiver walks down the min/max pyramid to the tiles that hide the light",
     .source = "Schwarz 2009, sections 3.2.1 and 4.3.3 (SS-07)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = HsmTraversal::quantities()}};

}  // namespace
}  // namespace limen::techniques
