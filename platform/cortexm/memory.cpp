// The memory functions that compilers call, for images without a C library.
#include <stddef.h>
#include <stdint.h>

namespace {

// A word that may stand for any object's bytes.
typedef uint32_t __attribute__((may_alias)) Word;

bool aligned(const void* pointer) {
  return (reinterpret_cast<uintptr_t>(pointer) & (sizeof(Word) - 1)) == 0;
}

}  // namespace

extern "C" void* memcpy(void* to, const void* from, size_t bytes) {
  uint8_t* target = static_cast<uint8_t*>(to);
  const uint8_t* source = static_cast<const uint8_t*>(from);
  if (aligned(target) && aligned(source)) {
    for (; bytes >= sizeof(Word); bytes -= sizeof(Word), target += sizeof(Word), source += sizeof(Word)) {
      *reinterpret_cast<Word*>(target) = *reinterpret_cast<const Word*>(source);
    }
  }
  while (bytes-- != 0) *target++ = *source++;
  return to;
}

extern "C" void* memmove(void* to, const void* from, size_t bytes) {
  uint8_t* target = static_cast<uint8_t*>(to);
  const uint8_t* source = static_cast<const uint8_t*>(from);
  if (target <= source || source + bytes <= target) return memcpy(to, from, bytes);
  while (bytes-- != 0) target[bytes] = source[bytes];
  return to;
}

extern "C" void* memset(void* to, int value, size_t bytes) {
  uint8_t* target = static_cast<uint8_t*>(to);
  const uint8_t byte = static_cast<uint8_t>(value);
  if (aligned(target)) {
    const Word word = byte * 0x01010101u;
    for (; bytes >= sizeof(Word); bytes -= sizeof(Word), target += sizeof(Word)) *reinterpret_cast<Word*>(target) = word;
  }
  while (bytes-- != 0) *target++ = byte;
  return to;
}
