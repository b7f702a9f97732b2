// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows for frames with several samples a pixel (SS-35; Schwarz 2009, section 4.6): visibility is
// found for one sample a pixel; samples on another surface take it from the neighbour that is closest to them
// in depth.
//
// Departures and choices: the product is the mean visibility of a pixel's samples; weights by their colours
// are left out, since products here are visibilities. The thesis does not give the tolerance. Samples that no
// light can reach (background, turned away) are known to and neither give nor take visibility; there, their
// colour is 0. Every sample's depth comes from its triangle in compute instead of from a multisampled colour
// buffer.
#include <epoxy/gl.h>

#include <algorithm>
#include <optional>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"
#include "renderer/techniques/soft_shadows/multisample/multisample_ids.h"

namespace limen::techniques {
namespace {

constexpr const char *kRaster = "multisample/raster", *kSelect = "multisample/select",
                     *kResolve = "multisample/resolve";
constexpr const char* kMultisampleFolder = "renderer/techniques/soft_shadows/multisample/";
constexpr const char* kMultisampleSection = "Schwarz 2009, section 4.6";
constexpr double kDefaultTolerance = 0.01;

enum class Method { Interpolate, Centre, PerSample };

Method methodOf(const ParameterValues& values) {
  const std::string& name = values.text("method");
  return name == "interpolate" ? Method::Interpolate : name == "centre" ? Method::Centre : Method::PerSample;
}

std::vector<Parameter> multisampleParameters() {
  std::vector<Parameter> out = {
      choiceParameter("samples", "4", {"1", "2", "4", "8"},
                      "Samples a pixel; a driver need not have every number", kMultisampleSection),
      choiceParameter(
          "method", "interpolate", {"interpolate", "centre", "per_sample"},
          "Samples take the visibility of what is closest in depth, or all that of the pixel, or each "
          "gets its own",
          kMultisampleSection),
      choiceParameter(
          "representative", "first", {"first", "nearest", "farthest", "median"},
          "Sample that the visibility is found for; all but the first are chosen by depth among those "
          "that see a surface",
          "Schwarz 2009, section 4.6 (first; others suggested)"),
      choiceParameter(
          "depth_at", "centre", {"centre", "sample"},
          "Place whose depth a sample has: the pixel's centre, as where shading runs once a pixel, or "
          "its own",
          "Schwarz 2009, section 4.6, footnote 10 (centre)"),
      realParameter(
          "tolerance", kDefaultTolerance, 0.0, 1.0, "",
          "Difference in depth, as a share of the sample's, up to which samples are taken for one surface",
          "Schwarz 2009, section 4.6 (value not given there)"),
      choiceParameter("neighbours", "4", {"4", "8"}, "Pixels around one that may lend their visibility",
                      "Schwarz 2009, section 4.6 (4)")};
  for (Parameter& parameter : innerParameters(InnerKind::OrRayTraced)) out.push_back(std::move(parameter));
  return out;
}

void checkMultisample(const ParameterValues& values) {
  const Method method = methodOf(values);
  const auto refuse = [&](const std::string& name, const std::string& why) {
    throw Error("'" + name + "' " + why, name, "leave it out, or give another method");
  };
  for (const Parameter& parameter : multisampleParameters()) {
    const std::string& name = parameter.name;
    if (values.all().at(name) == parameter.defaultValue) continue;
    if (method != Method::Interpolate && (name == "tolerance" || name == "neighbours"))
      refuse(name, "is about interpolation, and method '" + values.text("method") + "' does none");
    if (method == Method::PerSample && (name == "representative" || name == "depth_at"))
      refuse(name, "is about one sample for all of a pixel's, and each has its own");
  }
  checkInner(values);
}

class Multisample : public Technique {
 public:
  explicit Multisample(const ParameterValues& values)
      : method_(methodOf(values)),
        samples_(std::stoi(values.text("samples"))),
        representative_(values.text("representative")),
        depthAtCentre_(values.text("depth_at") == "centre"),
        tolerance_(values.real("tolerance")),
        neighbours_(std::stoi(values.text("neighbours"))),
        inner_(makeInner(values)) {
    checkMultisample(values);
  }

