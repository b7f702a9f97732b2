// SPDX-License-Identifier: BSD-3-Clause
// limen study protocol: which protocols there are, and what one of them shows to a participant.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "experiments/base/text.h"
#include "renderer/catalogue.h"
#include "study/application/protocol_lettering.h"
#include "study/command/commands.h"
#include "study/protocol/describe.h"

namespace limen::study {
namespace {

struct ProtocolOptions {
  std::vector<std::string> names;
  int participantNumber = 0;
  uint64_t seed = 1;
  bool json = false, check = false;
};

void listProtocols(bool asJson) {
  nlohmann::json out = nlohmann::json::array();
  std::string text = "Shipped protocols:\n";
  for (const auto& [name, title] : shippedProtocols()) {
    out.push_back({{"name", name}, {"title", title}});
    text += fmt::format("  {:<16}  {}\n", name, title);
  }
  text += "limen study protocol NAME shows conditions, trials and order; use FILE for your own.\n";
  std::fputs(asJson ? (out.dump(2) + "\n").c_str() : text.c_str(), stdout);
}

void showProtocols(const ProtocolOptions& options) {
  const std::shared_ptr<const Catalogue> catalogue = catalogueFromRegistries();
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& name : options.names) {
    const Protocol protocol = readProtocol(name, catalogue);
    checkLettering(protocol);
    const Design design = makeDesign(protocol, options.seed, options.participantNumber);
    if (options.check) {
      const size_t trials = trialsOf(design);
      if (!options.json)
        std::printf("%s: valid, %zu trials, sha256 %s\n", protocol.path.c_str(), trials,
                    protocol.hash.c_str());
      all.push_back(
          {{"name", protocol.name}, {"path", protocol.path}, {"sha256", protocol.hash}, {"trials", trials}});
    } else if (options.json) {
      all.push_back(describeAsJson(protocol, design, options.seed, options.participantNumber));
    } else {
      std::fputs(describe(protocol, design, options.seed, options.participantNumber).c_str(), stdout);
    }
  }
  if (options.json) std::printf("%s\n", (all.size() == 1 ? all[0] : all).dump(2).c_str());
}

}  // namespace

void addProtocolCommand(CLI::App& app, Run&) {
  CLI::App* command =
      app.add_subcommand("protocol", "Lists protocols; shows conditions, trials and order of one");
  auto options = std::make_shared<ProtocolOptions>();
  command->add_option("protocol", options->names, "Name of a shipped protocol, or a file")
      ->type_name("NAME|FILE");
  command
      ->add_option("--participant-number", options->participantNumber,
                   "Number of the participant, from 0: picks rows of Latin squares")
      ->check(CLI::Range(0, 1000000000));
  command->add_option("--seed", options->seed, "Seed of the session's orders")->capture_default_str();
  command->add_flag("--check", options->check, "Only check whether it is valid");
  command->add_flag("--json", options->json, "As JSON");
  command->callback(
      [options] { options->names.empty() ? listProtocols(options->json) : showProtocols(*options); });
}

}  // namespace limen::study
