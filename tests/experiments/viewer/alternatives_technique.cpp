// SPDX-License-Identifier: BSD-3-Clause
// A technique with alternatives and a group, for tests of how the viewer shows and writes them: a picture of
// one value, which its settings decide.
#include <optional>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/gl/texture.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

struct Fixed {
  static constexpr const char *kKind = "fixed", *kSummary = "the same everywhere";
  double level = 0.5;
  static const SettingsTable<Fixed>& table() {
    static const SettingsTable<Fixed> kTable = {{&Fixed::level, "level", {0.0, 1.0}, "", "Visibility"}};
    return kTable;
  }
};
struct Stepped {
  static constexpr const char *kKind = "stepped", *kSummary = "one of several steps";
  int steps = 4, step = 1;
  static const SettingsTable<Stepped>& table() {
    static const SettingsTable<Stepped> kTable = {
        {&Stepped::steps, "steps", oneOf({2, 4, 8}), "px", "Number of steps"},
        {&Stepped::step, "step", {0, 8}, "", "Which step"}};
    return kTable;
  }
};
struct Dark {
  static constexpr const char *kKind = "dark", *kSummary = "no light";
};
struct Gain {
  double factor = 1.0;
  static const SettingsTable<Gain>& table() {
    static const SettingsTable<Gain> kTable = {
        {&Gain::factor, "factor", {0.0, 2.0}, "", "Multiplies the level"}};
    return kTable;
  }
};

struct AlternativesSettings {
  std::variant<Fixed, Stepped, Dark> source;
  Gain gain;
  static const SettingsTable<AlternativesSettings>& table() {
    using S = AlternativesSettings;
    static const SettingsTable<S> kTable = {{&S::source, "source", "Where the level comes from"},
                                            {&S::gain, "gain", "What is done with the level"}};
    return kTable;
  }
};

class AlternativesTechnique : public techniques::Technique {
 public:
  using Settings = AlternativesSettings;
  explicit AlternativesTechnique(const Settings& settings) : settings_(settings) {}
  void prepare(frame::Frame& frame) override { product_.emplace(gl::Format::R32F, frame.sizePx()); }
  void render(frame::Frame&) override {
    double level = 0.0;
    if (const auto* fixed = std::get_if<Fixed>(&settings_.source)) level = fixed->level;
    if (const auto* stepped = std::get_if<Stepped>(&settings_.source))
      level = double(stepped->step) / stepped->steps;
    product_->clear(glm::vec4(static_cast<float>(level * settings_.gain.factor)));
  }
  const gl::Texture& product() const override { return *product_; }

 private:
  Settings settings_;
  std::optional<gl::Texture> product_;
};

const techniques::RegisteredTechnique<AlternativesTechnique> kRegistered{
    {.name = "test/alternatives", .summary = "One value everywhere", .source = {}}};

}  // namespace
}  // namespace limen::viewer
