// Matches the synthetic scene, rendered on the board, with any configuration, and prints one line: the instruction set of
// the kernels, the hash of the map, and what matching took. Tests and measure.sh run it; the costs hold under qemu's -icount
// shift=0.
//
// Arguments (by semihosting), in the order they are to take effect: width=, height=, disparities=, format=gray8|rgb24,
// preset=paper|fast|balanced|local, then any of the fields below; scalar=1 for scalar kernels, frame=1 for bsm_process
// instead of rows, map=FILE.pgm to write the map, fault=1 to read a misaligned word, which has to fault on ARMv6-M.
#include <stddef.h>
#include <stdint.h>

#include "bsm/bsm.h"
#include "cortexm/measure.h"
#include "cortexm/pnm_rows.h"
#include "cortexm/semihosting.h"
#include "cortexm/text.h"
#include "host/scene.h"

using namespace bsm::cortexm;

namespace {

// The arena; whole frames lie behind it.
alignas(64) uint8_t memory[BSM_IMAGE_BYTES];
uint8_t left_row[3 * BSM_IMAGE_WIDTH], right_row[3 * BSM_IMAGE_WIDTH];
int16_t disparities[BSM_IMAGE_WIDTH];

[[noreturn]] void stop(const char* about, const char* problem) {
  host_print("probe: ");
  host_print(about);
  host_print(": ");
  host_print(problem);
  host_print("\n");
  host_exit(1);
}

void check(bsm_status status) {
  if (status < 0) stop("bsm", bsm_status_string(status));
}

struct Name {
  const char* name;
  int32_t value;
};
constexpr Name kFormats[] = {{"gray8", BSM_FORMAT_GRAY8}, {"rgb24", BSM_FORMAT_RGB24}};
constexpr Name kMethods[] = {{"local", BSM_METHOD_LOCAL}, {"sgm", BSM_METHOD_SGM}};
constexpr Name kPresets[] = {
    {"paper", BSM_PRESET_PAPER}, {"fast", BSM_PRESET_FAST}, {"balanced", BSM_PRESET_BALANCED}, {"local", BSM_PRESET_LOCAL}};

template <size_t kCount>
int32_t value_of(const Name (&names)[kCount], const char* word) {
  for (const Name& name : names) {
    if (same_text(name.name, word)) return name.value;
  }
  stop(word, "unknown name");
}

int32_t number_of(const char* word) {
  int32_t number = 0;
  for (const char* digit = word; *digit != 0; ++digit) {
    if (*digit < '0' || *digit > '9' || number > 1000000) stop(word, "no number");
    number = 10 * number + (*digit - '0');
  }
  return number;
}

struct Field {
  const char* name;
  int32_t bsm_config::*field;
};
constexpr Field kFields[] = {{"width", &bsm_config::width},
                             {"height", &bsm_config::height},
                             {"disparities", &bsm_config::num_disparities},
                             {"stage", &bsm_config::stage},
                             {"bits", &bsm_config::bits},
                             {"paths", &bsm_config::paths},
                             {"right_costs", &bsm_config::right_costs},
                             {"speckle", &bsm_config::speckle},
                             {"border", &bsm_config::border},
                             {"vote_radius", &bsm_config::vote_radius},
                             {"vote_step", &bsm_config::vote_step},
                             {"smooth_radius", &bsm_config::smooth_radius},
                             {"smooth_passes", &bsm_config::smooth_passes}};

struct Run {
  bsm_config config;
  bool frame = false;
  const char* map_path = nullptr;
};

void misaligned_read() {
  const volatile uint8_t* address = memory + 1;
  uint32_t word;
  __asm__ volatile("ldr %0, [%1]" : "=l"(word) : "l"(address));
}

void apply(const char* key, const char* value, Run* run) {
  bsm_config* config = &run->config;
  if (same_text(key, "format")) {
    config->format = value_of(kFormats, value);
  } else if (same_text(key, "preset")) {
    check(bsm_config_preset(config, static_cast<bsm_preset>(value_of(kPresets, value))));
  } else if (same_text(key, "method")) {
    config->method = value_of(kMethods, value);
  } else if (same_text(key, "scalar")) {
    config->isa_mask = number_of(value) != 0 ? 0 : BSM_ISA_ALL;
  } else if (same_text(key, "frame")) {
    run->frame = number_of(value) != 0;
  } else if (same_text(key, "map")) {
    run->map_path = value;
  } else if (same_text(key, "fault")) {
    misaligned_read();
    stop("fault", "a misaligned read went through");
  } else {
    for (const Field& field : kFields) {
      if (same_text(key, field.name)) {
        config->*field.field = number_of(value);
        return;
      }
    }
    stop(key, "unknown argument");
  }
}

// Splits each KEY=VALUE in place.
Run run_of(char** words, int32_t count) {
  Run run;
  check(bsm_config_init(&run.config, 160, 120));
  run.config.num_disparities = 32;
  for (int32_t i = 0; i < count; ++i) {
    char* value = words[i];
    while (*value != 0 && *value != '=') ++value;
    if (*value == 0) stop(words[i], "not of the form KEY=VALUE");
    *value = 0;
    apply(words[i], value + 1, &run);
  }
  return run;
}

// Both views of the scene, one row at a time.
struct Scene {
  bsm::host::SceneOptions options;
  int32_t format;

