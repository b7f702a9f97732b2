// SPDX-License-Identifier: BSD-3-Clause
#include "perception/command/video_difference.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/color_video_vdp/color_video_vdp_gpu.h"
#include "perception/metrics/color_video_vdp/reference.h"
#include "renderer/gl/context.h"

namespace limen::perception {

struct VideoDifference::Settings {
  std::string display;
  FilePath displayFile, colourSpaceFile;
  cvvdp::TemporalPadding padding = cvvdp::TemporalPadding::Replicate;
  bool referenceBorders = true;

  static const SettingsTable<Settings>& table() {
    static const SettingsTable<Settings> kTable = {
        {&Settings::display, "display",
         "display of ColorVideoVDP (standard_4k, standard_fhd, standard_hdr_pq, ...) or of Limen"},
        {&Settings::displayFile, "display_file", FileIs::Optional,
         "file of displays in the form of ColorVideoVDP's display_models.json; display is a name in it"},
        {&Settings::colourSpaceFile, "colour_space_file", FileIs::Optional,
         "file of colour spaces in the form of ColorVideoVDP's color_spaces.json"},
        {&Settings::padding, "padding",
         "what was seen before the first frame of a video: it, or the video backwards"},
        {&Settings::referenceBorders, "reference_borders",
         "borders of the pyramid as in the authors' program, which is off where one side is odd and the "
         "other even"}};
    return kTable;
  }
};

/// The context and what is held in it.
struct VideoDifference::Gpu {
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<cvvdp::ColorVideoVdpGpu> metric;
  cvvdp::Values values = cvvdp::Values::Coded;
  bool map = false;
};

namespace {

/// Pooled differences by band and channel, before all weights; over frames the root of their mean square.
nlohmann::json bandsAsJson(const cvvdp::Score& score) {
  nlohmann::json out = nlohmann::json::array();
  for (size_t band = 0; band < score.frequenciesCpd.size(); ++band) {
    nlohmann::json row = {{"frequency_cpd", score.frequenciesCpd[band]}};
    for (size_t c = 0; c < (score.video ? cvvdp::kChannels : cvvdp::kChannels - 1); ++c) {
      double sum = 0.0;
      for (const cvvdp::FrameDifferences& frame : score.frames) sum += frame[band][c] * frame[band][c];
      row[cvvdp::kChannelNames[c]] = std::sqrt(sum / static_cast<double>(score.frames.size()));
    }
    out.push_back(row);
  }
  return out;
}

}  // namespace

SettingsGroup VideoDifference::settings(const std::string& displayName) {
  SettingsGroup out{kName, Settings::table().parameters()};
  for (Parameter& parameter : out.parameters)
    if (parameter.name == "display") {
      parameter.defaultValue = displayName;
      parameter.description += " (default: that of --display)";
    }
  return out;
}

VideoDifference::VideoDifference(const ParameterValues& settings, const std::string& displayName,
                                 size_t frames, double framesPerSecond)
    : settings_(std::make_unique<Settings>(Settings::table().read(settings))),
      frames_(frames),
      framesPerSecond_(framesPerSecond) {
  if (settings_->display.empty()) settings_->display = displayName;
  facts_ = {{"frames_per_second", isVideo() ? nlohmann::json(framesPerSecond_) : nlohmann::json()}};
  try {
    gpu_ = std::make_unique<Gpu>();
    gpu_->context = gl::createHeadlessContext();
  } catch (const std::exception& error) {
    gpu_.reset();
    noGpu_ = std::string("no OpenGL context: ") + error.what();
  }
}

VideoDifference::~VideoDifference() = default;

Figures VideoDifference::declared(bool video) {
  Figures out = {{kName, "JOD", "ColorVideoVDP: 10 for no visible difference", true, {}, {}}};
  if (video) out.push_back({kVideoName, "JOD", "ColorVideoVDP of all frames as a video", true, {}, {}});
  return out;
}

Figures VideoDifference::add(const InputImage& test, const InputImage& reference,
                             std::vector<MetricMap>* maps) {
  Figures out = declared(false);
  cvvdp::Options options;
  options.display =
      cvvdp::readDisplay(settings_->display, {settings_->displayFile.path, settings_->colourSpaceFile.path});
  const bool coded =
      test.coded && reference.coded && !test.values.data.empty() && !reference.values.data.empty();
  options.values = coded ? cvvdp::Values::Coded : cvvdp::Values::Relative;
  options.framesPerSecond = framesPerSecond_;
  options.padding = settings_->padding;
  options.referenceBorders = settings_->referenceBorders;
  options.map = maps != nullptr;
  const Image& testImage = coded ? test.values : test.linear;
  const Image& referenceImage = coded ? reference.values : reference.linear;
  const glm::ivec2 sizePx(testImage.width, testImage.height);
  facts_["display"] = options.display.line();
  if (!gpu_) {
    if (isVideo()) {
      out[0].reason = noGpu_;
      return out;
    }
    const cvvdp::ReferenceResult found = cvvdp::evaluate(
        {sizePx.x, sizePx.y, 1, [&](int) { return testImage; }, [&](int) { return referenceImage; }},
        options);
    out[0].value = found.score.jod;
    if (maps) {
      Image map(sizePx.x, sizePx.y, 1);
      for (size_t i = 0; i < map.data.size(); ++i) map.data[i] = static_cast<float>(found.maps[0].data[i]);
      maps->push_back({kName, std::move(map)});
    }
    return out;
  }
  if (gpu_->metric && isVideo() && (gpu_->metric->sizePx() != sizePx || gpu_->values != options.values))
    throw Error("the frames of a video differ in size, or in being light or pixel values", "compare",
                "give frames of one size and kind");
  if (!gpu_->metric || gpu_->metric->sizePx() != sizePx || gpu_->values != options.values ||
      gpu_->map != options.map) {
    gpu_->metric = std::make_unique<cvvdp::ColorVideoVdpGpu>(*gpu_->context, sizePx, options, isVideo());
    gpu_->metric->begin(static_cast<int>(frames_));
    gpu_->values = options.values, gpu_->map = options.map;
    facts_["opengl"] = gpu_->context->device().line();
  }
  if (!isVideo()) gpu_->metric->begin();
  const size_t before = gpu_->metric->frames().size();
  gpu_->metric->add(cvvdp::uploadFrame(testImage), cvvdp::uploadFrame(referenceImage));
  const std::vector<cvvdp::FrameDifferences>& done = gpu_->metric->frames();
  if (done.size() == before + 1) {
    out[0].value = cvvdp::jodOf(cvvdp::frameDifference(done.back(), isVideo()));
    if (maps) maps->push_back({kName, gpu_->metric->readMap()});
    if (!isVideo()) facts_["bands"] = bandsAsJson(gpu_->metric->finish());
  } else {
    out[0].reason = "with symmetric padding the first frames are evaluated together";
  }
  return out;
}

Figures VideoDifference::finish() {
  if (!isVideo()) return {};
  Figures out = {declared(true).back()};
  if (!gpu_ || !gpu_->metric) {
    out[0].reason = noGpu_;
    return out;
  }
  const cvvdp::Score score = gpu_->metric->finish();
  out[0].value = score.jod;
  facts_["difference"] = score.difference;
  facts_["bands"] = bandsAsJson(score);
  return out;
}

std::string VideoDifference::sentence(const Figures& overall) const {
  if (overall.empty() || !overall.front().value) return "";
  return fmt::format(
      "As a video of {} frames at {:.6g} frames/s: {} JOD by ColorVideoVDP (10: no visible difference).",
      frames_, framesPerSecond_, numberText(*overall.front().value));
}

}  // namespace limen::perception
