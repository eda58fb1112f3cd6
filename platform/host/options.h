// Command-line options from a table: "--name value", "--name=value", flags, positional arguments, help text.
#ifndef BSM_HOST_OPTIONS_H
#define BSM_HOST_OPTIONS_H

#include <cstdint>
#include <string>
#include <vector>

namespace bsm::host {

// A word that stands for a number.
struct Choice {
  const char* name;
  int32_t value;
};

class Options {
 public:
  // `usage` follows "bsm " in the help's first line.
  Options(const char* command, const char* usage, const char* summary)
      : command_(command), usage_(usage), summary_(summary) {}

  // Each target keeps its value unless the option is given; the help shows that value as the default, if the option could
  // give it. Names begin with "--"; `help` is one line. A `value_name` is what the help calls the value.
  void flag(const char* name, bool* target, const char* help);
  void integer(const char* name, const char* value_name, int32_t* target, int32_t min, int32_t max, const char* help);
  // A finite number, at least `min`, or above it when above_min.
  void number(const char* name, const char* value_name, double* target, double min, bool above_min, const char* help);
  void word(const char* name, const char* value_name, std::string* target, const char* help);
  void words(const char* name, const char* value_name, std::vector<std::string>* target, const char* help);
  void choice(const char* name, int32_t* target, std::vector<Choice> choices, const char* help);
  // A second name, such as "-o", of the option added last.
  void also(const char* name) { options_.back().other_name = name; }
  // Positional arguments in order; all are required.
  void positional(const char* value_name, std::string* target);

  enum class Result { kRun, kHelp, kError };
  // Reads arguments[0..]; kHelp when --help is among them (then help() is what to print), kError with error() otherwise.
  Result parse(const std::vector<std::string>& arguments);
  bool given(const char* name) const;

  // One line that says what is wrong and where the help is.
  const std::string& error() const { return error_; }
  std::string help() const;

 private:
  enum class Kind { kFlag, kInteger, kNumber, kWord, kWords, kChoice };
  struct Option {
    Kind kind = Kind::kFlag;
    const char* name = "";
    const char* other_name = "";
    std::string value_name;
    const char* help = "";
    std::string default_text;
    void* target = nullptr;
    int32_t min = 0, max = 0;
    double number_min = 0.0;
    bool above_min = false;
    std::vector<Choice> choices;
    bool given = false;
  };
  struct Positional {
    const char* value_name;
    std::string* target;
  };

  Option& add(Kind kind, const char* name, const char* value_name, void* target, const char* help);
  Option* find(const std::string& name);
  std::string nearest(const std::string& name) const;
  bool store(Option* option, const std::string& value);
  bool fail(const std::string& message);

  const char* command_;
  const char* usage_;
  const char* summary_;
  std::vector<Option> options_;
  std::vector<Positional> positionals_;
  std::string error_;
};

// The whole text as a decimal integer within min..max.
bool parse_integer(const std::string& text, int32_t min, int32_t max, int32_t* value);

// The one of `names` that begins with `name` or differs from it in the fewest letters; empty when none is near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

}  // namespace bsm::host

#endif  // BSM_HOST_OPTIONS_H