  void render(int32_t y, uint8_t* left, uint8_t* right) const {
    bsm::host::scene_row(options, y, bsm::host::SceneRow{left, right, nullptr, nullptr, nullptr, nullptr});
    if (format != BSM_FORMAT_GRAY8) return;
    for (int32_t x = 0; x < options.width; ++x) {  // green stands for gray, as in the hashes of tests/golden.inc
      left[x] = left[3 * x + 1];
      right[x] = right[3 * x + 1];
    }
  }
};

// FNV-1a, 64 bit, over the values in little-endian order.
struct Hash {
  uint64_t value = 0xcbf29ce484222325u;
  void add(const int16_t* values, int32_t count) {
    for (int32_t i = 0; i < count; ++i) {
      const uint32_t bits = static_cast<uint16_t>(values[i]);
      value = (value ^ (bits & 255u)) * 0x100000001b3u;
      value = (value ^ (bits >> 8)) * 0x100000001b3u;
    }
  }
};

// Where finished rows go.
struct Sink {
  Hash hash;
  MapRows map{-1, 0, 0};

  void take(int16_t* row, int32_t width) {
    hash.add(row, width);
    if (map.file >= 0 && !write_row(map, row)) stop("map", "cannot be written");
  }
};

// Hands out the memory behind the arena.
class Shelf {
 public:
  explicit Shelf(size_t taken) : next_(taken) {}
  template <class T>
  T* take(int32_t count) {
    const size_t offset = (next_ + 7) & ~size_t{7};
    next_ = offset + sizeof(T) * static_cast<size_t>(count);
    if (next_ > sizeof memory) stop("memory", "too small for this run");
    return reinterpret_cast<T*>(memory + offset);
  }

