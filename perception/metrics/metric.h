// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/base/image.h"
#include "experiments/base/parameter_list.h"
#include "experiments/base/quantity.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"

namespace limen::gl {
class Texture;
}

namespace limen::surfaces {
struct PatchSet;
struct TessellatedSurface;
}  // namespace limen::surfaces

namespace limen::perception {

class MetricGpu;
struct PathFrame;
struct PathRequest;

/// What a product is to a viewer.
enum class Depicts {
  Light,         ///< linear light, 1: the display's white
  ShareOfLight,  ///< share of the direct light that arrives at each pixel's surface
  Nothing,       ///< a quantity that is not looked at
  Items          ///< numbers of items, row by row, then negative values: no picture at all
};

/// The surfaces that a share of light falls on: RGBA32F, linear.
struct LitSurfaces {
  const gl::Texture* albedo = nullptr;  ///< reflectance; negative in the background
  const gl::Texture* direct = nullptr;  ///< reflectance times the cosine towards the light
};

/// Renders the frames of a path in order, both products, and visits each with the one before it.
using PathVisitor = std::function<void(int step, const PathFrame& before, const PathFrame& now)>;
using PathRenderer = std::function<void(const PathRequest&, const PathVisitor&)>;

/// One pair of products to compare. All images have the same size. The textures are the technique's output;
/// the images are the same values read back (once for all metrics of a run).
struct ComparisonInput {
  const gl::Texture* testTexture = nullptr;       ///< R32F or RGBA32F; null: made from the image if needed
  const gl::Texture* referenceTexture = nullptr;  ///< same format
  const Image* test = nullptr;  ///< 1 (visibility) or 3..4 channels (linear RGB; alpha is ignored)
  const Image* reference = nullptr;
  /// 1 where the product is meaningful (receivers), 0 elsewhere; 1 channel. Null: everywhere.
  const Image* mask = nullptr;
  MetricGpu* gpu = nullptr;  ///< for metrics with needsGl; null if there is no GL context
  Depicts depicts = Depicts::Light;
  const LitSurfaces* surfaces = nullptr;  ///< for metrics with needsSurfaces; null if there are none
  const PathRenderer* path = nullptr;     ///< for metrics with needsPath; null if there is no scene
  /// For metrics with needsTessellation: the scene's curved surfaces, and how they were drawn.
  const surfaces::PatchSet* patches = nullptr;
  const surfaces::TessellatedSurface* tessellation = nullptr;
  /// 1 where a pixel sees a surface that reflects, 0 elsewhere; 1 channel. Null: there are none.
  const Image* mirrors = nullptr;
  bool wantsMap = true;        ///< MetricResult::map will be used; it may be left out otherwise
  bool wantsPictures = false;  ///< coded ones of MetricResult::pictures will be used
  bool wantsLight = false;     ///< those of linear light will be
};

/// What a metric shows besides its map.
struct MetricPicture {
  std::string name;   ///< "jnd_regions"
  Image image;        ///< 3 channels
  bool coded = true;  ///< for a display, as writePng() takes it; otherwise linear light
};

struct MetricResult {
  double value = 0.0;
  std::vector<double> figures = {};  ///< those that MetricInfo::figures declares, in its order
  /// Per-pixel map (1 channel, larger is worse), if the metric has one.
  std::optional<Image> map;
  std::string mapName;  ///< "absolute_error", "flip", ...
  std::vector<MetricPicture> pictures = {};
  /// Pixels that were evaluated. If there are none (an empty region), `value` is that of a perfect product.
  int64_t evaluatedPixels = 0;
};

/// Registration of a metric: `compare` evaluates a test product against a reference. It throws Error if the
/// images do not match or the reference holds non-finite values. A non-finite test value counts as an error
/// of 1, the whole range of a product, so that every figure stays finite; non_finite distinguishes such a
/// product from a bad one.
struct MetricInfo {
  static constexpr const char* kKind = "metric";
  std::string name;
  int version = 1;  ///< raised when values change
  std::string summary;
  std::string source = {};
  std::string title = {};  ///< as an axis label, without the unit: "RMSE", "Mean FLIP error"
  std::string unit = {};   ///< "" for pure numbers
  Direction direction = Direction::LowerIsBetter;
  /// Of a metric with several figures: each is stored under the metric's name followed by its own ("p95" of
  /// "jnd": jnd_p95). Empty: `value` alone is stored.
  std::vector<Quantity> figures = {};
  bool needsGl = false;
  bool needsSurfaces = false;  ///< shows visibility and light colour on the scene's surfaces
  bool needsPath = false;      ///< evaluates several frames
  /// Evaluates tessellated surfaces: refused for techniques that make none (TechniqueInfo::tessellates).
  bool needsTessellation = false;
  /// Changing the reference changes the value by at most the root mean square of its pixels' changes, as for
  /// means of errors over pixels.
  bool averagesPixels = false;
  bool needsReference = true;  ///< false: evaluates only the test product (non-finite count)
  ParameterList parameters = {};
  std::function<MetricResult(const ComparisonInput&, const ParameterValues&)> compare = {};

  /// Its value, as reports and tables describe it.
  Quantity quantity() const { return {name, title, unit, direction, source}; }
};
using MetricRegistry = Registry<MetricInfo>;

/// Empty settings, for metrics without any.
struct NoMetricSettings {
  static const SettingsTable<NoMetricSettings>& table() {
    static const SettingsTable<NoMetricSettings> kTable = {};
    return kTable;
  }
};

/// Registers a metric with settings S (settings_table.h) at program start. `info` provides the rest; its
/// parameters and compare are filled in.
template <class S>
struct RegisteredMetric {
  RegisteredMetric(MetricInfo info, std::function<MetricResult(const ComparisonInput&, const S&)> compare,
                   const S& defaults = {}) {
    info.parameters = ParameterList([defaults] { return S::table().parameters(defaults); });
    info.compare = [compare = std::move(compare)](const ComparisonInput& input,
                                                  const ParameterValues& values) {
      return compare(input, S::table().read(values));
    };
    MetricRegistry::instance().add(std::move(info));
  }
};

}  // namespace limen::perception
