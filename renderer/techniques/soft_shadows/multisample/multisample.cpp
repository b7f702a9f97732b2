// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows for frames with several samples per pixel (SS-35; Schwarz 2009, section 4.6): visibility is
// found for one sample per pixel; samples on another surface take it from the neighbour closest in depth.
// By default, beyond the thesis: it is found behind each pixel's centre, and once for each further surface
// that the pixel's samples see. Sub-pixel surfaces, which no neighbour's sample may be on, have theirs too.
//
// Departures and choices: the product is the mean visibility of a pixel's samples; weights by their colours
// are left out, since products here are visibilities. The thesis does not give the tolerance. Samples that
// light cannot reach (background, facing away) are recognised and neither lend nor take visibility; in the
// thesis their colour is 0. Every sample's depth is computed from its triangle instead of read from a
// multisampled colour buffer.
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/common_counters.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_bindings.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_settings.h"
#include "renderer/techniques/soft_shadows/multisample/pixel_samples.h"
#include "renderer/techniques/soft_shadows/multisample/surface_points.h"

namespace limen::techniques {
namespace {

constexpr const char *kRaster = "multisample/raster", *kSelect = "multisample/select",
                     *kResolve = "multisample/resolve";
constexpr const char* kMultisampleFolder = "renderer/techniques/soft_shadows/multisample/";
class Multisample : public Technique {
 public:
  using Settings = MultisampleSettings;
  explicit Multisample(const MultisampleSettings& settings, gl::Format format = gl::Format::R32F)
      : settings_(settings), format_(format), chosen_(settings.chosen()), inner_(makeInner(settings.inner)) {}

  static std::vector<Quantity> counters() {
    return {{"inner_evaluations_per_px", "Points evaluated per pixel", "1/px", Direction::LowerIsBetter},
            counterOf(innerCounters(), "micro_occluders_per_px"),
            {"complex_share", "Share of pixels that see several surfaces", "", Direction::Neither},
            {"borrowed_share", "Share of samples that take a neighbour's visibility", "", Direction::Neither},
            {"orphan_share", "Share of samples with another surface's visibility", "", Direction::Neither},
            {"sample_bytes", "Memory of samples and points", "byte", Direction::LowerIsBetter}};
  }

  void prepare(frame::Frame& frame) override {
    const glm::ivec2 sizePx = frame.sizePx();
    const auto* surfaces = std::get_if<SurfaceSamples>(&settings_.method);
    if (settings_.samples > 1) samples_.emplace(frame, settings_.samples, settings_.raster, surfaces);
    sampleBytes_ = samples_ ? samples_->bytes() : 0;
    if (samples_) frame.passes().setBytesHeld(kRaster, sampleBytes_);
    points_.reset();
    if (surfaces) {
      surfaces_.emplace(frame, *surfaces, samples_ ? &*samples_ : nullptr, format_);
      holdForChoice(frame, surfaces_->chooseBytes());
      frame.passes().setBytesHeld(kResolve, surfaces_->visibility().bytes());
      points_.emplace(frame, "multisample/inner", surfaces_->pointsPx());
      points_->setSeen(surfaces_->seen(frame));
    } else {
      prepareThesisForm(frame, sizePx);
    }
    inner_->prepare(*points_);
  }

  void render(frame::Frame& frame) override { run(frame, resolve_, nullptr); }
  const gl::Texture& product() const override { return surfaces_ ? surfaces_->visibility() : *visibility_; }
  std::vector<std::string> remarks() const override { return inner_->remarks(); }

