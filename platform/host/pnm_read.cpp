// Reads PGM and PPM images.
#include "host/pnm_read.h"

#include <vector>

#include "bsm/bsm.h"
#include "host/text.h"

namespace bsm::host {
namespace {

constexpr int32_t kMaxSize = BSM_MAX_SIZE;
constexpr int32_t kMaxHeaderBytes = 1 << 16;  // comments included; stops an endless header on a pipe

bool is_digit(int c) {
  return c >= '0' && c <= '9';
}

// Text part of the file: numbers between white space and comments. A comment, from '#' to the end of its line, may stand
// anywhere and counts as the line end that closes it.
class NumberReader {
 public:
  NumberReader(ByteSource& source, const std::string& name) : source_(source), name_(name) {}

  // Reads one number of at most `max_value` and the one white-space character after it.
  bool next(const char* what, int32_t max_value, int32_t* value, std::string* error) {
    int c = get();
    while (is_space(c)) c = get();
    if (!is_digit(c)) {
      *error = name_ + ": " + (c < 0 ? end_reason(what) : text("%s is not a number; the file is damaged", what));
      return false;
    }
    int32_t number = 0;
    for (; is_digit(c); c = get()) {
      number = number * 10 + (c - '0');  // at most 10 * 65535 + 9 before the check
      if (number > max_value) {
        *error = name_ + text(": %s is above %d", what, static_cast<int>(max_value));
        return false;
      }
    }
    if (c >= 0 && !is_space(c)) {
      if (header_) {
        *error = name_ + text(": %s is followed by something else than white space; the file is damaged", what);
        return false;
      }
      source_.put_back(static_cast<uint8_t>(c));  // the last sample may touch the next image on the stream
    }
    *value = number;
    return true;
  }

  // From here on no limit on the bytes read: the raster's size is known.
  void end_of_header() { header_ = false; }

 private:
  int get() {
    int c = get_raw();
    if (c == '#') {
      do c = get_raw();
      while (c >= 0 && c != '\n' && c != '\r');
    }
    return c;
  }

  int get_raw() {
    if (header_ && ++header_bytes_ > kMaxHeaderBytes) return -1;
    return source_.get();
  }

  std::string end_reason(const char* what) const {
    if (header_bytes_ > kMaxHeaderBytes)
      return text("the header is longer than %d bytes", static_cast<int>(kMaxHeaderBytes));
    if (!source_.error().empty()) return "cannot read: " + source_.error();
    return text("the file ends before %s; it is truncated", what);
  }

