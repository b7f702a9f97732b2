// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "experiments/base/build_facts.h"
#include "experiments/base/error.h"
#include "experiments/base/printable.h"
#include "experiments/base/text.h"

namespace limen::experiments {
namespace {

/// "i/n" with 1 <= i <= n.
void readShard(const std::string& text, SweepOptions& options) {
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, options.shardIndex);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = std::from_chars(slash ? first.ptr + 1 : end, end, options.shardCount);
  if (!slash || second.ec != std::errc{} || second.ptr != end || options.shardIndex < 1 ||
      options.shardIndex > options.shardCount)
    throw Error("'" + text + "' is not a shard", "--shard", "give i/n with i from 1 to n: --shard 2/4");
}

std::string suggestOption(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  return suggest(word, known);
}

void checkTogether(const SweepOptions& options) {
  if (options.merge) return;
  if (options.descriptors.empty() && !options.list && !options.features)
    throw Error("no descriptor given", "command line", "name a YAML file, or see --help");
  if (!options.descriptors.empty() && (options.list || options.features))
    throw Error("--list and --features do not run descriptors", "command line", "use them on their own");
}

}  // namespace

ParsedOptions parseOptions(int argc, char** argv, const std::string& program) {
  ParsedOptions parsed;
  SweepOptions& options = parsed.options;
  options.root = LIMEN_SOURCE_DIR;
  CLI::App app("Runs whatever is not done yet of the experiments in the descriptors.", program);
  app.set_version_flag("--version", versionText(program), "Print version and commit");
  app.add_option("descriptor", options.descriptors, "Descriptors, run one after another")->type_name("FILE");
  app.add_option("--store", options.store, "Result store (default: results/DESCRIPTOR.sqlite)")
      ->type_name("FILE");
  std::string shard;
  app.add_option("--shard", shard, "Only part i of n, split by run key; join the stores with merge")
      ->type_name("i/n");
  app.add_flag("--fail-fast", options.failFast, "Stop after the first failed run");
  app.add_flag("--retry-died", options.retryDied, "Try runs again whose process died twice");
  app.add_flag("--dry-run", options.dryRun, "Print the plan and its size without running it");
  app.add_flag("--no-report", options.noReport, "Do not write an HTML report");
  app.add_option("--device", options.device,
                 "GPU to measure on: a part of its name (nvidia) or its index; --list devices shows them")
      ->type_name("NAME");
  app.add_flag("--json", options.json, "JSON lines on standard output");
  std::string list;
  CLI::Option* const listOption = app.add_option(
      "--list", list,
      "List what descriptors can name: scenes, techniques, metrics, or one NAME in full; or devices");
  listOption->expected(0, 1)->type_name("WHAT");
  app.add_flag("--features", options.features, "List which features of the theses the descriptors cover");
  app.add_option("--root", options.root,
                 "Source tree with experiments/features.yaml and experiments/descriptors")
      ->envname("LIMEN_ROOT")
      ->type_name("DIR");
  CLI::App* const merge = app.add_subcommand("merge", "Join stores: merge OUT IN...");
  merge->add_option("out", options.mergeOut, "Store to merge into; created if missing")
      ->required()
      ->type_name("OUT");
  merge->add_option("in", options.mergeIn, "Stores to copy from")->required()->type_name("IN");
  merge->add_flag("--json", options.json, "Print a JSON line on standard output");
  try {
    app.parse(argc, argv);
    if (!shard.empty()) readShard(shard, options);
    if (listOption->count() > 0) options.list = list;
    options.merge = merge->parsed();
    checkTogether(options);
  } catch (const CLI::ExtrasError& error) {
    const auto& rest = app.remaining(true);
    const std::string word = rest.empty() ? "" : rest.front();
    std::fprintf(stderr, "%s: unknown argument '%s'; %s\n", program.c_str(), printable(word).c_str(),
                 suggestOption(merge->parsed() ? *merge : app, word).c_str());
    parsed.exitCode = kExitBadInput;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
      std::fprintf(stderr, "%s: %s; see --help\n", program.c_str(), printable(error.what()).c_str());
      parsed.exitCode = kExitBadInput;
    } else {
      parsed.exitCode = app.exit(error);
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), printable(error.what()).c_str());
    parsed.exitCode = kExitBadInput;
  }
  return parsed;
}

}  // namespace limen::experiments
