// SPDX-License-Identifier: BSD-3-Clause
#include "perception/threshold_maps/threshold_map_gpu.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "perception/threshold_maps/model.h"
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/threshold_tables.h"

namespace limen::perception {
namespace {

using gl::Access;
using gl::Format;
using Settings = ThresholdMapSettings;

constexpr glm::ivec2 kTilePx{64, 32};
/// Invocations of a group that computes a tile; on an H200 faster than smaller groups, whose tiles overlap
/// more.
constexpr int kInvocations = 512;
/// Levels up to this size are computed several at a time: starting a pass costs about 2 us, computing twice
/// the necessary samples costs less.
constexpr int64_t kSmallLevelPx = 600'000;
constexpr int kMostSteps = 3;
constexpr float kLargestHalfCdM2 = 6e4F;
constexpr std::array<int, 8> kMostColumns{LIMEN_MOST_SAMPLE_COLUMNS};
constexpr std::array<int, 8> kMostRows{LIMEN_MOST_SAMPLE_ROWS};

constexpr std::array<const char*, kMostSteps> kDownwardNames{"downward[0]", "downward[1]", "downward[2]"};

glm::ivec2 halvedSize(glm::ivec2 size) { return {halved(size.x), halved(size.y)}; }

bool isEven(glm::ivec2 size) { return size.x % 2 == 0 && size.y % 2 == 0; }

void refuse(bool wrong, const char* what, const char* where, const char* hint) {
  if (wrong) throw Error(what, where, hint);
}

void checkSettings(const Settings& settings, const ThresholdMapGpuSettings& gpu) {
  refuse(settings.isTrueStack(), "a true stack is not computed on the GPU", "decomposition",
         "use stack or pyramid, or the technique perception/threshold_map_reference");
  refuse(std::holds_alternative<RepeatedStack>(settings.decomposition),
         "the mistaken stack is not computed on the GPU", "decomposition",
         "use stack or pyramid, or the technique perception/threshold_map_reference");
  refuse(std::holds_alternative<MistakenDegreeAdaptation>(settings.adaptation),
         "the mistaken mean is not computed on the GPU", "adaptation",
         "use one_degree, or the technique perception/threshold_map_reference");
  refuse(settings.expands(), "levels are upsampled bilinearly on the GPU", "decomposition.upsampler",
         "use bilinear, or the technique perception/threshold_map_reference");
  refuse(gpu.direct() && (settings.csf != "barten89" || settings.tvi != "ward"),
         "only csf: barten89 and tvi: ward are computed directly", "lookup",
         "use lookup: tables, or model: schwarz_2009");
  refuse(settings.nineFetch() && settings.border != Border::Clamp,
         "bilinear fetches do not support a mirrored border", "border",
         "use border: clamp or downsample: binomial");
}

/// Model number in the shader and its constants.
std::pair<int, glm::vec4> maskingConstants(const std::string& name) {
  const DalyMasking daly;
  const LubinMasking lubin;
  if (name == "daly") return {1, {std::log2(daly.k1) + daly.s * std::log2(daly.k2), daly.s, daly.b, 0.0}};
  if (name == "schwarz") return {1, {0.0, SchwarzMasking{}.s, SchwarzMasking{}.b, 0.0}};
  if (name == "lubin") return {2, {lubin.n, lubin.w, 0.0, 0.0}};
  if (name == "self") return {3, {1.0 - SelfMasking{}.alpha, 0.0, 0.0, 0.0}};
  refuse(name != "none", "this masking model has no GPU version", "masking", "use another one");
  return {0, glm::vec4(0.0F)};
}

ThresholdRun runBlock(const Settings& settings, const ThresholdMapGpuSettings& gpu,
                      const ThresholdModel& model, const DisplayProfile& display) {
  ThresholdRun block{};
  const Kernel kernel = settings.kernel();
  block.kernel = {kernel.taps[0], kernel.taps[1], kernel.taps[2], 0.0};
  const double largest =
      gpu.half() ? std::min<double>(settings.largestCdM2, kLargestHalfCdM2) : settings.largestCdM2;
  block.light = {display.blackLevelCdM2(), display.whiteLevelCdM2() - display.blackLevelCdM2(), largest,
                 settings.contrastEpsilonCdM2};
  const auto* smooth = std::get_if<SmoothFlat>(&settings.flat);
  block.rule = {model.adaptation().next, smooth ? smooth->epsilon : 0.0, settings.tviFactor, 0.0};
  block.masking = maskingConstants(settings.masking).second;
  for (int band = 0; band < model.bands(); ++band) {
    const BandPeak& peak = model.peaks()[static_cast<size_t>(band)];
    // F at two luminances tells whether it varies.
    const double dim = model.frequencyElevation(band, 0.01), bright = model.frequencyElevation(band, 300.0);
    block.bands[band] = {peak.frequencyCpd(display.pixelsPerDegree()), 1.0 / peak.gain,
                         dim == bright ? dim : 0.0, 0.0};
  }
  return block;
}

const char* yes(bool value) { return value ? "1" : "0"; }

}  // namespace

struct ThresholdMapGpu::Programs {
  const gl::Program* first = nullptr;                           ///< level 0 to level 1, or luminance
  const gl::Program* next = nullptr;                            ///< one level to the next
  const gl::Program *firstEven = nullptr, *nextEven = nullptr;  ///< where both sides are even
  const gl::Program* mean = nullptr;
  std::array<const gl::Program*, kMostSteps> many{};  ///< 1, 2, 3 levels at once
  const gl::Program* evaluate = nullptr;
};

ThresholdMapGpu::ThresholdMapGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                                 const Settings& settings, const ThresholdMapGpuSettings& gpu,
                                 bool colourInput)
    : context_(context),
      sizePx_(sizePx),
      settings_(settings),
      gpu_(gpu),
      colourInput_(colourInput),
      levels_(std::min(settings.levels, mostLevels(sizePx.x, sizePx.y))),
      threshold_(Format::R32F, sizePx),
      finest_(gpu.half() ? Format::R16F : Format::R32F, sizePx, 1, 0,
              settings.nineFetch() ? gl::Sampling::Linear : gl::Sampling::Nearest),
      tiles_((sizePx + kTilePx - 1) / kTilePx),
      programs_(std::make_unique<Programs>()) {
  checkSettings(settings, gpu);
  const ThresholdModel model(settings, display.pixelsPerDegree(), sizePx.x, sizePx.y);
  assert(levels_ == model.levels());
  if (levels_ > 1) {
    const glm::ivec2 half = halvedSize(sizePx);
    gaussian_.emplace(gpu.half() && settings.nineFetch() ? Format::R16F : Format::R32F, half, levels_ - 1, 0,
                      settings.nineFetch() ? gl::Sampling::Linear : gl::Sampling::Nearest);
    if (storesLuminance() && !settings.nineFetch()) rest_.emplace(Format::R16F, half);
    const bool direct = settings.isPyramid();
    std::vector<glm::vec4> taps = levelTaps(sizePx.x, levels_, direct);
    const std::vector<glm::vec4> rowTaps = levelTaps(sizePx.y, levels_, direct);
    std::vector<glm::ivec2> patches = tilePatches(taps, sizePx.x, kTilePx.x, levels_);
    const std::vector<glm::ivec2> rows = tilePatches(rowTaps, sizePx.y, kTilePx.y, levels_);
    taps.insert(taps.end(), rowTaps.begin(), rowTaps.end());
    taps_.emplace(taps);
    for (size_t i = 0; i < patches.size(); ++i)
      assert(patches[i].y <= kMostColumns[i % static_cast<size_t>(levels_ - 1)]);
    for (size_t i = 0; i < rows.size(); ++i)
      assert(rows[i].y <= kMostRows[i % static_cast<size_t>(levels_ - 1)]);
    patches.insert(patches.end(), rows.begin(), rows.end());
    patches_.emplace(patches);
    LevelPlaces places = levelPlaces(sizePx, levels_);
    places_.emplace(places.places);
    upward_ = std::move(places.upward);
    downward_ = std::move(places.downward);
  }
  const ThresholdRun block = runBlock(settings, gpu, model, display);
  run_.emplace(int64_t{sizeof block}, &block);
  tables_.emplace(thresholdTables(model));
  elevations_.emplace(elevationTable(model));

  const int maskingModel = maskingConstants(settings.masking).first;
  defines_ = {{"COLOUR", yes(colourInput)},
              {"MIRROR", yes(settings.border == Border::Mirror)},
              {"HALF", yes(gpu.half())},
              {"LEVELS", std::to_string(levels_)},
              {"BANDS", std::to_string(model.bands())},
              {"FINEST_LUMINANCE", yes(storesLuminance())},
              {"REST", yes(storesLuminance() && !settings.nineFetch())},
              {"MEAN_REMOVED", yes(gpu.half() && (settings.nineFetch() || levels_ == 1))},
              {"ADAPTATION_LEVEL", std::to_string(model.adaptation().level)},
              {"MASKING", std::to_string(gpu.direct() ? maskingModel : 0)},  // with tables, they contain it
              {"FOURTH_ROOT", yes(gpu.direct() && maskingModel == 1 && block.masking.z == 4.0F)},
              {"FLAT_SMOOTH", yes(std::holds_alternative<SmoothFlat>(settings.flat))},
              {"DIRECT", yes(gpu.direct())},
              {"KINK", yes(!gpu.direct() && model.hasCastleKink())},
              {"TILE_X", std::to_string(kTilePx.x)},
              {"TILE_Y", std::to_string(kTilePx.y)},
              {"THREADS", std::to_string(kInvocations)},
              {"STAGES", "0"}};
  const std::string folder = "perception/threshold_maps/";
  gl::ProgramCache& programs = context.programs();
  const auto make = [&](const std::string& file, std::vector<const char*> names, gl::ShaderDefines extra) {
    extra["TILE_X"] = std::to_string(kTilePx.x);
    extra["TILE_Y"] = std::to_string(kTilePx.y);
    extra["THREADS"] = std::to_string(kInvocations);
    for (const char* name : names) extra[name] = defines_.at(name);
    return &programs.compute(folder + file, extra);
  };
  if (settings.nineFetch() || levels_ == 1) {
    programs_->first = make("luminance.comp.glsl", {"COLOUR", "MIRROR", "HALF"}, {});
    if (levels_ > 1) programs_->next = make("nine_fetch.comp.glsl", {"COLOUR", "MIRROR", "HALF"}, {});
    if (gpu.half()) {
      programs_->mean = make("mean.comp.glsl", {"COLOUR", "MIRROR"}, {});
      mean_.emplace(std::vector<float>(4, 0.0F));
    }
  } else {
    programs_->first = make("reduce.comp.glsl", {"COLOUR", "MIRROR"},
                            {{"FROM_LEVEL", "0"}, {"BAND", gpu.half() ? "16" : "32"}});
    programs_->next = make("reduce.comp.glsl", {"COLOUR", "MIRROR"}, {{"FROM_LEVEL", "1"}, {"BAND", "0"}});
    if (gpu.finest == FinestStored::Luminance) {
      programs_->firstEven = make("reduce_even.comp.glsl", {"COLOUR", "MIRROR"}, {{"FROM_LEVEL", "0"}});
      programs_->nextEven = make("reduce_even.comp.glsl", {"COLOUR", "MIRROR"}, {{"FROM_LEVEL", "1"}});
    }
    for (int steps = 1; steps <= kMostSteps; ++steps)
      programs_->many[static_cast<size_t>(steps - 1)] =
          make("reduce_many.comp.glsl", {"COLOUR", "MIRROR"}, {{"STEPS", std::to_string(steps)}});
  }
  programs_->evaluate = &programs.compute(folder + "evaluate.comp.glsl", defines_);
}

