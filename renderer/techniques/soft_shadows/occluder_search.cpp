// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/frame/multi_scale_map.h"
#include "renderer/techniques/soft_shadows/quality/quality_counters.h"
#include "renderer/techniques/soft_shadows/search_pictures.h"

namespace limen::techniques {
namespace {

constexpr double kDefaultSlopeBias = 2.0;
constexpr const char *kDefaultGapFill = "left_bottom", *kDefaultBase = "256",
                     *kDefaultSamples = "one_then_four";
constexpr uint32_t kBudgetUnit = 12, kCameraDepthUnit = 15;
/// Of level_steps.glsl.
constexpr uint32_t kPositionUnit = 14, kNormalUnit = 15, kWorkImage = 1, kSearchImage = 2, kStepImage = 4;
const char* const kSmoothShader = "renderer/techniques/soft_shadows/quality/smooth_levels.comp.glsl";
const char* const kOrderShader = "renderer/techniques/soft_shadows/quality/order_work.comp.glsl";

Structure structureOf(const std::string& name) {
  return name == "none"       ? Structure::None
         : name == "hsm"      ? Structure::Hsm
         : name == "mssm"     ? Structure::Mssm
         : name == "n_buffer" ? Structure::NBuffer
                              : Structure::Ysm;
}

bool hasLayers(Structure structure) { return structure >= Structure::Mssm; }

gl::ShaderDefines withSearch(const ParameterValues& values, gl::ShaderDefines defines) {
  const std::string &fill = values.text("gap_fill"), &occluders = values.text("occluders");
  defines["GAP_FILL"] = fill == "none" ? "0" : fill == "left_bottom" ? "1" : "2";
  defines["OCCLUDERS"] = occluders == "micropatches"          ? "0"
                         : occluders == "microquads"          ? "1"
                         : occluders == "contours"            ? "3"
                         : occluders == "microrects"          ? "4"
                         : occluders == "morphing_microquads" ? "5"
                                                              : "2";
  for (const auto& [name, value] : BiasForm(values).defines()) defines[name] = value;
  const Structure structure = structureOf(values.text("structure"));
  defines[structure == Structure::None  ? "STRUCTURE_NONE"
          : structure == Structure::Hsm ? "STRUCTURE_HSM"
          : structure == Structure::Ysm ? "STRUCTURE_YSM"
                                        : "STRUCTURE_WINDOWS"] = "1";
  if (structure == Structure::NBuffer) defines["CORNER"] = "1";
  // With one level for all pixels, what it makes of the shadow is the question: no pixel may escape it by
  // texels that are finer.
  if ((hasLayers(structure) && values.boolean("growth")) || CoarseOccluders(values).isFixed())
    defines["GROW"] = "1";
  if (hasBudgetMap(values)) defines["BUDGET_MAP"] = "1";
  LevelOfQuality(values).define(defines);
  return defines;
}

const gl::ShaderDefines kGatherDefines = {{"SPLIT_GATHER", "1"}};

gl::ShaderDefines classifyDefines(bool smooths) {
  gl::ShaderDefines defines = {{"SPLIT_CLASSIFY", "1"}};
  if (smooths) defines["SMOOTH"] = "1";
  return defines;
}

/// Depth ranges of a pixel, from the first on, that one square answers.
int roughQueries(const std::string& samples) { return samples == "one" ? 1000 : samples == "four" ? 0 : 1; }

}  // namespace

std::vector<Parameter> OccluderSearch::searchParameters(std::vector<std::string> occluders) {
  // A micropatch of the receiver's own plane stands above that plane by the slope over one texel. Leaving out
  // the receiver's texel and the next leaves only patches whose false elevation is below half of the plane's
  // own.
  std::vector<Parameter> all = commonParameters(kDefaultSlopeBias);
  all.push_back(integerParameter("budget", kDefaultBudget, 0, 1 << 24, "",
                                 "Micro-occluders allowed for a pixel; its root counts per axis; 0: no limit",
                                 "Schwarz 2009, sections 4.1 and 4.5"));
  all.push_back(integerParameter("refinements", 2, 0, 3, "",
                                 "Times that the search area is narrowed by its depth range",
                                 "Schwarz 2009, section 4.1"));
  all.push_back(
      choiceParameter("structure", "hsm", {"none", "hsm", "mssm", "n_buffer", "ysm"},
                      "What finds the depth range of a search area: nothing, hierarchical shadow map, "
                      "multi-scale shadow map, N-buffer, Y shadow map",
                      "Schwarz 2009, sections 4.1 and 4.3; N-buffer: Décoret 2005"));
  all.push_back(choiceParameter("ysm_base", kDefaultBase, {"64", "128", "256", "512"},
                                "Texels along a side of the Y shadow map's layers, at most the map's",
                                "Schwarz 2009, section 4.3.2"));
  all.push_back(choiceParameter("range_samples", kDefaultSamples, {"one", "one_then_four", "four"},
                                "Squares that answer a depth range in the structures with layers: one around "
                                "the area, four at its corners, or one for the first range of a pixel",
                                "Schwarz 2009, section 4.3.1 (one_then_four)"));
  all.push_back(booleanParameter("growth", true,
                                 "Structures with layers take whole micro-occluders of the level that the "
                                 "budget leads to; without, a seam stands where pixels become fully lit",
                                 "Schwarz 2009, section 4.3.1"));
  all.push_back(choiceParameter("gap_fill", kDefaultGapFill, {"none", "left_bottom", "diagonal"},
                                "Neighbours to which a micropatch is stretched to close gaps",
                                "Schwarz 2009, section 4.1 (after Guennebaud 2006; diagonal: Bavoil 2008)"));
  const bool morphing =
      std::find(occluders.begin(), occluders.end(), "morphing_microquads") != occluders.end();
  all.push_back(choiceParameter("occluders", "micropatches", std::move(occluders),
                                "What is made of texels that block: rectangles at one depth, a mesh between "
                                "their centres, that with triangles where three of four block, contours, "
                                "rectangles of their own extents, or a mesh between two levels",
                                "Schwarz 2009, sections 4.1, 4.4.1, 4.4.3, 4.4.5, 4.5.1 and 5.1.2"));
  for (const std::vector<Parameter>& more : {CoarseOccluders::parameters(morphing), BiasForm::parameters(),
                                             LevelOfQuality::parameters(), budgetParameters()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

void OccluderSearch::checkSearch(const ParameterValues& values) {
  const std::string& occluders = values.text("occluders");
  if (occluders != "micropatches" && occluders != "microrects" && values.text("gap_fill") != kDefaultGapFill)
    throw Error("'gap_fill' stretches micropatches and microrects; there are none, and no gaps", "gap_fill",
                "leave it out, or give occluders: micropatches");
  CoarseOccluders::check(values);
  BiasForm::check(values, kDefaultSlopeBias);
  const Structure structure = structureOf(values.text("structure"));
  if (structure != Structure::Ysm && values.text("ysm_base") != kDefaultBase)
    throw Error("'ysm_base' is about the Y shadow map, and there is none", "ysm_base",
                "leave it out, or give structure: ysm");
  if (!hasLayers(structure) && values.text("range_samples") != kDefaultSamples)
    throw Error("'range_samples' is about structures with layers, and there are none", "range_samples",
                "leave it out, or give structure: mssm, n_buffer or ysm");
  if (!hasLayers(structure) && !values.boolean("growth"))
    throw Error("'growth' is about structures with layers, and there are none", "growth",
                "leave it out, or give structure: mssm, n_buffer or ysm");
  if (CoarseOccluders(values).isFixed() && values.text("levels") != "finest_within")
    throw Error(
        "one level for all pixels is given, and 'levels: " + values.text("levels") + "' would choose others",
        "levels", "leave it out, or leave out fixed_level and morphing microquads");
  if (CoarseOccluders(values).isFixed() && hasBudgetMap(values))
    throw Error("one level for all pixels is given, and a map of budgets would choose others", "budget_map",
                "leave it out, or leave out fixed_level and morphing microquads");
  LevelOfQuality::check(values);
  checkBudget(values);
}

OccluderSearch::OccluderSearch(const ParameterValues& values, std::string shader, std::string pass,
                               gl::ShaderDefines defines)
    : VisibilityTechnique(values, std::move(shader), std::move(pass), withSearch(values, std::move(defines))),
      budget_(static_cast<int>(values.integer("budget"))),
      refinements_(static_cast<int>(values.integer("refinements"))),
      roughQueries_(roughQueries(values.text("range_samples"))),
      structure_(structureOf(values.text("structure"))),
      coarse_(values),
      biasForm_(values),
      base_(structure_ == Structure::Ysm
                ? std::min(std::stoi(values.text("ysm_base")), mapSettings().resolution)
                : mapSettings().resolution),
      quality_(values),
      budgets_(makeBudgetDriver(values)) {
  checkSearch(values);
}

const frame::LightFrustum& OccluderSearch::bindMap(frame::Frame& frame) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(mapSettings());
  coarse_.make(frame, mapSettings());
  biasForm_.make(frame, mapSettings());
  int64_t bytes = pyramid.minimum().bytes() + pyramid.maximum().bytes();
  const frame::MultiScaleMap* layers = nullptr;
  if (hasLayers(structure_)) {
    layers = &frame.get<frame::MultiScaleMap>(frame::MultiScaleSettings{
        mapSettings(), base_,
        structure_ == Structure::NBuffer ? frame::WindowAnchor::Corner : frame::WindowAnchor::Centre});
    baseLevel_ = layers->baseLevel();
    bytes += layers->texture().bytes();
  }
  structureBytes_.resize(maps().size());
  structureBytes_[currentMap()] = bytes;
  const gl::Texture* depth = nullptr;
  if (split_ && smooths())
    depth = &frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Depth}).texture();
  // Last, since making the inputs binds textures too.
  if (layers) layers->texture().bindTexture(3);
  if (budgetMap_) budgetMap_->bindTexture(kBudgetUnit);
  if (depth) depth->bindTexture(kCameraDepthUnit);
  coarse_.bind();
  biasForm_.bind();
  maxIterations_ = maxIterations(frame);
  return bindPyramid(frame);
}

void OccluderSearch::configure(const gl::Program& program) const {
  coarse_.configure(program);
  biasForm_.configure(program);
  program.set("levels", pyramidLevels());
  program.set("maxIterations", maxIterations_);
  program.set("refinements", refinements_);
  program.set("roughQueries", hasLayers(structure_) ? roughQueries_ : 0);
  program.set("baseLevel", baseLevel_);
  program.set("budgetPerAxis",
              budget_ == 0 ? 1 << 14 : std::max(1, static_cast<int>(std::floor(std::sqrt(double(budget_))))));
  quality_.configure(program);
}

void OccluderSearch::prepareSearch(frame::Frame& frame) { VisibilityTechnique::prepare(frame); }

void OccluderSearch::prepare(frame::Frame& frame) {
  prepareSearch(frame);
  for (int i = 0; budgets_ && i < budgets_->settleFrames(); ++i) {
    frame.begin();
    render(frame);
    frame.end();
    glFinish();
  }
}

void OccluderSearch::preparePasses(frame::Frame& frame) {
  if (budgets_) budgets_->prepare(frame);
  if (!quality_.splits()) {
    VisibilityTechnique::preparePasses(frame);
    return;
  }
  split_.emplace(frame, smooths(), quality_.orders());
  classify_ = &program(frame, false, classifyDefines(smooths()));
  gather_ = &program(frame, false, kGatherDefines);
  gl::ProgramCache& programs = frame.context().programs();
  if (smooths()) smooth_ = &programs.compute(kSmoothShader);
  if (quality_.orders()) {
    countBins_ = &programs.compute(kOrderShader);
    scatter_ = &programs.compute(kOrderShader, {{"SCATTER", "1"}});
  }
  frame.passes().setBytesHeld(passName() + "/classify", product().bytes() + split_->bytes());
}

void OccluderSearch::makeInputs(frame::Frame& frame) {
  if (budgets_) budgetMap_ = &budgets_->make(frame);
}

void OccluderSearch::runPasses(frame::Frame& frame, const CountImages* counts) {
  // Frames that count take longer than those they stand for.
  BudgetDriver* steered = counts ? nullptr : budgets_.get();
  if (steered) steered->begin();
  if (split_)
    runSplit(frame, counts);
  else
    VisibilityTechnique::runPasses(frame, counts);
  // Levels of several maps stand behind one visibility, of which none has a step of its own.
  if (counts && maps().size() == 1 && choicesDiffer()) findLevelSteps(frame, *counts);
  if (steered) steered->finish(frame, split_ ? &split_->work() : nullptr);
}

void OccluderSearch::runSplit(frame::Frame& frame, const CountImages* counts) {
  assert(maps().size() == 1);  // see checkValues() of the techniques with several
  {
    const auto scope = frame.passes().open(passName() + "/classify");
    const gl::Program& classify = counts ? program(frame, true, classifyDefines(smooths())) : *classify_;
    bindPass(frame, classify, counts);
    split_->bindForClassify();
    classify.dispatch(frame.sizePx());
    SplitSearch::makeVisible();
  }
  if (smooths()) {
    const auto scope = frame.passes().open(passName() + "/smooth");
    quality_.configureSmoothing(*smooth_);
    split_->smooth(*smooth_);
  }
  if (quality_.orders()) {
    const auto scope = frame.passes().open(passName() + "/order");
    split_->order(*countBins_, *scatter_);
  }
  const auto scope = frame.passes().open(passName() + "/gather");
  const gl::Program& gather = counts ? program(frame, true, kGatherDefines) : *gather_;
  bindPass(frame, gather, counts);
  split_->bindForGather();
  split_->dispatchOverList(gather);
  SplitSearch::makeVisible();
  if (counts) addCounts(*counts);
}

bool OccluderSearch::choicesDiffer() const {
  std::optional<float> first;
  for (size_t i = 0; i < counted().work.size(); i += 4) {
    if (counted().work[i] != Processed) continue;
    const auto level = std::bit_cast<float>(counted().search[i + 3]);
    if (level != first.value_or(level) || (quality_.dithers() && level != std::floor(level))) return true;
    first = level;
  }
  return false;
}

void OccluderSearch::findLevelSteps(frame::Frame& frame, const CountImages& counts) {
  const auto& positions = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Position});
  const auto& normals = frame.get<frame::GBufferChannel>(frame::ChannelSetting{frame::Channel::Normal});
  const gl::Texture found(gl::Format::RG32F, frame.sizePx());
  const gl::Program& steps = program(frame, false, {{"LEVEL_STEPS", "1"}});
  const auto from = [&](glm::ivec2 offset) {
    bindPass(frame, steps, nullptr);
    positions.texture().bindTexture(kPositionUnit);
    normals.texture().bindTexture(kNormalUnit);
    counts.work.bindImage(kWorkImage, gl::Access::Read);
    counts.search.bindImage(kSearchImage, gl::Access::Read);
    found.bindImage(kStepImage, gl::Access::Write);
    steps.set("offset", offset);
    steps.set("surfaceSlope", static_cast<float>(kSurfaceSlope));
    steps.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return found.read();
  };
  levelSteps_.emplace(LevelSteps{from({0, 0}), from({1, 0}), from({0, 1})});
}

