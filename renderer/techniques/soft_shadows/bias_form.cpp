// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bias_form.h"

#include "experiments/base/error.h"

namespace limen::techniques {
namespace {

constexpr const char *kReceiverSlope = "receiver_slope", *kConstant = "constant", *kPerLevel = "per_level",
                     *kStored = "stored";
constexpr double kDefaultGrowth = 2.0, kDefaultScale = 1.0, kDefaultMaxSlope = 10.0;
constexpr uint32_t kBiasUnit = 9;

}  // namespace

BiasForm::BiasForm(const ParameterValues& values)
    : byLevel_(values.text("bias_form") == kConstant || values.text("bias_form") == kPerLevel),
      isStored_(values.text("bias_form") == kStored),
      growth_(values.text("bias_form") == kPerLevel ? static_cast<float>(values.real("bias_growth")) : 1.0F),
      scale_(static_cast<float>(values.real("stored_scale"))),
      constant_(static_cast<float>(values.real("bias"))),
      maxSlope_(static_cast<float>(values.real("max_slope"))) {}

std::vector<Parameter> BiasForm::parameters() {
  return {
      choiceParameter(
          "bias_form", kReceiverSlope, {kReceiverSlope, kConstant, kPerLevel, kStored},
          "What the depth bias has beyond or instead of a constant: the receiver's slope over a "
          "texel, nothing, a factor for each level, or what texels store of their triangles' slopes",
          "Schwarz 2009, section 4.5.4"),
      realParameter("bias_growth", kDefaultGrowth, 1.0, 8.0, "",
                    "Factor by which the constant bias grows from level to level (bias_form: per_level)",
                    "Schwarz 2009, section 4.5.4 (value not given there)"),
      // Where the light is seen from the receiver's plane within an angle whose tangent, times that of the
      // plane's tilt, is c, occluders of the plane itself darken it unless the scale is 1 / (1 - c) or more.
      realParameter("stored_scale", kDefaultScale, 0.0, 16.0, "",
                    "Multiple of the stored bias that is tested with (bias_form: stored)",
                    "Schwarz 2009, section 4.5.4 (1)")};
}

void BiasForm::check(const ParameterValues& values, double defaultSlopeBias) {
  const std::string &form = values.text("bias_form"), &occluders = values.text("occluders");
  if (form != kReceiverSlope && values.real("slope_bias") != defaultSlopeBias)
    throw Error("'slope_bias' is about the receiver's slope, and bias_form " + form + " ignores that",
                "slope_bias", "leave it out, or give bias_form: receiver_slope");
  if (form != kReceiverSlope && form != kStored && values.real("max_slope") != kDefaultMaxSlope)
    throw Error("'max_slope' is about slopes, and bias_form " + form + " ignores these", "max_slope",
                "leave it out, or give bias_form: receiver_slope or stored");
  if (form != kPerLevel && values.real("bias_growth") != kDefaultGrowth)
    throw Error("'bias_growth' is about a constant for each level, and bias_form " + form + " has none",
                "bias_growth", "leave it out, or give bias_form: per_level");
  if (form != kStored && values.real("stored_scale") != kDefaultScale)
    throw Error("'stored_scale' is about biases that texels store, and bias_form " + form + " stores none",
                "stored_scale", "leave it out, or give bias_form: stored");
  if (form == kStored && !(occluders == "micropatches" || occluders.starts_with("microquads")))
    throw Error("'bias_form: stored' has a bias for each texel of a level, and " + occluders +
                    " are made of others or of several",
                "bias_form", "give another form, or occluders: micropatches or microquads");
}

gl::ShaderDefines BiasForm::defines() const {
  if (byLevel_) return {{"BIAS_BY_LEVEL", "1"}};
  if (isStored_) return {{"BIAS_STORED", "1"}};
  return {};
}

void BiasForm::make(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  if (isStored_)
    stored_ = &frame.get<frame::BiasMap>(frame::BiasSettings{map, maxSlope_, constant_}).levels();
}

void BiasForm::bind() const {
  if (stored_) stored_->biases().bindTexture(kBiasUnit);
}

void BiasForm::configure(const gl::Program& program) const {
  program.set("biasGrowth", growth_);
  program.set("storedScale", scale_);
}

}  // namespace limen::techniques