  /// Points evaluated per pixel and their micro-occluders; unless every sample is a point, also the share of
  /// pixels that see several surfaces, and of samples that took a neighbour's visibility or one from another
  /// surface.
  std::vector<Counter> count(frame::Frame& frame) override {
    std::optional<gl::Texture> counts;
    const gl::Program* program = resolve_;
    if (chosen_) {
      counts.emplace(gl::Format::RGBA32UI, frame.sizePx());
      program = &shader(frame, "resolve.comp.glsl", {{"COUNT", "1"}});
    }
    frame.begin();
    run(frame, program, counts ? &*counts : nullptr);
    const std::vector<float> receivers = points_->get<frame::Receivers>().texture().read().data;
    const std::vector<Counter> work = inner_->count(*points_);
    frame.end();
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    double evaluated = 0.0;
    for (size_t i = 3; i < receivers.size(); i += 4) evaluated += receivers[i] >= 0.0F ? 1.0 : 0.0;
    std::vector<Counter> out = {{"inner_evaluations_per_px", evaluated / pixels}};
    for (const Counter& counter : work)
      if (counter.name == "micro_occluders_per_px") out.push_back(counter);
    out.push_back({"sample_bytes", static_cast<double>(sampleBytes_)});
    if (surfaces_) {
      const SurfacePoints::Counts found = surfaces_->counts();
      out.push_back({"complex_share", found.complexPixels / pixels});
      out.push_back({"orphan_share", found.dropped / (pixels * settings_.samples)});
    }
    if (!counts) return out;
    double complex = 0.0, lent = 0.0, orphaned = 0.0, samples = 0.0;
    const std::vector<uint32_t> read = counts->readUint();
    for (size_t i = 0; i < read.size(); i += 4) {
      samples += read[i], lent += read[i + 1], orphaned += read[i + 2];
      complex += read[i + 3] > 0 ? 1.0 : 0.0;
    }
    const auto share = [&](double part) { return samples > 0.0 ? part / samples : 0.0; };
    out.push_back({"complex_share", complex / pixels});
    out.push_back({"borrowed_share", share(lent)});
    out.push_back({"orphan_share", share(orphaned)});
    return out;
  }

 private:
  void prepareThesisForm(frame::Frame& frame, glm::ivec2 sizePx) {
    const bool all = !chosen_;
    const glm::ivec2 pointsPx(sizePx.x, sizePx.y * (all ? settings_.samples : 1));
    requireSize(pointsPx);
    gl::ShaderDefines defines = {{"SAMPLES", std::to_string(settings_.samples)}};
    if (samples_)
      defines = samples_->defines();
    else
      defines["SINGLE"] = "1";
    if (chosen_) defineEnum(defines, "REPRESENTATIVE", chosen_->representative);
    choose_ = &shader(frame, all ? "spread.comp.glsl" : "select.comp.glsl", defines);
    defines["MEAN"] = "1";
    resolve_ = all ? &shader(frame, "spread.comp.glsl", defines) : &shader(frame, "resolve.comp.glsl");
    pointIds_.emplace(gl::Format::R32UI, pointsPx);
    places_.emplace(gl::Format::RG32F, pointsPx);
    visibility_.emplace(gl::Format::R32F, sizePx);
    int64_t held = pointIds_->bytes() + places_->bytes();
    if (!all) {
      depths_.emplace(gl::Format::R32F, sizePx);
      sampleDepths_.emplace(gl::Format::R32F, sizePx, 1, settings_.samples);
      held += depths_->bytes() + sampleDepths_->bytes();
    }
    holdForChoice(frame, held);
    frame.passes().setBytesHeld(kResolve, visibility_->bytes());
    points_.emplace(frame, "multisample/inner", pointsPx);
    points_->setSeen({&*pointIds_, &*places_, sizePx});
  }

  void holdForChoice(frame::Frame& frame, int64_t bytes) {
    frame.passes().setBytesHeld(kSelect, bytes);
    sampleBytes_ += bytes;
  }

  static const gl::Program& shader(frame::Frame& frame, const std::string& name,
                                   const gl::ShaderDefines& defines = {}) {
    return frame.context().programs().compute(kMultisampleFolder + name, defines);
  }

  void requireSize(glm::ivec2 pointsPx) const {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(pointsPx.x, pointsPx.y) <= largest) return;
    throw Error("visibility for each of " + std::to_string(settings_.samples) +
                    " samples needs a picture of " + std::to_string(pointsPx.x) + " x " +
                    std::to_string(pointsPx.y) + " points",
                "samples",
                "this driver has at most " + std::to_string(largest) + ": lower 'samples' or the image size");
  }

  /// `resolve`: of the thesis's forms.
  void run(frame::Frame& frame, const gl::Program* resolve, const gl::Texture* counts) {
    points_->setTime(frame.timeS());
    points_->begin();
    choose(frame);
    inner_->render(*points_);
    points_->end();
    const auto scope = frame.passes().open(kResolve);
    if (surfaces_)
      surfaces_->resolve(frame, inner_->product());
    else
      resolveThesisForm(frame, *resolve, counts);
  }

