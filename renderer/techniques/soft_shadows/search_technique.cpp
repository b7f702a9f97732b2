// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/search_technique.h"

#include <epoxy/gl.h>

#include "renderer/techniques/soft_shadows/quality/level_step_search.h"
#include "renderer/techniques/soft_shadows/quality/quality_counters.h"
#include "renderer/techniques/soft_shadows/search_pictures.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

void append(std::vector<Counter>& all, std::vector<Counter> more) {
  for (Counter& counter : more) all.push_back(std::move(counter));
}

}  // namespace

SearchTechnique::SearchTechnique(SearchParts parts)
    : pass_(std::move(parts.shader), std::move(parts.pass), {}),
      search_(parts.search, parts.levels, parts.occluders),
      quality_(parts.levels, parts.passes),
      maps_(parts.search.map, parts.maps),
      budget_(mostOf(parts.search.budget)),
      budgets_(makeBudgetDriver(parts.search.budget)),
      gathering_(std::move(parts.gathering)),
      last_(std::move(parts.last)) {
  gl::ShaderDefines defines = search_.defines();
  if (budgets_) defines["BUDGET_MAP"] = "1";
  quality_.define(defines);
  pass_.define(defines);
}

void SearchTechnique::prepare(frame::Frame& frame) {
  maps_.prepare(frame.scene());
  pass_.define(maps_.defines());
  pass_.define(gathering_->prepare(frame, maps_));
  pass_.prepare(frame);
  if (budgets_) budgets_->prepare(frame);
  if (quality_.splits()) {
    split_.emplace(frame, pass_, quality_, smooths(), static_cast<int>(maps_.mapsOf(0).size()));
  } else {
    pass_.compile(frame);
    frame.passes().setBytesHeld(pass_.name(), pass_.visibility().bytes());
  }
  if (last_) last_->prepare(frame);
  for (int i = 0; budgets_ && i < budgets_->settleFrames(); ++i) {
    frame.begin();
    render(frame);
    frame.end();
    glFinish();
  }
}

const frame::LightFrustum& SearchTechnique::bindInputs(frame::Frame& frame, const frame::ShadowMapSettings&) {
  if (split_) split_->makeInputs(frame);
  const frame::LightFrustum& frustum = search_.bind(frame, maps_.mapsOf(current_), current_);
  if (budgetMap_) budgetMap_->bindTexture(kBudgetMapUnit);
  if (split_) split_->bindInputs(frame);
  return frustum;
}

void SearchTechnique::setUniforms(const gl::Program& program) const {
  search_.configure(program);
  quality_.configure(program);
  gathering_->configure(program, current_);
}

void SearchTechnique::runPasses(frame::Frame& frame, const CountImages* counts) {
  if (split_ && maps_.passes() == 1) {
    split_->run(frame, pass_, *this, maps_.maps()[0], counts, SplitRunner::Timing::Stages);
    if (counts) counted_->add(*counts);
    return;
  }
  const auto scope = frame.passes().open(pass_.name());
  for (current_ = 0; current_ < maps_.passes(); ++current_) {
    if (!maps_.isDue(current_)) continue;
    if (split_)
      split_->run(frame, pass_, *this, maps_.maps()[current_], counts, SplitRunner::Timing::Whole);
    else
      pass_.run(frame, *this, maps_.maps()[current_], counts);
    if (counts) counted_->add(*counts);
  }
  current_ = 0;
}

void SearchTechnique::run(frame::Frame& frame, const CountImages* counts) {
  if (budgets_) budgetMap_ = &budgets_->make(frame);
  for (current_ = 0; current_ < maps_.passes(); ++current_)
    if (maps_.isDue(current_)) VisibilityPass::makeInputs(frame, *this, maps_.maps()[current_]);
  current_ = 0;
  // Frames that count take longer than those they represent.
  BudgetDriver* steered = counts ? nullptr : budgets_.get();
  if (steered) steered->begin();
  runPasses(frame, counts);
  // Levels of several maps contribute to one visibility, so none has a step of its own.
  if (counts && maps_.maps().size() == 1)
    levelSteps_ = findLevelSteps(frame, pass_, *this, maps_.maps()[0], quality_, *counts, *counted_);
  if (steered) steered->finish();
  gathering_->join(frame, pass_.visibility());
  if (last_) last_->run(frame, pass_.visibility());
}

void SearchTechnique::render(frame::Frame& frame) {
  maps_.choose(frame.timeS());
  run(frame, nullptr);
}

const gl::Texture& SearchTechnique::product() const { return last_ ? last_->product() : pass_.visibility(); }

std::vector<Quantity> SearchTechnique::quantities() {
  std::vector<Quantity> all = visibilityQuantities();
  all.insert(all.end(),
             {{"structure_bytes", "Memory of the acceleration structure", "byte", Direction::LowerIsBetter,
               "Schwarz 2009, section 4.3"},
              {"occluder_bytes", "Memory of occluders and biases", "byte", Direction::LowerIsBetter}});
  for (const std::vector<Quantity>& more : {qualityQuantities(), levelStepQuantities(), budgetQuantities()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Counter> SearchTechnique::count(frame::Frame& frame) {
  // For a whole image, however few maps the last frame read.
  maps_.chooseAll();
  levelSteps_.reset();
  const CountImages counts{gl::Texture(gl::Format::RGBA32UI, frame.sizePx()),
                           gl::Texture(gl::Format::RGBA32UI, frame.sizePx())};
  counted_ = std::make_shared<PixelCounts>(PixelCounts{frame.sizePx(), {}, {}});
  frame.begin();
  run(frame, &counts);
  frame.end();
  std::vector<Counter> all = visibilityCounters(*counted_);
  all.push_back({"structure_bytes", static_cast<double>(search_.structureBytes())});
  all.push_back({"occluder_bytes", static_cast<double>(search_.occluderBytes())});
  const std::optional<Image> budgets = budgetMap_ ? std::optional(budgetMap_->read()) : std::nullopt;
  append(all, qualityCounters(*counted_, budgets ? &*budgets : nullptr, budget_));
  if (maps_.maps().size() == 1) append(all, levelStepCounters(levelSteps_.value_or(LevelSteps{})));
  append(all, budgetFacts());
  append(all, gathering_->count(frame));
  if (last_) append(all, last_->count());
  return all;
}

std::vector<Counter> SearchTechnique::budgetFacts() const {
  return budgets_ ? budgets_->count() : std::vector<Counter>{};
}

std::map<std::string, const gl::Texture*> SearchTechnique::debugViews() const {
  std::map<std::string, const gl::Texture*> views;
  if (split_) views = split_->debugViews();
  if (budgets_) views.merge(budgets_->debugViews());
  if (budgetMap_) views["budget_map"] = budgetMap_;
  return views;
}

std::map<std::string, PictureMaker> SearchTechnique::pictures() const {
  std::map<std::string, PictureMaker> all;
  if (!counted_->work.empty()) {
    all["search_area"] = [counted = counted_] { return searchAreaPicture(*counted); };
    all["levels"] = [counted = counted_] { return levelPicture(*counted); };
  }
  if (budgetMap_) all["budget"] = [budgets = budgetMap_->read()] { return budgetPicture(budgets); };
  return all;
}

}  // namespace limen::techniques
