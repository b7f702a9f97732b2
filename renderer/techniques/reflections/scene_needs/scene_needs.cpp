// SPDX-License-Identifier: BSD-3-Clause
// Finds which technique a scene's mirrors need. By rule: Roger's advice (2008, sections 1.3.1, 2.4 and 6),
// from figures of each mirror's geometry, material and surroundings. By measurement: candidates of all kinds
// are rendered, compared with a reference and timed, and the cheapest within a target is taken. One technique
// serves the whole frame, or each mirror has its own (`choose`) and their pictures are joined; what each
// mirror needs by itself is on record either way. Either choice can be checked against all candidates at full
// size.
//
// The measured choice depends on measured times: on the same machine, candidates of nearly equal time may be
// chosen in turn. The rule depends on the scene alone.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "perception/metrics/error_map.h"
#include "renderer/techniques/reflections/reflection_picture.h"
#include "renderer/techniques/reflections/scene_needs/mirror_choice.h"
#include "renderer/techniques/reflections/scene_needs/reflection_candidates.h"
#include "renderer/techniques/scene_needs/needs_record.h"

namespace limen::techniques {
namespace {

/// Error shown as white in the picture of the check, as in those of a run's error.
constexpr double kReflectionCheckWhite = 0.25;
/// What a technique has to build anew in each frame of a scene that moves, and says so.
const char* const kEachFrameOfAMovingScene = "tree_build_ms";

struct MeasureCandidates {
  static constexpr const char *kKind = "measure", *kSummary = "the cheapest candidate within the target";
  int picturePx = 20000;
  double seconds = 120.0;
  static const SettingsTable<MeasureCandidates>& table() {
    using S = MeasureCandidates;
    static const SettingsTable<S> kTable = {
        {&S::picturePx,
         "picture_px",
         {64, 1 << 24},
         "px",
         "Pixels of the small picture in which an RMSE is measured; JND are measured at full size"},
        {&S::seconds, "seconds", {0.0, 86400.0}, "s", "Time after which no further candidate is tried"}};
    return kTable;
  }
};
struct FollowRule {
  static constexpr const char *kKind = "rule", *kSummary = "by geometry, material, surroundings and motion";
  ReflectorRule rule;
  static const SettingsTable<FollowRule>& table() {
    static const SettingsTable<FollowRule> kTable = {included(&FollowRule::rule)};
    return kTable;
  }
};

struct NoCheck {
  static constexpr const char *kKind = "none", *kSummary = "no reference is rendered";
};
struct CheckChoice {
  static constexpr const char *kKind = "choice", *kSummary = "error and time of the choice at full size";
};
struct CheckWholeSet {
  static constexpr const char *kKind = "whole_set",
                              *kSummary = "errors and times of all candidates at full size";
  double seconds = 600.0;
  static const SettingsTable<CheckWholeSet>& table() {
    static const SettingsTable<CheckWholeSet> kTable = {{&CheckWholeSet::seconds,
                                                         "seconds",
                                                         {0.0, 86400.0},
                                                         "s",
                                                         "Time after which no further candidate is tried"}};
    return kTable;
  }
};

struct BuiltInReflections {
  static constexpr const char *kKind = "built_in", *kSummary = "all ways to show mirrors";
};
struct ReflectionFile {
  static constexpr const char *kKind = "file", *kSummary = "a list of techniques with their settings";
  FilePath file;
  static const SettingsTable<ReflectionFile>& table() {
    static const SettingsTable<ReflectionFile> kTable = {
        {&ReflectionFile::file, "file", FileIs::Required,
         "YAML file with a list of techniques, as in a descriptor; lists within an entry are axes"}};
    return kTable;
  }
};

/// Whether the scene moves, other than by its camera.
enum class SceneMotion { AsBuilt, Still, Moving };
constexpr EnumNames<SceneMotion, 3> enumNames(SceneMotion) {
  return {
      {{{SceneMotion::AsBuilt, "as_built"}, {SceneMotion::Still, "still"}, {SceneMotion::Moving, "moving"}}}};
}

/// What a technique is chosen for.
enum class ChosenFor { Frame, EachMirror };
constexpr EnumNames<ChosenFor, 2> enumNames(ChosenFor) {
  return {{{{ChosenFor::Frame, "frame"}, {ChosenFor::EachMirror, "each_mirror"}}}};
}

struct ReflectionNeedsSettings {
  std::variant<FollowRule, MeasureCandidates> decide;
  ChosenFor choose = ChosenFor::Frame;
  SceneMotion motion = SceneMotion::AsBuilt;
  NeedsTarget target;
  std::variant<CheckChoice, CheckWholeSet, NoCheck> check;
  std::variant<BuiltInReflections, ReflectionFile> candidates;
  NeedsReference reference;
  CandidateTiming timing;
  ReflectionCommon common;
  static const SettingsTable<ReflectionNeedsSettings>& table();