  void resolveThesisForm(frame::Frame& frame, const gl::Program& resolve, const gl::Texture* counts) {
    resolve.set("sizePx", frame.sizePx());
    if (!chosen_) {
      inner_->product().bindTexture(kSampleSpreadVisibilityUnit);
    } else {
      resolve.set("samples", settings_.samples);
      const auto* given = std::get_if<InterpolatedSamples>(&settings_.method);
      const InterpolatedSamples interpolation = given ? *given : InterpolatedSamples{};
      resolve.set("neighbours", interpolation.neighbours);
      resolve.set("tolerance", static_cast<float>(interpolation.tolerance));
      resolve.set("interpolate", given ? 1 : 0);
      sampleDepths_->bindTexture(kSampleResolveSampleDepthsUnit);
      depths_->bindTexture(kSampleResolveDepthsUnit);
      inner_->product().bindTexture(kSampleResolveVisibilityUnit);
    }
    visibility_->bindImage(kSampleResolveVisibilityImage, gl::Access::Write);
    if (counts) counts->bindImage(kSampleResolveCountsImage, gl::Access::Write);
    resolve.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  /// Writes ids and positions of the points for the inner technique.
  void choose(frame::Frame& frame) {
    if (samples_)
      samples_->draw(frame, kRaster);
    else
      frame.get<frame::TriangleIds>();
    const auto scope = frame.passes().open(kSelect);
    if (surfaces_) {
      surfaces_->choose(frame);
      return;
    }
    choose_->set("sizePx", frame.sizePx());
    for (int i = 0; i < settings_.samples; ++i)
      choose_->set(("samplePlaces[" + std::to_string(i) + "]").c_str(),
                   samples_ ? samples_->places()[static_cast<size_t>(i)] : glm::vec2(0.5F));
    if (samples_)
      samples_->bindForSampleIds(frame);
    else
      frame.get<frame::TriangleIds>().texture().bindTexture(kSampleIdsUnit);
    pointIds_->bindImage(kSamplePointIdsImage, gl::Access::Write);
    places_->bindImage(kSamplePlacesImage, gl::Access::Write);
    if (chosen_) {
      const glm::dmat4& toCamera = frame.anchorToCamera();
      const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
      choose_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
      choose_->set("anchorToCamera", glm::mat4(toCamera));
      choose_->set("cameraToLight", glm::mat4(toLight * glm::inverse(toCamera)));
      choose_->set("depthAtCentre", chosen_->depthAt == DepthAt::Centre ? 1 : 0);
      depths_->bindImage(kSampleChosenDepthsImage, gl::Access::Write);
      sampleDepths_->bindImage(kSampleDepthsImage, gl::Access::Write);
      frame.geometry().bindStorage();
    }
    choose_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  MultisampleSettings settings_;
  gl::Format format_;                   // of the product
  std::optional<ChosenSample> chosen_;  // none: every sample or every surface has its own visibility
  std::unique_ptr<Technique> inner_;
  std::optional<PixelSamples> samples_;  // none: one, behind the centre
  std::optional<SurfacePoints> surfaces_;
  int64_t sampleBytes_ = 0;
  const gl::Program *choose_ = nullptr, *resolve_ = nullptr;
  std::optional<gl::Texture> pointIds_, places_, depths_, sampleDepths_, visibility_;
  std::optional<frame::Frame> points_;
};

/// Each sample's share of the light's radiance, per channel: their mean, as light of several colours has
/// shadows of several colours within a pixel.
class MultisampleColoured : public Multisample {
 public:
  using Settings = MultisampleColouredSettings;
  explicit MultisampleColoured(const MultisampleColouredSettings& settings)
      : Multisample({.inner = settings.inner,
                     .samples = settings.samples,
                     .raster = settings.raster,
                     .method = settings.surfaces},
                    gl::Format::RGBA32F) {}
};

const RegisteredTechnique<Multisample> kMultisampleRegistered{
    {.name = "soft_shadows/multisample",
     .version = 2,
     .summary = "Another technique's visibility for all samples of a pixel, found once per pixel and surface",
     .source = "Schwarz 2009, section 4.6 (SS-35)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = Multisample::counters()}};

const RegisteredTechnique<MultisampleColoured> kMultisampleColouredRegistered{
    {.name = "soft_shadows/multisample_coloured",
     .version = 1,
     .summary =
         "Visible share of a coloured light's radiance for all samples of a pixel, found once per pixel "
         "and surface",
     .source = "bench; Schwarz 2009, sections 4.2.2 and 4.6 (SS-17, SS-35)",
     .product = ProductKind::LightColour,
     .needs = {"area_light"},
     .counters = Multisample::counters()}};

}  // namespace
}  // namespace limen::techniques
