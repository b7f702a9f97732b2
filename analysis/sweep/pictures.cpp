// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/hash.h"
#include "experiments/base/image.h"

namespace limen::analysis {
namespace {

namespace fs = std::filesystem;

constexpr int kWindowWidthPx = 192, kWindowHeightPx = 144;
constexpr int kStepPx = 16;       // the window is sought on this grid
constexpr size_t kMostRows = 72;  // about 10 MB of page
/// Artefacts in which a technique explains its product: "view_regions_png".
const std::string kViewPrefix = "view_";

struct Window {
  int x = 0, y = 0, width = 0, height = 0, fullWidth = 0, fullHeight = 0;
};

const store::Artefact* find(const store::Run& run, const std::string& kind) {
  for (const store::Artefact& artefact : run.artefacts)
    if (artefact.kind == kind) return &artefact;
  return nullptr;
}

// The map of the error that the charts show, else the plain error, else any other. A metric with several
// figures names its map: "jnd" of "jnd_p95".
const store::Artefact* findErrorMap(const store::Run& run, const std::string& metric) {
  for (std::string name = metric; !name.empty();
       name.resize(name.find('_') == std::string::npos ? 0 : name.rfind('_')))
    if (const store::Artefact* map = find(run, name + "_png")) return map;
  if (const store::Artefact* map = find(run, "error_png")) return map;
  for (const store::Artefact& artefact : run.artefacts)
    if (artefact.kind.ends_with("_png") && artefact.kind != "product_png" &&
        artefact.kind != "reference_png" && !artefact.kind.starts_with(kViewPrefix))
      return &artefact;
  return nullptr;
}

struct Chosen {
  size_t cell;
  std::string why;
};

std::vector<Chosen> chooseOf(const Sweep& sweep, std::vector<size_t> cells, size_t perSeries) {
  const bool higher = sweep.y.higherIsBetter();
  std::stable_sort(cells.begin(), cells.end(), [&](size_t a, size_t b) {
    const double ya = *sweep.cells[a].y, yb = *sweep.cells[b].y;
    return higher ? ya > yb : ya < yb;
  });
  const size_t n = cells.size();
  if (n == 1) return {{cells[0], "its only setting"}};
  const std::string of = fmt::format(" of {} settings", n);
  std::vector<Chosen> out{{cells[0], "lowest error" + of}};
  if (perSeries >= 3 && n >= 3) out.push_back({cells[n / 2], "middle error" + of});
  if (perSeries >= 2) out.push_back({cells[n - 1], "highest error" + of});
  return out;
}

// A run's pictures belong together if they show the same reference, or else the same panel.
std::string groupOf(const Cell& cell) {
  const store::Artefact* reference = find(cell.run, "reference_png");
  return reference != nullptr ? reference->sha256 : std::to_string(cell.panel);
}

class Cutter {
 public:
  Cutter(std::string storeFolder, std::string folder)
      : storeFolder_(std::move(storeFolder)), folder_(std::move(folder)) {}

  Image load(const store::Artefact& artefact) const {
    const fs::path path = artefact.path;
    for (const fs::path& part : path)
      if (part == ".." || path.is_absolute()) throw Error("leaves the store's folder", artefact.path);
    return readImage((fs::path(storeFolder_) / path).string());
  }

  // Adds |product - reference| of a run, block by block.
  void addDifference(const Cell& cell) {
    const store::Artefact* product = find(cell.run, "product_png");
    const store::Artefact* reference = find(cell.run, "reference_png");
    if (product == nullptr || reference == nullptr) return;
    try {
      const Image a = load(*product), b = load(*reference);
      if (a.width != b.width || a.height != b.height) return;
      Blocks& blocks = blocks_[groupOf(cell)];
      blocks.columns = (a.width + kStepPx - 1) / kStepPx;
      blocks.sums.resize(static_cast<size_t>(blocks.columns) * ((a.height + kStepPx - 1) / kStepPx));
      const int channels = std::min({a.channels, b.channels, 3});
      for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
          for (int c = 0; c < channels; ++c)
            blocks.sums[static_cast<size_t>(y / kStepPx) * blocks.columns + x / kStepPx] +=
                std::abs(a.at(x, y, c) - b.at(x, y, c));
    } catch (const Error&) {
      // The row says that the picture is missing.
    }
  }

  Window windowFor(const Cell& cell, int width, int height) const {
    Window window{0, 0, std::min(width, kWindowWidthPx), std::min(height, kWindowHeightPx), width, height};
    window.x = (width - window.width) / 2;
    window.y = (height - window.height) / 2;
    const auto found = blocks_.find(groupOf(cell));
    if (found == blocks_.end()) return window;
    double best = 0.0;
    for (int y = 0; y + window.height <= height; y += kStepPx)
      for (int x = 0; x + window.width <= width; x += kStepPx) {
        const double sum = found->second.sumOver(x, y, window);
        if (sum > best) {
          best = sum;
          window.x = x;
          window.y = y;
        }
      }
    return window;
  }

  Picture cut(const Image& image, const Window& window, const std::string& caption) const {
    if (image.width != window.fullWidth || image.height != window.fullHeight)
      throw Error(fmt::format("the {} has {}×{} pixels, the product {}×{}", caption, image.width,
                              image.height, window.fullWidth, window.fullHeight));
    Image part(window.width, window.height, image.channels);
    for (int y = 0; y < window.height; ++y)
      for (int x = 0; x < window.width; ++x)
        for (int c = 0; c < image.channels; ++c) part.at(x, y, c) = image.at(window.x + x, window.y + y, c);
    const std::string temporary = (fs::path(folder_) / "cut.png").string();
    writePng(temporary, part);
    const std::string bytes = readFileBytes(temporary);
    const std::string id = sha256(bytes).substr(0, 12);
    fs::rename(temporary, fs::path(folder_) / (id + ".png"));
    return {caption, "data:image/png;base64," + base64(bytes), "picture-" + id, ""};
  }

