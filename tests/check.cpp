// check.cpp - runs the cases of one test program: options, the seed, the count of failures and the exit code.
#include "check.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace bsm::test {
namespace {

constexpr int kExitSkipped = 77;
constexpr int kFailuresShown = 10;  // per case; the rest are counted

struct Case {
  const char* name;
  CaseFunction run;
};

// Function-local, because registrars run before main in an order that is fixed within one file only.
std::vector<Case>& cases() {
  static std::vector<Case> list;
  return list;
}
std::vector<std::string>& scopes() {
  static std::vector<std::string> list;
  return list;
}

uint64_t run_seed = 20120611;
bool print_values = false;
int case_failures = 0;

const char* option_value(int argc, char** argv, int& i) {
  if (i + 1 >= argc) {
    std::fprintf(stderr, "%s needs a value\n", argv[i]);
    std::exit(2);
  }
  return argv[++i];
}

enum class Result { kPassed, kFailed, kSkipped };

Result run_case(const Case& test) {
  case_failures = 0;
  scopes().clear();
  try {
    test.run();
  } catch (const Skip& skip) {
    if (case_failures == 0) {
      std::printf("SKIPPED: %s: %s\n", test.name, skip.reason.c_str());
      return Result::kSkipped;
    }
  } catch (const Stop&) {
  } catch (const std::exception& error) {
    report_failure("exception", 0, error.what());
  }
  if (case_failures > kFailuresShown) std::printf("    ... %d failures in this case\n", case_failures);
  std::printf("%s: %s\n", case_failures ? "FAILED" : "ok", test.name);
  return case_failures ? Result::kFailed : Result::kPassed;
}

}  // namespace

int repeats(int full) {
  const char* text = std::getenv("BSM_TEST_EFFORT");
  const long percent = text ? std::strtol(text, nullptr, 10) : (kSanitized || !kOptimized) ? 15 : 100;
  return static_cast<int>(std::max(1L, static_cast<long>(full) * std::clamp(percent, 1L, 10000L) / 100));
}

uint64_t seed() {
  return run_seed;
}
bool printing() {
  return print_values;
}

Scope::Scope(std::string text) {
  scopes().push_back(std::move(text));
}
Scope::~Scope() {
  scopes().pop_back();
}

Registrar::Registrar(const char* name, CaseFunction run) {
  cases().push_back({name, run});
}

void report_failure(const char* file, int line, const std::string& text) {
  if (++case_failures > kFailuresShown) return;
  std::printf("  %s:%d: check failed: %s\n", file, line, text.c_str());
  for (const std::string& scope : scopes()) std::printf("      with %s\n", scope.c_str());
  std::fflush(stdout);
}

int failures() {
  return case_failures;
}

int run_cases(int argc, char** argv) {
  std::string filter;
  bool list_only = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--filter") {
      filter = option_value(argc, argv, i);
    } else if (option == "--seed") {
      run_seed = std::strtoull(option_value(argc, argv, i), nullptr, 0);
    } else if (option == "--list") {
      list_only = true;
    } else if (option == "--print") {
      print_values = true;
    } else {
      std::fprintf(stderr,
                   "usage: %s [--filter TEXT] [--seed N] [--list] [--print]\n"
                   "  --filter TEXT  only the cases whose name contains TEXT\n"
                   "  --seed N       another seed for the random inputs\n"
                   "  --list         names of the cases\n"
                   "  --print        print measured values as source text (where a case has expected values)\n",
                   argv[0]);
      return option == "--help" ? 0 : 2;
    }
  }

  int passed = 0, failed = 0, skipped = 0;
  if (!list_only) std::printf("seed %llu\n", static_cast<unsigned long long>(seed()));
  for (const Case& test : cases()) {
    if (std::string(test.name).find(filter) == std::string::npos) continue;
    if (list_only) {
      std::printf("%s\n", test.name);
      ++passed;
      continue;
    }
    switch (run_case(test)) {
      case Result::kPassed:
        ++passed;
        break;
      case Result::kFailed:
        ++failed;
        break;
      case Result::kSkipped:
        ++skipped;
        break;
    }
    std::fflush(stdout);
  }
  if (list_only) return passed > 0 ? 0 : 2;
  if (passed + failed + skipped == 0) {
    std::fprintf(stderr, "no case has '%s' in its name; --list shows the names\n", filter.c_str());
    return 2;
  }
  std::printf("%d passed, %d failed, %d skipped\n", passed, failed, skipped);
  if (failed) return 1;
  return passed == 0 ? kExitSkipped : 0;
}

}  // namespace bsm::test
