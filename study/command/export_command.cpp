// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <map>
#include <memory>

#include "experiments/base/interrupt.h"
#include "study/command/commands.h"
#include "study/export/clips.h"
#include "study/export/export.h"
#include "study/export/pseudonyms.h"

namespace limen::study {

void addExportCommand(CLI::App& app, Run&) {
  CLI::App* command = app.add_subcommand("export", "Exports sessions as tables for other programs");
  auto request = std::make_shared<ExportRequest>();
  command->add_option("store", request->store, "Result store with sessions")->required();
  command->add_option("-o,--output", request->folder, "Folder to create")->required();
  static const std::map<std::string, ExportFormat> kFormats = {
      {"csv", ExportFormat::Csv}, {"bids", ExportFormat::Bids}, {"psych-ds", ExportFormat::PsychDs}};
  command->add_option("--format", request->formats, "csv, bids or psych-ds; may be repeated (default: csv)")
      ->transform(CLI::CheckedTransformer(kFormats));
  command->add_option("--protocol", request->protocol, "Only sessions of this protocol (name or SHA-256)");
  command->add_flag("--frames", request->frames, "Include frame logs");
  command->add_flag("--codes", request->codes,
                    "Participant codes instead of pseudonyms: for the lab's own use");
  struct ClipOptions {
    bool wanted = false;
    std::vector<std::string> formats;
  };
  auto clips = std::make_shared<ClipOptions>();
  command->add_flag(
      "--clips", clips->wanted,
      "Also what was seen, in folder clips: every clip, the same without its change, and tables that say "
      "which trial showed which");
  command
      ->add_option(
          "--clip-format", clips->formats,
          "Of --clips, may be repeated: .mkv (lossless), .avi, .mp4, .exr (light, a file for each frame that "
          "differs; default: .mkv and .exr)")
      ->needs("--clips");
  command->callback([request, clips] {
    if (request->formats.empty()) request->formats = {ExportFormat::Csv};
    const WrittenExport written = writeExport(*request);
    for (const std::string& file : written.files)
      std::printf("%s/%s\n", request->folder.c_str(), file.c_str());
    if (clips->wanted) {
      installInterruptHandlers();
      ClipRequest wanted;
      wanted.sessions = *request;
      wanted.folder = request->folder + "/clips";
      if (!clips->formats.empty()) wanted.formats = clips->formats;
      wanted.progress = [](size_t done, size_t all) {
        std::fprintf(stderr, "%zu of %zu clips\n", done, all);
      };
      const WrittenClips seen = writeClips(wanted);
      std::printf("%s: %zu clips, shown in %zu intervals\n", wanted.folder.c_str(), seen.clips, seen.trials);
    }
    if (written.ordersTellCode > 0)
      std::fprintf(
          stderr,
          "warning: %zu of the sessions were run by an older Limen, which drew their orders from the "
          "participants' codes: whoever guesses a code can check it against the order of trials\n",
          written.ordersTellCode);
    if (!request->codes)
      std::printf("pseudonym key: %s (keep it separate from the export)\n",
                  keyFileOf(request->store).c_str());
  });
}

}  // namespace limen::study
