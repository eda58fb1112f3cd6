// fuzz_pnm.cpp - libFuzzer harness of the file readers: any bytes are read or refused, and what is read is as it claims.
//
// The first byte of the input chooses a beginning, so that most inputs get past the header.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "host/byte_source.h"
#include "host/image.h"
#include "host/pfm_read.h"
#include "host/pnm_read.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace bsm::host;
  constexpr const char* kBeginnings[] = {
      "", "P5\n", "P6\n3 2\n255\n", "P2\n", "P3\n2 2\n255\n", "P5\n4 3\n65535\n", "Pf\n", "Pf\n2 2\n-1\n"};
  std::string bytes = size > 0 ? kBeginnings[data[0] % 8] : "";
  if (size > 0) bytes.append(reinterpret_cast<const char*>(data) + 1, size - 1);
  const uint8_t* input = reinterpret_cast<const uint8_t*>(bytes.data());
  std::string error;
  ByteSource source(input, bytes.size());
  SampleImage image;
  while (read_pnm(source, "input.ppm", &image, &error)) {  // images one after the other, as on a pipe
    const size_t samples =
        static_cast<size_t>(image.width) * static_cast<size_t>(image.height) * static_cast<size_t>(image.channels);
    if (image.samples.size() != samples || samples == 0) std::abort();
    for (const uint16_t sample : image.samples) {
      if (sample > image.max_value) std::abort();
    }
    if (to_image8(image).pixels.size() != samples) std::abort();
  }
  if (error.empty()) std::abort();

  error.clear();
  ByteSource again(input, bytes.size());
  FloatImage floats;
  if (read_pfm(again, "input.pfm", &floats, &error)) {
    if (floats.pixels.size() != static_cast<size_t>(floats.width) * static_cast<size_t>(floats.height)) std::abort();
  } else if (error.empty()) {
    std::abort();
  }
  return 0;
}
