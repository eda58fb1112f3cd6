// kernel_cases.cpp - contents, scratch and outputs of the kernels' trials.
#include "kernel_cases.h"

#include "platform/compiler.h"

namespace bsm::test {

Values any_values(Rng& rng) {
  return static_cast<Values>(rng.range(0, 4));
}

template <typename T>
void fill(Rng& rng, T* values, size_t count, Values kind) {
  constexpr uint64_t kMost = static_cast<T>(-1);
  const T few[3] = {static_cast<T>(rng.next()), static_cast<T>(rng.next()), static_cast<T>(rng.next())};
  uint64_t smooth = rng.next() & kMost;
  for (size_t i = 0; i < count; ++i) {
    switch (kind) {
      case Values::kNoise:
        values[i] = static_cast<T>(rng.next());
        break;
      case Values::kConstant:
        values[i] = few[0];
        break;
      case Values::kFew:
        values[i] = few[rng.range(0, 2)];
        break;
      case Values::kExtremes:
        values[i] = rng.one_in(2) ? static_cast<T>(0) : static_cast<T>(kMost);
        break;
      case Values::kSmooth:
        if (const int step = rng.range(-3, 3); step < 0) {
          smooth -= smooth < static_cast<uint64_t>(-step) ? smooth : static_cast<uint64_t>(-step);
        } else {
          smooth += kMost - smooth < static_cast<uint64_t>(step) ? kMost - smooth : static_cast<uint64_t>(step);
        }
        values[i] = static_cast<T>(smooth);
        break;
    }
  }
}
template void fill(Rng&, uint8_t*, size_t, Values);
template void fill(Rng&, uint16_t*, size_t, Values);

void* take_scratch(const Trial& trial, kernel_scratch_fn* scratch, const KernelShape& shape) {
  const size_t bytes = static_cast<size_t>(scratch(shape));
  uint8_t* const memory = trial.yard.take(bytes, 64);
  BSM_MEMSET(memory, trial.rng.byte(), bytes);
  return memory;
}

template <typename T>
Output<T> take_output(const Trial& trial, size_t count, size_t alignment) {
  const Output<T> output{trial.yard.take_array<T>(count, alignment), trial.yard.take_array<T>(count, alignment), count};
  fill(trial.rng, output.scalar, count, Values::kNoise);
  BSM_MEMCPY(output.kernel, output.scalar, count * sizeof(T));
  return output;
}
template Output<uint8_t> take_output(const Trial&, size_t, size_t);
template Output<uint16_t> take_output(const Trial&, size_t, size_t);

template <typename T>
void check_output(const Trial& trial, const Output<T>& output, const char* what, const Note* notes, size_t notes_count) {
  if (!trial.yard.intact()) return trial.report(Difference{what, 0, 0, 0, notes, notes_count});
  for (size_t i = 0; i < output.count; ++i) {
    if (output.kernel[i] == output.scalar[i]) continue;
    return trial.report(Difference{what, i, output.kernel[i], output.scalar[i], notes, notes_count});
  }
}
template void check_output(const Trial&, const Output<uint8_t>&, const char*, const Note*, size_t);
template void check_output(const Trial&, const Output<uint16_t>&, const char*, const Note*, size_t);

}  // namespace bsm::test
