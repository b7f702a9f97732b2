// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/viewing.h"

namespace limen::perception {
namespace {

constexpr const char* kFile = "file";
constexpr Range kDistance{1e-3, 100.0};

settings::EntryOptions displays() {
  std::vector<std::string> names = displayPresets();
  names.emplace_back(kFile);
  return {names, [](const std::string& name) -> const std::vector<Parameter>& {
            static const std::map<std::string, std::vector<Parameter>> kDeclared = [] {
              std::map<std::string, std::vector<Parameter>> out;
              for (const std::string& preset : displayPresets())
                out[preset] = PresetViewing::table().parameters({displayPreset(preset).distanceM});
              out[kFile] = FileViewing::table().parameters();
              return out;
            }();
            return kDeclared.at(name);
          }};
}

}  // namespace

const SettingsTable<PresetViewing>& PresetViewing::table() {
  static const SettingsTable<PresetViewing> kTable = {
      Binding(&PresetViewing::distanceM, "distance_m", kDistance, "m", "viewing distance")
          .formerly({"distance_m"})};
  return kTable;
}

const SettingsTable<GivenDistance>& GivenDistance::table() {
  static const SettingsTable<GivenDistance> kTable = {
      {&GivenDistance::m, "m", kDistance, "m", "viewing distance"}};
  return kTable;
}

const SettingsTable<FileViewing>& FileViewing::table() {
  static const SettingsTable<FileViewing> kTable = {
      Binding(&FileViewing::file, "file", FileIs::Required, "profile of the display")
          .formerly({"display_file"}),
      {&FileViewing::distance, "distance", "viewing distance"}};
  return kTable;
}

const SettingsTable<ViewingSettings>& ViewingSettings::table() {
  static const SettingsTable<ViewingSettings> kTable = {Binding<ViewingSettings>(
      settings::state(ParameterType::Choice, "display", "display and viewing distance",
                      "Schwarz 2009, section 10.4.1"),
      std::make_shared<settings::EntryMember<ViewingSettings>>(&ViewingSettings::display, displays()))};
  return kTable;
}

DisplayProfile ViewingSettings::profile() const {
  const std::map<std::string, ParameterValue>& given = display.values.all();
  if (display.name == kFile) {
    const auto settings = FileViewing::table().read(display.values);
    DisplayProfile profile = readDisplay(settings.file.path);
    if (const auto* distance = std::get_if<GivenDistance>(&settings.distance))
      profile.distanceM = distance->m;
    checkDisplay(profile, "display.distance");
    return profile;
  }
  DisplayProfile profile = displayPreset(display.name);
  if (!given.empty()) profile.distanceM = PresetViewing::table().read(display.values).distanceM;
  checkDisplay(profile, "display.distance_m");
  return profile;
}

}  // namespace limen::perception
