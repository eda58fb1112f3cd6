// check.h - the test harness: named cases, checks that print file, line and both values, and skips that name their reason.
//
// A test program is any number of TEST_CASE blocks linked with check_main.cpp. It exits with 0 when every case
// passed, 1 when one failed, and 77 when every case was skipped. Each skip prints "SKIPPED: case: reason".
#ifndef BSM_TESTS_CHECK_H
#define BSM_TESTS_CHECK_H

#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>

#include "rng.h"

namespace bsm::test {

// True where the code runs several times slower than a user's build: sanitizers or no optimisation.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif
#if defined(__OPTIMIZE__) && defined(NDEBUG)
inline constexpr bool kOptimized = true;
#else
inline constexpr bool kOptimized = false;
#endif

// Scales a count of repetitions to the build and to the environment variable BSM_TEST_EFFORT (percent; 100 without it, and
// 15 in builds that are sanitized or not optimized). At least 1.
int repeats(int full);

// Seed of this run: --seed, else a constant. Printed at the start; every case makes its own generator from it.
uint64_t seed();
// True with --print: cases that hold expected values print what they measured as source text.
bool printing();

// Describes what is being checked; printed with every failure while it lives.
class Scope {
 public:
  explicit Scope(std::string text);
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;
};

struct Skip {
  std::string reason;
};
struct Stop {};  // leaves a case after a failed REQUIRE

using CaseFunction = void (*)();
struct Registrar {
  Registrar(const char* name, CaseFunction run);
};

void report_failure(const char* file, int line, const std::string& text);

// Checks that have failed since the case began.
int failures();

// What main() does.
int run_cases(int argc, char** argv);

template <typename T>
std::string text_of(const T& value) {
  std::ostringstream out;
  if constexpr (std::is_enum_v<T>) {
    out << static_cast<long long>(value);
  } else if constexpr (std::is_same_v<T, bool>) {
    out << (value ? "true" : "false");
  } else if constexpr (std::is_integral_v<T> && sizeof(T) == 1) {
    out << static_cast<int>(value);
  } else {
    out << value;
  }
  return out.str();
}

template <typename A, typename B>
bool check_equal(const A& a, const B& b, const char* a_text, const char* b_text, const char* file, int line) {
  if (a == b) return true;
  report_failure(file, line,
                 std::string(a_text) + " == " + b_text + "\n      left:  " + text_of(a) + "\n      right: " + text_of(b));
  return false;
}

template <typename A, typename B>
bool check_at_most(const A& a, const B& b, const char* a_text, const char* b_text, const char* file, int line) {
  if (a <= b) return true;
  report_failure(file, line,
                 std::string(a_text) + " <= " + b_text + "\n      left:  " + text_of(a) + "\n      right: " + text_of(b));
  return false;
}

inline bool check_true(bool value, const char* text, const char* file, int line) {
  if (!value) report_failure(file, line, text);
  return value;
}

}  // namespace bsm::test

#define TEST_CASE(name)                                               \
  static void name();                                                 \
  static const bsm::test::Registrar registrar_of_##name(#name, name); \
  static void name()

#define CHECK(condition) bsm::test::check_true((condition), #condition, __FILE__, __LINE__)
#define CHECK_EQ(a, b) bsm::test::check_equal((a), (b), #a, #b, __FILE__, __LINE__)
#define CHECK_LE(a, b) bsm::test::check_at_most((a), (b), #a, #b, __FILE__, __LINE__)
#define REQUIRE(condition)                          \
  do {                                              \
    if (!CHECK(condition)) throw bsm::test::Stop(); \
  } while (false)
#define REQUIRE_EQ(a, b)                          \
  do {                                            \
    if (!CHECK_EQ(a, b)) throw bsm::test::Stop(); \
  } while (false)
#define SKIP(reason)      \
  throw bsm::test::Skip { \
    reason                \
  }

#endif  // BSM_TESTS_CHECK_H
