// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/render_thread.h"

#include <epoxy/gl.h>

#include <array>
#include <chrono>
#include <cmath>

#include "experiments/base/cancel.h"
#include "experiments/base/error.h"
#include "experiments/product.h"
#include "experiments/scene_rendering.h"
#include "experiments/viewer/texture_readback.h"
#include "experiments/viewer/viewed_scene.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/gl/shader_source.h"

namespace limen::viewer {
namespace {

/// How often shader files are checked for changes.
constexpr std::chrono::milliseconds kWatchInterval{400};
/// Frames timed for a picture at rest, and how long they may take.
constexpr int kRestFrames = 24;
constexpr double kRestSeconds = 0.3;

}  // namespace

/// What lives in the thread's context.
class RenderThread::Work {
 public:
  Work(gl::Context& context, std::atomic<int64_t>& frames) : context_(context), frames_(frames) {}

  /// One frame, rebuilding whatever the request changes.
  RenderResult live(const RenderRequest& request) {
    RenderResult out = begin(request);
    if (!out.error.empty()) return out;
    for (size_t i = 0; i < entries_.size(); ++i) {
      Rendered one;
      attempt(one, i, [&] {
        const bool fresh = !live_[i];
        if (fresh) make(i);
        const int64_t before = live_[i]->framesRendered();
        live_[i]->render(1, 0.0);
        frames_ += live_[i]->framesRendered() - before + (fresh ? 1 : 0);
        show(one, i, request);
      });
      out.rendered.push_back(std::move(one));
    }
    return out;
  }

  /// The picture at rest.
  RenderResult settle(const RenderRequest& request) {
    RenderResult out = begin(request);
    out.settled = true;
    if (!out.error.empty()) return out;
    auto view = std::make_shared<experiments::ViewImages>();
    for (size_t i = 0; i < entries_.size(); ++i) {
      Rendered one;
      attempt(one, i, [&] {
        live_[i].reset();
        make(i);
        ++frames_;
        auto product = std::make_shared<Image>(live_[i]->technique().product().read());
        one.productHash = experiments::productHash(*product);
        one.nonFinite = std::count_if(product->data.begin(), product->data.end(),
                                      [](float value) { return !std::isfinite(value); });
        if (one.nonFinite > 0)
          one.failure = std::to_string(one.nonFinite) + " values of the product are not finite";
        one.product = std::move(product);
        one.prepareMs = live_[i]->prepareMs();
        one.counters = live_[i]->technique().count(live_[i]->frame());
        one.remarks = live_[i]->technique().remarks();
        show(one, i, request);
        if (request.pickedPx) one.picked = pick(i, *request.pickedPx);
      });
      out.rendered.push_back(std::move(one));
    }
    try {
      *view = experiments::viewImages(context_, viewed_.get(), request.setup.sizePx);
      out.view = std::move(view);
    } catch (const std::exception& error) {
      out.error = error.what();
    }
    return out;
  }

  /// The same with times, and with what is currently picked and shown.
  void refresh(RenderResult& settled, const RenderRequest& request, bool timed) {
    for (size_t i = 0; i < settled.rendered.size() && i < 2; ++i) {
      Rendered& one = settled.rendered[i];
      if (!one.error.empty() || !live_[i]) continue;
      attempt(one, i, [&] {
        if (timed) {
          const int64_t before = live_[i]->framesRendered();
          live_[i]->render(kRestFrames, kRestSeconds);
          frames_ += live_[i]->framesRendered() - before;
          times(one, i);
        } else {
          show(one, i, request);
        }
        one.picked = request.pickedPx ? pick(i, *request.pickedPx) : std::vector<PickedValues>{};
      });
    }
    settled.number = request.number;
  }

  void forgetTechniques() {
    for (auto& live : live_) live.reset();
    presenter_.reset();
  }

 private:
  RenderResult begin(const RenderRequest& request) {
    RenderResult out;
    out.number = request.number;
    out.setup = request.setup;
    try {
      const experiments::Configuration scene = completeScene(request.setup.scene);
      if (viewed_.empty() || !(scene.name == scene_.name && scene.values.all() == scene_.values.all())) {
        // Whatever refers to a scene is destroyed before it.
        scene_ = {};
        if (viewed_.empty() || needsBuilding(scene)) forgetTechniques();
        viewed_.show(scene);
        scene_ = scene;
        if (presenter_) presenter_->refresh();
      }
      if (request.setup.sizePx != sizePx_) {
        forgetTechniques();
        sizePx_ = request.setup.sizePx;
      }
      if (!presenter_) presenter_ = std::make_unique<Presenter>(context_, viewed_.get(), sizePx_);
    } catch (const std::exception& error) {
      forgetTechniques();
      out.error = error.what();
      return out;
    }
    dropStale(request.setup);
    const scene::Scene& scene = viewed_.get().scene;
    out.traits = scene.traits();
    out.camera = scene.camera.at(0.0);
    out.path = viewed_.path();
    out.bounds = scene.bounds();
    out.triangles = scene.mesh.triangles.size();
    return out;
  }

  bool needsBuilding(const experiments::Configuration& scene) const { return viewed_.needsBuilding(scene); }

  /// Keeps the techniques that the setup still asks for.
  void dropStale(const ViewSetup& setup) {
    std::vector<Entry> wanted = {setup.technique};
    if (setup.second) wanted.push_back(*setup.second);
    for (size_t i = 0; i < live_.size(); ++i)
      if (i >= wanted.size() || i >= entries_.size() || !(entries_[i] == wanted[i])) live_[i].reset();
    entries_ = std::move(wanted);
  }