  ByteSource& source_;
  const std::string& name_;
  bool header_ = true;
  int32_t header_bytes_ = 0;
};

std::string truncated(const ByteSource& source, const std::string& name, const SampleImage& image, int32_t y) {
  if (!source.error().empty()) return name + ": cannot read: " + source.error();
  return name + text(": the file ends in row %d of %d (%d x %d pixels); it is truncated", static_cast<int>(y + 1),
                     static_cast<int>(image.height), static_cast<int>(image.width), static_cast<int>(image.height));
}

std::string above_max(const std::string& name, const SampleImage& image, int32_t y) {
  return name + text(": a sample in row %d is above the maximum %d that the header states; the file is damaged",
                     static_cast<int>(y + 1), static_cast<int>(image.max_value));
}

bool read_binary_raster(ByteSource& source, const std::string& name, SampleImage* image, std::string* error) {
  const size_t row_samples = static_cast<size_t>(image->width) * static_cast<size_t>(image->channels);
  const bool wide = image->max_value > 255;
  std::vector<uint8_t> bytes(row_samples * (wide ? 2 : 1));
  for (int32_t y = 0; y < image->height; ++y) {
    if (source.read(bytes.data(), bytes.size()) != bytes.size()) {
      *error = truncated(source, name, *image, y);
      return false;
    }
    for (size_t i = 0; i < row_samples; ++i) {
      const int32_t sample = wide ? bytes[2 * i] * 256 + bytes[2 * i + 1] : bytes[i];
      if (sample > image->max_value) {
        *error = above_max(name, *image, y);
        return false;
      }
      image->samples.push_back(static_cast<uint16_t>(sample));
    }
  }
  return true;
}

bool read_ascii_raster(NumberReader& numbers, SampleImage* image, std::string* error) {
  const size_t row_samples = static_cast<size_t>(image->width) * static_cast<size_t>(image->channels);
  for (int32_t y = 0; y < image->height; ++y) {
    const std::string what = text("a sample in row %d of %d", static_cast<int>(y + 1), static_cast<int>(image->height));
    for (size_t i = 0; i < row_samples; ++i) {
      int32_t sample = 0;
      if (!numbers.next(what.c_str(), image->max_value, &sample, error)) return false;
      image->samples.push_back(static_cast<uint16_t>(sample));
    }
  }
  return true;
}

const char* format_of_bytes(int first, int second) {
  if (first == 0x89 && second == 'P') return "PNG";
  if (first == 0xff && second == 0xd8) return "JPEG";
  if (first == 'G' && second == 'I') return "GIF";
  if (first == 'B' && second == 'M') return "BMP";
  if (first == 'R' && second == 'I') return "WebP";
  if ((first == 'I' && second == 'I') || (first == 'M' && second == 'M')) return "TIFF";
  return nullptr;
}

const char* format_of_extension(const std::string& name) {
  const std::string extension = lower_extension(name);
  if (extension == "png") return "PNG";
  if (extension == "jpg" || extension == "jpeg") return "JPEG";
  return nullptr;
}

}  // namespace

std::string not_pnm_message(const std::string& name, int first, int second, const char* wanted) {
  const char* by_content = format_of_bytes(first, second);
  const char* format = by_content != nullptr ? by_content : format_of_extension(name);
  if (format != nullptr) {
    const bool piped = name == kStandardInput;
    const std::string from = piped ? "image." + lower_extension(std::string("x.") + format) : name;
    const std::string to = with_extension(from, wanted);
    const std::string words = shell_word(from) + " " + shell_word(to);
    return name + ": a " + format + " file" + (by_content != nullptr ? "" : " by its name") +
           ", which bsm does not read. Convert it with ImageMagick, or else with ffmpeg, and give " +
           (piped ? "the result" : to) + ":\n  convert " + words + "\n  ffmpeg -i " + words;
  }
  if (first == 'P' && (second == 'f' || second == 'F'))
    return name + ": this is a PFM file, where a PGM or PPM image belongs";
  if (first == 'P' && (second == '1' || second == '4' || second == '7')) {
    return name + text(": this is a P%c file (bitmap or PAM), which bsm does not read; convert it to PGM or PPM", second);
  }
  return name + ": neither a PGM nor a PPM image (P2, P3, P5, P6)";
}

bool read_pnm(ByteSource& source, const std::string& name, SampleImage* image, std::string* error, const char* wanted) {
  *image = SampleImage();
  int first = source.get();
  while (is_space(first)) first = source.get();  // line ends after an ASCII image that came before on this stream
  if (first < 0) {
    *error =
        name + ": " + (source.error().empty() ? "no image there: the file has ended" : "cannot read: " + source.error());
    return false;
  }
  const int kind = source.get();
  if (first != 'P' || (kind != '2' && kind != '3' && kind != '5' && kind != '6')) {
    *error = not_pnm_message(name, first, kind, wanted);
    return false;
  }
  image->channels = kind == '3' || kind == '6' ? 3 : 1;

  NumberReader numbers(source, name);
  if (!numbers.next("the width", kMaxSize, &image->width, error) ||
      !numbers.next("the height", kMaxSize, &image->height, error) ||
      !numbers.next("the maximum sample value", 65535, &image->max_value, error)) {
    return false;
  }
  if (image->width < 1 || image->height < 1 || image->max_value < 1) {
    *error = name + ": the width, the height or the maximum sample value is 0";
    return false;
  }
  numbers.end_of_header();
  return kind <= '3' ? read_ascii_raster(numbers, image, error) : read_binary_raster(source, name, image, error);
}

bool read_pnm_file(const std::string& path, SampleImage* image, std::string* error, const char* wanted) {
  InputFile file;
  if (!file.open(path, error)) return false;
  ByteSource source(file.stream());
  return read_pnm(source, path == "-" ? kStandardInput : path, image, error, wanted);
}

}  // namespace bsm::host
