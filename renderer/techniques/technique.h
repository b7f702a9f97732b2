// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/base/parameter_list.h"
#include "experiments/base/quantity.h"
#include "experiments/base/registry.h"
#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::surfaces {
struct TessellatedSurface;
}

namespace limen::techniques {

/// What a technique makes. Products of one kind can be compared.
enum class ProductKind {
  Visibility,   ///< R32F, share of the light's area seen from each pixel's surface point, 0..1; 1 outside
                ///< receivers
  Colour,       ///< RGBA32F, linear radiance, alpha 1
  Threshold,    ///< R32F, luminance increment [cd/m2] that stays invisible, >= 0, at every pixel
  LightColour,  ///< RGBA32F, share of the light's radiance, averaged over its area, that each pixel's surface
                ///< point sees, per channel: 0..1, 1 outside receivers and in channels the light does not
                ///< have; alpha 1
  VisibilityChange,  ///< R32F, Visibility minus that of an earlier frame, -1..1, or the mean size of such
                     ///< changes, 0..1; 0 where either frame has no receiver
  JndMap,            ///< R32F, visible difference between two frames [JND], >= 0, at every pixel
  Stream  ///< R32F, not a picture: the numbers of items row by row, then kStreamEnd; of a size of its
          ///< own. Whole numbers below 2^24, which floats hold exactly
};
/// Follows the last item of a Stream.
inline constexpr float kStreamEnd = -1.0F;
std::string toText(ProductKind kind);

/// A machine-independent figure that a technique counts. Title, unit and direction are in the Quantity that
/// the technique declares under the same name.
struct Counter {
  std::string name;  ///< snake_case with unit: "micro_occluders_per_px"
  double value = 0.0;
};

/// A sequence of figures, one for each step of what a technique does; kept in a run's facts.
struct Series {
  std::string name;     ///< snake_case: "flux_after_step"
  std::string summary;  ///< with the unit
  std::vector<double> values;
};

/// Makes one picture: display-coded, 3 channels, of the product's size. Holds what it needs: it touches
/// neither OpenGL nor its technique, so that it may run on another thread and after the technique is gone.
using PictureMaker = std::function<Image()>;

/// A renderer of one product. Created for each run; prepare() is called once, then render() for each frame.
class Technique {
 public:
  virtual ~Technique() = default;

  /// Compiles programs, allocates and precomputes. Timed apart from the frame. render() allocates and
  /// compiles nothing.
  virtual void prepare(frame::Frame& frame) = 0;
  /// Renders one frame into product(). Passes are opened with frame.passes().
  virtual void render(frame::Frame& frame) = 0;
  virtual const gl::Texture& product() const = 0;
  /// Machine-independent costs, counted in a separate pass outside the timed frames. Called
  /// after render().
  virtual std::vector<Counter> count(frame::Frame&) { return {}; }
  /// Sequences of numbers behind the counters, such as one for each step. Valid after count().
  virtual std::vector<Series> series() const { return {}; }
  /// What a reader of the run's record should know, one sentence each: choices that the technique made
  /// itself, with their reasons, and what went wrong in frames rendered so far. Valid after prepare(); asked
  /// for again after frames were timed. May wait for the GPU. Throws Error if frames were wrong.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Named intermediate images for the viewer and for artefacts; valid after render().
  virtual std::map<std::string, const gl::Texture*> debugViews() const { return {}; }
  /// The scene's curved surfaces as last drawn; null unless TechniqueInfo::tessellates. Called after
  /// render(), outside the timed frames; waits for the GPU.
  virtual std::shared_ptr<const surfaces::TessellatedSurface> tessellation(frame::Frame&) { return nullptr; }
  /// Pictures that explain the product, for artefacts and reports; called outside the timed frames, after
  /// render() and count(); may wait for the GPU.
  virtual std::map<std::string, PictureMaker> pictures() const { return {}; }
};

/// Registration of a technique or a reference.
struct TechniqueInfo {
  static constexpr const char* kKind = "technique";
  std::string name;
  int version = 1;  ///< raised when the product changes
  std::string summary;
  std::string source;
  ProductKind product = ProductKind::Visibility;
  ParameterList parameters = {};
  std::vector<std::string> needs = {};  ///< scene traits without which it cannot run ("rectangular_light")
  bool reference = false;               ///< a reference to compare with
  /// Right for scenes whose parts move ("moving_parts"); others are refused them.
  bool followsMotion = false;
  /// Renders all frames of a path of the light: prepared with the first, it reads the light anew in each and
  /// may carry something over. Others are made anew for every frame of such a path.
  bool followsLight = false;
  bool tessellates = false;  ///< has a tessellation() for metrics of the surface
  /// Runs on the CPU: its time is wall time on any machine.
  bool onCpu = false;
  /// One-line account of how well the product is known, for a reference: bound on its own error, if any.
  std::function<std::unique_ptr<Technique>(const ParameterValues&)> make = {};
  /// Half-width of the 99.9 % confidence interval of one pixel's value, worst case, for a reference with
  /// sampling error; null: exact, or it counts its standard error itself.
  std::function<double(const ParameterValues&)> errorBound = {};
  /// Everything that count() may return: expectations and report axes may name these.
  std::vector<Quantity> counters = {};
  /// Throws Error if the values contradict each other, so that a sweep refuses them before anything runs;
  /// null: they cannot.
  std::function<void(const ParameterValues&)> check = {};
  /// Name of the parameter (whole number) with which cost rises and error falls, so that a viewer can start
  /// coarse; "": none.
  std::string effort = {};
};
using TechniqueRegistry = Registry<TechniqueInfo>;

/// Registers technique T at program start. T has a type Settings with a table (settings_table.h) and is made
/// from such settings. `defaults` are those of this registration. `info` provides the rest; its parameters,
/// make and check are filled in.
template <class T>
struct RegisteredTechnique {
  explicit RegisteredTechnique(TechniqueInfo info, const typename T::Settings& defaults = {}) {
    using S = typename T::Settings;
    info.parameters = ParameterList([defaults] { return S::table().parameters(defaults); });
    info.make = [](const ParameterValues& values) { return std::make_unique<T>(S::table().read(values)); };
    info.check = [](const ParameterValues& values) { S::table().read(values); };
    TechniqueRegistry::instance().add(std::move(info));
  }
  /// As above, for a reference: `errorBound` as in TechniqueInfo::errorBound.
  RegisteredTechnique(TechniqueInfo info, double (*errorBound)(const typename T::Settings&))
      : RegisteredTechnique(withBound(std::move(info), errorBound)) {}

 private:
  static TechniqueInfo withBound(TechniqueInfo info, double (*errorBound)(const typename T::Settings&)) {
    info.errorBound = [errorBound](const ParameterValues& values) {
      return errorBound(T::Settings::table().read(values));
    };
    return info;
  }
};

}  // namespace limen::techniques
