// SPDX-License-Identifier: BSD-3-Clause
// Several procedures whose trials are mixed, so that the next stimulus is unpredictable. The first value of a
// stimulus is the number of the procedure that requested it, which makes a list of trials self-contained.
#include <cmath>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "study/procedures/details.h"
#include "study/procedures/settings_reader.h"

namespace limen::study {
namespace {

using nlohmann::json;

struct InterleavedDetail : ProcedureDetail, std::enable_shared_from_this<InterleavedDetail> {
  std::vector<ProcedureSettings> parts;
  std::vector<std::string> names;
  bool random = true;

  std::unique_ptr<Procedure> make(uint64_t seed) const override;
  json toJson() const override {
    json list = json::array();
    for (size_t i = 0; i < parts.size(); ++i) {
      list.push_back(study::toJson(parts[i]));
      list.back()["name"] = names[i];
    }
    return {{"procedures", list}, {"order", random ? "random" : "rotation"}};
  }
};

class Interleaved : public Procedure {
 public:
  Interleaved(std::shared_ptr<const InterleavedDetail> detail, uint64_t seed)
      : detail_(std::move(detail)), seed_(seed) {
    for (size_t i = 0; i < detail_->parts.size(); ++i) {
      parts_.push_back(
          makeProcedure(detail_->parts[i], psychometrics::childSeed(seed, "procedure " + std::to_string(i))));
    }
  }

  std::optional<std::vector<double>> next() const override {
    std::vector<size_t> open;
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i]->next()) open.push_back(i);
    }
    if (open.empty()) return std::nullopt;
    const size_t chosen = detail_->random ? pick(open) : following(open);
    std::vector<double> stimulus = {static_cast<double>(chosen)};
    const std::vector<double> rest = *parts_[chosen]->next();
    stimulus.insert(stimulus.end(), rest.begin(), rest.end());
    return stimulus;
  }

  void update(const std::vector<double>& stimulus, int outcome) override {
    const double number = stimulus.empty() ? -1.0 : stimulus.front();
    if (!(number >= 0.0 && number < static_cast<double>(parts_.size()) && number == std::floor(number))) {
      throw Error("the first value of an interleaved trial's stimulus is not the number of a procedure", {},
                  "give a whole number from 0 to " + std::to_string(parts_.size() - 1));
    }
    parts_[static_cast<size_t>(number)]->update({stimulus.begin() + 1, stimulus.end()}, outcome);
    last_ = static_cast<int>(number);
    ++trials_;
  }

  int trialsDone() const override { return trials_; }

  Estimate estimate(double level) const override {
    Estimate out;
    out.level = level;
    for (size_t i = 0; i < parts_.size(); ++i) {
      const Estimate part = parts_[i]->estimate(level);
      if (out.kind.find(part.kind) == std::string::npos)
        out.kind += (out.kind.empty() ? "" : "; ") + part.kind;
      for (ParameterEstimate parameter : part.parameters) {
        parameter.name = detail_->names[i] + "." + parameter.name;
        out.parameters.push_back(std::move(parameter));
      }
    }
    return out;
  }

  json state() const override {
    json list = json::array();
    for (const auto& part : parts_) list.push_back(part->state());
    return {{"trials", trials_}, {"seed", seed_}, {"last", last_}, {"procedures", list}};
  }

 private:
  size_t pick(const std::vector<size_t>& open) const {
    psychometrics::Random random(psychometrics::childSeed(seed_, "pick " + std::to_string(trials_)));
    return open[random.below(open.size())];
  }

  // The first open one after the last that had a trial, cyclically.
  size_t following(const std::vector<size_t>& open) const {
    for (size_t i : open) {
      if (static_cast<int>(i) > last_) return i;
    }
    return open.front();
  }

  std::shared_ptr<const InterleavedDetail> detail_;
  uint64_t seed_;
  std::vector<std::unique_ptr<Procedure>> parts_;
  int last_ = -1, trials_ = 0;
};

std::unique_ptr<Procedure> InterleavedDetail::make(uint64_t seed) const {
  return std::make_unique<Interleaved>(shared_from_this(), seed);
}

void checkSameStimulus(const ProcedureSettings& first, const ProcedureSettings& other,
                       const std::string& where) {
  bool same = first.stimulus.size() == other.stimulus.size() && first.outcomes == other.outcomes;
  for (size_t d = 0; same && d < first.stimulus.size(); ++d) {
    same =
        first.stimulus[d].name == other.stimulus[d].name && first.stimulus[d].unit == other.stimulus[d].unit;
  }
  if (!same) {
    throw Error("its stimulus or outcomes differ from those of the first procedure", where,
                "give all the same dimensions, units and outcomes");
  }
}

}  // namespace

ProcedureSettings readInterleaved(SettingsReader& reader) {
  auto detail = std::make_shared<InterleavedDetail>();
  const json& list = reader.required("procedures", "a list of procedures");
  const std::string where = reader.at("procedures");
  if (!list.is_array() || list.empty() || list.size() > 1000) {
    throw Error("found " + std::string(list.is_array() ? "a list of the wrong length" : list.dump()), where,
                "list at least one procedure");
  }
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string place = where + "[" + std::to_string(i) + "]";
    json entry = list[i];
    std::string name = std::to_string(i);
    if (entry.is_object() && entry.contains("name")) {
      if (!entry["name"].is_string()) throw Error("the name is not a text", place + ".name", "give a text");
      name = entry["name"].get<std::string>();
      entry.erase("name");
    }
    for (const std::string& other : detail->names) {
      if (other == name) throw Error("two procedures are called '" + name + "'", place + ".name");
    }
    detail->parts.push_back(readProcedure(entry, place));
    detail->names.push_back(name);
    checkSameStimulus(detail->parts.front(), detail->parts.back(), place);
  }
  detail->random = reader.choiceOr("order", "random", {"random", "rotation"}) == "random";
  reader.finish();
  ProcedureSettings out;
  out.type = "interleaved";
  out.stimulus = detail->parts.front().stimulus;
  for (const ProcedureSettings& part : detail->parts) {
    for (size_t d = 0; d < out.stimulus.size(); ++d) {
      out.stimulus[d].minimum = std::min(out.stimulus[d].minimum, part.stimulus[d].minimum);
      out.stimulus[d].maximum = std::max(out.stimulus[d].maximum, part.stimulus[d].maximum);
    }
  }
  out.stimulus.insert(out.stimulus.begin(),
                      {"procedure", "", 0.0, static_cast<double>(detail->parts.size() - 1)});
  out.outcomes = detail->parts.front().outcomes;
  out.mostTrials = 0;
  for (const ProcedureSettings& part : detail->parts) {
    if (out.mostTrials && part.mostTrials) {
      *out.mostTrials += *part.mostTrials;
    } else {
      out.mostTrials.reset();
    }
  }
  out.detail = std::move(detail);
  return out;
}

const char* describeInterleaved() {
  return "interleaved: several procedures, their trials mixed; the first value of a stimulus is the "
         "procedure's number\n"
         "    procedures    list of procedures of any type with the same stimulus dimensions, each with a "
         "`name`\n"
         "                  (default: its number from 0) that prefixes its estimates\n"
         "    order         random (default): each trial one of those unfinished, by the seed; or rotation\n";
}

}  // namespace limen::study