 private:
  size_t next_;
};

struct Costs {
  InstructionCounter counter;
  size_t stack = 0;
};

template <class Call>
bsm_status measured(Costs* costs, const Call& call) {
  paint_stack();
  costs->counter.start();
  const bsm_status status = call();
  costs->counter.stop();
  const size_t stack = deepest_stack();
  costs->stack = costs->stack < stack ? stack : costs->stack;
  check(status);
  return status;
}

void match_rows(bsm_context* context, const Scene& scene, Sink* sink, Costs* costs) {
  const int32_t width = scene.options.width;
  const bsm_row left = {{left_row, nullptr}}, right = {{right_row, nullptr}};
  for (int32_t y = 0;; ++y) {
    if (y < scene.options.height) {
      scene.render(y, left_row, right_row);
      measured(costs, [&] { return bsm_push_row(context, &left, &right); });
    }
    const bsm_status pulled = measured(costs, [&] { return bsm_pull_row(context, disparities, nullptr, nullptr); });
    if (pulled == BSM_END) return;
    if (pulled == BSM_OK) sink->take(disparities, width);
  }
}

void match_frame(bsm_context* context, const Scene& scene, Shelf shelf, Sink* sink, Costs* costs) {
  const int32_t width = scene.options.width, height = scene.options.height;
  const int32_t row_bytes = width * (scene.format == BSM_FORMAT_GRAY8 ? 1 : 3);
  uint8_t* left = shelf.take<uint8_t>(row_bytes * height + 2 * width);  // a row is rendered in colour
  uint8_t* right = shelf.take<uint8_t>(row_bytes * height + 2 * width);
  int16_t* map = shelf.take<int16_t>(width * height);
  for (int32_t y = 0; y < height; ++y) scene.render(y, left + row_bytes * y, right + row_bytes * y);
  bsm_frame frame{};
  frame.left = bsm_image{{left, nullptr}, {row_bytes, 0}};
  frame.right = bsm_image{{right, nullptr}, {row_bytes, 0}};
  frame.disparity = bsm_map{map, 2 * width};
  measured(costs, [&] { return bsm_process(context, &frame); });
  for (int32_t y = 0; y < height; ++y) sink->take(map + width * y, width);
}

// The instruction set of the mask's kernel, the end of its name; every set that kernels are written for has one.
const char* isa_name(const bsm_context* context) {
  const char* name = bsm_kernel_name(context, BSM_KERNEL_MASK);
  if (name == nullptr) return "-";  // a library without text
  for (const char* end = name; *end != 0; ++end) {
    if (*end == '_') name = end + 1;
  }
  return name;
}

void report(const Run& run, const bsm_context* context, const Sink& sink, size_t arena, const Costs& costs) {
  char line[160];
  char* end = append_text(line, "isa=");
  end = append_text(end, isa_name(context));
  end = append_text(end, " hash=");
  end = append_hex(end, sink.hash.value);
  end = append_text(end, " arena=");
  end = append_decimal(end, static_cast<uint32_t>(arena));
  end = append_text(end, " stack=");
  end = append_decimal(end, static_cast<uint32_t>(costs.stack));
  if (!run.frame) {  // a whole frame may take longer than the timer counts
    end = append_text(end, " instructions=");
    end = append_decimal(end, static_cast<uint32_t>(costs.counter.instructions()));
  }
  *append_text(end, "\n") = 0;
  host_print(line);
}

}  // namespace

extern "C" void HardFault_Handler() {
  stop("board", "hard fault");
}

int main() {
  static char arguments[400];
  constexpr int32_t kMostWords = 20;
  char* words[kMostWords];
  if (!host_arguments(arguments, sizeof arguments)) stop("arguments", "too long");
  const int32_t count = split_words(arguments, words, kMostWords);
  const Run run = run_of(words + 1, count - 1);

  size_t arena = 0;
  bsm_context* context = nullptr;
  check(bsm_memory_required(&run.config, &arena));
  check(bsm_open(&run.config, memory, sizeof memory, &context));
  Scene scene;
  scene.format = run.config.format;
  scene.options.width = run.config.width;
  scene.options.height = run.config.height;
  scene.options.num_disparities = run.config.num_disparities;
  Sink sink;
  if (run.map_path != nullptr) {
    const char* problem =
        create_map(run.map_path, run.config.width, run.config.height, bsm_invalid_disparity(&run.config), &sink.map);
    if (problem != nullptr) stop(run.map_path, problem);
  }
  Costs costs;
  if (run.config.width > BSM_IMAGE_WIDTH) stop("width", "longer than this image's rows");
  if (run.frame) {
    match_frame(context, scene, Shelf(arena), &sink, &costs);
  } else {
    match_rows(context, scene, &sink, &costs);
  }
  report(run, context, sink, arena, costs);
  host_exit(0);
}
