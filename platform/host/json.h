// Builds JSON text, in the order of the calls.
#ifndef BSM_HOST_JSON_H
#define BSM_HOST_JSON_H

#include <cstdint>
#include <string>

namespace bsm::host {

class JsonObject {
 public:
  JsonObject& add(const char* name, const std::string& value);
  JsonObject& add(const char* name, const char* value) { return add(name, std::string(value)); }
  JsonObject& add(const char* name, int64_t value);
  JsonObject& add(const char* name, double value);  // null when it is not finite
  JsonObject& add(const char* name, bool value);
  // An object or array that is JSON text already.
  JsonObject& add_json(const char* name, const std::string& json);

  std::string str() const { return "{" + members_ + "}"; }

 private:
  std::string members_;
};

class JsonArray {
 public:
  JsonArray& add_json(const std::string& json);
  std::string str() const { return "[" + elements_ + "]"; }

 private:
  std::string elements_;
};

// The string as a JSON literal. Bytes of UTF-8 pass as they are.
std::string json_string(const std::string& value);

}  // namespace bsm::host

#endif  // BSM_HOST_JSON_H