std::vector<Quantity> OccluderSearch::counterNames() {
  std::vector<Quantity> names = VisibilityTechnique::counterNames();
  names.emplace_back("structure_bytes");
  names.emplace_back("occluder_bytes");
  for (const Counter& counter : qualityCounters({}, nullptr, 0)) names.push_back(counter.name);
  for (Quantity& name : levelStepCounterNames()) names.push_back(std::move(name));
  for (const BudgetDriverInfo& driver : budgetDrivers())
    names.insert(names.end(), driver.counters.begin(), driver.counters.end());
  return names;
}

std::vector<Counter> OccluderSearch::count(frame::Frame& frame) {
  levelSteps_.reset();
  std::vector<Counter> all = VisibilityTechnique::count(frame);
  const int64_t bytes = std::accumulate(structureBytes_.begin(), structureBytes_.end(), int64_t{0});
  all.push_back({"structure_bytes", static_cast<double>(bytes), "byte", true});
  all.push_back({"occluder_bytes", static_cast<double>(coarse_.bytes() + biasForm_.bytes()), "byte", true});
  const std::optional<Image> budgets = budgetMap_ ? std::optional(budgetMap_->read()) : std::nullopt;
  for (Counter& counter : qualityCounters(counted(), budgets ? &*budgets : nullptr, budget_))
    all.push_back(std::move(counter));
  if (maps().size() == 1)
    for (Counter& counter : levelStepCounters(levelSteps_.value_or(LevelSteps{})))
      all.push_back(std::move(counter));
  for (Counter& counter : budgetFacts()) all.push_back(std::move(counter));
  return all;
}

std::vector<Counter> OccluderSearch::budgetFacts() const {
  return budgets_ ? budgets_->count() : std::vector<Counter>{};
}

std::map<std::string, const gl::Texture*> OccluderSearch::debugViews() const {
  std::map<std::string, const gl::Texture*> views;
  if (split_) views = {{"search_areas", &split_->areas()}, {"levels", &split_->levels()}};
  if (budgets_) views.merge(budgets_->debugViews());
  if (budgetMap_) views["budget_map"] = budgetMap_;
  return views;
}

std::map<std::string, Image> OccluderSearch::pictures() const {
  std::map<std::string, Image> all;
  if (!counted().work.empty())
    all = {{"search_area", searchAreaPicture(counted())}, {"levels", levelPicture(counted())}};
  if (budgetMap_) all["budget"] = budgetPicture(budgetMap_->read());
  return all;
}

}  // namespace limen::techniques
