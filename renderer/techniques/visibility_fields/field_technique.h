// SPDX-License-Identifier: BSD-3-Clause
// The two techniques over the same rays: looked up in fields, or traced. What differs is in their settings:
// `rays` (with a member `receiver`, makeInputs() and configure()), `field` or `tracer`, the shader, the pass
// and the product's format.
#pragma once

#include <epoxy/gl.h>

#include <optional>
#include <utility>
#include <vector>

#include "renderer/techniques/technique.h"
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_rays.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/techniques/visibility_fields/field_reader.h"
#include "renderer/techniques/visibility_fields/near_receivers/near_receivers.h"
#include "renderer/techniques/visibility_fields/object_tracer.h"
#include "renderer/techniques/visibility_fields/tile_filter.h"

namespace limen::techniques {

/// S: also `field`, a FieldReading, define(), which adds to the shader's defines, passes() over the
/// picture for a number of objects, each with its own `passObject`, near(), kNearShader, which traces all
/// rays of receivers that are near to an object, and kDoubtfulShader, which traces single ones.
template <class S>
class FieldTechnique : public Technique {
 public:
  using Settings = S;
  explicit FieldTechnique(const S& settings)
      : settings_(settings),
        reader_(settings.field),
        near_(settings.near()),
        doubtful_(settings.near()),
        filter_(settings.rays.receiver, S::kPass, S::kFormat) {}

  void prepare(frame::Frame& frame) override {
    reader_.prepare(frame, settings_.rays.receiver, true, near_.traced() || doubtful_.traced());
    gl::ShaderDefines defines = reader_.defines();
    settings_.define(defines);
    gl::ShaderDefines tracing = reader_.traceDefines();
    tracing.insert(defines.begin(), defines.end());
    near_.prepare(frame, S::kNearShader, tracing);
    doubtful_.prepare(frame, S::kDoubtfulShader, tracing, S::kFormat, settings_.rays.receiver.rays);
    near_.define(defines);
    doubtful_.define(defines);
    program_ = &frame.context().programs().compute(S::kShader, defines);
    defines["COUNT"] = "1";
    counting_ = &frame.context().programs().compute(S::kShader, defines);
    picture_.emplace(S::kFormat, frame.sizePx());
    filter_.prepare(frame);
    frame.passes().setBytesHeld(
        S::kPass, picture_->bytes() + reader_.bytesHeld() + near_.bytesHeld() + doubtful_.bytesHeld());
  }
  void render(frame::Frame& frame) override {
    run(frame, *program_, nullptr);
    filter_.run(frame, *picture_);
  }
  const gl::Texture& product() const override { return filter_.product(*picture_); }
  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> out =
        reader_.count(frame, [&](const gl::Buffer& counts) { run(frame, *counting_, &counts); });
    out.push_back(near_.count(frame));
    for (Counter& counter : doubtful_.count()) out.push_back(std::move(counter));
    return out;
  }
  std::vector<std::string> remarks() const override {
    std::vector<std::string> out = reader_.remarks();
    for (std::string& remark : doubtful_.remarks()) out.push_back(std::move(remark));
    return out;
  }
  static std::vector<Quantity> quantities() {
    std::vector<Quantity> out = FieldReader::quantities();
    out.push_back(NearReceivers::quantity());
    for (Quantity& quantity : DoubtfulRays::quantities()) out.push_back(std::move(quantity));
    return out;
  }

 private:
  void run(frame::Frame& frame, const gl::Program& program, const gl::Buffer* counts) {
    settings_.rays.makeInputs(frame);
    const auto scope = frame.passes().open(S::kPass);
    reader_.place(frame);
    reader_.bind(program);
    near_.bindList(program);
    doubtful_.bindList(program);
    if (counts) counts->bindStorage(kFieldCountsBuffer);
    settings_.rays.configure(program, frame);
    picture_->bindImage(kFieldOutImage, gl::Access::ReadWrite);
    const int passes = settings_.passes(reader_.objectCount());
    for (int pass = 0; pass < passes; ++pass) {
      if (passes > 1) program.set("passObject", static_cast<uint32_t>(pass));
      program.dispatch(frame.sizePx());
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    near_.trace(reader_, [&](const gl::Program& tracing) {
      settings_.rays.configure(tracing, frame);
      picture_->bindImage(kFieldOutImage, gl::Access::Write);
    });
    doubtful_.trace(reader_, frame, *picture_,
                    [&](const gl::Program& tracing) { settings_.rays.configure(tracing, frame); });
  }

  S settings_;
  FieldReader reader_;
  NearReceivers near_;
  DoubtfulRays doubtful_;
  TileFilter filter_;
  std::optional<gl::Texture> picture_;
  const gl::Program *program_ = nullptr, *counting_ = nullptr;
};

template <class S>
class TracedTechnique : public Technique {
 public:
  using Settings = S;
  explicit TracedTechnique(const S& settings)
      : settings_(settings), filter_(settings.rays.receiver, S::kPass, S::kFormat) {}

  void prepare(frame::Frame& frame) override {
    tracer_.prepare(frame, settings_.rays.receiver, settings_.tracer);
    program_ = &frame.context().programs().compute(S::kShader, ObjectTracer::defines(settings_.tracer));
    picture_.emplace(S::kFormat, frame.sizePx());
    filter_.prepare(frame);
    frame.passes().setBytesHeld(S::kPass, picture_->bytes() + tracer_.bytesHeld());
  }
  void render(frame::Frame& frame) override {
    settings_.rays.makeInputs(frame);
    tracer_.update(frame);
    {
      const auto scope = frame.passes().open(S::kPass);
      tracer_.bind(*program_);
      settings_.rays.configure(*program_, frame);
      picture_->bindImage(kFieldOutImage, gl::Access::ReadWrite);
      ObjectTracer::dispatchRows(*program_, frame, settings_.rays.receiver.side());
    }
    filter_.run(frame, *picture_);
  }
  const gl::Texture& product() const override { return filter_.product(*picture_); }

 private:
  S settings_;
  ObjectTracer tracer_;
  TileFilter filter_;
  std::optional<gl::Texture> picture_;
  const gl::Program* program_ = nullptr;
};

}  // namespace limen::techniques
