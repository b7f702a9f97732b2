// SPDX-License-Identifier: BSD-3-Clause
// Occlusion textures (SS-08): the scene cut into slices parallel to the light, each flattened to a picture of
// what it covers. Visibility is the product over the slices before the receiver of the part of the light's
// cone that each leaves open, as if they blocked independently of each other. What blocks within the
// receiver's own slice is missed. Source: Schwarz 2009, section 3.2.1 (after Eisemann and Décoret 2006 and
// 2008; formula reconstructed). Here the slices are seen in perspective from the light's centre and made in
// one pass, a bit of a texel each.
#include "experiments/base/error.h"
#include "renderer/frame/occlusion_slices.h"
#include "renderer/techniques/soft_shadows/prefiltered_technique.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines occlusionTexturesDefines(const ParameterValues& values) {
  if (prefilterOf(values) == frame::Prefilter::Mips) return {{"MIPS", "1"}};
  return frame::SummedAreaTable::defines(frame::SumForm::Fixed);
}

void checkOcclusionTextures(const ParameterValues& values) {
  if (values.text("raster") == "compute")
    throw Error("slices are rasterised by the driver alone", "raster",
                "leave it out, or give raster: hardware");
}

class OcclusionTextures : public VisibilityTechnique {
 public:
  explicit OcclusionTextures(const ParameterValues& values)
      : VisibilityTechnique(
            values, "renderer/techniques/soft_shadows/occlusion_textures/occlusion_textures.comp.glsl",
            "soft_shadows/occlusion_textures", occlusionTexturesDefines(values)),
        settings_{mapSettings().resolution, static_cast<int>(values.integer("slices")), prefilterOf(values)} {
    checkOcclusionTextures(values);
  }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = VisibilityTechnique::count(frame);
    all.push_back({"structure_bytes", static_cast<double>(slices_->bytes()), "byte", true});
    return all;
  }

 protected:
  const frame::LightFrustum& bindMap(frame::Frame& frame) override {
    slices_ = &frame.get<frame::OcclusionSlices>(settings_);
    slices_->bind(2);
    return slices_->frustum();
  }

  void configure(const gl::Program& program) const override {
    program.set("slices", settings_.slices);
    program.set("sliceBegin", static_cast<float>(slices_->begin()));
    program.set("sliceDepth", static_cast<float>(slices_->depth()));
    program.set("sumsUnit", 1.0F);
  }

 private:
  frame::OcclusionSliceSettings settings_;
  const frame::OcclusionSlices* slices_ = nullptr;
};

std::vector<Parameter> occlusionTexturesParameters() {
  std::vector<Parameter> all = VisibilityTechnique::commonParameters(1.0);
  for (Parameter& parameter : all)
    if (parameter.name == "resolution") parameter.defaultValue = std::string("256");
  all.push_back(integerParameter("slices", 16, 1, 32, "",
                                 "Slices between the nearest and the farthest caster",
                                 "Schwarz 2009, section 3.2.1 (number not given there)"));
  all.push_back(prefilterParameter({"sums", "mips"}));
  return all;
}

std::vector<Quantity> counterNamesWithBytes() {
  std::vector<Quantity> names = VisibilityTechnique::counterNames();
  names.emplace_back("structure_bytes");
  return names;
}

const Registered<TechniqueInfo> kOcclusionTexturesRegistered{
    {.name = "soft_shadows/occlusion_textures",
     .version = 1,
     .summary =
         "Occlusion textures: product over slices of the part of the light's cone that each leaves open",
     .source = "Schwarz 2009, section 3.2.1 (SS-08)",
     .product = ProductKind::Visibility,
     .parameters = occlusionTexturesParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<OcclusionTextures>(values); },
     .errorBound = {},
     .counters = counterNamesWithBytes(),
     .check = checkOcclusionTextures}};

}  // namespace
}  // namespace limen::techniques