  void prepare(frame::Frame& frame) override {
    const bool all = method_ == Method::PerSample;
    const glm::ivec2 sizePx = frame.sizePx(), pointsPx(sizePx.x, sizePx.y * (all ? samples_ : 1));
    requireSize(pointsPx);
    gl::ShaderDefines defines = {{"SAMPLES", std::to_string(samples_)}};
    if (samples_ == 1)
      defines["SINGLE"] = "1";
    else
      ids_.emplace(frame, samples_);
    choose_ = &shader(frame, all ? "spread.comp.glsl" : "select.comp.glsl", defines);
    defines["MEAN"] = "1";
    resolve_ = all ? &shader(frame, "spread.comp.glsl", defines) : &shader(frame, "resolve.comp.glsl");
    pointIds_.emplace(gl::Format::R32UI, pointsPx);
    places_.emplace(gl::Format::RG32F, pointsPx);
    visibility_.emplace(gl::Format::R32F, sizePx);
    int64_t held = pointIds_->bytes() + places_->bytes();
    if (!all) {
      depths_.emplace(gl::Format::R32F, sizePx);
      sampleDepths_.emplace(gl::Format::R32F, sizePx, 1, samples_);
      held += depths_->bytes() + sampleDepths_->bytes();
    }
    if (ids_) frame.passes().setBytesHeld(kRaster, ids_->bytes());
    frame.passes().setBytesHeld(kSelect, held);
    frame.passes().setBytesHeld(kResolve, visibility_->bytes());
    points_.emplace(frame, "multisample/inner", pointsPx);
    points_->setSeen({&*pointIds_, &*places_, sizePx});
    inner_->prepare(*points_);
  }

  void render(frame::Frame& frame) override { run(frame, *resolve_, nullptr); }
  const gl::Texture& product() const override { return *visibility_; }

  /// Points asked for a pixel and their micro-occluders; where one sample stands for others, also the share
  /// of pixels that see several surfaces, and of samples that took a neighbour's visibility, or one that is
  /// not of their surface.
  std::vector<Counter> count(frame::Frame& frame) override {
    std::optional<gl::Texture> counts;
    const gl::Program* program = resolve_;
    if (method_ != Method::PerSample) {
      counts.emplace(gl::Format::RGBA32UI, frame.sizePx());
      program = &shader(frame, "resolve.comp.glsl", {{"COUNT", "1"}});
    }
    frame.begin();
    run(frame, *program, counts ? &*counts : nullptr);
    const std::vector<float> receivers = points_->get<frame::Receivers>().texture().read().data;
    const std::vector<Counter> work = inner_->count(*points_);
    frame.end();
    const double pixels = double(frame.sizePx().x) * frame.sizePx().y;
    double evaluated = 0.0;
    for (size_t i = 3; i < receivers.size(); i += 4) evaluated += receivers[i] >= 0.0F ? 1.0 : 0.0;
    std::vector<Counter> out = {{"inner_evaluations_per_px", evaluated / pixels, "", true}};
    for (const Counter& counter : work)
      if (counter.name == "micro_occluders_per_px") out.push_back(counter);
    if (!counts) return out;
    double complex = 0.0, lent = 0.0, orphaned = 0.0, samples = 0.0;
    const std::vector<uint32_t> read = counts->readUint();
    for (size_t i = 0; i < read.size(); i += 4) {
      samples += read[i], lent += read[i + 1], orphaned += read[i + 2];
      complex += read[i + 3] > 0 ? 1.0 : 0.0;
    }
    const auto share = [&](double part) { return samples > 0.0 ? part / samples : 0.0; };
    out.push_back({"complex_share", complex / pixels, "", false});
    out.push_back({"borrowed_share", share(lent), "", false});
    out.push_back({"orphan_share", share(orphaned), "", false});
    return out;
  }

 private:
  static const gl::Program& shader(frame::Frame& frame, const std::string& name,
                                   const gl::ShaderDefines& defines = {}) {
    return frame.context().programs().compute(kMultisampleFolder + name, defines);
  }

