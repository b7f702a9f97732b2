// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical traversal of the min/max pyramid (SS-07): each receiver walks the quadtree over the shadow map
// down to the texels that hide the light, and takes a tile that lies in the shaft to the light, all texels of
// which are nearer than the receiver, as one block. Source: Schwarz 2009, sections 3.2.1 and 4.3.3 (after
// Dmitriev 2007, who keeps a stack; here the order of the tiles needs none).
//
// A block has one depth, which the thesis leaves open: declared as 'block_depth'. Tiles that the shaft's
// sides cut are taken apart, so blocks are the only approximation beside micropatches.
#include <bit>

#include "experiments/base/error.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kDefaultTraversalPattern = "jittered_16", *kDefaultBlockDepth = "mean";

gl::ShaderDefines traversalDefines(const ParameterValues& values) {
  gl::ShaderDefines defines;
  if (values.text("accumulation") == "bitmask") {
    const std::string& pattern = values.text("pattern");
    defines["BITMASK"] = "1";
    defines["PATTERN"] = pattern == "jittered_16" ? "160" : pattern.substr(pattern.rfind('_') + 1);
  }
  if (values.boolean("blocks")) {
    defines["BLOCKS"] = "1";
    const std::string& depth = values.text("block_depth");
    defines["BLOCK_DEPTH"] = depth == "minimum"   ? "nearest"
                             : depth == "maximum" ? "farthest"
                                                  : "(0.5 * (nearest + farthest))";
  }
  return defines;
}

void checkTraversal(const ParameterValues& values) {
  if (values.text("accumulation") != "bitmask" && values.text("pattern") != kDefaultTraversalPattern)
    throw Error("'pattern' is about bitmasks, and areas are summed", "pattern",
                "leave it out, or give accumulation: bitmask");
  if (!values.boolean("blocks") && values.text("block_depth") != kDefaultBlockDepth)
    throw Error("'block_depth' is about blocks, and there are none", "block_depth",
                "leave it out, or give blocks: true");
  const auto coarsest = std::bit_width(static_cast<unsigned>(std::stoi(values.text("resolution")))) - 1;
  if (values.integer("finest_level") > coarsest)
    throw Error("a map of " + values.text("resolution") + " texels has no level " +
                    std::to_string(values.integer("finest_level")),
                "finest_level", "give at most " + std::to_string(coarsest) + ", or raise 'resolution'");
}

class HsmTraversal : public VisibilityTechnique {
 public:
  explicit HsmTraversal(const ParameterValues& values)
      : VisibilityTechnique(values, "renderer/techniques/soft_shadows/hsm_traversal/hsm_traversal.comp.glsl",
                            "soft_shadows/hsm_traversal", traversalDefines(values)),
        finestLevel_(static_cast<int>(values.integer("finest_level"))) {
    checkTraversal(values);
  }

  static std::vector<Quantity> counterNames() {
    std::vector<Quantity> names = VisibilityTechnique::counterNames();
    names.emplace_back("nodes_per_px");
    return names;
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = VisibilityTechnique::count(frame);
    double nodes = 0.0, processed = 0.0;
    for (size_t i = 0; i < counted().work.size(); i += 4) {
      if (counted().work[i] != Processed) continue;
      nodes += counted().search[i + 1], processed += 1.0;
    }
    all.push_back({"nodes_per_px", processed > 0.0 ? nodes / processed : 0.0, "", true});
    return all;
  }

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    // A tile costs a turn of the loop and at most one more on the way back up.
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

std::vector<Parameter> traversalParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(2.0);
  all.push_back(choiceParameter("accumulation", "area", {"area", "bitmask"},
                                "Hidden areas of the light are summed, or hidden samples are joined",
                                "Schwarz 2009, sections 3.2.1 and 4.2"));
  all.push_back(choiceParameter("pattern", kDefaultTraversalPattern,
                                {"regular_8", "regular_16", "regular_32", "jittered_16"},
                                "Light samples of the bitmask", "Schwarz 2009, sections 4.2.1 and 4.2.2"));
  all.push_back(booleanParameter("blocks", true,
                                 "A tile within the shaft to the light that is nearer than the receiver all "
                                 "over counts as one block; without, every texel is visited",
                                 "Schwarz 2009, section 3.2.1 (after Dmitriev 2007)"));
  all.push_back(choiceParameter("block_depth", kDefaultBlockDepth, {"minimum", "mean", "maximum"},
                                "Depth of a block: its nearest, its farthest, or half-way between"));
  all.push_back(integerParameter("finest_level", 0, 0, 12, "",
                                 "Level of the pyramid below which no tile is taken apart; 0: texels"));
  return all;
}

const Registered<TechniqueInfo> kHsmTraversalRegistered{
    {.name = "soft_shadows/hsm_traversal",
     .version = 1,
     .summary = "Each receiver walks down the min/max pyramid to the tiles that hide the light",
     .source = "Schwarz 2009, sections 3.2.1 and 4.3.3 (SS-07)",
     .product = ProductKind::Visibility,
     .parameters = traversalParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<HsmTraversal>(values); },
     .errorBound = {},
     .counters = HsmTraversal::counterNames(),
     .check = checkTraversal}};

}  // namespace
}  // namespace limen::techniques
