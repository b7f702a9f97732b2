// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "analysis/commands/commands.h"
#include "analysis/fits/fit_options.h"
#include "base/error.h"

namespace limen::analysis {

void addFitCommand(CLI::App& app) {
  struct Call {
    FitOptions options;
    std::string plot;
    bool json = false, csv = false;
  };
  const auto call = std::make_shared<Call>();
  FitOptions& options = call->options;
  CLI::App* fit =
      app.add_subcommand("fit", "psychometric functions of answers: thresholds, widths, intervals");
  fit->add_option("DATA", options.file, "CSV or TSV, columns named in the first line")->required();
  fit->add_option("--x", options.level, "column with the stimulus level")->required();
  fit->add_option("--k", options.correct, "column with the number of correct or positive answers");
  fit->add_option("--n", options.trials, "column with the number of trials");
  fit->add_option("--outcome", options.outcome, "column with 0 or 1, where each row is one trial");
  fit->add_option("--by", options.by, "columns whose values are the conditions")->delimiter(',');
  fit->add_option("--order", options.order,
                  "column that says when a row was measured; otherwise the file's order");
  fit->add_option("--task", options.task, "yesno, 2afc, mafc:M, equal (guess rate = lapse rate)")
      ->capture_default_str();
  fit->add_option("--sigmoid", options.sigmoid,
                  "logistic, normal, weibull, gumbel, reversed_gumbel, hyperbolic_secant, student_t")
      ->capture_default_str();
  fit->add_option("--axis", options.axis, "linear or log; weibull is log")->capture_default_str();
  fit->add_option("--level", options.thresholdLevel, "F at which the threshold is")->capture_default_str();
  fit->add_option("--method", options.method, "ml: maximum likelihood, map: with priors")
      ->capture_default_str();
  fit->add_option("--fix", options.fixed, "parameter that is known: lapse=0.01; may be repeated");
  fit->add_option("--share", options.shared, "parameters that all conditions have in common: lapse,width")
      ->delimiter(',');
  fit->add_option("--lapse-most", options.lapseMost, "upper bound of the lapse rate")->capture_default_str();
  fit->add_option("--guess-most", options.guessMost, "upper bound of a guess rate that is fitted")
      ->capture_default_str();
  fit->add_option("--range", options.range,
                  "LOW,HIGH: levels between which the threshold is expected; bounds and "
                  "priors go by them and not by the data's")
      ->delimiter(',');
  fit->add_flag("--overdispersion", options.overdispersion, "fit eta: beta-binomial answers");
  fit->add_option("--intervals", options.intervals, "bootstrap, bca, profile, laplace, posterior");
  fit->add_option("--confidence", options.confidence, "of the intervals")->capture_default_str();
  fit->add_option("--resample", options.resample,
                  "parametric (from the fit) or nonparametric (from the answers)")
      ->capture_default_str();
  fit->add_option("--samples", options.samples, "of bootstrap and goodness of fit")->capture_default_str();
  fit->add_option("--seed", options.seed, "of bootstrap and goodness of fit")->capture_default_str();
  fit->add_option("--threads", options.threads, "of the bootstrap; no result depends on them")
      ->capture_default_str()
      ->check(CLI::Range(1u, 64u));
  fit->add_flag("--goodness", options.goodness,
                "deviance and residuals against samples drawn from the fit; influence of each block");
  fit->add_option("--plot", call->plot, "draw into FILE.svg, .pdf or .png");
  CLI::Option* json = fit->add_flag("--json", call->json, "print JSON");
  fit->add_flag("--csv", call->csv, "print CSV, a row for each parameter")->excludes(json);
  fit->callback([call] {
    const FitAnswer answer = answerFit(call->options);
    if (!call->plot.empty()) drawFit(answer, call->plot);
    const std::string text = call->json ? toJson(answer) + "\n" : call->csv ? toCsv(answer) : toText(answer);
    std::fputs(text.c_str(), stdout);
  });
}

}  // namespace limen::analysis