  void requireSize(glm::ivec2 pointsPx) const {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(pointsPx.x, pointsPx.y) <= largest) return;
    throw Error("visibility for each of " + std::to_string(samples_) + " samples needs a picture of " +
                    std::to_string(pointsPx.x) + " x " + std::to_string(pointsPx.y) + " points",
                "samples",
                "this driver has at most " + std::to_string(largest) + ": lower 'samples' or the image size");
  }

  void run(frame::Frame& frame, const gl::Program& resolve, const gl::Texture* counts) {
    points_->setTime(frame.timeS());
    points_->begin();
    choose(frame);
    inner_->render(*points_);
    points_->end();
    const auto scope = frame.passes().open(kResolve);
    resolve.set("sizePx", frame.sizePx());
    if (method_ == Method::PerSample) {
      inner_->product().bindTexture(0);
    } else {
      resolve.set("samples", samples_);
      resolve.set("neighbours", neighbours_);
      resolve.set("tolerance", static_cast<float>(tolerance_));
      resolve.set("interpolate", method_ == Method::Interpolate ? 1 : 0);
      sampleDepths_->bindTexture(0);
      depths_->bindTexture(1);
      inner_->product().bindTexture(2);
    }
    visibility_->bindImage(0, gl::Access::Write);
    if (counts) counts->bindImage(1, gl::Access::Write);
    resolve.dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }

  /// Writes ids and places of the points that the inner technique is asked for.
  void choose(frame::Frame& frame) {
    if (ids_) {
      const auto scope = frame.passes().open(kRaster);
      ids_->draw(frame);
    } else {
      frame.get<frame::TriangleIds>();
    }
    const auto scope = frame.passes().open(kSelect);
    choose_->set("sizePx", frame.sizePx());
    for (int i = 0; i < samples_; ++i)
      choose_->set(("samplePlaces[" + std::to_string(i) + "]").c_str(),
                   ids_ ? ids_->places()[static_cast<size_t>(i)] : glm::vec2(0.5F));
    if (ids_)
      ids_->bindTexture(0);
    else
      frame.get<frame::TriangleIds>().texture().bindTexture(0);
    pointIds_->bindImage(0, gl::Access::Write);
    places_->bindImage(1, gl::Access::Write);
    if (method_ != Method::PerSample) {
      const glm::dmat4& toCamera = frame.anchorToCamera();
      const glm::dmat4 toLight = frame.scene().lights.at(0).toLightSpace(frame.gpuScene().anchor());
      choose_->set("rayScale", glm::vec2(frame.tanHalfFov() * frame.aspect(), frame.tanHalfFov()));
      choose_->set("anchorToCamera", glm::mat4(toCamera));
      choose_->set("cameraToLight", glm::mat4(toLight * glm::inverse(toCamera)));
      choose_->set("depthAtCentre", depthAtCentre_ ? 1 : 0);
      choose_->set("representative", representative_ == "first"      ? 0
                                     : representative_ == "nearest"  ? 1
                                     : representative_ == "farthest" ? 2
                                                                     : 3);
      depths_->bindImage(2, gl::Access::Write);
      sampleDepths_->bindImage(3, gl::Access::Write);
      frame.geometry().bindStorage(0);
    }
    choose_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

  Method method_;
  int samples_;
  std::string representative_;
  bool depthAtCentre_;
  double tolerance_;
  int neighbours_;
  std::unique_ptr<Technique> inner_;
  std::optional<MultisampleIds> ids_;
  const gl::Program *choose_ = nullptr, *resolve_ = nullptr;
  std::optional<gl::Texture> pointIds_, places_, depths_, sampleDepths_, visibility_;
  std::optional<frame::Frame> points_;
};

const Registered<TechniqueInfo> kMultisampleRegistered{
    {.name = "soft_shadows/multisample",
     .version = 1,
     .summary = "Another technique's visibility at one sample a pixel, shared by the pixel's other samples",
     .source = "Schwarz 2009, section 4.6 (SS-35)",
     .product = ProductKind::Visibility,
     .parameters = multisampleParameters(),
     .needs = {"rectangular_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<Multisample>(values); },
     .errorBound = {},
     .counters = {"inner_evaluations_per_px", "micro_occluders_per_px", "complex_share", "borrowed_share",
                  "orphan_share"},
     .check = checkMultisample}};

}  // namespace
}  // namespace limen::techniques
