// json_check.h - a strict reader of JSON for the tests: whether a text is valid, and the members of its outermost object.
#ifndef BSM_TESTS_JSON_CHECK_H
#define BSM_TESTS_JSON_CHECK_H

#include <cctype>
#include <map>
#include <string>

namespace bsm::test {

class JsonCheck {
 public:
  explicit JsonCheck(const std::string& text) : text_(text) {
    skip_space();
    valid_ = object(&members_);
    skip_space();
    valid_ = valid_ && at_ == text_.size();
  }
  bool valid() const { return valid_; }
  // The text of a member's value; empty when there is no such member. Strings keep their quotes.
  std::string member(const std::string& name) const {
    const auto it = members_.find(name);
    return it == members_.end() ? std::string() : it->second;
  }
  double number(const std::string& name) const {
    const std::string text = member(name);
    return text.empty() ? -1e300 : std::stod(text);
  }

 private:
  bool peek(char c) const { return at_ < text_.size() && text_[at_] == c; }
  bool take(char c) {
    if (!peek(c)) return false;
    ++at_;
    return true;
  }
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t' || text_[at_] == '\r'))
      ++at_;
  }
  bool digits() {
    const size_t first = at_;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ > first;
  }
  bool number_value() {
    take('-');
    if (!take('0') && !digits()) return false;
    if (take('.') && !digits()) return false;
    if (take('e') || take('E')) {
      if (!take('+')) take('-');
      if (!digits()) return false;
    }
    return true;
  }
  bool word(const std::string& expected) {
    if (text_.compare(at_, expected.size(), expected) != 0) return false;
    at_ += expected.size();
    return true;
  }
  bool string_value() {
    if (!take('"')) return false;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) return false;
      if (text_[at_++] != '\\') continue;
      if (at_ == text_.size()) return false;
      const char escaped = text_[at_++];
      if (escaped == 'u') {
        for (int i = 0; i < 4; ++i) {
          if (at_ == text_.size() || !std::isxdigit(static_cast<unsigned char>(text_[at_++]))) return false;
        }
      } else if (std::string("\"\\/bfnrt").find(escaped) == std::string::npos) {
        return false;
      }
    }
    return take('"');
  }
  bool array() {
    if (!take('[')) return false;
    skip_space();
    if (take(']')) return true;
    do {
      skip_space();
      if (!value()) return false;
      skip_space();
    } while (take(','));
    return take(']');
  }
  bool object(std::map<std::string, std::string>* members) {
    if (!take('{')) return false;
    skip_space();
    if (take('}')) return true;
    do {
      skip_space();
      const size_t name = at_;
      if (!string_value()) return false;
      const std::string key = text_.substr(name + 1, at_ - name - 2);
      skip_space();
      if (!take(':')) return false;
      skip_space();
      const size_t first = at_;
      if (!value()) return false;
      if (members && !members->emplace(key, text_.substr(first, at_ - first)).second) return false;  // a name twice
      skip_space();
    } while (take(','));
    return take('}');
  }
  bool value() {
    if (peek('{')) return object(nullptr);
    if (peek('[')) return array();
    if (peek('"')) return string_value();
    return word("true") || word("false") || word("null") || number_value();
  }

  std::string text_;
  size_t at_ = 0;
  bool valid_ = false;
  std::map<std::string, std::string> members_;
};

}  // namespace bsm::test

#endif  // BSM_TESTS_JSON_CHECK_H
