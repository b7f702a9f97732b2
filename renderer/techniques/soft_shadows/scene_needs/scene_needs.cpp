// SPDX-License-Identifier: BSD-3-Clause
// Finds by measurement which soft shadows a view of a scene needs (SS-45): of candidates from all families,
// the cheapest whose error against rays, by RMSE or by what a viewer sees, stays within a target. Source of
// the question: Schwarz 2009, section 5.1.1, which weighs criteria of the scene (layers, thin casters, coarse
// levels). These decide between forms of one technique and say nothing about how far any of them is from the
// truth, or about other techniques, so that here error and time of each candidate are measured instead.
//
// The choice depends on measured times: on the same machine, candidates of nearly equal time may be chosen in
// turn. The record of the run says which one was.
#include <optional>

#include "perception/metrics/error_map.h"
#include "renderer/techniques/scene_needs/needs_record.h"
#include "renderer/techniques/soft_shadows/bitmask/mask_gathering.h"
#include "renderer/techniques/soft_shadows/scene_needs/shadow_candidates.h"
#include "renderer/techniques/soft_shadows/search_technique.h"
#include "renderer/techniques/soft_shadows/visibility_technique.h"

namespace limen::techniques {
namespace {

/// Error shown as white in the picture of the check, as in those of a run's error.
constexpr double kCheckPictureWhite = 0.25;

struct BuiltInCandidates {
  static constexpr const char *kKind = "built_in", *kSummary = "about fifty, of all families";
};
struct CandidateFile {
  static constexpr const char *kKind = "file", *kSummary = "a list of techniques with their settings";
  FilePath file;
  static const SettingsTable<CandidateFile>& table() {
    static const SettingsTable<CandidateFile> kTable = {
        {&CandidateFile::file, "file", FileIs::Required,
         "YAML file with a list of techniques, as in a descriptor; lists within an entry are axes"}};
    return kTable;
  }
};

struct SceneNeedsSettings {
  MapSettings map;
  NeedsTarget target;
  std::variant<BuiltInCandidates, CandidateFile> candidates;
  int picturePx = NeedsOptions{}.picturePx;
  NeedsReference reference;
  CandidateTiming timing;
  double seconds = 60.0;
  static const SettingsTable<SceneNeedsSettings>& table();

  std::vector<Candidate> listed() const {
    const auto* inFile = std::get_if<CandidateFile>(&candidates);
    return inFile ? readCandidates(inFile->file.path, map) : builtInCandidates(map);
  }
  /// Finds mistakes in the file before anything runs.
  void check() const { listed(); }
};

/// Of the techniques in the built-in list; what others count beyond is left out.
std::vector<Quantity> chosenQuantities() {
  std::vector<Quantity> all = SearchTechnique::quantities();
  for (Quantity& quantity : MaskGathering::quantities()) all.push_back(std::move(quantity));
  // Named here, since the references may not be registered yet.
  all.insert(all.end(),
             {{"shadow_maps", "Shadow maps", "", Direction::LowerIsBetter},
              {"triangles_drawn", "Triangles drawn", "", Direction::LowerIsBetter},
              {"maps_cutting_casters_share", "Share of maps that cut casters", "", Direction::Neither}});
  return all;
}

class SceneNeeds : public Technique {
 public:
  using Settings = SceneNeedsSettings;
  explicit SceneNeeds(const SceneNeedsSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    FrameClock clock(frame, settings_.timing);
    const std::vector<Candidate> candidates = settings_.listed();
    found_ = findNeeds(frame, candidates, shadowSubject(),
                       {.target = settings_.target,
                        .picturePx = settings_.picturePx,
                        .reference = settings_.reference,
                        .seconds = settings_.seconds},
                       clock);
    chosen_ = makeTechnique(found_->chosen().candidate);
    chosen_->prepare(frame);
  }
  void render(frame::Frame& frame) override { chosen_->render(frame); }
  const gl::Texture& product() const override { return chosen_->product(); }
  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = countersOf(*found_);
    const std::vector<Quantity> declared = chosenQuantities();
    for (Counter& counter : chosen_->count(frame))
      if (std::any_of(declared.begin(), declared.end(),
                      [&](const Quantity& one) { return one.name == counter.name; }))
        all.push_back(std::move(counter));
    return all;
  }
  std::vector<std::string> remarks() const override { return remarksOn(*found_); }
  std::map<std::string, const gl::Texture*> debugViews() const override { return chosen_->debugViews(); }
  std::map<std::string, PictureMaker> pictures() const override {
    std::map<std::string, PictureMaker> all = chosen_->pictures();
    all["check_error"] = [errors = found_->check.errors] {
      return perception::errorPicture(errors, kCheckPictureWhite);
    };
    return all;
  }

 private:
  SceneNeedsSettings settings_;
  std::optional<SceneNeedsFound> found_;
  std::unique_ptr<Technique> chosen_;
};

const SettingsTable<SceneNeedsSettings>& SceneNeedsSettings::table() {
  using S = SceneNeedsSettings;
  static const SettingsTable<S> kTable = {
      included(&S::map),
      Binding(&S::target, "target", "Error that is good enough: the cheapest candidate within it is chosen")
          .shorthand("value"),
      {&S::candidates, "candidates", "Techniques and settings to choose from"},
      {&S::picturePx,
       "picture_px",
       {64, 1 << 24},
       "px",
       "Pixels of the small picture in which an RMSE is measured; JND are measured at full size"},
      {&S::reference, "reference", "Rays that candidates are compared with"},
      {&S::timing, "timing", "Frames in which candidates are timed, at full size"},
      {&S::seconds,
       "seconds",
       {0.0, 86400.0},
       "s",
       "Time after which no further candidate is tried; those built in go from cheap to expensive"}};
  return kTable;
}

std::vector<Quantity> sceneNeedsQuantities() {
  std::vector<Quantity> all = needsQuantities();
  for (Quantity& quantity : chosenQuantities()) all.push_back(std::move(quantity));
  return all;
}

const RegisteredTechnique<SceneNeeds> kSceneNeedsRegistered{
    {.name = "soft_shadows/scene_needs",
     .version = 3,
     .summary =
         "The cheapest soft shadows within a target of error, of candidates that are measured, with the "
         "figures on record",
     .source = "Schwarz 2009, section 5.1.1 (SS-45)",
     .product = ProductKind::Visibility,
     .needs = {"area_light"},
     .counters = sceneNeedsQuantities()}};

}  // namespace
}  // namespace limen::techniques
