// SPDX-License-Identifier: BSD-3-Clause
// Coloured and textured lights with occlusion bitmasks (SS-17, SS-18): the emission of uncovered samples is
// summed by a mask per colour, by a table of sums for groups of samples, or one by one. Source: Schwarz 2009,
// section 4.2.2.
//
// The thesis stores its table in a texture of 256 columns; here it is a buffer of the same half floats, so
// that groups of 16 samples fit as well.
#include <epoxy/gl.h>

#include "experiments/base/error.h"
#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/soft_shadows/bitmask/mask_gathering.h"
#include "renderer/techniques/soft_shadows/bitmask_coloured/coloured_settings.h"
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.h"
#include "renderer/techniques/soft_shadows/bitmask_coloured/light_colours_bindings.h"
#include "renderer/techniques/soft_shadows/search_technique.h"

namespace limen::techniques {
namespace {

constexpr const char *kColourPass = "soft_shadows/light_colours",
                     *kColourShader =
                         "renderer/techniques/soft_shadows/bitmask_coloured/light_colours.comp.glsl";
/// Number of colours up to which masks pay off: each costs one operation per word of samples.
constexpr size_t kMostColours = 64;

/// The emission of visible samples, from the stored masks of all pixels.
class LightColourStage : public ProductStage {
 public:
  /// `masks` outlives this.
  LightColourStage(const ColouredSettings& settings, const MaskGathering& masks)
      : colours_(settings.colours), filters_(settings.prefilters()), masks_(masks) {}

  const gl::Texture& product() const override { return *colour_; }

  std::vector<Counter> count() const override { return {{"colour_table_bytes", double(tableBytes_)}}; }

  void prepare(frame::Frame& frame) override {
    const int side = static_cast<int>(std::lround(std::sqrt(double(masks_.samples().size()))));
    const std::vector<glm::dvec3> shares =
        emissionShares(frame.scene().lights.at(0), masks_.samples(), filters_ ? side : 0);
    glm::dvec3 sum(0.0);
    for (const glm::dvec3 share : shares) sum += share;
    absent_ = glm::vec3(glm::lessThan(sum, glm::dvec3(0.5)));
    gl::ShaderDefines defines = masks_.maskDefines();
    std::vector<glm::vec4> rows;
    if (std::holds_alternative<ColourMasks>(colours_)) {
      defines["COLOURS_MASKS"] = "1";
      std::vector<uint32_t> words;
      const std::vector<ColourMask> masks = colourMasks(shares);
      if (masks.size() > kMostColours)
        throw Error(
            "the light's samples have " + std::to_string(masks.size()) + " colours, too many for masks",
            "colours", "choose colours: table or colours: samples");
      for (const ColourMask& colour : masks) {
        words.insert(words.end(), colour.mask.begin(), colour.mask.end());
        rows.emplace_back(glm::vec3(colour.share), 0.0F);
      }
      colourCount_ = static_cast<int>(masks.size());
      table_.emplace(words);
    } else if (const auto* table = std::get_if<ColourTable>(&colours_)) {
      defines["COLOURS_TABLE"] = "1";
      defines["GROUP_BITS"] = std::to_string(table->groupBits);
      table_.emplace(colourTable(shares, table->groupBits));
    } else {
      defines["COLOURS_SAMPLES"] = "1";
      for (const glm::dvec3 share : shares) rows.emplace_back(glm::vec3(share), 0.0F);
    }
    shares_.emplace(rows);
    program_ = &frame.context().programs().compute(kColourShader, defines);
    colour_.emplace(gl::Format::RGBA32F, frame.sizePx());
    tableBytes_ = (table_ ? table_->bytes() : 0) + shares_->bytes();
    frame.passes().setBytesHeld(kColourPass, colour_->bytes() + tableBytes_);
  }

  void run(frame::Frame& frame, const gl::Texture&) override {
    const gl::Texture& receivers = frame.get<frame::Receivers>().texture();
    const auto scope = frame.passes().open(kColourPass);
    program_->set("sizePx", frame.sizePx());
    program_->set("sets", masks_.bindMasks());
    program_->set("absent", absent_);
    program_->set("colours", colourCount_);
    if (table_) table_->bindStorage(kLightColoursTableBuffer);
    shares_->bindStorage(kLightColoursSharesBuffer);
    receivers.bindTexture(kLightColoursReceiversUnit);
    colour_->bindImage(kLightColoursColourImage, gl::Access::Write);
    program_->dispatch(frame.sizePx());
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  }

 private:
  ColourSums colours_;
  int colourCount_ = 0;
  bool filters_;
  const MaskGathering& masks_;
  glm::vec3 absent_{0.0F};
  const gl::Program* program_ = nullptr;
  std::optional<gl::Buffer> table_, shares_;
  std::optional<gl::Texture> colour_;
  int64_t tableBytes_ = 0;
};

class BitmaskColoured : public SearchTechnique {
 public:
  using Settings = ColouredSettings;
  explicit BitmaskColoured(const ColouredSettings& settings) : SearchTechnique(partsOf(settings)) {}

 private:
  static SearchParts partsOf(const ColouredSettings& settings) {
    auto masks = std::make_unique<MaskGathering>(settings.occluders, sampleChoice(settings.pattern),
                                                 MaskGathering::Masks::Stored);
    auto colours = std::make_unique<LightColourStage>(settings, *masks);
    return {.shader = "renderer/techniques/soft_shadows/bitmask/bitmask.comp.glsl",
            .pass = "soft_shadows/bitmask",
            .search = settings.search,
            .levels = anyLevels(settings.levels),
            .passes = settings.passes,
            .occluders = occluderChoice(settings.occluders),
            .maps = settings.maps,
            .gathering = std::move(masks),
            .last = std::move(colours)};
  }
};

std::vector<Quantity> colouredQuantities() {
  std::vector<Quantity> all = SearchTechnique::quantities();
  for (Quantity& quantity : MaskGathering::quantities()) all.push_back(std::move(quantity));
  all.emplace_back("colour_table_bytes", "Memory of the table of colours", "byte", Direction::LowerIsBetter);
  return all;
}

const RegisteredTechnique<BitmaskColoured> kBitmaskColouredRegistered{
    {.name = "soft_shadows/bitmask_coloured",
     .version = 6,
     .summary = "Visible share of a coloured or textured light's radiance, by a bit field of light samples",
     .source = "Schwarz 2009, section 4.2.2 (SS-17, SS-18)",
     .product = ProductKind::LightColour,
     .needs = {"area_light"},
     .counters = colouredQuantities()}};

}  // namespace
}  // namespace limen::techniques
