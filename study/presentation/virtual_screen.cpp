// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/virtual_screen.h"

#include <algorithm>
#include <utility>

namespace limen::study {

VirtualScreen::VirtualScreen(VirtualDisplay display) : display_(std::move(display)), random_(display_.seed) {}

double VirtualScreen::refreshHz() const {
  return display_.nominalHz > 0.0 ? display_.nominalHz : display_.refreshHz;
}

void VirtualScreen::clear(double light) { next_ = {light, {}}; }

void VirtualScreen::draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) {
  next_.items.push_back({Drawn::Item::Kind::Picture, picture, topLeftPx, sizePx, 0.0});
}

void VirtualScreen::fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) {
  next_.items.push_back({Drawn::Item::Kind::Fill, {}, topLeftPx, sizePx, light});
}

void VirtualScreen::ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) {
  next_.items.push_back({Drawn::Item::Kind::Ring, {}, centrePx, {radiusPx, widthPx}, light});
}

void VirtualScreen::arrow(glm::dvec2 tipPx, double lengthPx, double light) {
  next_.items.push_back({Drawn::Item::Kind::Arrow, {}, tipPx, {lengthPx, lengthPx}, light});
}

int64_t VirtualScreen::swap() {
  const int number = static_cast<int>(shown_.size());
  shown_.push_back(next_);
  const double periodNs = 1e9 / display_.refreshHz, jitterNs = 1e6 * display_.jitterMs;
  // Drawn whether used or not, so that a drop does not change the jitter of later frames.
  const double jitter = random_.uniform(-jitterNs, jitterNs);
  const bool late = random_.chance(display_.lateChance);
  const double lateness = random_.uniform(0.0, display_.latestPeriods) * periodNs;
  if (display_.early.count(number)) {
    timeNs_ += 1e-2 * periodNs;
  } else {
    const auto drop = display_.drops.find(number);
    blank_ += 1.0 + (drop == display_.drops.end() ? 0 : drop->second);
    timeNs_ = std::max(timeNs_ + 1.0, 1e9 + blank_ * periodNs + (late ? lateness : jitter));
  }
  const auto time = static_cast<int64_t>(timeNs_);
  if (const auto event = display_.events.find(number); event != display_.events.end()) {
    waiting_.push_back(event->second);
    waiting_.back().timeNs = time;
  }
  return time;
}

bool VirtualScreen::lost() const {
  return display_.lostAt >= 0 && static_cast<int>(shown_.size()) > display_.lostAt;
}

std::vector<ScreenEvent> VirtualScreen::poll() { return std::exchange(waiting_, {}); }

}  // namespace limen::study
