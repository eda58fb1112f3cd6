// Words and numbers as text.
#include "cortexm/text.h"

namespace bsm::cortexm {

char* append_text(char* end, const char* text) {
  while (*text != 0) *end++ = *text++;
  return end;
}

char* append_decimal(char* end, uint32_t number) {
  if (number >= 10) end = append_decimal(end, number / 10);
  *end = static_cast<char>('0' + number % 10);
  return end + 1;
}

char* append_hex(char* end, uint64_t number) {
  end = append_text(end, "0x");
  for (int32_t shift = 60; shift >= 0; shift -= 4) *end++ = "0123456789abcdef"[number >> shift & 15];
  return end;
}

bool same_text(const char* a, const char* b) {
  for (; *a == *b; ++a, ++b) {
    if (*a == 0) return true;
  }
  return false;
}

int32_t split_words(char* text, char** words, int32_t most) {
  int32_t count = 0;
  while (*text != 0 && count < most) {
    if (*text == ' ') {
      *text++ = 0;
      continue;
    }
    words[count++] = text;
    while (*text != 0 && *text != ' ') ++text;
  }
  return count;
}

}  // namespace bsm::cortexm
