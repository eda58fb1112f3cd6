// bsm_experiments: repeats the paper's experiments and further ones over two folders of pairs, and writes a report.
#include <algorithm>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "bench/command_line.h"
#include "bench/experiments/experiments.h"
#include "bench/experiments/study.h"
#include "bench/study_error.h"
#include "host/config_options.h"
#include "host/options.h"

namespace bsm::bench {
namespace {

constexpr char kProgram[] = "bsm_experiments";
constexpr char kUsage[] = "bsm_experiments BENCHMARK SCENES -o OUTDIR [options]";
constexpr char kTitle[] = "Binary stereo matching: experiments";

constexpr const Experiment* kExperiments[] = {&kTable1,      &kTable2,     &kFigure1,    &kFigure3, &kFigure4,
                                              &kDisparities, &kPresets,    &kThresholds, &kGray,    &kFractions,
                                              &kRefinement,  &kConfidence, &kErrors};

std::string summary() {
  std::string text =
      "Repeats the experiments of \"Binary Stereo Matching\" (ICPR 2012) and measures what this library adds. BENCHMARK is\n"
      "a folder of pairs with region masks (Middlebury v2), SCENES one of the radiometric study's scenes (Middlebury "
      "2005);\n"
      "their layout is that of bsm_quality. Results go to standard output as text, to OUTDIR as CSV, SVG, PNG and one "
      "page,\n"
      "index.html, that needs no other file. Experiments, in the order they run:\n";
  for (const Experiment* experiment : kExperiments) {
    std::string name = experiment->name;
    name.resize(14, ' ');
    text += "  " + name + experiment->summary + "\n";
  }
  text.pop_back();
  return text;
}

bool split_names(const std::string& list, std::vector<std::string>* names) {
  size_t begin = 0;
  while (begin <= list.size()) {
    const size_t end = std::min(list.find(',', begin), list.size());
    if (end > begin) names->push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return !names->empty();
}

bool choose(const std::vector<std::string>& only, std::vector<const Experiment*>* chosen, std::string* error) {
  std::vector<std::string> names;
  for (const Experiment* experiment : kExperiments) names.push_back(experiment->name);
  for (const std::string& name : only) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string near = host::nearest_name(name, names);
    *error = "--only '" + name + "': no such experiment" + (near.empty() ? "" : "; did you mean " + near + "?") +
             " (--help lists them)";
    return false;
  }
  for (const Experiment* experiment : kExperiments) {
    if (only.empty() || std::find(only.begin(), only.end(), experiment->name) != only.end()) chosen->push_back(experiment);
  }
  return true;
}

int run(const StudyOptions& options, const std::vector<const Experiment*>& experiments) {
  Study study(options, kTitle);
  int steps = 0;
  for (const Experiment* experiment : experiments) steps += experiment->steps(study);
  study.progress().begin(steps);
  for (const Experiment* experiment : experiments) {
    study.begin(experiment->name);
    experiment->run(study);
  }
  const std::string page = study.report().finish();
  std::printf("\nThe page with tables, plots and pictures: %s\n", page.c_str());
  return kExitOk;
}

int main_program(int argc, char** argv) {
  StudyOptions study;
  std::string isa = "auto", confirmed = "laundry,moebius,reindeer", error;
  std::vector<std::string> only;
  const std::string description = summary();
  host::Options options(kProgram, kUsage, description.c_str());
  options.positional("BENCHMARK", &study.benchmark_folder);
  options.positional("SCENES", &study.scenes_folder);
  options.word("--output", "OUTDIR", &study.output_folder, "the folder that the results go to");
  options.also("-o");
  options.words("--only", "NAME", &only, "this experiment; may be given several times");
  options.flag("--quick", &study.quick, "three scenes, fewer lengths, one repetition: a look, no measurement");
  options.integer("--threads", "T", &study.threads, 1, BSM_MAX_JOBS, "threads where time is not what is measured");
  options.integer("--repeat", "R", &study.repeat, 1, 1000, "repetitions of each measured time; the fastest counts");
  options.word("--isa", "NAME", &isa, "instructions allowed: auto, scalar or a name from 'bsm info'");
  options.word("--confirmed", "A,B", &confirmed, "the scenes that no parameter was chosen on");
  options.word("--pairs", "FILE", &study.pairs_file, "table of 'name disparities scale', before all others");
  int exit_code = kExitOk;
  if (!parse_command_line(argc, argv, &options, &exit_code)) return exit_code;
  std::vector<const Experiment*> experiments;
  if (study.output_folder.empty()) error = "-o OUTDIR is missing: the folder that the results go to";
  split_names(confirmed, &study.confirmed);
  if (!error.empty() || !choose(only, &experiments, &error) || !host::isa_mask_of(isa, &study.isa_mask, &error)) {
    complain(kProgram, error);
    return kExitUsage;
  }
  try {
    return run(study, experiments);
  } catch (const StudyError& failure) {
    complain(kProgram, failure.what());
    return kExitData;
  }
}

}  // namespace
}  // namespace bsm::bench

int main(int argc, char** argv) {
  int exit_code = bsm::bench::kExitData;
  try {
    exit_code = bsm::bench::main_program(argc, argv);
  } catch (const std::bad_alloc&) {
    bsm::bench::complain(bsm::bench::kProgram, "out of memory");
  }
  return bsm::bench::finish_output(bsm::bench::kProgram, exit_code);
}
