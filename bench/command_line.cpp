// Command lines of the measuring programs.
#include "bench/command_line.h"

#include <cstdio>

namespace bsm::bench {
namespace {

// The options speak of "bsm COMMAND"; these programs stand alone.
std::string own_name(std::string message) {
  for (const std::string prefix : {"bsm bsm_", "bsm compare_"}) {
    for (size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix, at)) message.erase(at, 4);
  }
  return message;
}

}  // namespace

bool parse_command_line(int argc, char** argv, host::Options* options, int* exit_code) {
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  switch (options->parse(arguments)) {
    case host::Options::Result::kHelp:
      std::fputs(own_name(options->help()).c_str(), stdout);
      *exit_code = kExitOk;
      return false;
    case host::Options::Result::kError:
      std::fprintf(stderr, "%s\n", own_name(options->error()).c_str());
      *exit_code = kExitUsage;
      return false;
    case host::Options::Result::kRun:
      break;
  }
  return true;
}

void complain(const char* program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program, message.c_str());
}

int finish_output(const char* program, int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  complain(program, "cannot write to standard output");
  return exit_code == kExitOk ? kExitData : exit_code;
}

}  // namespace bsm::bench