ThresholdMapGpu::~ThresholdMapGpu() = default;

bool ThresholdMapGpu::storesLuminance() const {
  return settings_.nineFetch() ||
         (gpu_.finest == FinestStored::Luminance && !gpu_.half() && levels_ > 1 && isEven(sizePx_));
}

void ThresholdMapGpu::keepStages() {
  stages_.emplace(Format::RG32F, sizePx_);
  defines_["STAGES"] = "1";
  programs_->evaluate =
      &context_.programs().compute("perception/threshold_maps/evaluate.comp.glsl", defines_);
}

const gl::Texture& ThresholdMapGpu::run(const gl::Texture& input, gl::PassList* passes,
                                        const std::optional<MapArea>& only) {
  assert(input.sizePx() == sizePx_ && (gl::channelCount(input.format()) == 4) == colourInput_);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  run_->bindUniform(kThresholdRunBlock);
  tables_->bindStorage(kThresholdTablesBuffer);
  elevations_->bindStorage(kThresholdElevationsBuffer);
  if (patches_) {
    patches_->bindStorage(kEvaluatePatchesBuffer);
    places_->bindStorage(kThresholdPlacesBuffer);
    taps_->bindStorage(kEvaluateTapsBuffer);
  }
  const auto timed = [&](const char* name, const auto& work) {
    if (!passes) return work();
    const gl::PassList::Scope scope = passes->open(name);
    work();
  };
  timed(kThresholdLevelsPass,
        [&] { settings_.nineFetch() || levels_ == 1 ? reduceNineFetch(input) : reduce(input); });
  timed(kThresholdEvaluationPass, [&] { evaluate(only.value_or(MapArea{glm::ivec2(0), sizePx_})); });
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT);
  return threshold_;
}

