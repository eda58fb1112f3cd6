// Reads disparity maps from files.
#include "host/disparity_file.h"

#include <cmath>

#include "bsm/bsm.h"
#include "host/byte_source.h"
#include "host/image.h"
#include "host/pfm_read.h"
#include "host/pnm_read.h"
#include "host/text.h"

namespace bsm::host {
namespace {

// A file as it stands: either floats or samples.
struct AnyMap {
  bool is_pfm = false;
  FloatImage floats;
  SampleImage samples;
};

bool read_any(const std::string& path, AnyMap* map, std::string* error) {
  InputFile file;
  if (!file.open(path, error)) return false;
  ByteSource source(file.stream());
  const std::string name = path == "-" ? kStandardInput : path;
  const int first = source.get();
  const int second = first < 0 ? -1 : source.get();
  map->is_pfm = first == 'P' && (second == 'f' || second == 'F');
  if (second >= 0) source.put_back(static_cast<uint8_t>(second));
  if (first >= 0) source.put_back(static_cast<uint8_t>(first));
  if (map->is_pfm) return read_pfm(source, name, &map->floats, error);
  if (!read_pnm(source, name, &map->samples, error, "pgm")) return false;
  if (map->samples.channels != 1) {
    *error = name + ": a colour image, where a disparity map (.pfm or .pgm) belongs";
    return false;
  }
  return true;
}

DisparityMap from_floats(const FloatImage& image) {
  DisparityMap map{image.width, image.height, image.pixels};
  for (float& value : map.pixels) {
    if (!std::isfinite(value)) value = kNoDisparity;
  }
  return map;
}

// value / scale, with one sample value that means "none".
DisparityMap from_samples(const SampleImage& image, double scale, int32_t none) {
  DisparityMap map{image.width, image.height, {}};
  map.pixels.reserve(image.samples.size());
  for (const uint16_t sample : image.samples) {
    map.pixels.push_back(sample == none ? kNoDisparity : static_cast<float>(sample / scale));
  }
  return map;
}

}  // namespace

DisparityMap disparity_map(const int16_t* values, int32_t width, int32_t height, int16_t invalid) {
  DisparityMap map{width, height, {}};
  const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
  map.pixels.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    map.pixels.push_back(values[i] == invalid ? kNoDisparity
                                              : static_cast<float>(values[i]) / static_cast<float>(BSM_DISPARITY_SCALE));
  }
  return map;
}

MapRead read_result(const std::string& path, double scale, DisparityMap* map, std::string* error) {
  AnyMap any;
  if (!read_any(path, &any, error)) return MapRead::kBadFile;
  const bool wide = !any.is_pfm && any.samples.max_value > 255;
  if ((any.is_pfm || wide) && scale > 0.0) {
    *error = path + (wide ? ": a 16-bit PGM holds 1/16 pixel" : ": a PFM holds pixels") +
             "; --disparity-scale is for 8-bit PGM alone, leave it out";
    return MapRead::kBadScale;
  }
  if (!any.is_pfm && !wide && !(scale > 0.0)) {
    *error = path + ": an 8-bit PGM; say with --disparity-scale what its values were multiplied by";
    return MapRead::kBadScale;
  }
  if (any.is_pfm) {
    *map = from_floats(any.floats);
  } else if (wide) {
    *map = from_samples(any.samples, BSM_DISPARITY_SCALE, 65535);
  } else {
    *map = from_samples(any.samples, scale, 0);
  }
  return MapRead::kDone;
}

MapRead read_truth(const std::string& path, double scale, DisparityMap* map, std::string* error) {
  AnyMap any;
  if (!read_any(path, &any, error)) return MapRead::kBadFile;
  if (any.is_pfm && scale > 0.0) {
    *error = path + ": a PFM holds pixels; leave out --scale";
    return MapRead::kBadScale;
  }
  if (!any.is_pfm && !(scale > 0.0)) {
    *error = path + ": a PGM; say with --scale what its values were multiplied by (true disparity = value / scale)";
    return MapRead::kBadScale;
  }
  *map = any.is_pfm ? from_floats(any.floats) : from_samples(any.samples, scale, 0);
  return MapRead::kDone;
}

}  // namespace bsm::host
