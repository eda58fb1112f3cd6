// Finds and reads pairs.
#include "bench/pair_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "bench/truth_regions.h"
#include "host/pnm_read.h"
#include "host/text.h"

namespace bsm::bench {
namespace {

namespace fs = std::filesystem;
using host::text;

bool is_pair(const fs::path& folder) {
  std::error_code failure;
  return fs::is_regular_file(folder / "left.ppm", failure);
}

bool present(const fs::path& path) {
  std::error_code failure;
  return fs::exists(path, failure);
}

void find_pairs(const fs::path& folder, int levels, std::vector<fs::path>* found) {
  if (is_pair(folder)) {
    found->push_back(folder);
    return;
  }
  if (levels == 0) return;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.is_directory(failure)) find_pairs(entry.path(), levels - 1, found);
  }
}

std::string folder_name(const fs::path& folder) {
  const fs::path absolute = fs::absolute(folder).lexically_normal();
  return absolute.has_filename() ? absolute.filename().string() : absolute.parent_path().filename().string();
}

bool read_view(const fs::path& path, bool gray, host::Image8* image, std::string* error) {
  host::SampleImage samples;
  if (!host::read_pnm_file(path.string(), &samples, error)) return false;
  *image = host::to_image8(samples);
  if (gray) *image = to_gray(*image);
  return true;
}

bool same_size(const fs::path& path, int32_t width, int32_t height, const Pair& pair, std::string* error) {
  if (width == pair.left.width && height == pair.left.height) return true;
  *error =
      path.string() + text(": %d x %d pixels, but left.ppm has %d x %d", static_cast<int>(width), static_cast<int>(height),
                           static_cast<int>(pair.left.width), static_cast<int>(pair.left.height));
  return false;
}

bool read_mask(const fs::path& path, const Pair& pair, host::Mask* mask, std::string* error) {
  host::SampleImage image;
  if (!host::read_pnm_file(path.string(), &image, error)) return false;
  if (image.channels != 1 || image.max_value != 255) {
    *error = path.string() + ": a mask is an 8-bit PGM, where 255 means that the pixel counts";
    return false;
  }
  if (!same_size(path, image.width, image.height, pair, error)) return false;
  mask->assign(image.samples.size(), 0);
  for (size_t i = 0; i < image.samples.size(); ++i) (*mask)[i] = static_cast<uint8_t>(image.samples[i]);
  return true;
}

// What to write when a folder is in no table: the guess that its own truth suggests.
std::string unlisted(const fs::path& folder) {
  std::string message = folder.string() + ": no table lists this pair; add a line '" + folder_name(folder) +
                        " DISPARITIES SCALE' to a pairs.txt in the folder that is measured (true disparity = value / SCALE)";
  host::SampleImage truth;
  std::string ignored;
  if (!host::read_pnm_file((folder / "disparity.pgm").string(), &truth, &ignored)) return message;
  const int largest = *std::max_element(truth.samples.begin(), truth.samples.end());
  const int scale = truth.width < 700 ? 3 : truth.width < 1000 ? 2 : 1;  // third, half and full size of the later sets
  return message + text("; its largest value is %d, so '%s %d %d' if the scale is %d", largest, folder_name(folder).c_str(),
                        largest / scale + 1, scale, scale);
}

bool read_regions(const fs::path& folder, Pair* pair, std::string* error) {
  for (int region = 0; region < kRegionCount; ++region) {
    const fs::path path = folder / (std::string(kRegionNames[region]) + ".pgm");
    if (!present(path)) continue;
    if (!read_mask(path, *pair, &pair->masks[region], error)) return false;
    pair->has_region[region] = true;
    pair->official_regions = true;
  }
  if (!pair->has_region[kNonOccluded] && present(folder / "disparity_right.pgm")) {
    const fs::path path = folder / "disparity_right.pgm";
    host::DisparityMap right;
    if (host::read_truth(path.string(), pair->scale, &right, error) != host::MapRead::kDone ||
        !same_size(path, right.width, right.height, *pair, error)) {
      return false;
    }
    pair->masks[kNonOccluded] = host::cross_check(pair->truth, right);
    pair->has_region[kNonOccluded] = true;
  }
  if (!pair->has_region[kDiscontinuous]) {
    pair->masks[kDiscontinuous] = near_jumps(pair->truth, pair->masks[kNonOccluded]);
    pair->has_region[kDiscontinuous] = true;
  }
  return true;
}

