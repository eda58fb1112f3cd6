// The common part of the programs' command lines: parsing, help and errors under the program's own name, exit codes.
#ifndef BSM_BENCH_COMMAND_LINE_H
#define BSM_BENCH_COMMAND_LINE_H

#include <string>
#include <vector>

#include "host/options.h"

namespace bsm::bench {

constexpr int kExitOk = 0;
constexpr int kExitData = 1;   // a file or the machine stands in the way
constexpr int kExitUsage = 2;  // the command line has to change

// Parses what main got. True to go on; otherwise the help or the error is printed and *exit_code set.
bool parse_command_line(int argc, char** argv, host::Options* options, int* exit_code);

// Writes "program: message" to stderr.
void complain(const char* program, const std::string& message);

// Flushes standard output; kExitData instead of kExitOk when that fails.
int finish_output(const char* program, int exit_code);

}  // namespace bsm::bench

#endif  // BSM_BENCH_COMMAND_LINE_H