  std::vector<Candidate> listed(double glossRad) const {
    const auto* inFile = std::get_if<ReflectionFile>(&candidates);
    return inFile ? readReflections(inFile->file.path, common) : builtInReflections(glossRad, common);
  }
};

const SettingsTable<ReflectionNeedsSettings>& ReflectionNeedsSettings::table() {
  using S = ReflectionNeedsSettings;
  static const SettingsTable<S> kTable = {
      {&S::decide, "decide", "How the technique is chosen",
       "Roger 2008, chapter 6; measure: the bench's own"},
      {&S::choose, "choose", "One technique for the whole frame, or one for each mirror",
       "Roger 2008, section 6 (a technique for each reflector); the bench's own"},
      {&S::motion, "motion",
       "Whether the scene moves, other than by its camera. If so, the tree of ray tracing counts in every "
       "frame"},
      Binding(&S::target, "target", "Error that is good enough, over the pixels that see mirrors")
          .shorthand("value"),
      {&S::check, "check", "What the choice is checked against, at full size"},
      {&S::candidates, "candidates", "Techniques and settings to choose from, and to check against"},
      {&S::reference, "reference", "Samples of the reference, for glossy mirrors; for others it is exact"},
      {&S::timing, "timing", "Frames in which candidates are timed, at full size"},
      included(&S::common)};
  return kTable;
}

class ReflectionNeeds : public Technique {
 public:
  using Settings = ReflectionNeedsSettings;
  explicit ReflectionNeeds(const Settings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    const auto* byRule = std::get_if<FollowRule>(&settings_.decide);
    const ReflectorRule rule = byRule ? byRule->rule : ReflectorRule{};
    facts_ = measureReflectors(frame.scene(), rule.creaseDeg);
    const std::set<std::string> traits = frame.scene().traits();
    moving_ = settings_.motion == SceneMotion::AsBuilt
                  ? traits.count("moving_surfaces") + traits.count("moving_parts") > 0
                  : settings_.motion == SceneMotion::Moving;
    verdict_ = decideByRule(facts_, moving_, rule);
    double glossRad = 0.0;
    for (const ReflectorFacts& facts : facts_) glossRad = std::max(glossRad, facts.glossRad);
    const bool each = settings_.choose == ChosenFor::EachMirror && !facts_.empty();
    Candidate ruled = candidateFor(verdict_, glossRad, frame.scene(), settings_.common);
    if (each) {
      needs_ = eachByRule(frame.scene(), facts_, verdict_, moving_, settings_.common);
      ruled = candidateOf(groupsOf(facts_, needs_));
    }
    ruled_ = describe(ruled);
    choice_ = byRule ? ruled : Candidate{};

    FrameClock clock(frame, settings_.timing, eachFrame());
    const NeedsSubject subject = reflectionSubject(glossRad > 0.0, settings_.common);
    NeedsOptions options{.target = settings_.target, .reference = settings_.reference};
    const std::vector<Candidate> candidates = settings_.listed(glossRad);
    if (const auto* measure = std::get_if<MeasureCandidates>(&settings_.decide)) {
      options.picturePx = measure->picturePx;
      options.seconds = measure->seconds;
      if (each) {
        options.seconds /= double(facts_.size());
        measureEach(frame, candidates, options);
        checked_ = checkAtFullSize(frame, choice_, subject, options, clock);
      } else {
        found_ = findNeeds(frame, candidates, subject, options, clock);
        choice_ = found_->chosen().candidate;
        checked_ = found_->check;
      }
    } else if (!std::holds_alternative<NoCheck>(settings_.check)) {
      checked_ = checkAtFullSize(frame, choice_, subject, options, clock);
    }
    if (const auto* all = std::get_if<CheckWholeSet>(&settings_.check)) {
      options.seconds = all->seconds;
      wholeSet_ = checkWholeSet(frame, choice_, candidates, subject, options, clock);
    }
    chosen_ = makeTechnique(choice_);
    chosen_->prepare(frame);
  }
  void render(frame::Frame& frame) override { chosen_->render(frame); }
  const gl::Texture& product() const override { return chosen_->product(); }

