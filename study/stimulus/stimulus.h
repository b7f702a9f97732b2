// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "experiments/base/enum_names.h"
#include "experiments/base/parameter.h"

namespace limen::study {

/// A registered scene or technique with a complete set of values.
struct NamedEntry {
  std::string name;
  int version = 1;  ///< as declared in its registration
  ParameterValues values;
  /// Parameter that names a file -> SHA-256 of the file.
  std::map<std::string, std::string> fileHashes;
};

/// One object's level-of-detail change.
struct LevelChange {
  int object = 0;                 ///< of Scene::lodObjects
  int before = 1, after = 0;      ///< levels, 0 the finest
  std::string others = "finest";  ///< levels of all other objects: "finest", "distance", "omitted"
};

enum class Presentation {
  Dynamic,  ///< the camera moves as defined by the scene
  Static    ///< the frame of the change, before and after it, the camera at rest
};
constexpr EnumNames<Presentation, 2> enumNames(Presentation) {
  return {{{{Presentation::Dynamic, "dynamic"}, {Presentation::Static, "static"}}}};
}

enum class CueKind { None, Arrow, Circle };
constexpr EnumNames<CueKind, 3> enumNames(CueKind) {
  return {{{{CueKind::None, "none"}, {CueKind::Arrow, "arrow"}, {CueKind::Circle, "circle"}}}};
}

/// Cue that guides the viewer's attention before a stimulus.
struct Cue {
  using Kind = CueKind;
  Kind kind = Kind::None;
  double xPx = 0.0, yPx = 0.0;  ///< where it points, from the window's upper left corner
  double radiusPx = 50.0;       ///< Circle only
  double durationS = 0.0;       ///< shown before the stimulus, over its first frame
};

/// One sequence as shown, with every value fixed: the unit that is rendered, predicted, hashed and logged.
/// Row 0 at the top, window pixels, times in seconds from the sequence's first frame.
struct Stimulus {
  NamedEntry scene;
  /// What changes: a level of detail, rendered as frame::Shaded ...
  std::optional<LevelChange> levels;
  ParameterValues shading;  ///< of frame::ShadedSetting
  /// ... or the technique; without `after` nothing changes.
  std::optional<NamedEntry> before, after;
  bool changes =
      true;  ///< false: a catch trial or the other interval, which shows what `catchShowsAfter` says
  bool catchShowsAfter = false;
  Presentation presentation = Presentation::Dynamic;
  double durationS = 4.0, changeAtS = 2.0;
  /// Scene time of the sequence's first frame; a static one shows the scene at sceneStartS + changeAtS.
  double sceneStartS = 0.0;
  int showings = 1;   ///< how often it is shown before the question
  double gapS = 1.0;  ///< of background between showings
  int samples = 2;    ///< per pixel along each axis
  Cue cue;
};

/// Canonical form; fromJson() gives the same back. The hash is SHA-256 over it, with the content of files in
/// place of their paths: together with the display profile and the window it determines every pixel shown,
/// given the versions of scene and techniques. stimulusFromJson() throws Error on anything that is not a
/// stimulus.
nlohmann::json toJson(const Stimulus& stimulus);
Stimulus stimulusFromJson(const nlohmann::json& json);
std::string stimulusHash(const Stimulus& stimulus);

}  // namespace limen::study
