// Command-line options from a table.
#include "host/options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "host/text.h"

namespace bsm::host {
namespace {

constexpr size_t kHelpColumn = 28;
constexpr size_t kMinPrefix = 5;  // letters that name an option by its beginning

// Fewest insertions, deletions and replacements of a letter that turn a into b.
size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min(replaced, std::min(row[j], row[j - 1]) + 1);
    }
  }
  return row[b.size()];
}

bool parse_number(const std::string& text, double* value) {
  if (text.empty() || text[0] == ' ') return false;
  char* end = nullptr;
  *value = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(*value);
}

std::string choice_names(const std::vector<Choice>& choices) {
  std::string names;
  for (const Choice& choice : choices) names += (names.empty() ? "" : "|") + std::string(choice.name);
  return names;
}

}  // namespace

bool parse_integer(const std::string& text, int32_t min, int32_t max, int32_t* value) {
  const bool negative = !text.empty() && text[0] == '-';
  const size_t first = negative || (!text.empty() && text[0] == '+') ? 1 : 0;
  if (first == text.size()) return false;
  int64_t number = 0;
  for (size_t i = first; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') return false;
    number = number * 10 + (text[i] - '0');
    if (number > INT32_MAX) return false;
  }
  if (negative) number = -number;
  if (number < min || number > max) return false;
  *value = static_cast<int32_t>(number);
  return true;
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
  std::string best;
  size_t best_distance = 1 + name.size() / 4;  // how many letters may be wrong
  for (const std::string& candidate : names) {
    const bool begins = name.size() >= kMinPrefix && candidate.compare(0, name.size(), name) == 0;
    const size_t distance = begins ? 0 : edit_distance(name, candidate);
    if (distance <= best_distance && (best.empty() || distance < best_distance)) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

Options::Option& Options::add(Kind kind, const char* name, const char* value_name, void* target, const char* help) {
  options_.emplace_back();
  Option& option = options_.back();
  option.kind = kind;
  option.name = name;
  option.value_name = value_name;
  option.target = target;
  option.help = help;
  return option;
}

void Options::flag(const char* name, bool* target, const char* help) {
  add(Kind::kFlag, name, "", target, help);
}

void Options::integer(const char* name, const char* value_name, int32_t* target, int32_t min, int32_t max,
                      const char* help) {
  Option& option = add(Kind::kInteger, name, value_name, target, help);
  option.min = min;
  option.max = max;
  if (*target >= min && *target <= max) option.default_text = text("%d", static_cast<int>(*target));
}

void Options::number(const char* name, const char* value_name, double* target, double min, bool above_min,
                     const char* help) {
  Option& option = add(Kind::kNumber, name, value_name, target, help);
  option.number_min = min;
  option.above_min = above_min;
  if (*target > min || (!above_min && *target >= min)) option.default_text = text("%g", *target);
}

void Options::word(const char* name, const char* value_name, std::string* target, const char* help) {
  add(Kind::kWord, name, value_name, target, help).default_text = *target;
}

void Options::words(const char* name, const char* value_name, std::vector<std::string>* target, const char* help) {
  add(Kind::kWords, name, value_name, target, help);
}

void Options::choice(const char* name, int32_t* target, std::vector<Choice> choices, const char* help) {
  Option& option = add(Kind::kChoice, name, choice_names(choices).c_str(), target, help);
  for (const Choice& choice : choices) {
    if (choice.value == *target) option.default_text = choice.name;
  }
  option.choices = std::move(choices);
}

void Options::positional(const char* value_name, std::string* target) {
  positionals_.push_back({value_name, target});
}

bool Options::fail(const std::string& message) {
  error_ = std::string(command_) + ": " + message + " ('bsm " + command_ + " --help' says more)";
  return false;
}

Options::Option* Options::find(const std::string& name) {
  for (Option& option : options_) {
    if (name == option.name || (option.other_name[0] != '\0' && name == option.other_name)) return &option;
  }
  return nullptr;
}

std::string Options::nearest(const std::string& name) const {
  std::vector<std::string> names = {"--help"};
  for (const Option& option : options_) names.push_back(option.name);
  return nearest_name(name, names);
}

bool Options::given(const char* name) const {
  for (const Option& option : options_) {
    if (std::strcmp(option.name, name) == 0) return option.given;
  }
  return false;
}

bool Options::store(Option* option, const std::string& value) {
  const std::string named = std::string(option->name) + " '" + value + "': ";
  switch (option->kind) {
    case Kind::kFlag:
      return fail(std::string(option->name) + " takes no value");
    case Kind::kInteger:
      if (parse_integer(value, option->min, option->max, static_cast<int32_t*>(option->target))) return true;
      return fail(named +
                  text("not a whole number within %d..%d", static_cast<int>(option->min), static_cast<int>(option->max)));
    case Kind::kNumber: {
      double number = 0.0;
      const double min = option->number_min;
      if (!parse_number(value, &number) || (option->above_min ? number <= min : number < min)) {
        return fail(named + text("not a number %s %g", option->above_min ? "above" : "of at least", min));
      }
      *static_cast<double*>(option->target) = number;
      return true;
    }
    case Kind::kWord:
    case Kind::kWords:
      if (value.empty()) return fail(std::string(option->name) + " needs a value that is not empty");
      if (option->kind == Kind::kWord) {
        *static_cast<std::string*>(option->target) = value;
      } else {
        static_cast<std::vector<std::string>*>(option->target)->push_back(value);
      }
      return true;
    case Kind::kChoice:
      for (const Choice& choice : option->choices) {
        if (value == choice.name) {
          *static_cast<int32_t*>(option->target) = choice.value;
          return true;
        }
      }
      return fail(named + "must be one of " + choice_names(option->choices));
  }
  return false;
}

Options::Result Options::parse(const std::vector<std::string>& arguments) {
  size_t positional = 0;
  bool options_end = false;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!options_end && (argument == "--help" || argument == "-h")) return Result::kHelp;
    if (!options_end && argument == "--") {
      options_end = true;
      continue;
    }
    if (options_end || argument.size() < 2 || argument[0] != '-') {
      if (positional == positionals_.size()) {
        fail("'" + argument + "': one argument too many");
        return Result::kError;
      }
      *positionals_[positional++].target = argument;
      continue;
    }
    const size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    Option* option = find(name);
    if (option == nullptr) {
      const std::string near = nearest(name);
      fail(name + ": unknown option" + (near.empty() ? "" : "; did you mean " + near + "?"));
      return Result::kError;
    }
    option->given = true;
    if (option->kind == Kind::kFlag && equals == std::string::npos) {
      *static_cast<bool*>(option->target) = true;
      continue;
    }
    std::string value;
    if (equals != std::string::npos) {
      value = argument.substr(equals + 1);
    } else if (i + 1 == arguments.size() || find(arguments[i + 1]) != nullptr) {
      fail(name + " needs a value, " + option->value_name);
      return Result::kError;
    } else {
      value = arguments[++i];
    }
    if (!store(option, value)) return Result::kError;
  }
  if (positional < positionals_.size()) {
    fail(std::string(positionals_[positional].value_name) + " is missing; usage: bsm " + usage_);
    return Result::kError;
  }
  return Result::kRun;
}

std::string Options::help() const {
  std::string result = std::string("usage: bsm ") + usage_ + "\n\n" + summary_ + "\n\noptions:\n";
  for (const Option& option : options_) {
    std::string left = "  ";
    if (option.other_name[0] != '\0') left += std::string(option.other_name) + ", ";
    left += option.name;
    if (!option.value_name.empty()) left += " " + option.value_name;
    if (left.size() + 2 > kHelpColumn) {
      left += "\n" + std::string(kHelpColumn, ' ');
    } else {
      left.resize(kHelpColumn, ' ');
    }
    result += left + option.help;
    if (!option.default_text.empty()) result += " [" + option.default_text + "]";
    result += "\n";
  }
  return result + "  --help                    this text\n";
}

}  // namespace bsm::host
