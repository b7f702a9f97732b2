// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "experiments/base/settings_table.h"
#include "experiments/base/value_writer.h"

namespace limen::preset_test {
namespace {

using Values = std::map<std::string, ParameterValue>;

enum class Style { Modern, Classic };
constexpr EnumNames<Style, 2> enumNames(Style) {
  return {{{{Style::Modern, "modern"}, {Style::Classic, "classic"}}}};
}
struct Fixed {
  static constexpr const char *kKind = "fixed", *kSummary = "a given width";
  int width = 3;
  static const SettingsTable<Fixed>& table() {
    static const SettingsTable<Fixed> kTable = {{&Fixed::width, "width", {1, 9}, "px", "Width"}};
    return kTable;
  }
};
struct Free {
  static constexpr const char *kKind = "free", *kSummary = "any width";
};
/// Has a parameter of the same path as Fixed, which is another.
struct Limited {
  static constexpr const char *kKind = "limited", *kSummary = "at most a width";
  int width = 5;
  static const SettingsTable<Limited>& table() {
    static const SettingsTable<Limited> kTable = {{&Limited::width, "width", {1, 9}, "px", "Largest width"}};
    return kTable;
  }
};
struct Filter {
  Style style = Style::Modern;
  std::variant<Free, Fixed, Limited> width;
  double gain = 1.0;
  static const SettingsTable<Filter>& table();
};

Values classic(const std::string& choice) {
  return choice == "classic" ? Values{{"width", "fixed"}, {"width.width", int64_t{7}}, {"gain", 2.0}}
                             : Values{};
}

const SettingsTable<Filter>& Filter::table() {
  static const SettingsTable<Filter> kTable = {
      Binding(&Filter::style, "style", "Sets the others").presets(&classic),
      {&Filter::width, "width", "Width"},
      {&Filter::gain, "gain", {0.0, 9.0}, "", "Gain"}};
  return kTable;
}
struct Camera {
  Filter filter;
  static const SettingsTable<Camera>& table() {
    static const SettingsTable<Camera> kTable = {{&Camera::filter, "filter", "A filter"}};
    return kTable;
  }
};

Filter read(const Values& given) {
  return Camera::table().read(ParameterValues(Camera::table().parameters(), given)).filter;
}

TEST(Preset, SetsTheDefaultsOfItsNeighbours) {
  EXPECT_TRUE(std::holds_alternative<Free>(read({}).width));
  const Filter preset = read({{"filter.style", "classic"}});
  EXPECT_EQ(std::get<Fixed>(preset.width).width, 7);
  EXPECT_EQ(preset.gain, 2.0);
}

TEST(Preset, WhatIsGivenPrevails) {
  const Filter other = read({{"filter.style", "classic"}, {"filter.width", "free"}, {"filter.gain", 1.0}});
  EXPECT_TRUE(std::holds_alternative<Free>(other.width));
  EXPECT_EQ(other.gain, 1.0);
  EXPECT_EQ(std::get<Fixed>(read({{"filter.width", "fixed"}}).width).width, 3);
}

TEST(Preset, LeavesAlternativesAloneThatItDoesNotChoose) {
  const Filter other = read({{"filter.style", "classic"}, {"filter.width", "limited"}});
  EXPECT_EQ(std::get<Limited>(other.width).width, 5);
  EXPECT_EQ(other.gain, 2.0);
}

// A value that is the default without the preset must be written with it.
TEST(Preset, WrittenValuesReadBack) {
  const std::vector<Parameter> declared = Camera::table().parameters();
  for (const Values& given :
       {Values{{"filter.style", "classic"}}, Values{{"filter.style", "classic"}, {"filter.gain", 1.0}},
        Values{{"filter.style", "classic"}, {"filter.width", "free"}}, Values{{"filter.gain", 2.0}}}) {
    const ParameterValues complete(declared, given);
    const Values written = withoutDefaults(declared, complete.all());
    EXPECT_EQ(written, given);
    EXPECT_EQ(ParameterValues(declared, written), complete);
  }
  EXPECT_EQ(
      toYaml(declared, ParameterValues(declared, {{"filter.style", "classic"}, {"filter.gain", 1.0}}).all()),
      "filter: {style: classic, gain: 1}");
}

}  // namespace
}  // namespace limen::preset_test