 private:
  struct Blocks {
    int columns = 0;
    std::vector<double> sums;
    double sumOver(int x, int y, const Window& window) const {
      double sum = 0.0;
      for (int row = y / kStepPx; row < (y + window.height) / kStepPx; ++row)
        for (int column = x / kStepPx; column < (x + window.width) / kStepPx; ++column)
          sum += sums[static_cast<size_t>(row) * columns + column];
      return sum;
    }
  };

  std::string storeFolder_, folder_;
  std::map<std::string, Blocks> blocks_;
};

/// What white stands for: "0.25 JND"; "" if the store names no scale.
std::string whiteOf(const store::Run& run, const std::string& kind) {
  for (const store::Measurement& measurement : run.measurements)
    if (measurement.name == kind + "_white" && measurement.value)
      return formatNumber(*measurement.value) + (measurement.unit.empty() ? "" : " ") + measurement.unit;
  return {};
}

PictureRow makeRow(const Sweep& sweep, const Chosen& chosen, const Cutter& cutter) {
  const Cell& cell = sweep.cells[chosen.cell];
  PictureRow row;
  row.cell = chosen.cell;
  row.chosen = chosen.why;
  const auto addNote = [&](const std::string& text) { row.note += (row.note.empty() ? "" : " ") + text; };
  try {
    const Image product = cutter.load(*find(cell.run, "product_png"));
    const Window window = cutter.windowFor(cell, product.width, product.height);
    row.width = window.width;
    row.height = window.height;
    row.window = window.width == window.fullWidth && window.height == window.fullHeight
                     ? fmt::format("All {}×{} pixels", window.width, window.height)
                     : fmt::format("{}×{} pixels from ({}, {}) of {}×{}", window.width, window.height,
                                   window.x, window.y, window.fullWidth, window.fullHeight);
    row.pictures.push_back(cutter.cut(product, window, "product"));
    if (const std::string white = whiteOf(cell.run, "product_png"); !white.empty())
      addNote("White in the product stands for " + white + ".");
    if (const store::Artefact* reference = find(cell.run, "reference_png"))
      row.pictures.push_back(cutter.cut(cutter.load(*reference), window, "reference"));
    if (const store::Artefact* map = findErrorMap(cell.run, sweep.y.name)) {
      row.pictures.push_back(cutter.cut(cutter.load(*map), window, "error map"));
      row.pictures.back().white = whiteOf(cell.run, map->kind);
      if (row.pictures.back().white.empty())
        addNote("The error map (" + map->kind +
                ") is shown as the sweep wrote it; the store names no scale for it.");
    }
    for (const store::Artefact& artefact : cell.run.artefacts)
      if (artefact.kind.starts_with(kViewPrefix) && artefact.kind.ends_with("_png")) {
        std::string title =
            artefact.kind.substr(kViewPrefix.size(), artefact.kind.size() - kViewPrefix.size() - 4);
        std::ranges::replace(title, '_', ' ');
        row.pictures.push_back(cutter.cut(cutter.load(artefact), window, title));
      }
  } catch (const Error& error) {
    addNote(std::string("A picture cannot be shown: ") + error.what() + ".");
  }
  return row;
}

}  // namespace

Pictures choosePictures(const Sweep& sweep, const std::string& storePath, const std::string& folder) {
  Pictures out;
  out.panels.resize(sweep.panels.size());
  std::map<std::pair<size_t, size_t>, std::vector<size_t>> groups;
  size_t withPictures = 0;
  for (size_t index = 0; index < sweep.cells.size(); ++index) {
    const Cell& cell = sweep.cells[index];
    if (!cell.y || find(cell.run, "product_png") == nullptr) continue;
    ++withPictures;
    groups[{cell.panel, cell.series}].push_back(index);
  }
  if (groups.empty()) return out;

  const size_t perSeries = std::clamp<size_t>(kMostRows / groups.size(), 1, 3);
  std::vector<Chosen> chosen;
  size_t shownGroups = 0;
  for (const auto& [place, cells] : groups) {
    if (++shownGroups > kMostRows) break;
    for (Chosen& one : chooseOf(sweep, cells, perSeries)) chosen.push_back(std::move(one));
  }
  fs::create_directories(folder);
  Cutter cutter(fs::absolute(storePath).parent_path().string(), folder);
  for (const Chosen& one : chosen) cutter.addDifference(sweep.cells[one.cell]);
  for (const Chosen& one : chosen)
    out.panels[sweep.cells[one.cell].panel].push_back(makeRow(sweep, one, cutter));
  out.note = fmt::format("{} of the {} runs with pictures are shown: for each {} {} in each panel. ",
                         chosen.size(), withPictures, sweep.seriesName,
                         perSeries == 1   ? "the setting with the lowest error"
                         : perSeries == 2 ? "the settings with the lowest and the highest error"
                                          : "the settings with the lowest, middle and highest error");
  if (groups.size() > kMostRows) out.note += "The page would grow too large with more panels. ";
  out.note +=
      "Each panel shows one window in every picture: where the shown products differ most from the "
      "reference.";
  return out;
}

}  // namespace limen::analysis
