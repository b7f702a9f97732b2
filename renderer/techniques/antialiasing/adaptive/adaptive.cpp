// SPDX-License-Identifier: BSD-3-Clause
// Shades one sample of each pixel, decides from the geometry in its window and from the light around it how
// many more it needs, and shades these. Choices that the thesis leaves open: k counts samples beyond the
// first and is rounded to the nearest; a window that a surface shares with the background asks for all; the
// range of luminance includes the pixel's own, in linear light. Source: Holländer 2013, section 4.3.
#include <epoxy/gl.h>

#include <numeric>
#include <optional>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/antialiasing/adaptive/adaptive_settings.h"
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"
#include "renderer/techniques/antialiasing/sample_costs.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {
namespace {

constexpr const char* kFolder = "renderer/techniques/antialiasing/";

/// The alternatives of AdaptiveSettings::geometry, in their order, for the shader.
enum class Geometry { NormalAndDepth, MinMaxDepth, NormalCone, DepthVariance, NormalVariance, None };
constexpr EnumNames<Geometry, 6> enumNames(Geometry) {
  return {{{{Geometry::NormalAndDepth, NormalAndDepth::kKind},
            {Geometry::MinMaxDepth, MinMaxDepth::kKind},
            {Geometry::NormalCone, NormalCone::kKind},
            {Geometry::DepthVariance, DepthVariance::kKind},
            {Geometry::NormalVariance, NormalVariance::kKind},
            {Geometry::None, NoGeometry::kKind}}}};
}

enum class SortStep { Count, Place, List };
constexpr EnumNames<SortStep, 3> enumNames(SortStep) {
  return {{{{SortStep::Count, "count"}, {SortStep::Place, "place"}, {SortStep::List, "list"}}}};
}

class Adaptive : public Technique {
 public:
  using Settings = AdaptiveSettings;
  explicit Adaptive(const AdaptiveSettings& settings) : settings_(settings) {}

  void prepare(frame::Frame& frame) override {
    view_.emplace(frame, settings_.window, settings_.samples, settings_.gradients);
    first_ = &shader(frame, SampleForm::First);
    count_ =
        &frame.context().programs().compute(std::string(kFolder) + "count_samples.comp.glsl", countDefines());
    firstColours_.emplace(gl::Format::RGBA32F, frame.sizePx());
    counts_.emplace(gl::Format::R32UI, frame.sizePx());
    picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
    gl::PassList& passes = frame.passes();
    passes.setBytesHeld("antialiasing/first", firstColours_->bytes());
    passes.setBytesHeld("antialiasing/count", counts_->bytes());
    passes.setBytesHeld("antialiasing/shade", picture_->bytes());
    if (settings_.block > 1) {
      spread_ = &frame.context().programs().compute(std::string(kFolder) + "block_counts.comp.glsl");
      spreadCounts_.emplace(gl::Format::R32UI, frame.sizePx());
      passes.setBytesHeld("antialiasing/spread", spreadCounts_->bytes());
    }
    prepareExecution(frame);
  }