  std::vector<std::string> remarks() const override {
    std::vector<std::string> out;
    if (found_)
      out = remarksOn(*found_);
    else
      out = {"chosen: " + describe(choice_)};
    if (!found_ && needs_.empty()) out.push_back("by rule: " + verdict_.all.reason);
    for (size_t i = 0; i < facts_.size(); ++i) {
      const std::string mirror = fmt::format("mirror '{}', {:.3g} % of the mirrors' area: ", facts_[i].name,
                                             100.0 * facts_[i].areaShare);
      out.push_back(mirror + (needs_.empty() ? verdict_.reflectors[i].reason
                                             : describe(needs_[i].candidate) + ": " + needs_[i].reason));
    }
    if (!needs_.empty() && describe(choice_) != ruled_) out.push_back("the rule takes " + ruled_);
    if (found_) out.push_back("the rule takes " + ruled_ + ": " + verdict_.all.reason);
    out.emplace_back(moving_ ? "the scene moves: times include the tree of ray tracing"
                             : "the scene is still: times include no tree");
    if (checked_ && !found_) out.push_back(checkRemark(*checked_, settings_.target));
    if (wholeSet_)
      for (std::string& remark : wholeSetRemarks(*wholeSet_, settings_.target))
        out.push_back(std::move(remark));
    return out;
  }
  std::vector<Counter> count(frame::Frame&) override {
    std::set<std::string> techniques = {describe(choice_)};
    if (!needs_.empty()) techniques.clear();
    for (const MirrorNeed& need : needs_) techniques.insert(need.candidate.technique);
    std::vector<Counter> out = {{"reflectors", double(facts_.size())},
                                {"techniques_joined", double(techniques.size())},
                                {"rule_followed", describe(choice_) == ruled_ ? 1.0 : 0.0}};
    const auto add = [&](std::vector<Counter> more) {
      for (Counter& counter : more) out.push_back(std::move(counter));
    };
    if (found_)
      add(countersOf(*found_));
    else if (checked_)
      add(checkCounters(*checked_, settings_.target));
    if (wholeSet_) add(wholeSetCounters(*wholeSet_, settings_.target));
    return out;
  }
  std::map<std::string, const gl::Texture*> debugViews() const override { return chosen_->debugViews(); }
  std::map<std::string, PictureMaker> pictures() const override {
    std::map<std::string, PictureMaker> all = chosen_->pictures();
    if (checked_)
      all["check_error"] = [errors = checked_->errors] {
        return perception::errorPicture(errors, kReflectionCheckWhite);
      };
    return all;
  }

 private:
  /// What each mirror needs, measured where pixels see it, with the other mirrors showing nothing.
  void measureEach(frame::Frame& frame, const std::vector<Candidate>& candidates,
                   const NeedsOptions& options) {
    needs_.clear();
    for (const ReflectorFacts& mirror : facts_) {
      frame::Frame alone(frame.context(), frame.scene(), frame.gpuScene(), frame.sizePx(), frame.timeS(),
                         frame.raster());
      alone.setShownMirrors(frame::ShownMirrors({mirror.part}));
      FrameClock clock(alone, settings_.timing, eachFrame());
      const SceneNeedsFound found = findNeeds(
          alone, candidates, reflectionSubject(mirror.glossRad > 0.0, settings_.common), options, clock);
      const Tried& chosen = found.chosen();
      needs_.push_back(
          {chosen.candidate,
           fmt::format("{} of {} candidates within the target, {:.3g}; the {}: {:.3g} ms, {} {:.3g}",
                       found.verdict.withinTarget ? found.verdict.eligible.size() : 0, found.tried.size(),
                       largestOf(settings_.target), found.verdict.withinTarget ? "cheapest" : "most exact",
                       chosen.time.medianMs, measureOf(settings_.target), chosen.error.value())});
    }
    choice_ = candidateOf(groupsOf(facts_, needs_));
  }
  std::vector<std::string> eachFrame() const {
    return moving_ ? std::vector<std::string>{kEachFrameOfAMovingScene} : std::vector<std::string>{};
  }

  ReflectionNeedsSettings settings_;
  std::vector<ReflectorFacts> facts_;
  std::vector<MirrorNeed> needs_;  ///< of each mirror, if each has its own technique
  RuleVerdict verdict_;
  bool moving_ = false;
  std::string ruled_;
  Candidate choice_;
  std::optional<SceneNeedsFound> found_;  ///< by measurement
  std::optional<FullSizeCheck> checked_;
  std::optional<WholeSetCheck> wholeSet_;
  std::unique_ptr<Technique> chosen_;
};

std::vector<Quantity> reflectionNeedsQuantities() {
  std::vector<Quantity> all = needsQuantities();
  for (Quantity& quantity : wholeSetQuantities()) all.push_back(std::move(quantity));
  all.emplace_back("reflectors", "Mirrors", "", Direction::Neither);
  all.emplace_back("techniques_joined", "Techniques that show mirrors", "", Direction::Neither);
  all.emplace_back("rule_followed", "Rule and choice agree (1: yes)", "", Direction::Neither);
  return all;
}

const RegisteredTechnique<ReflectionNeeds> kReflectionNeedsRegistered{
    {.name = "reflections/scene_needs",
     .version = 2,
     .summary =
         "What a scene's mirrors need, by Roger's rule or by measuring all techniques, with the reasons "
         "on record",
     .source = "Roger 2008, sections 1.3.1, 2.4 and 6 (R-60)",
     .product = ProductKind::Colour,
     .needs = {"mirrors"},
     .followsMotion = true,
     .counters = reflectionNeedsQuantities()}};

}  // namespace
}  // namespace limen::techniques
