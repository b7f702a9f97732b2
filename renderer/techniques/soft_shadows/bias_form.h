// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/frame/bias_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

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

using BiasSettings = std::variant<SlopeBias, ConstantBias, PerLevelBias, StoredBias>;

/// Share of the receiver's distance that is part of every form of bias.
double constantOf(const BiasSettings& settings);

/// By how much an occluder must be nearer to the light than a receiver to count, beyond a constant share of
/// the receiver's distance: by the receiver's slope, by nothing, by a factor per level, or by what each texel
/// stores. Only the test is biased; backprojection uses the unbiased depth. Source: Schwarz 2009,
/// section 4.5.4.
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
