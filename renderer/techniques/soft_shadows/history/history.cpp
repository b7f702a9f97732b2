// SPDX-License-Identifier: BSD-3-Clause
// Another technique's visibility averaged over the frames rendered so far (SS-43). The first frame is the
// other technique's own; what later ones gain and lose in motion is measured by soft_shadows/change and
// soft_shadows/in_motion, which contain the same history.
#include "renderer/techniques/soft_shadows/history/visibility_history.h"
#include "renderer/techniques/soft_shadows/inner_technique.h"

namespace limen::techniques {
namespace {

struct HistoryTechniqueSettings {
  ChosenEntry inner{"soft_shadows/backprojection", {}};
  HistorySettings history;
  static const SettingsTable<HistoryTechniqueSettings>& table() {
    using S = HistoryTechniqueSettings;
    static const SettingsTable<S> kTable = {innerBinding(&S::inner, InnerKind::OrExact),
                                            included(&S::history)};
    return kTable;
  }
};

class History : public Technique {
 public:
  using Settings = HistoryTechniqueSettings;
  explicit History(const HistoryTechniqueSettings& settings)
      : inner_(makeInner(settings.inner)), history_(settings.history) {}

  void prepare(frame::Frame& frame) override {
    inner_->prepare(frame);
    history_.prepare(frame);
  }

  void render(frame::Frame& frame) override {
    inner_->render(frame);
    history_.add(frame, inner_->product());
  }

  const gl::Texture& product() const override { return history_.current(); }
  std::vector<std::string> remarks() const override { return inner_->remarks(); }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = countInner(*inner_, frame);
    for (Counter& counter : history_.count(frame, inner_->product())) all.push_back(std::move(counter));
    return all;
  }

  std::map<std::string, const gl::Texture*> debugViews() const override {
    return {{"present", &inner_->product()}};
  }

 private:
  std::unique_ptr<Technique> inner_;
  VisibilityHistory history_;
};

std::vector<Quantity> historyTechniqueCounters() {
  std::vector<Quantity> all = innerCounters();
  for (Quantity& counter : VisibilityHistory::counters()) all.push_back(std::move(counter));
  return all;
}

const RegisteredTechnique<History> kHistoryTechnique{
    {.name = "soft_shadows/history",
     .version = 1,
     .summary = "Visibility of another technique averaged over past frames",
     .source = "Schwarz 2009, section 5.2.2 (suggested there, after Scherzer et al. 2007) (SS-43)",
     .product = ProductKind::Visibility,
     .needs = {"rectangular_light"},
     .counters = historyTechniqueCounters()}};

}  // namespace
}  // namespace limen::techniques
