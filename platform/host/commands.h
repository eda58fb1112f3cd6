// The commands of the program; each takes its arguments and returns the exit code.
#ifndef BSM_HOST_COMMANDS_H
#define BSM_HOST_COMMANDS_H

#include <string>
#include <vector>

namespace bsm::host {

constexpr int kExitOk = 0;
constexpr int kExitData = 1;   // a file or the machine stands in the way
constexpr int kExitUsage = 2;  // the command line has to change

int match_command(const std::vector<std::string>& arguments);
int evaluate_command(const std::vector<std::string>& arguments);
int info_command(const std::vector<std::string>& arguments);
int demo_command(const std::vector<std::string>& arguments);

}  // namespace bsm::host

#endif  // BSM_HOST_COMMANDS_H