void ThresholdMapGpu::reduce(const gl::Texture& input) {
  input.bindTexture(kCoarsenSourceUnit);
  finest_.bindImage(kCoarsenBandImage, Access::Write);
  gaussian_->bindImage(kCoarsenCoarserImage, Access::Write, 0);
  // Programs of one step take one pair of levels, those of several steps what is downward of each.
  const auto setPlaces = [&](const gl::Program& program, size_t level, int steps) {
    program.set("upward[0]", upward_[level]);
    for (size_t step = 0; step < static_cast<size_t>(steps); ++step)
      program.set(kDownwardNames.at(step), downward_[level + step]);
  };
  if (storesLuminance()) {
    rest_->bindImage(kCoarsenRestImage, Access::Write);
    programs_->firstEven->dispatch(sizePx_, kTilePx);
  } else {
    setPlaces(*programs_->first, 0, 1);
    programs_->first->dispatch(sizePx_, kTilePx);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  gaussian_->bindTexture(kCoarsenSourceUnit);
  glm::ivec2 size = halvedSize(sizePx_);
  for (int level = 1; level + 1 < levels_;) {
    const bool small = int64_t{size.x} * size.y <= kSmallLevelPx;
    const auto* given = std::get_if<GivenLevels>(&gpu_.levelsPerPass);
    const int wanted = given ? given->count : small ? kMostSteps : 1;
    const int steps = std::min(levels_ - 1 - level, wanted);
    static_assert(kCoarsenManyCoarser2Image == kCoarsenCoarserImage + 1 &&
                  kCoarsenManyCoarser3Image == kCoarsenCoarserImage + 2);
    for (int step = 0; step < steps; ++step)
      gaussian_->bindImage(kCoarsenCoarserImage + static_cast<uint32_t>(step), Access::Write, level + step);
    const bool even = gpu_.finest == FinestStored::Luminance && wanted == 1 && isEven(size);
    const gl::Program& program = wanted > 1 ? *programs_->many[static_cast<size_t>(steps - 1)]
                                 : even     ? *programs_->nextEven
                                            : *programs_->next;
    program.set("sourceLevel", level - 1);
    if (!even) setPlaces(program, static_cast<size_t>(level), steps);
    program.dispatch(size, kTilePx);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    for (int step = 0; step < steps; ++step) size = halvedSize(size);
    level += steps;
  }
}

void ThresholdMapGpu::reduceNineFetch(const gl::Texture& input) {
  constexpr glm::ivec2 kGroup(kThresholdGroupSide);
  input.bindTexture(kLuminanceSourceUnit);
  if (mean_) {
    mean_->bindStorage(kThresholdMeanBuffer);
    programs_->mean->dispatch({1, 1}, {1, 1});
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  finest_.bindImage(kLuminanceImage, Access::Write);
  programs_->first->dispatch(sizePx_, kGroup);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glm::ivec2 size = sizePx_;
  for (int level = 0; level + 1 < levels_; ++level) {
    (level == 0 ? finest_ : *gaussian_).bindTexture(kNineFetchSourceUnit);
    gaussian_->bindImage(kNineFetchCoarserImage, Access::Write, level);
    size = halvedSize(size);
    programs_->next->set("sourceLevel", std::max(level - 1, 0));
    programs_->next->dispatch(size, kGroup);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }
}

void ThresholdMapGpu::evaluate(const MapArea& area) {
  finest_.bindTexture(kEvaluateFinestUnit);
  if (gaussian_) gaussian_->bindTexture(kEvaluateGaussianUnit);
  if (rest_) rest_->bindTexture(kEvaluateRestUnit);
  threshold_.bindImage(kEvaluateImage, Access::Write);
  if (stages_) stages_->bindImage(kEvaluateStagesImage, Access::Write);
  programs_->evaluate->set("tileColumns", tiles_.x);
  const glm::ivec2 firstTile = area.low / kTilePx;
  programs_->evaluate->set("firstTile", firstTile);
  programs_->evaluate->dispatch(glm::min(area.high, sizePx_) - firstTile * kTilePx, kTilePx);
}

std::map<std::string, const gl::Texture*> ThresholdMapGpu::debugViews() const {
  std::map<std::string, const gl::Texture*> out;
  out[storesLuminance() || levels_ == 1 ? "luminance" : "band_0"] = &finest_;
  if (gaussian_) out["gaussian"] = &*gaussian_;
  if (stages_) out["stages"] = &*stages_;
  return out;
}

int64_t ThresholdMapGpu::bytesHeld() const {
  int64_t bytes =
      threshold_.bytes() + finest_.bytes() + run_->bytes() + tables_->bytes() + elevations_->bytes();
  for (const auto* texture : {&gaussian_, &rest_, &stages_})
    if (*texture) bytes += (*texture)->bytes();
  return bytes + (patches_ ? patches_->bytes() + places_->bytes() + taps_->bytes() : 0);
}

int64_t ThresholdMapGpu::bytesMoved(const gl::Texture& input) const {
  // The input and the map once; intermediate results are written and read again: levels by the next one and
  // by the evaluation.
  int64_t bytes = input.bytes() + threshold_.bytes() + 2 * finest_.bytes();
  if (settings_.nineFetch()) bytes += finest_.bytes();
  if (gaussian_) bytes += 3 * gaussian_->bytes();
  if (rest_) bytes += 2 * rest_->bytes();
  return bytes;
}

}  // namespace limen::perception
