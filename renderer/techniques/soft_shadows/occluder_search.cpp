// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/occluder_search.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/multi_scale_map.h"
#include "renderer/techniques/soft_shadows/quality/quality_counters.h"
#include "renderer/techniques/soft_shadows/search_pictures.h"

namespace limen::techniques {
namespace {

constexpr uint32_t kBudgetUnit = 12, kCameraDepthUnit = 15;
/// Of level_steps.glsl.
constexpr uint32_t kPositionUnit = 14, kNormalUnit = 15, kWorkImage = 1, kSearchImage = 2, kStepImage = 4;
const char* const kSmoothShader = "renderer/techniques/soft_shadows/quality/smooth_levels.comp.glsl";
const char* const kOrderShader = "renderer/techniques/soft_shadows/quality/order_work.comp.glsl";

gl::ShaderDefines withSearch(const SearchSettings& settings, const LevelSettings& levels,
                             const PassSettings& passes, const OccluderChoice& occluders,
                             gl::ShaderDefines defines) {
  occluders.define(defines);
  for (const auto& [name, value] : BiasForm(settings.bias).defines()) defines[name] = value;
  defineStructure(settings.structure, defines);
  // With one level for all pixels, what it makes of the shadow is the question: no pixel may escape it by
  // texels that are finer.
  if (CoarseOccluders(occluders, levels).isFixed()) defines["GROW"] = "1";
  if (!std::holds_alternative<UniformBudget>(settings.budget)) defines["BUDGET_MAP"] = "1";
  LevelOfQuality(levels, passes).define(defines);
  return defines;
}

/// Of the visibility pass, whose uniforms all forms share.
SlopeBias slopeOf(const BiasSettings& bias) {
  const auto* slope = std::get_if<SlopeBias>(&bias);
  return slope ? *slope : SlopeBias{constantOf(bias), 0.0};
}

const gl::ShaderDefines kGatherDefines = {{"SPLIT_GATHER", "1"}};

gl::ShaderDefines classifyDefines(bool smooths) {
  gl::ShaderDefines defines = {{"SPLIT_CLASSIFY", "1"}};
  if (smooths) defines["SMOOTH"] = "1";
  return defines;
}

}  // namespace

OccluderSearch::OccluderSearch(const SearchSettings& settings, const LevelSettings& levels,
                               const PassSettings& passes, const OccluderChoice& occluders,
                               std::string shader, std::string pass, gl::ShaderDefines defines)
    : VisibilityTechnique(settings.map, slopeOf(settings.bias), std::move(shader), std::move(pass),
                          withSearch(settings, levels, passes, occluders, std::move(defines))),
      budget_(mostOf(settings.budget)),
      refinements_(settings.refinements),
      structure_(settings.structure),
      coarse_(occluders, levels),
      biasForm_(settings.bias),
      quality_(levels, passes),
      budgets_(makeBudgetDriver(settings.budget)) {}

const frame::LightFrustum& OccluderSearch::bindMap(frame::Frame& frame) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(mapSettings());
  coarse_.make(frame, mapSettings());
  biasForm_.make(frame, mapSettings());
  int64_t bytes = pyramid.minimum().bytes() + pyramid.maximum().bytes();
  const frame::MultiScaleMap* layers = nullptr;
  if (layersOf(structure_)) {
    layers = &frame.get<frame::MultiScaleMap>(multiScaleSettings(structure_, mapSettings()));
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
  program.set("roughQueries", roughQueries(structure_));
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
  assert(maps().size() == 1);  // techniques with several refuse split passes
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

std::vector<Quantity> OccluderSearch::quantities() {
  std::vector<Quantity> all = VisibilityTechnique::quantities();
  all.insert(all.end(),
             {{"structure_bytes", "Memory of the acceleration structure", "byte", Direction::LowerIsBetter,
               "Schwarz 2009, section 4.3"},
              {"occluder_bytes", "Memory of occluders and biases", "byte", Direction::LowerIsBetter}});
  for (const std::vector<Quantity>& more : {qualityQuantities(), levelStepQuantities(), budgetQuantities()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Counter> OccluderSearch::count(frame::Frame& frame) {
  levelSteps_.reset();
  std::vector<Counter> all = VisibilityTechnique::count(frame);
  const int64_t bytes = std::accumulate(structureBytes_.begin(), structureBytes_.end(), int64_t{0});
  all.push_back({"structure_bytes", static_cast<double>(bytes)});
  all.push_back({"occluder_bytes", static_cast<double>(coarse_.bytes() + biasForm_.bytes())});
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
