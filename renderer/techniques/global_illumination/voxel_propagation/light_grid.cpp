// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/voxel_propagation/light_grid.h"

#include <epoxy/gl.h>

#include <cmath>
#include <string>

#include "experiments/base/error.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/light_box.h"
#include "renderer/techniques/global_illumination/surface_light.h"
#include "renderer/techniques/global_illumination/voxel_dispatch.h"
#include "renderer/techniques/global_illumination/voxel_propagation/lobe_shares.h"
#include "renderer/techniques/global_illumination/voxel_propagation/surface_samples.h"

namespace limen::techniques {
namespace {

constexpr const char* kVoxelizePass = "global_illumination/voxelize";
constexpr const char* kInjectPass = "global_illumination/inject";
constexpr const char* kPropagatePass = "global_illumination/propagate";
constexpr const char* kArrivePass = "global_illumination/arrive";

voxels::VoxelGrid gridOf(const frame::Frame& frame, const LightGridSettings& settings) {
  if (const auto* box = std::get_if<BoxAroundCamera>(&settings.box)) {
    voxels::VoxelGrid grid;
    grid.voxelSize = box->side / settings.resolution;
    grid.resolution = glm::ivec3(settings.resolution);
    return grid;
  }
  voxels::VoxelGrid grid = lightBox(frame.scene(), settings.resolution);
  // The first of them is there: the middles of the outermost voxels are just beyond the scene.
  const int further = std::max(std::get<BoxOfScene>(settings.box).margin - 1, 0);
  grid.origin -= further * grid.voxelSize;
  grid.resolution += 2 * further;
  return grid;
}

}  // namespace

LightGrid::LightGrid(frame::Frame& frame, const LightGridSettings& settings,
                     const frame::SurfaceLightSettings& lighting)
    : settings_(settings),
      lighting_(lighting),
      bounds_(frame.scene().bounds()),
      rays_(frame),
      counts_(sizeof(InjectCounts), nullptr),
      layerSums_(4, nullptr),
      changes_(int64_t{4} * std::max(settings.iterations, 1), nullptr) {
  gl::Context& context = frame.context();
  volume_.emplace(context, gridOf(frame, settings), frame.gpuScene().anchor(),
                  voxels::VolumeAttributes{true, true, gl::Format::RGBA16F});
  voxelizer_.emplace(frame, settings.coverage, *volume_);
  programs_.emplace(frame, settings, lighting, *volume_);
  const voxels::VoxelGrid& grid = volume_->grid();
  const glm::ivec3 size = grid.resolution;
  const double h = grid.voxelSize;
  const SampleTexture samples = sampleTexture(frame.scene(), h / settings.injection.samplesAside, h * h);
  sampleCount_ = samples.count;
  samples_.emplace(gl::Format::RGBA32UI, samples.sizePx);
  samples_->writeUint(samples.texels);
  const int sets = std::holds_alternative<UpdateAxes>(settings.update) ? 3 : 1;
  sums_.emplace(gl::Format::R32UI, glm::ivec2(size), 1, 12 * size.z * sets);
  for (int set = 0; set < sets; ++set) sumsOfAxis_.push_back(sums_->view(12 * size.z * set, 12 * size.z));
  const gl::Format format = settings.format == FieldFormat::Half ? gl::Format::RGBA16F : gl::Format::RGBA32F;
  source_.emplace(format, glm::ivec2(size), 1, 3 * size.z);
  pairs_ = settings.goesOn() ? settings.generations() : 1;
  fields_.emplace(format, glm::ivec2(size), 1, 6 * size.z * pairs_);
  if (settings.generations() > 1) reflected_.emplace(gl::Format::RGBA32F, glm::ivec2(size), 1, 3 * size.z);
  layerSums_ = gl::Buffer(int64_t{4} * 3 * size.z, nullptr);
  lightCells_.emplace(gl::Format::R32UI, glm::ivec2(size), 1, size.z);
  const bool summed = settings.sumsArrivals();
  arrived_.emplace(summed ? gl::Format::RGBA32F : format, glm::ivec2(size), 1, 6 * size.z);
  arrived_->clear(glm::vec4(0.0F));
  if (std::holds_alternative<MomentTransport>(settings.transport)) {
    static const std::vector<float> kTable = shareTable();
    const glm::ivec3 sides(kShareSide, kShareSide, kShareLevels * 6);
    if (settings.format == FieldFormat::Half)
      shares_.emplace(gl::VolumeTexture::ofSignedShares(sides));
    else
      shares_.emplace(gl::Format::RGBA32F, sides, 1);
    shares_->write(kTable);
  }
  tryStepsAtOnce(frame);
  frame.passes().setBytesHeld(kVoxelizePass, volume_->bytes() + lightCells_->bytes());
  frame.passes().setBytesHeld(kInjectPass,
                              samples_->bytes() + sums_->bytes() + source_->bytes() + counts_.bytes());
  frame.passes().setBytesHeld(kPropagatePass, fields_->bytes() + (reflected_ ? reflected_->bytes() : 0) +
                                                  (shares_ ? shares_->bytes() : 0) +
                                                  (settings_.steps.stopBelow > 0.0 ? changes_.bytes() : 0) +
                                                  (resident_ ? resident_->bytes() : 0));
  frame.passes().setBytesHeld(kArrivePass, arrived_->bytes());
}

void LightGrid::tryStepsAtOnce(frame::Frame& frame) {
  const bool needed = std::holds_alternative<OneDispatch>(settings_.steps.dispatch);
  if (std::holds_alternative<DispatchEach>(settings_.steps.dispatch) || settings_.iterations < 1 ||
      settings_.steps.stopBelow > 0.0 || settings_.steps.sources == LightSources::Once)
    return;
  const bool software = frame.context().device().software;
  const glm::ivec3 size = volume_->grid().resolution;
  const ResidentSteps::Form form = ResidentSteps::formOf(settings_.format, size, software);
  const glm::ivec3 groups = form.groups(size);
  const std::string what = std::to_string(groups.x * groups.y * groups.z) + " groups";
  std::string reason;
  if (software && !needed && groups != glm::ivec3(1)) {
    // Where it has the threads, they take turns on few processors.
    reason = "a software renderer runs " + what + " at a time on request alone (dispatch: once)";
  } else {
    residentProgram_ = &programs_->residentSteps(frame, form);
    resident_.emplace(*residentProgram_, form, size);
    lightCells_->clearUint(glm::uvec4(0));
    fields_->clear(glm::vec4(0.0F));
    source_->clear(glm::vec4(0.0F));
    restartSteps(true, *source_);
    if (!resident_->works()) {
      resident_.reset();
      residentProgram_ = nullptr;
      reason = "the device did not run " + what + " at a time when they were tried";
    }
  }
  if (resident_) programs_->arrive = &programs_->arriveAfterResident(frame);
  if (needed && !resident_)
    throw Error("cannot do all steps of light in one dispatch: " + reason + "; use dispatch: fitting");
  stepsRemark_ = resident_
                     ? "Steps of light are one dispatch of " + what + ", which were tried on this device."
                     : "Steps of light are one dispatch each: " + reason + ".";
}

void LightGrid::checkSteps() const {
  if (resident_ && resident_->stuck())
    throw Error(
        "groups of a dispatch waited for each other in vain, so that light is missing: another program may "
        "have used the GPU; run it again, or with steps: {dispatch: each}");
}

void LightGrid::update(frame::Frame& frame) {
  const int64_t number = frames_++;
  rays_.build(frame);
  const bool anew = std::holds_alternative<UpdateAll>(settings_.update) ||
                    std::holds_alternative<UpdateEvery>(settings_.update);
  if (const auto* every = std::get_if<UpdateEvery>(&settings_.update); every && number % every->frames != 0)
    return;
  const bool moved = place(frame);
  const bool restarts = anew || moved || number == 0;
  pair_ = 0;
  voxelize(frame);
  {
    const auto scope = frame.passes().open(kInjectPass);
    inject(frame, restarts ? -1 : static_cast<int>(number % 3), restarts);
  }
  const auto scope = frame.passes().open(kPropagatePass);
  const int generations = settings_.generations(), start = from_;
  const bool apart = pairs_ > 1, lasting = settings_.steps.sources == LightSources::Steady;
  for (int generation = 0; generation < generations; ++generation) {
    const bool more = generation + 1 < generations;
    restartSteps(lasting, generation == 0 ? *source_ : *reflected_);
    spread(generation == 0, more);
    if (!more) break;
    // Where each bounce has fields of its own, light in them goes on from frame to frame.
    const int nextPair = apart ? generation + 1 : 0, nextFrom = apart ? start : 1 - from_;
    reflect(lasting, lasting, restarts || !apart, 2 * nextPair + nextFrom);
    pair_ = nextPair, from_ = nextFrom;
  }
}

void LightGrid::spread(bool first, bool reflects) {
  const bool lasting = settings_.steps.sources == LightSources::Steady;
  if (resident_) {
    resident_->run(reading(), writing(), settings_.iterations);
    from_ = 1 - from_;
  } else {
    for (int step = 0; step < settings_.iterations; ++step) {
      if (!lasting) {
        arrive(first && step == 0);
        if (reflects) reflect(true, step == 0, false, 0);
      }
      propagate();
    }
  }
  if (lasting || settings_.iterations == 0) arrive(first);
}

void LightGrid::reflect(bool adds, bool first, bool seeds, int to) {
  const gl::Program& program = *programs_->reflect;
  program.set("from", reading());
  program.set("to", to);
  program.set("adds", adds ? 1 : 0);
  program.set("first", first ? 1 : 0);
  program.set("seeds", seeds ? 1 : 0);
  reflected_->bindImage(kReflectedImage, gl::Access::ReadWrite);
  program.use();
  const glm::ivec3 size = volume_->grid().resolution;
  dispatchVoxels({size.x, size.y, 3 * size.z});
}

void LightGrid::start(frame::Frame& frame) {
  rays_.build(frame);
  place(frame);
  voxelize(frame);
  inject(frame, -1, true);
  restartSteps(false, *source_);
}

bool LightGrid::place(const frame::Frame& frame) {
  const auto* box = std::get_if<BoxAroundCamera>(&settings_.box);
  if (!box) return false;
  const voxels::VoxelGrid& grid = volume_->grid();
  const glm::dvec3 corner =
      grid.voxelSize * glm::round(frame.camera().eye / grid.voxelSize - 0.5 * settings_.resolution);
  if (corner == grid.origin) return false;
  volume_->moveTo(corner);
  return true;
}

void LightGrid::configureBounds(const gl::Program& program) const {
  volume_->configure(program);
  const auto* box = std::get_if<BoxOfScene>(&settings_.box);
  program.set("margin", box ? static_cast<float>(box->margin) : 0.0F);
  program.set("boundsLow", glm::vec3(volume_->grid().toVoxels(bounds_.low)));
  program.set("boundsHigh", glm::vec3(volume_->grid().toVoxels(bounds_.high)));
}

void LightGrid::voxelize(frame::Frame& frame) {
  const auto scope = frame.passes().open(kVoxelizePass);
  voxelizer_->run(frame, *volume_);
  configureBounds(*programs_->cells);
  lightCells_->bindImage(kLightCellsImage, gl::Access::Write);
  programs_->cells->use();
  dispatchVoxels(volume_->grid().resolution);
}

void LightGrid::inject(frame::Frame& frame, int axis, bool restart) {
  counts_.clearUint(0);
  configureSurfaceLight(*programs_->inject, frame, lighting_, rays_.tree());
  configureBounds(*programs_->inject);
  programs_->inject->set("sampleCount", sampleCount_);
  programs_->inject->set("shift", static_cast<float>(settings_.injection.shift));
  samples_->bindTexture(kInjectSamplesUnit);
  counts_.bindStorage(kInjectCountsBuffer);
  const bool byAxis = sumsOfAxis_.size() > 1;
  for (int set = 0; set < static_cast<int>(sumsOfAxis_.size()); ++set) {
    if (byAxis && axis >= 0 && set != axis) continue;
    sumsOfAxis_[size_t(set)].clearUint(glm::uvec4(0));
    sumsOfAxis_[size_t(set)].bindImage(kInjectSumsImage, gl::Access::ReadWrite);
    programs_->inject->set("onlyAxis", byAxis ? set : -1);
    programs_->inject->dispatch(samples_->sizePx());
  }
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  volume_->configure(*programs_->seed);
  programs_->seed->set("sumSets", static_cast<int>(sumsOfAxis_.size()));
  sums_->bindImage(kInjectSumsImage, gl::Access::Read);
  source_->bindImage(kPropagateOutImage, gl::Access::Write);
  fields_->bindImage(kSeedFieldImage, gl::Access::Write);
  if (restart) pair_ = from_ = 0;
  programs_->seed->set("restart", restart ? 1 : 0);
  programs_->seed->use();
  const glm::ivec3 size = volume_->grid().resolution;
  dispatchVoxels({size.x, size.y, 3 * size.z});
}

void LightGrid::restartSteps(bool lasting, const gl::Texture& source) {
  step_ = 0;
  if (settings_.steps.stopBelow > 0.0) {
    changes_.clearUint(0);
    programs_->propagate->set("stopBelow", static_cast<float>(settings_.steps.stopBelow));
  }
  for (const gl::Program* program :
       {programs_->arrive, programs_->propagate, programs_->reflect, residentProgram_}) {
    if (!program) continue;
    volume_->configure(*program);
    programs_->setTransport(*program);
    program->set("from", reading());
    program->set("lasting", lasting ? 1 : 0);
  }
  if (shares_) shares_->bindTexture(kShareTableUnit);
  lightCells_->bindTexture(kLightCellsUnit);
  fields_->bindTexture(kPropagateFieldUnit);
  source.bindTexture(kPropagateSourceUnit);
  fields_->bindImage(kPropagateOutImage, gl::Access::Write);
  arrived_->bindImage(kArriveFacesImage, gl::Access::ReadWrite);
}

void LightGrid::propagate() {
  if (settings_.steps.stopBelow > 0.0) {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    changes_.bindStorage(kPropagateChangesBuffer);
    programs_->propagate->set("step_", step_);
  }
  programs_->propagate->set("from", reading());
  programs_->propagate->set("to", writing());
  programs_->propagate->use();
  const glm::ivec3 size = volume_->grid().resolution;
  dispatchVoxels({size.x, size.y, 3 * size.z});
  from_ = 1 - from_;
  ++step_;
}

void LightGrid::arrive(bool first) {
  if (resident_) resident_->stuckBuffer().bindStorage(kStepStuckBuffer);
  programs_->arrive->set("from", reading());
  programs_->arrive->set("first", first ? 1 : 0);
  programs_->arrive->use();
  const glm::ivec3 size = volume_->grid().resolution;
  dispatchVoxels({size.x, size.y, 6 * size.z});
}

Image LightGrid::fieldLayer(int channel, int z) const {
  return fields_->readLayer((3 * reading() + channel) * volume_->grid().resolution.z + z);
}

glm::dvec3 LightGrid::flux() const {
  const int depth = volume_->grid().resolution.z;
  fields_->bindTexture(kPropagateFieldUnit);
  layerSums_.bindStorage(kLightFluxBuffer);
  programs_->flux->set("firstLayer", 3 * reading() * depth);
  programs_->flux->use();
  glDispatchCompute(static_cast<GLuint>(3 * depth), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  const std::vector<float> sums = layerSums_.read<float>();
  const double h = volume_->grid().voxelSize;
  glm::dvec3 out(0.0);
  for (int layer = 0; layer < 3 * depth; ++layer) out[layer / depth] += h * h * double(sums[size_t(layer)]);
  return out;
}

uint32_t LightGrid::homeless() const {
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  return counts_.read<InjectCounts>()[0].homeless;
}

}  // namespace limen::techniques
