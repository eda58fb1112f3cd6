// The program bsm: finds the command and runs it.
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "bsm/bsm.h"
#include "host/commands.h"
#include "host/options.h"
#include "host/text.h"

namespace bsm::host {
namespace {

struct Command {
  const char* name;
  int (*run)(const std::vector<std::string>& arguments);
  const char* summary;
};

constexpr Command kCommands[] = {
    {"match", match_command, "disparity map of two rectified images"},
    {"evaluate", evaluate_command, "a map against ground truth: bad pixels, mean error"},
    {"info", info_command, "CPU features, kernels, memory for a size"},
    {"demo", demo_command, "render, match and measure a synthetic scene, with pictures"},
};

std::string help() {
  std::string result = "bsm: binary stereo matching, integers only\n\nusage: bsm COMMAND ...\n\ncommands:\n";
  for (const Command& command : kCommands) result += text("  %-10s%s\n", command.name, command.summary);
  return result +
         "\n'bsm COMMAND --help' says more, 'bsm --version' prints the version.\n\n"
         "  bsm match left.ppm right.ppm -o depth.png --color --disparities 64\n";
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::fputs(help().c_str(), stderr);
    return kExitUsage;
  }
  const std::string& name = arguments[0];
  if (name == "--help" || name == "-h" || name == "help") {
    std::fputs(help().c_str(), stdout);
    return kExitOk;
  }
  if (name == "--version") {
    std::printf("bsm %s\n", bsm_version());
    return kExitOk;
  }
  std::vector<std::string> names;
  for (const Command& command : kCommands) {
    if (name == command.name) return command.run(std::vector<std::string>(arguments.begin() + 1, arguments.end()));
    names.push_back(command.name);
  }
  const std::string near = nearest_name(name, names);
  print_error(name + ": unknown command" + (near.empty() ? "" : "; did you mean " + near + "?") +
              " ('bsm --help' lists them)");
  return kExitUsage;
}

int run_and_flush(const std::vector<std::string>& arguments) {
  int code = kExitData;
  try {
    code = run(arguments);
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
  }
  if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && code == kExitOk) {
    print_error("cannot write to standard output");
    code = kExitData;
  }
  return code;
}

}  // namespace
}  // namespace bsm::host

int main(int argc, char** argv) {
  return bsm::host::run_and_flush(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
}
