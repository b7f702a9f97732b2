// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/frame/bias_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// Blockers must lie before the receiver's own plane, wherever in the map they are.
struct PlaneBias {
  static constexpr const char *kKind = "receiver_plane",
                              *kSummary = "against the receiver's own plane at each texel's place";
  double constant = 1e-4, slope = 0.5, maxSlope = 10.0;
  static const SettingsTable<PlaneBias>& table();
};

/// Nothing beyond the constant share of the receiver's distance that all forms have.
struct ConstantBias {
  static constexpr const char *kKind = "constant", *kSummary = "only a share of the receiver's distance";
  double constant = 1e-4;
  static const SettingsTable<ConstantBias>& table();
};

struct PerLevelBias {
  static constexpr const char *kKind = "per_level", *kSummary = "a constant that grows from level to level";
  double constant = 1e-4, growth = 2.0;
  static const SettingsTable<PerLevelBias>& table();
};

struct StoredBias {
  static constexpr const char *kKind = "stored", *kSummary = "stored per texel from its triangle's slope";
  double constant = 1e-4, scale = 1.0, maxSlope = 10.0;
  static const SettingsTable<StoredBias>& table();
};

/// Receivers are moved off their surface along its normal, by the sine of the light's angle of incidence
/// times `offset` texels, before anything is looked up. Source: Holbert 2011, "Saying Goodbye to Shadow Acne"
/// (GDC).
struct NormalOffsetBias {
  static constexpr const char *kKind = "normal_offset",
                              *kSummary = "receivers moved off their surface along its normal";
  double constant = 1e-4, offset = 1.0;
  static const SettingsTable<NormalOffsetBias>& table();
};

using BiasSettings =
    std::variant<PlaneBias, SlopeBias, ConstantBias, PerLevelBias, StoredBias, NormalOffsetBias>;
/// Forms for techniques that only read the map itself, no level of its pyramid.
using TexelBiasSettings = std::variant<PlaneBias, SlopeBias, ConstantBias, StoredBias, NormalOffsetBias>;
/// Forms that need nothing stored beside depths.
using ReceiverBiasSettings = std::variant<PlaneBias, SlopeBias, ConstantBias, NormalOffsetBias>;

template <class... A>
BiasSettings anyBias(const std::variant<A...>& form) {
  return std::visit([](const auto& chosen) -> BiasSettings { return chosen; }, form);
}

/// Share of the receiver's distance that is part of every form of bias.
double constantOf(const BiasSettings& settings);

/// By how much an occluder must be nearer to the light than a receiver to count, beyond a constant share of
/// the receiver's distance: by the receiver's plane, by its slope, by nothing, by a factor per level, by
/// what each texel stores, or from a receiver that has been moved. Only the test is biased; backprojection
/// uses the unbiased depth. Source: Schwarz 2009, section 4.5.4.
class BiasForm {
 public:
  explicit BiasForm(const BiasSettings& settings) : settings_(settings) {}

  gl::ShaderDefines defines() const;
  /// Computes what is stored for texels; leaves no bindings behind.
  void make(frame::Frame& frame, const frame::ShadowMapSettings& map);
  void bind() const;
  void configure(const gl::Program& program) const;
  /// Memory of stored biases; 0 for other forms.
  int64_t bytes() const { return stored_ ? stored_->bytes() : 0; }

 private:
  BiasSettings settings_;
  const frame::BiasLevels* stored_ = nullptr;
};

}  // namespace limen::techniques
