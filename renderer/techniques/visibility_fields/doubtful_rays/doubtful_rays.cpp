// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/doubtful_rays/doubtful_rays.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>

#include "experiments/base/error.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {

static_assert(kDoubtGroup == kGroupSide * kGroupSide);

void checkNear(const NearSetting& setting, const FieldReading& field, const char* where) {
  if (!std::holds_alternative<DoubtfulTraced>(setting)) return;
  if (field.fetch == FieldFetch::Nearest)
    throw Error(
        "'near: doubtful' compares rays around the direction that is asked for, which 'fetch: nearest' "
        "does not know",
        where, "give fetch: aimed, or near: field or traced");
  if (field.form.directionMap != visibility_fields::DirectionForm::Concentric)
    throw Error("'near: doubtful' compares neighbours in concentric maps", where,
                "leave out 'direction_map', or give near: field or traced");
}

DoubtfulRays::DoubtfulRays(const NearSetting& setting) {
  if (const auto* doubtful = std::get_if<DoubtfulTraced>(&setting)) setting_ = *doubtful;
}

void DoubtfulRays::define(gl::ShaderDefines& defines) const {
  if (!traced()) return;
  defines["FIELD_NEAR"] = "1";
  defines["FIELD_DOUBT"] = "1";
}

void DoubtfulRays::prepare(frame::Frame& frame, const std::string& shader, const gl::ShaderDefines& defines,
                           gl::Format format, int64_t raysPerPx) {
  if (!traced()) return;
  const std::string folder = "renderer/techniques/visibility_fields/doubtful_rays/";
  gl::ProgramCache& programs = frame.context().programs();
  groups_ = &programs.compute(folder + "doubtful_groups.comp.glsl");
  program_ = &programs.compute(shader, defines);
  adding_ = &programs.compute(folder + "doubtful_sums.comp.glsl",
                              {{"DOUBT_FORMAT", format == gl::Format::R32F ? "r32f" : "rgba32f"}});
  const int64_t pixels = int64_t{frame.sizePx().x} * frame.sizePx().y, rays = pixels * raysPerPx;
  if (rays > std::numeric_limits<uint32_t>::max())
    throw Error(
        "the picture has " + std::to_string(rays) + " rays, more than are counted for 'near: doubtful'",
        "rays", "use fewer 'rays', or a smaller image");
  raysPerPx_ = raysPerPx, allRays_ = static_cast<double>(rays);
  capacity_ = static_cast<uint32_t>(
      std::min(std::ceil(setting_->capacity * static_cast<double>(rays)), static_cast<double>(rays)));
  const int64_t bytes = static_cast<int64_t>(sizeof(DoubtListHeader)) + int64_t{4} * capacity_;
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > most)
    throw Error("a list of doubtful rays takes " + std::to_string(bytes) +
                    " bytes in one buffer; this device allows " + std::to_string(most),
                "capacity", "give less 'capacity', use fewer 'rays', or a smaller image");
  list_.emplace(bytes, nullptr);
  list_->clearUint(0);
  sums_.emplace(int64_t{8} * pixels, nullptr);
  sums_->clearUint(0);
}

void DoubtfulRays::bindList(const gl::Program& program) const {
  if (!traced()) return;
  list_->bindStorage(kDoubtListBuffer);
  sums_->bindStorage(kDoubtSumsBuffer);
  program.set("nearFootprints", static_cast<float>(setting_->footprints));
  program.set("doubtReach", static_cast<float>(setting_->reach));
  program.set("doubtDifference", static_cast<float>(setting_->difference));
  program.set("doubtCapacity", capacity_);
}

void DoubtfulRays::makeGroups() const {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  list_->bindStorage(kDoubtListBuffer);
  sums_->bindStorage(kDoubtSumsBuffer);
  groups_->set("doubtCapacity", capacity_);
  groups_->dispatch({1, 1}, {1, 1});
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void DoubtfulRays::dispatch() const {
  program_->use();
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_->id());
  glDispatchComputeIndirect(static_cast<GLintptr>(offsetof(DoubtListHeader, groupsX)));
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void DoubtfulRays::addSums(frame::Frame& frame, const gl::Texture& picture) const {
  adding_->set("sizePx", frame.sizePx());
  adding_->set("rayCount", static_cast<int>(raysPerPx_));
  picture.bindImage(kFieldOutImage, gl::Access::ReadWrite);
  adding_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

std::vector<Counter> DoubtfulRays::count() const {
  if (!traced()) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const auto header = list_->read<DoubtListHeader>(0, 1)[0];
  return {{"doubtful_ray_share", header.found / allRays_}, {"doubtful_overflow", double(header.overflow)}};
}

std::vector<std::string> DoubtfulRays::remarks() const {
  if (!list_) return {};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const uint32_t most = list_->read<DoubtListHeader>(0, 1)[0].most;
  if (most <= capacity_) return {};
  return {fmt::format(
      "more rays were in doubt than the list of 'near: doubtful' takes, {:.4f} of all in one frame: where "
      "that "
      "was so none was traced, and the picture is that of 'near: field'; give a 'capacity' above it",
      most / allRays_)};
}

std::vector<Quantity> DoubtfulRays::quantities() {
  return {
      {"doubtful_ray_share", "Rays of the picture about which fields are in doubt, and which are traced", "",
       Direction::LowerIsBetter, "bench"},
      {"doubtful_overflow", "1: there were more doubtful rays than the list takes, so that none was traced",
       "", Direction::LowerIsBetter, "bench"}};
}

}  // namespace limen::techniques
