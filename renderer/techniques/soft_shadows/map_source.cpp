// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/map_source.h"

#include <algorithm>

namespace limen::techniques {

MapSource::MapSource(const MapSettings& map, const MapChoice& choice)
    : usual_{map.resolution, map.raster}, choice_(choice) {}

void MapSource::prepare(const scene::Scene& scene) {
  maps_ = lightMaps(choice_, scene, usual_);
  const auto* peeled = std::get_if<PeeledMaps>(&choice_);
  if (peeled && peeled->passes == LayerPasses::One)
    for (frame::ShadowMapSettings& map : maps_) map.together = static_cast<int>(maps_.size());
  chooseAll();
}

gl::ShaderDefines MapSource::defines() const {
  if (maps_[0].together > 1) return {{"MAP_LAYERS", std::to_string(maps_.size())}};
  const auto* points = std::get_if<LightPointMaps>(&choice_);
  if (!points) return {};
  gl::ShaderDefines defines = {{"EYE_OFF_CENTRE", "1"}};
  if (points->gaps == PointGaps::Open && maps_.size() > 1) {
    defines["GAPS_OPEN"] = "1";
    defines["GAP_FILL"] = "GAP_FILL_NONE";
  }
  return defines;
}

void MapSource::choose(double timeS) {
  const size_t due = mapsAtRest();
  const bool rests = wasRead_ && due < isDue_.size() && readForS_ == timeS;
  isDue_.assign(isDue_.size(), !rests);
  for (size_t i = 0; rests && i < due; ++i) isDue_[(nextUpdate_ + i) % isDue_.size()] = true;
  if (rests) nextUpdate_ = (nextUpdate_ + due) % isDue_.size();
  wasRead_ = true;
  readForS_ = timeS;
}

size_t MapSource::mapsAtRest() const {
  const auto* objects = std::get_if<ObjectMaps>(&choice_);
  return objects && objects->updates > 0 ? std::min(static_cast<size_t>(objects->updates), maps_.size())
                                         : maps_.size();
}

}  // namespace limen::techniques
