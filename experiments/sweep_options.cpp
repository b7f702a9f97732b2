// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/sweep_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "experiments/base/build_facts.h"
#include "experiments/base/data_folder.h"
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
  if (options.command != SweepOptions::Command::Sweep) return;
  if (options.descriptors.empty() && !options.list && !options.features)
    throw Error("no descriptor given", "command line", "name a YAML file, or see --help");
  if (!options.descriptors.empty() && (options.list || options.features))
    throw Error("--list and --features do not run descriptors", "command line", "use them on their own");
  if (!options.gpus.empty() && (options.shardCount > 1 || !options.device.empty()))
    throw Error("goes with neither --shard nor --device", "--gpus",
                "it makes the shards and names the devices itself");
}

void addStore(CLI::App& app, SweepOptions& options) {
  app.add_option("--store", options.store, "Result store (default: results/DESCRIPTOR.sqlite)")
      ->type_name("FILE");
}

void addPlaces(CLI::App& app, SweepOptions& options) {
  app.add_option("--device", options.device,
                 "GPU to measure on: a part of its name (nvidia) or its index; --list devices shows them")
      ->type_name("NAME");
  app.add_option("--references", options.references,
                 "Folder of reference products, which any number of sweeps and tasks may share (default: "
                 "'references' beside the store)")
      ->type_name("DIR");
  app.add_option("--root", options.root,
                 "Source tree with experiments/features.yaml and experiments/descriptors")
      ->envname("LIMEN_ROOT")
      ->type_name("DIR");
}

CLI::App* addMerge(CLI::App& app, SweepOptions& options) {
  CLI::App* const merge = app.add_subcommand("merge", "Join stores: merge OUT IN...");
  merge->add_option("out", options.mergeOut, "Store to merge into; created if missing")
      ->required()
      ->type_name("OUT");
  merge->add_option("in", options.mergeIn, "Stores to copy from")->required()->type_name("IN");
  merge->add_flag("--json", options.json, "Print a JSON line on standard output");
  merge->callback([&options] { options.command = SweepOptions::Command::Merge; });
  return merge;
}

CLI::App* addSubmit(CLI::App& app, SweepOptions& options) {
  CLI::App* const submit = app.add_subcommand(
      "submit",
      "Share a sweep out among the tasks of a Slurm job array: submit DESCRIPTOR... --array 64 [-- OPTIONS "
      "OF "
      "SBATCH]; a second job merges their stores and writes the report. What is done or queued is not "
      "submitted again");
  submit->add_option("descriptor", options.descriptors, "Descriptors")->required()->type_name("FILE");
  submit
      ->add_option("--array", options.array,
                   "Number of tasks, at most; N%M lets M of them run at once. A task has a store of its own")
      ->required()
      ->type_name("N[%M]");
  addStore(*submit, options);
  addPlaces(*submit, options);
  submit->add_flag("--retry-died", options.retryDied, "Try runs again whose process died twice");
  submit->add_flag("--no-report", options.noReport, "Do not write an HTML report");
  submit->add_flag("--dry-run", options.dryRun, "Print the scripts and calls of sbatch; submit nothing");
  submit->add_flag("--json", options.json, "JSON lines on standard output");
  submit->callback([&options] { options.command = SweepOptions::Command::Submit; });
  return submit;
}

CLI::App* addStatus(CLI::App& app, SweepOptions& options) {
  CLI::App* const status = app.add_subcommand(
      "status", "What is done, running, failed and left of sweeps, from Slurm's queue and the stores");
  status->add_option("store", options.shown, "Stores, or descriptors with a store of the default name")
      ->required()
      ->type_name("STORE");
  status->add_flag("--json", options.json, "JSON lines on standard output");
  status->callback([&options] { options.command = SweepOptions::Command::Status; });
  return status;
}

/// Called by scripts of submit and by sweeps on several GPUs, not by people.
CLI::App* addJob(CLI::App& app, SweepOptions& options) {
  CLI::App* const job = app.add_subcommand("job", "");
  job->group("");
  job->add_option("verb", options.jobVerb)
      ->required()
      ->check(CLI::IsMember({"task", "measure", "merge", "stand_by"}));
  job->add_option("folder", options.jobFolder);
  job->add_option("--task", options.jobTask);
  job->add_option("--parent", options.jobParent);
  job->add_option("--device", options.device);
  job->callback([&options] { options.command = SweepOptions::Command::Job; });
  return job;
}

/// Takes the options of sbatch, which begin after "--", off the command line of submit.
int cutSlurmOptions(int argc, char** argv, SweepOptions& options) {
  if (argc < 2 || std::string(argv[1]) != "submit") return argc;
  for (int i = 2; i < argc; ++i) {
    if (std::string(argv[i]) != "--") continue;
    options.slurmOptions.assign(argv + i + 1, argv + argc);
    return i;
  }
  return argc;
}

}  // namespace

ParsedOptions parseOptions(int argc, char** argv, const std::string& program) {
  ParsedOptions parsed;
  SweepOptions& options = parsed.options;
  options.root = dataFolder();
  CLI::App app("Runs whatever is not done yet of the experiments in the descriptors.", program);
  app.set_version_flag("--version", versionText(program), "Print version and commit");
  app.add_option("descriptor", options.descriptors, "Descriptors, run one after another")->type_name("FILE");
  addStore(app, options);
  std::string shard;
  app.add_option("--shard", shard, "Only part i of n, split by run key; join the stores with merge")
      ->type_name("i/n");
  app.add_flag("--fail-fast", options.failFast, "Stop after the first failed run");
  app.add_flag("--retry-died", options.retryDied, "Try runs again whose process died twice");
  app.add_flag("--dry-run", options.dryRun, "Print the plan and its size without running it");
  app.add_flag("--no-report", options.noReport, "Do not write an HTML report");
  addPlaces(app, options);
  CLI::Option* const gpus = app.add_option(
      "--gpus", options.gpus,
      "Share the sweep out among GPUs of this machine, one process each: all, or indices (0,2)");
  gpus->type_name("WHICH");
  app.add_flag("--json", options.json, "JSON lines on standard output");
  std::string list;
  CLI::Option* const listOption = app.add_option(
      "--list", list,
      "List what descriptors can name: scenes, techniques, metrics, or one NAME in full; or devices");
  listOption->expected(0, 1)->type_name("WHAT");
  app.add_flag("--features", options.features, "List which features of the theses the descriptors cover");
  addMerge(app, options);
  addSubmit(app, options);
  addStatus(app, options);
  addJob(app, options);
  argc = cutSlurmOptions(argc, argv, options);
  try {
    app.parse(argc, argv);
    if (!shard.empty()) readShard(shard, options);
    if (listOption->count() > 0) options.list = list;
    if (gpus->count() > 0 && options.gpus.empty())
      throw Error("no GPU is named", "--gpus", "give all, or indices: --gpus 0,2");
    checkTogether(options);
  } catch (const CLI::ExtrasError& error) {
    const auto& rest = app.remaining(true);
    const std::string word = rest.empty() ? "" : rest.front();
    std::fprintf(
        stderr, "%s: unknown argument '%s'; %s\n", program.c_str(), printable(word).c_str(),
        suggestOption(app.get_subcommands().empty() ? app : *app.get_subcommands()[0], word).c_str());
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
