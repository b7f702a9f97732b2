// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bias_form.h"

#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

constexpr Range kConstants{0.0, 0.1};
constexpr const char* kConstantText =
    "Constant depth bias as a share of the receiver's distance from the light's plane";
constexpr const char* kFormsSource = "Schwarz 2009, section 4.5.4";

}  // namespace

const SettingsTable<PlaneBias>& PlaneBias::table() {
  static const SettingsTable<PlaneBias> kTable = {
      {&PlaneBias::constant, "constant", kConstants, "", kConstantText, kFormsSource},
      {&PlaneBias::slope,
       "slope",
       {0.0, 16.0},
       "texel",
       "Further bias by the change of the receiver's plane over as many texels of the finest level, for "
       "surfaces "
       "that bend towards the light"},
      {&PlaneBias::maxSlope,
       "max_slope",
       {0.1, 1e6},
       "",
       "Slope of depth, relative to distance and light-space tangent, up to which that bias grows"}};
  return kTable;
}

const SettingsTable<ConstantBias>& ConstantBias::table() {
  static const SettingsTable<ConstantBias> kTable = {
      {&ConstantBias::constant, "constant", kConstants, "", kConstantText, kFormsSource}};
  return kTable;
}

const SettingsTable<PerLevelBias>& PerLevelBias::table() {
  static const SettingsTable<PerLevelBias> kTable = {
      {&PerLevelBias::constant, "constant", kConstants, "", kConstantText, kFormsSource},
      Binding(&PerLevelBias::growth, "growth", Range{1.0, 8.0}, "",
              "Factor by which the constant grows from level to level",
              "Schwarz 2009, section 4.5.4 (value not given there)")
          .formerly({"bias_growth"})};
  return kTable;
}

// If the light is seen from the receiver's plane within an angle whose tangent, times that of the plane's
// tilt, is c, occluders of the plane itself darken it unless the scale is 1 / (1 - c) or more.
const SettingsTable<StoredBias>& StoredBias::table() {
  static const SettingsTable<StoredBias> kTable = {
      {&StoredBias::constant, "constant", kConstants, "", kConstantText, kFormsSource},
      Binding(&StoredBias::scale, "scale", Range{0.0, 16.0}, "",
              "Factor applied to the stored bias in the test", "Schwarz 2009, section 4.5.4 (1)")
          .formerly({"stored_scale"}),
      {&StoredBias::maxSlope,
       "max_slope",
       {0.1, 1e6},
       "",
       "Slope of depth, relative to distance and light-space tangent, up to which the bias grows"}};
  return kTable;
}

const SettingsTable<NormalOffsetBias>& NormalOffsetBias::table() {
  static const SettingsTable<NormalOffsetBias> kTable = {
      {&NormalOffsetBias::constant, "constant", kConstants, "", kConstantText, kFormsSource},
      {&NormalOffsetBias::offset,
       "offset",
       {0.0, 16.0},
       "texel",
       "Offset of receivers along their normal where light grazes the surface, in texels of the finest level "
       "at the "
       "receiver's distance; less by the sine of the angle of incidence",
       "Holbert 2011 (value not given there)"}};
  return kTable;
}

double constantOf(const BiasSettings& settings) {
  return std::visit([](const auto& form) { return form.constant; }, settings);
}

gl::ShaderDefines BiasForm::defines() const {
  if (std::holds_alternative<SlopeBias>(settings_)) return {};
  if (std::holds_alternative<PlaneBias>(settings_)) return {{"BIAS_PLANE", "1"}};
  if (std::holds_alternative<StoredBias>(settings_)) return {{"BIAS_STORED", "1"}};
  if (std::holds_alternative<NormalOffsetBias>(settings_)) return {{"BIAS_NORMAL_OFFSET", "1"}};
  return {{"BIAS_BY_LEVEL", "1"}};
}

void BiasForm::make(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  if (const auto* form = std::get_if<StoredBias>(&settings_))
    stored_ = &frame
                   .get<frame::BiasMap>(frame::BiasSettings{map, static_cast<float>(form->maxSlope),
                                                            static_cast<float>(form->constant)})
                   .levels();
}

void BiasForm::bind() const {
  if (stored_) stored_->biases().bindTexture(kTexelBiasesUnit);
}

void BiasForm::configure(const gl::Program& program) const {
  program.set("bias", static_cast<float>(constantOf(settings_)));
  if (const auto* form = std::get_if<SlopeBias>(&settings_)) {
    program.set("slopeBias", static_cast<float>(form->slope));
    program.set("maxSlope", static_cast<float>(form->maxSlope));
  } else if (const auto* plane = std::get_if<PlaneBias>(&settings_)) {
    program.set("slopeBias", static_cast<float>(plane->slope));
    program.set("maxSlope", static_cast<float>(plane->maxSlope));
  } else if (const auto* stored = std::get_if<StoredBias>(&settings_)) {
    program.set("storedScale", static_cast<float>(stored->scale));
  } else if (const auto* moved = std::get_if<NormalOffsetBias>(&settings_)) {
    program.set("normalOffset", static_cast<float>(moved->offset));
  } else {
    const auto* grown = std::get_if<PerLevelBias>(&settings_);
    program.set("biasGrowth", grown ? static_cast<float>(grown->growth) : 1.0F);
  }
}

}  // namespace limen::techniques
