// Builds JSON text.
#include "host/json.h"

#include <cinttypes>
#include <cmath>

#include "host/text.h"

namespace bsm::host {

std::string json_string(const std::string& value) {
  std::string literal = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') {
      literal += '\\';
      literal += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      literal += text("\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      literal += c;
    }
  }
  return literal + "\"";
}

JsonObject& JsonObject::add_json(const char* name, const std::string& json) {
  if (!members_.empty()) members_ += ", ";
  members_ += json_string(name) + ": " + json;
  return *this;
}

JsonObject& JsonObject::add(const char* name, const std::string& value) {
  return add_json(name, json_string(value));
}

JsonObject& JsonObject::add(const char* name, int64_t value) {
  return add_json(name, text("%" PRId64, value));
}

JsonObject& JsonObject::add(const char* name, double value) {
  return add_json(name, std::isfinite(value) ? text("%.6g", value) : "null");
}

JsonObject& JsonObject::add(const char* name, bool value) {
  return add_json(name, value ? "true" : "false");
}

JsonArray& JsonArray::add_json(const std::string& json) {
  if (!elements_.empty()) elements_ += ", ";
  elements_ += json;
  return *this;
}

}  // namespace bsm::host