// A region without a single pixel to count, or a truth beyond the search, would give numbers that mean nothing.
bool check_pair(const fs::path& folder, const Pair& pair, std::string* error) {
  float largest = 0.0f;
  for (const float d : pair.truth.pixels) {
    if (std::isfinite(d)) largest = std::max(largest, d);
  }
  if (largest > static_cast<float>(pair.num_disparities)) {
    *error = folder.string() + text(
                                   ": the truth reaches %.1f pixels, but the table says %d disparities and scale %g; "
                                   "correct its line in a pairs.txt",
                                   static_cast<double>(largest), static_cast<int>(pair.num_disparities), pair.scale);
    return false;
  }
  for (int region = 0; region < kRegionCount; ++region) {
    if (!pair.has_region[region]) continue;
    const host::Evaluation counted = host::evaluate(pair.truth, pair.truth, pair.masks[region], 1.0);
    if (counted.counted > 0 || (region == kDiscontinuous && !pair.official_regions)) continue;
    *error = folder.string() + ": no pixel counts in the region " + kRegionNames[region] +
             "; its mask must be 255 somewhere with known truth";
    return false;
  }
  return true;
}

bool read_pair(const fs::path& folder, const PairTable& table, const PairSetOptions& options, Pair* pair,
               std::string* error) {
  pair->name = folder_name(folder);
  const PairEntry* entry = table.find(pair->name);
  if (entry == nullptr) {
    *error = unlisted(folder);
    return false;
  }
  pair->num_disparities = entry->num_disparities;
  pair->scale = entry->scale;
  const fs::path left = folder / "left.ppm", right = folder / "right.ppm", truth = folder / "disparity.pgm";
  if (!read_view(left, options.gray, &pair->left, error) || !read_view(right, options.gray, &pair->right, error) ||
      !same_size(right, pair->right.width, pair->right.height, *pair, error) ||
      host::read_truth(truth.string(), pair->scale, &pair->truth, error) != host::MapRead::kDone ||
      !same_size(truth, pair->truth.width, pair->truth.height, *pair, error)) {
    return false;
  }
  return read_regions(folder, pair, error) && check_pair(folder, *pair, error);
}

}  // namespace

host::Image8 to_gray(const host::Image8& image) {
  if (image.channels == 1) return image;
  host::Image8 gray{image.width, image.height, 1, {}};
  gray.pixels.reserve(image.pixels.size() / 3);
  for (size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    const int luma = 76 * image.pixels[i] + 150 * image.pixels[i + 1] + 29 * image.pixels[i + 2];
    gray.pixels.push_back(static_cast<uint8_t>((luma + 127) / 255));
  }
  return gray;
}

bool load_pairs(const std::string& folder, const PairSetOptions& options, std::vector<Pair>* pairs, std::string* error) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) {
    *error = folder + ": no such folder; it holds one folder per pair, each with left.ppm, right.ppm and disparity.pgm";
    return false;
  }
  PairTable table;
  const fs::path own_table = fs::path(folder) / "pairs.txt";
  if (!options.pairs_file.empty() && !table.add_file(options.pairs_file, error)) return false;
  if (present(own_table) && !table.add_file(own_table.string(), error)) return false;
  if (!table.add_standard(error)) return false;

  std::vector<fs::path> found;
  find_pairs(folder, 2, &found);
  if (found.empty()) {
    *error = folder + ": no pair in it; a pair is a folder with left.ppm, right.ppm and disparity.pgm";
    return false;
  }
  std::sort(found.begin(), found.end(), [&](const fs::path& a, const fs::path& b) {
    const size_t first = table.position(folder_name(a)), second = table.position(folder_name(b));
    return first != second ? first < second : a < b;
  });
  for (const fs::path& path : found) {
    Pair pair;
    if (!read_pair(path, table, options, &pair, error)) return false;
    for (const Pair& other : *pairs) {
      if (other.name != pair.name) continue;
      *error = path.string() + ": another pair has the same name, " + pair.name;
      return false;
    }
    pairs->push_back(std::move(pair));
  }
  return true;
}

}  // namespace bsm::bench
