// SPDX-License-Identifier: BSD-3-Clause
// Coloured and textured lights by occlusion bitmasks (SS-17, SS-18): what samples that are not covered emit
// is added up, by a mask for each colour, by a table of sums for groups of samples, or one by one. Source:
// Schwarz 2009, section 4.2.2.
//
// The thesis keeps its table in a texture of 256 columns; here it is a buffer of the same half floats, so
// that groups of 16 samples fit, too.
#include <epoxy/gl.h>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/bitmask.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.h"

namespace limen::techniques {
namespace {

constexpr const char *kColourPass = "soft_shadows/light_colours", *kDefaultGroup = "8",
                     *kColourShader =
                         "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.comp.glsl";
constexpr uint32_t kTableBinding = 1, kSharesBinding = 2;
/// Colours up to which masks are of any use: each costs as many operations as the samples have words.
constexpr size_t kMostColours = 64;

void checkBitmaskColoured(const ParameterValues& values) {
  Bitmask::checkValues(values);
  Bitmask::checkKept(values, "colours follow from the masks of all pixels");
  if (values.text("colours") != "table" && values.text("group_bits") != kDefaultGroup)
    throw Error("'group_bits' is about the table of colours, and there is none", "group_bits",
                "leave it out, or give colours: table");
  if (!isGridPattern(values.text("pattern")) && !values.boolean("prefilter"))
    throw Error("'prefilter' is about samples with cells, which " + values.text("pattern") + " has not",
                "prefilter", "leave it out, or give another pattern");
}

class BitmaskColoured : public Bitmask {
 public:
  explicit BitmaskColoured(const ParameterValues& values)
      : Bitmask(values, true),
        colours_(values.text("colours")),
        groupBits_(std::stoi(values.text("group_bits"))),
        filters_(values.boolean("prefilter") && isGridPattern(values.text("pattern"))) {
    checkBitmaskColoured(values);
  }

  const gl::Texture& product() const override { return *colour_; }

  std::vector<Counter> count(frame::Frame& frame) override {
    std::vector<Counter> all = Bitmask::count(frame);
    all.push_back({"colour_table_bytes", double(tableBytes_), "byte", true});
    return all;
  }

 protected:
  void prepareSearch(frame::Frame& frame) override {
    Bitmask::prepareSearch(frame);
    const int side = static_cast<int>(std::lround(std::sqrt(double(samples().size()))));
    const std::vector<glm::dvec3> shares =
        emissionShares(frame.scene().lights.at(0), samples(), filters_ ? side : 0);
    glm::dvec3 sum(0.0);
    for (const glm::dvec3 share : shares) sum += share;
    absent_ = glm::vec3(glm::lessThan(sum, glm::dvec3(0.5)));
    gl::ShaderDefines defines = maskDefines();
    std::vector<glm::vec4> rows;
    if (colours_ == "masks") {
      defines["COLOURS"] = "0";
      std::vector<uint32_t> words;
      const std::vector<ColourMask> masks = colourMasks(shares);
      if (masks.size() > kMostColours)
        throw Error(
            "the light's samples have " + std::to_string(masks.size()) + " colours, too many for masks",
            "colours", "give colours: table or colours: samples");
      for (const ColourMask& colour : masks) {
        words.insert(words.end(), colour.mask.begin(), colour.mask.end());
        rows.emplace_back(glm::vec3(colour.share), 0.0F);
      }
      colourCount_ = static_cast<int>(masks.size());
      table_.emplace(words);
    } else if (colours_ == "table") {
      defines["COLOURS"] = "1";
      defines["GROUP_BITS"] = std::to_string(groupBits_);
      table_.emplace(colourTable(shares, groupBits_));
    } else {
      defines["COLOURS"] = "2";
      for (const glm::dvec3 share : shares) rows.emplace_back(glm::vec3(share), 0.0F);
    }
    shares_.emplace(rows);
    program_ = &frame.context().programs().compute(kColourShader, defines);
    colour_.emplace(gl::Format::RGBA32F, frame.sizePx());
    tableBytes_ = (table_ ? table_->bytes() : 0) + shares_->bytes();
    frame.passes().setBytesHeld(kColourPass, colour_->bytes() + tableBytes_);
  }

  void finish(frame::Frame& frame) override {
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const auto scope = frame.passes().open(kColourPass);
    program_->set("sizePx", frame.sizePx());
    program_->set("sets", bindMasks());
    program_->set("absent", absent_);
    program_->set("colours", colourCount_);
    if (table_) table_->bindStorage(kTableBinding);
    shares_->bindStorage(kSharesBinding);
    receivers.bindTexture(0);
    colour_->bindImage(0, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

 private:
  std::string colours_;
  int groupBits_, colourCount_ = 0;
  bool filters_;
  glm::vec3 absent_{0.0F};
  const gl::Program* program_ = nullptr;
  std::optional<gl::Buffer> table_, shares_;
  std::optional<gl::Texture> colour_;
  int64_t tableBytes_ = 0;
};

std::vector<Parameter> bitmaskColouredParameters() {
  std::vector<Parameter> all = Bitmask::parameters();
  all.push_back(choiceParameter("colours", "table", {"masks", "table", "samples"},
                                "How what visible samples emit is added up: a mask for each colour, a table "
                                "of sums for groups of samples, or one after another",
                                "Schwarz 2009, section 4.2.2 (samples: bench)"));
  all.push_back(choiceParameter("group_bits", kDefaultGroup, {"4", "8", "16"},
                                "Samples in a group of the table; its memory doubles with each",
                                "Schwarz 2009, section 4.2.2 (8)"));
  all.push_back(booleanParameter("prefilter", true,
                                 "Samples on a grid emit the mean of their cell of the light, not what is "
                                 "emitted at their place"));
  return all;
}

std::vector<Quantity> counterNames() {
  std::vector<Quantity> names = Bitmask::counterNames();
  names.emplace_back("colour_table_bytes");
  return names;
}

const Registered<TechniqueInfo> kBitmaskColouredRegistered{
    {.name = "soft_shadows/bitmask_coloured",
     .version = 1,
     .summary = "Share of a coloured or textured light's radiance that a bit field of light samples leaves",
     .source = "Schwarz 2009, section 4.2.2 (SS-17, SS-18)",
     .product = ProductKind::LightColour,
     .parameters = bitmaskColouredParameters(),
     .needs = {"area_light"},
     .reference = false,
     .onCpu = false,
     .make = [](const ParameterValues& values) { return std::make_unique<BitmaskColoured>(values); },
     .errorBound = {},
     .counters = counterNames(),
     .check = checkBitmaskColoured}};

}  // namespace
}  // namespace limen::techniques
