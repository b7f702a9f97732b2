// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/lod_pair.h"

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/motion.h"

namespace limen::frame {
namespace {

constexpr const char* kNames[4] = {"actual", "predicted", "actual_before", "predicted_before"};

}  // namespace

LodPair::LodPair(Frame& parent, LodPairSetting setting) : setting_(std::move(setting)), parent_(parent) {
  for (size_t i = 0; i < (setting_.moving ? 4 : 2); ++i)
    frames_[i] = std::make_unique<Frame>(parent, kNames[i], parent.sizePx());
}

LodPair::~LodPair() = default;

void LodPair::setLevels(const scene::LodSelection& actual, const scene::LodSelection& predicted) {
  for (size_t i = 0; i < 4; ++i)
    if (frames_[i]) frames_[i]->setLevels(i % 2 == 0 ? actual : predicted);
}

void LodPair::render() {
  for (size_t i = 0; i < 4; ++i) {
    if (!frames_[i]) continue;
    frames_[i]->setTime(parent_.timeS() - (i < 2 ? 0.0 : setting_.dtS));
    frames_[i]->begin();
  }
  const auto depth = [](Frame& frame) {
    return &frame.get<GBufferChannel>(ChannelSetting{Channel::Depth}).texture();
  };
  for (size_t i = 0; i < 2; ++i) {
    View& view = i == 0 ? actual_ : predicted_;
    view.colour = &frames_[i]->get<Shaded>(setting_.shaded).texture();
    if (!setting_.moving) continue;
    const Motion& motion = frames_[i]->get<Motion>(MotionSetting{setting_.dtS});
    view.shadedBefore = view.colour;
    if (setting_.shaded.specular > 0.0) {
      ShadedSetting before = setting_.shaded;
      before.eyeDtS = setting_.dtS;
      view.shadedBefore = &frames_[i]->get<Shaded>(before).texture();
    }
    view.displacement = &motion.displacement();
    view.previousDepth = &motion.previousDepth();
    view.depth = depth(*frames_[i]);
    view.depthBefore = depth(*frames_[i + 2]);
  }
  if (setting_.moving && setting_.previousColour)
    previousColour_ = &frames_[3]->get<Shaded>(setting_.shaded).texture();
  for (const std::unique_ptr<Frame>& frame : frames_)
    if (frame) frame->end();
}

std::pair<scene::LodSelection, scene::LodSelection> objectChange(const scene::LodSelection& others,
                                                                 size_t object, int oldLevel, int newLevel) {
  std::pair<scene::LodSelection, scene::LodSelection> out{others, others};
  out.first.levels.at(object) = newLevel;
  out.second.levels.at(object) = oldLevel;
  return out;
}

}  // namespace limen::frame
