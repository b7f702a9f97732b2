// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/scene_needs/grouped_mirrors.h"

#include <epoxy/gl.h>

#include <cassert>

#include "renderer/frame/mirror_rays.h"
#include "renderer/techniques/reflections/reflection_bindings.h"

namespace limen::techniques {
namespace {

constexpr const char* kJoinPass = "reflections/join_mirrors";
constexpr size_t kNamesOnRecord = 4;

std::string lastName(const Candidate& candidate) {
  return candidate.technique.substr(candidate.technique.rfind('/') + 1);
}

}  // namespace

void GroupedMirrors::prepare(frame::Frame& frame) {
  assert(!groups_.empty());
  shown_.clear();
  for (size_t i = 0; i < groups_.size(); ++i) {
    const MirrorGroup& group = groups_[i];
    Shown& shown = shown_.emplace_back();
    shown.frame = std::make_unique<frame::Frame>(
        frame, "mirrors_" + std::to_string(i + 1) + "_" + lastName(group.candidate),
        frame::ShownMirrors(group.parts));
    shown.technique = makeTechnique(group.candidate);
    shown.technique->prepare(*shown.frame);
  }
  join_ = &frame.context().programs().compute(
      "renderer/techniques/reflections/scene_needs/join_mirrors.comp.glsl");
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  frame.passes().setBytesHeld(kJoinPass, picture_->bytes());
}

void GroupedMirrors::render(frame::Frame& frame) {
  for (const Shown& shown : shown_) {
    shown.frame->setTime(frame.timeS());
    shown.frame->begin();
    shown.technique->render(*shown.frame);
  }
  const auto scope = frame.passes().open(kJoinPass);
  join_->set("sizePx", frame.sizePx());
  picture_->bindImage(kComposeImage, gl::Access::Write);
  for (size_t i = 0; i < shown_.size(); ++i) {
    join_->set("all", i == 0 ? 1 : 0);
    shown_[i].frame->get<frame::MirrorRays>().origins().bindTexture(kReflectionOriginsUnit);
    shown_[i].technique->product().bindTexture(kComposeReflectedUnit);
    join_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}

std::vector<Counter> GroupedMirrors::count(frame::Frame&) {
  std::vector<Counter> out;
  for (const Shown& shown : shown_)
    for (Counter& counter : shown.technique->count(*shown.frame)) out.push_back(std::move(counter));
  return out;
}

Candidate candidateOf(const std::vector<MirrorGroup>& groups) {
  if (groups.size() == 1) return groups.front().candidate;
  Candidate out{.technique = "reflections/each_mirror", .given = {}};
  for (const MirrorGroup& group : groups) {
    out.details += (out.details.empty() ? "" : "; ") + describe(group.candidate) + " for ";
    for (size_t i = 0; i < group.names.size() && i < kNamesOnRecord; ++i)
      out.details += (i == 0 ? "'" : ", '") + group.names[i] + "'";
    if (group.names.size() > kNamesOnRecord)
      out.details += " and " + std::to_string(group.names.size() - kNamesOnRecord) + " others";
  }
  out.make = [groups]() -> std::unique_ptr<Technique> { return std::make_unique<GroupedMirrors>(groups); };
  return out;
}

}  // namespace limen::techniques