  void render(frame::Frame& frame) override {
    view_->make();
    {
      const auto scope = frame.passes().open("antialiasing/first");
      view_->configure(*first_);
      firstColours_->bindImage(kSampleOutImage, gl::Access::Write);
      first_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    countSamples(frame);
    if (list_) sort(frame);
    const auto scope = frame.passes().open("antialiasing/shade");
    view_->configure(*shade_);
    firstColours_->bindTexture(kSampleFirstUnit);
    counts().bindTexture(kSampleCountsUnit);
    picture_->bindImage(kSampleOutImage, gl::Access::Write);
    shadeFurther(frame);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  const gl::Texture& product() const override { return *picture_; }

  std::vector<Counter> count(frame::Frame&) override {
    const std::vector<uint32_t> each = counts().readUint();
    const double shaded = std::accumulate(each.begin(), each.end(), 0.0);
    return sampleCosts(shaded, double(each.size()), settings_.window);
  }

  std::map<std::string, PictureMaker> pictures() const override {
    const std::vector<uint32_t> each = counts().readUint();
    const glm::ivec2 sizePx = picture_->sizePx();
    const float most = static_cast<float>(settings_.window * settings_.window);
    return {{"sample_counts", [each, sizePx, most] {
               Image image(sizePx.x, sizePx.y, 3);
               for (size_t i = 0; i < each.size(); ++i)
                 for (size_t c = 0; c < 3; ++c) image.data[3 * i + c] = static_cast<float>(each[i]) / most;
               return image;
             }}};
  }

 private:
  const gl::Program& shader(frame::Frame& frame, SampleForm form) const {
    gl::ShaderDefines defines = view_->defines();
    defineEnum(defines, "FORM", form);
    return frame.context().programs().compute(std::string(kFolder) + "shade_samples.comp.glsl", defines);
  }

  gl::ShaderDefines countDefines() const {
    gl::ShaderDefines defines = view_->defines();
    defineEnum(defines, "GEOMETRY", static_cast<Geometry>(settings_.geometry.index()));
    DepthTerms terms = DepthTerms::Relative;
    MetricForm form = MetricForm::Stable;
    std::visit(
        [&](const auto& metric) {
          if constexpr (requires { metric.depth; }) {
            terms = metric.depth;
            defines["MEASURE_DEPTH"] = "1";
          }
          if constexpr (requires { metric.form; }) form = metric.form;
        },
        settings_.geometry);
    defineEnum(defines, "DEPTH_TERMS", terms);
    defineEnum(defines, "METRIC_FORM", form);
    if (std::holds_alternative<LightnessRange>(settings_.lightness)) defines["LIGHTNESS"] = "1";
    if (settings_.flatTriangles) defines["FLAT_TRIANGLES"] = "1";
    if (settings_.powersOfTwo) defines["POWERS_OF_TWO"] = "1";
    return defines;
  }

  void prepareExecution(frame::Frame& frame) {
    switch (settings_.execution) {
      case SampleExecution::Loop:
        shade_ = &shader(frame, SampleForm::Loop);
        break;
      case SampleExecution::Grouped:
        shade_ = &shader(frame, SampleForm::Grouped);
        break;
      case SampleExecution::Sorted:
        shade_ = &shader(frame, SampleForm::Sorted);
        for (const SortStep step : {SortStep::Count, SortStep::Place, SortStep::List}) {
          gl::ShaderDefines defines;
          defineEnum(defines, "STEP", step);
          sort_[size_t(step)] =
              &frame.context().programs().compute(std::string(kFolder) + "sort_counts.comp.glsl", defines);
        }
        list_.emplace(int64_t{4} * frame.sizePx().x * frame.sizePx().y, nullptr);
        header_.emplace(int64_t{sizeof(SampleSort)}, nullptr);
        header_->clearUint(0);
        frame.passes().setBytesHeld("antialiasing/sort", list_->bytes() + header_->bytes());
        break;
      case SampleExecution::Balanced:
        shade_ = &frame.context().programs().compute(std::string(kFolder) + "shade_balanced.comp.glsl",
                                                     view_->defines());
        break;
    }
  }

  const gl::Texture& counts() const { return spread_ ? *spreadCounts_ : *counts_; }

  void countSamples(frame::Frame& frame) {
    {
      const auto scope = frame.passes().open("antialiasing/count");
      view_->configure(*count_);
      std::visit(
          [&](const auto& metric) {
            if constexpr (requires { metric.depthScale; })
              count_->set("depthScale", static_cast<float>(metric.depthScale));
            if constexpr (requires { metric.normalScale; })
              count_->set("normalScale", static_cast<float>(metric.normalScale));
          },
          settings_.geometry);
      if (const auto* range = std::get_if<LightnessRange>(&settings_.lightness)) {
        count_->set("lightnessScale", static_cast<float>(range->scale));
        count_->set("leastRange", static_cast<float>(range->leastRange));
        count_->set("edgeShare", static_cast<float>(range->edgeShare));
      }
      count_->set("nearest", static_cast<float>(frame::nearPlane(frame)));
      firstColours_->bindTexture(kSampleFirstUnit);
      counts_->bindImage(kSampleCountsImage, gl::Access::Write);
      count_->dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    if (!spread_) return;
    const auto scope = frame.passes().open("antialiasing/spread");
    spread_->set("pictureSizePx", frame.sizePx());
    spread_->set("block", settings_.block);
    counts_->bindTexture(kSampleCountsUnit);
    spreadCounts_->bindImage(kSampleCountsImage, gl::Access::Write);
    spread_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  void sort(frame::Frame& frame) {
    const auto scope = frame.passes().open("antialiasing/sort");
    list_->bindStorage(kSortedListBuffer);
    header_->bindStorage(kSortedHeaderBuffer);
    counts().bindTexture(kSampleCountsUnit);
    firstColours_->bindTexture(kSampleFirstUnit);
    picture_->bindImage(kSampleOutImage, gl::Access::Write);
    for (const SortStep step : {SortStep::Count, SortStep::Place, SortStep::List}) {
      const gl::Program& program = *sort_[size_t(step)];
      program.set("pictureSizePx", frame.sizePx());
      if (step == SortStep::Place)
        program.dispatch({1, 1}, {1, 1});
      else
        program.dispatch(frame.sizePx());
      glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                      GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
  }

  void shadeFurther(frame::Frame& frame) {
    switch (settings_.execution) {
      case SampleExecution::Loop:
      case SampleExecution::Balanced:
        shade_->dispatch(frame.sizePx());
        break;
      case SampleExecution::Grouped:
        for (int group = 1; group <= settings_.window * settings_.window; ++group) {
          shade_->set("group", group);
          shade_->dispatch(frame.sizePx());
        }
        break;
      case SampleExecution::Sorted:
        list_->bindStorage(kSortedListBuffer);
        header_->bindStorage(kSortedHeaderBuffer);
        shade_->use();
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, header_->id());
        glDispatchComputeIndirect(static_cast<GLintptr>(offsetof(SampleSort, groupsX)));
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
        break;
    }
  }

  AdaptiveSettings settings_;
  std::optional<SampleView> view_;
  const gl::Program *first_ = nullptr, *count_ = nullptr, *spread_ = nullptr, *shade_ = nullptr;
  std::array<const gl::Program*, 3> sort_{};
  std::optional<gl::Texture> firstColours_, counts_, spreadCounts_, picture_;
  std::optional<gl::Buffer> list_, header_;
};

const RegisteredTechnique<Adaptive> kAdaptive{
    {.name = "antialiasing/adaptive",
     .version = 1,
     .summary = "As many samples of each pixel as its geometry and light ask for",
     .source = "Holländer 2013, section 4.3 (HOL-42 to HOL-54)",
     .product = ProductKind::Colour,
     .counters = sampleCostQuantities()}};

}  // namespace
}  // namespace limen::techniques
