// Words and numbers as text, for images without a C library.
#ifndef BSM_CORTEXM_TEXT_H
#define BSM_CORTEXM_TEXT_H

#include <stdint.h>

namespace bsm::cortexm {

// Each appends at `end`, which has to have room, and returns the new end. Nothing ends the text with a zero.
char* append_text(char* end, const char* text);
char* append_decimal(char* end, uint32_t number);
char* append_hex(char* end, uint64_t number);

bool same_text(const char* a, const char* b);

// Ends the words of a text with zeros, in place; returns how many there are, `most` at most.
int32_t split_words(char* text, char** words, int32_t most);

}  // namespace bsm::cortexm

#endif  // BSM_CORTEXM_TEXT_H