  void make(size_t i) {
    live_[i] =
        std::make_unique<LiveTechnique>(context_, viewed_.get(), sizePx_, completeTechnique(entries_[i]));
  }

  /// What a technique throws is reported as its error; the viewer continues.
  template <class Step>
  void attempt(Rendered& one, size_t i, Step step) {
    try {
      step();
      context_.checkDebugMessages();
    } catch (const std::exception& error) {
      one.error = error.what();
      one.picture = nullptr;
      live_[i].reset();
      context_.takeDebugMessages();
    }
  }

  void times(Rendered& one, size_t i) {
    one.passes = live_[i]->passes();
    one.frameMs = live_[i]->frameMs();
    one.onCpu = live_[i]->onCpu();
  }

  void show(Rendered& one, size_t i, const RenderRequest& request) {
    techniques::Technique& technique = live_[i]->technique();
    one.kind = live_[i]->info().product;
    times(one, i);
    one.views.clear();
    const auto views = technique.debugViews();
    for (const auto& [name, texture] : views)
      if (texture && texture->format() != gl::Format::Depth32F) one.views.push_back(name);
    const auto chosen = views.find(request.view);
    one.viewWhite = 0.0;
    if (i == 0 && chosen != views.end() && chosen->second) {
      TexturePicture picture = texturePicture(*chosen->second);
      one.viewWhite = picture.white;
      one.picture = std::make_shared<ScreenPicture>(std::move(picture.picture));
    } else {
      one.picture = std::make_shared<ScreenPicture>(presenter_->picture(one.kind, technique.product()));
    }
  }

  std::vector<PickedValues> pick(size_t i, glm::ivec2 pixel) {
    using frame::Channel;
    std::vector<PickedValues> out;
    const auto add = [&](const std::string& name, const gl::Texture& texture) {
      out.push_back({name, valuesAt(texture, pixel, sizePx_)});
    };
    techniques::Technique& technique = live_[i]->technique();
    add("product", technique.product());
    for (const auto& [name, texture] : technique.debugViews())
      if (texture) add(name, *texture);
    if (i > 0) return out;
    frame::Frame& view = presenter_->view();
    constexpr std::array<std::pair<const char*, Channel>, 4> kChannels = {
        {{"position from the anchor", Channel::Position},
         {"normal", Channel::Normal},
         {"albedo", Channel::Albedo},
         {"depth", Channel::Depth}}};
    for (const auto& [name, channel] : kChannels)
      add(name, view.get<frame::GBufferChannel>(frame::ChannelSetting{channel}).texture());
    add("receiver in light space", view.get<frame::Receivers>().texture());
    return out;
  }

  gl::Context& context_;
  std::atomic<int64_t>& frames_;
  ViewedScene viewed_;
  experiments::Configuration scene_;
  glm::ivec2 sizePx_{0};
  std::unique_ptr<Presenter> presenter_;
  std::vector<Entry> entries_;
  std::array<std::unique_ptr<LiveTechnique>, 2> live_;
};

RenderThread::RenderThread(std::function<void()> wake, const std::string& shaderRoot)
    : device_(deviceMade_.get_future().share()), thread_([this, wake = std::move(wake), shaderRoot] {
        const CancelScope scope(cancel_.get_token());
        run(wake, shaderRoot);
        end_.set_value();
      }) {}

RenderThread::~RenderThread() { close(); }

void RenderThread::close() {
  requests_.close();
  cancel_.request_stop();
}

void RenderThread::run(const std::function<void()>& wake, const std::string& shaderRoot) {
  std::unique_ptr<gl::Context> context;
  try {
    context = gl::createHeadlessContext();
  } catch (...) {
    deviceMade_.set_exception(std::current_exception());
    return;
  }
  deviceMade_.set_value(context->device());
  Work work(*context, frames_);
  RenderRequest current;
  std::optional<RenderResult> settled;  // what the screen shows, if at rest
  bool untimed = false;
  const auto publish = [&](RenderResult result) {
    if (cancel_.stop_requested()) return;  // cut short
    results_.put(std::move(result));
    wake();
  };
  while (!requests_.closed()) {
    const bool more = settled && (untimed || (current.continuous && settled->error.empty()));
    if (!more) requests_.wait(kWatchInterval);
    if (requests_.closed()) break;
    if (std::optional<RenderRequest> next = requests_.take()) {
      const bool sameSetup = settled && settled->setup == next->setup;
      current = std::move(*next);
      if (current.moving) {
        settled.reset();
        publish(work.live(current));
      } else if (sameSetup) {
        work.refresh(*settled, current, false);
        publish(*settled);
      } else {
        settled = work.settle(current);
        publish(*settled);
      }
      // Timing starts once nothing else is waiting.
      untimed = settled && settled->error.empty() && (untimed || !sameSetup);
    } else if (settled && (untimed || current.continuous)) {
      work.refresh(*settled, current, true);
      publish(*settled);
      untimed = false;
    }
    if (!shaderRoot.empty()) {
      gl::ProgramCache::Reload reload = context->programs().reloadChanged();
      if (!reload.rebuilt.empty() || !reload.failures.empty()) {
        context->takeDebugMessages();  // drivers report refusals there as well
        if (!reload.rebuilt.empty()) {
          // Uniforms that a technique sets only once are lost with the old program.
          work.forgetTechniques();
          settled = work.settle(current);
          publish(*settled);
          untimed = settled->error.empty();
        }
        news_.put({std::move(reload.rebuilt), std::move(reload.failures)});
        wake();
      }
    }
  }
}

}  // namespace limen::viewer
