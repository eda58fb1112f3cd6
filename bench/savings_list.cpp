// Pairs the forms of each saving.
#include "bench/savings_list.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "bench/plain_forms.h"

namespace bsm::bench {
namespace {

// What a kernel wrote.
struct Output {
  const void* begin;
  size_t bytes;
};

size_t values(int32_t a, int32_t b) {
  return static_cast<size_t>(a) * static_cast<size_t>(b);
}

[[maybe_unused]] std::vector<Output> outputs(const DescriptorCompareArgs& args) {  // not by every instruction set
  return {{args.out, values(args.width, args.pattern.bits / 8)}};
}
std::vector<Output> outputs(const MaskThresholdArgs& args) {
  return {{args.out, values(args.width, args.pattern.bits / 8)}};
}
std::vector<Output> outputs(const MatchHammingArgs& args) {
  return {{args.left_level, values(args.width, 2)}, {args.right_level, values(args.width, 2)}};
}
std::vector<Output> outputs(const AggregateAlongArgs& args) {
  std::vector<Output> pixels;
  for (int32_t x = 0; x < args.width; ++x)
    pixels.push_back({args.sum + values(x, args.stride), values(args.num_disparities, 2)});
  return pixels;
}
// A row of levels.
template <class Args>
std::vector<Output> outputs(const Args& args) {
  return {{args.out, values(args.width, 2)}};
}

std::vector<Output> outputs(const TwoOrdersArgs& args) {
  return outputs(args.coherent);
}

// What the plain form wrote.
template <class Args>
std::vector<Output> plain_outputs(const Args& args) {
  return outputs(args);
}
std::vector<Output> plain_outputs(const TwoOrdersArgs& args) {
  return outputs(args.given);
}

bool equal(const std::vector<Output>& a, const std::vector<Output>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Output& one, const Output& other) {
    return one.bytes == other.bytes && std::memcmp(one.begin, other.begin, one.bytes) == 0;
  });
}

template <class Args>
struct Form {
  void (*run)(const Args&);
  kernel_scratch_fn* scratch;
};

template <class Args>
Saving saving(const PairRows& rows, const char* name, const char* where, Form<Args> plain, Form<Args> saved) {
  using Calls = std::vector<Call<Args>>;
  const auto calls_of = [&rows](const Form<Args>& form) {
    const auto calls = std::make_shared<Calls>();
    for (const int32_t y : rows.sampled()) calls->push_back(rows.call<Args>(y, form.scratch));
    return calls;
  };
  const auto run_all = [](void (*run)(const Args&), const std::shared_ptr<Calls>& calls) {
    return [run, calls] {
      for (const Call<Args>& call : *calls) run(call.args);
    };
  };
  const auto without = calls_of(plain), with = calls_of(saved);
  const auto same = [without, with] {
    return std::equal(
        without->begin(), without->end(), with->begin(), with->end(),
        [](const Call<Args>& a, const Call<Args>& b) { return equal(plain_outputs(a.args), outputs(b.args)); });
  };
  return Saving{name, where, run_all(plain.run, without), run_all(saved.run, with), same};
}

// A stage of core/ has no scratch.
uint64_t no_scratch(const KernelShape&) {
  return 0;
}

template <class Args>
Saving stage_saving(const PairRows& rows, const char* name, const char* where, void (*plain)(const Args&)) {
  return saving<Args>(rows, name, where, {plain, no_scratch}, {run_stage, no_scratch});
}

void add_scalar(const PairRows& rows, std::vector<Saving>* list) {
  using Match = Form<MatchHammingArgs>;
  const Form<MaskThresholdArgs> mask{mask_threshold_scalar, mask_threshold_scalar_scratch};
  list->push_back(saving<MaskThresholdArgs>(rows, "colours compared once a window offset, not by each pair",
                                            "mask_threshold_scalar", {mask_colors_by_pair, mask_colors_by_pair_scratch},
                                            mask));
  list->push_back(saving<MaskThresholdArgs>(rows, "colours compared at the offsets in a pair alone", "mask_threshold_scalar",
                                            {mask_whole_window, mask_whole_window_scratch}, mask));
  const Match each_view{match_each_view, match_each_view_scratch};
  const Match all_bits{match_all_bits, match_all_bits_scratch};
  const Match match{match_hamming_scalar, match_hamming_scalar_scratch};
  list->push_back(saving(rows, "XOR of a candidate shared by both views", "match_hamming_scalar", each_view, all_bits));
  list->push_back(saving(rows, "counting ends once neither view can win", "match_hamming_scalar", all_bits, match));
  list->push_back(saving<TwoOrdersArgs>(rows, "zero words of masks skipped, in a coherent order", "no kernel",
                                        {match_given_order, match_all_bits_scratch},
                                        {match_skipping_zeros, match_all_bits_scratch}));
  list->push_back(saving<AggregateAlongArgs>(rows, "least of the predecessor's levels found once a pixel",
                                             "aggregate_along_scalar",
                                             {aggregate_least_by_level, aggregate_least_by_level_scratch},
                                             {aggregate_along_scalar, aggregate_along_scalar_scratch}));
}

void add_refinement(const PairRows& rows, std::vector<Saving>* list) {
  list->push_back(saving<VoteWeighArgs>(rows, "votes for pixels without a level alone", "vote_weigh_scalar",
                                        {vote_everywhere, vote_everywhere_scratch},
                                        {vote_weigh_scalar, vote_weigh_scalar_scratch}));
  list->push_back(saving<MedianWeightedArgs>(rows, "median sought only where the own level is none",
                                             "median_weighted_scalar", {median_by_sorting, median_by_sorting_scratch},
                                             {median_weighted_scalar, median_weighted_scalar_scratch}));
  list->push_back(stage_saving(rows, "neighbours asked until they are enough", "core/speckle", speckles_of_all_neighbours));
  list->push_back(stage_saving(rows, "a hole's nearest levels found once, not by pixel", "core/holes", fill_by_pixel));
  list->push_back(stage_saving(rows, "columns sorted once for three medians", "core/median", median_by_sorting_nine));
}

#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX2)
void add_avx2(const PairRows& rows, std::vector<Saving>* list) {
  using Mask = Form<MaskThresholdArgs>;
  if ((kIsaAvx2 & ~rows.features()) != 0) return;
  list->push_back(saving<DescriptorCompareArgs>(rows, "a point loaded once for its pairs", "descriptor_compare_avx2",
                                                {descriptors_by_pair_avx2, descriptor_compare_avx2_scratch},
                                                {descriptor_compare_avx2, descriptor_compare_avx2_scratch}));
  const Mask mask{mask_threshold_avx2, mask_threshold_avx2_scratch};
  const Mask by_pair{mask_threshold_by_pair_avx2, mask_threshold_avx2_scratch};
  const Mask bisection{mask_by_bisection_avx2, mask_threshold_avx2_scratch};
  const Mask even{mask_by_even_steps_avx2, mask_threshold_avx2_scratch};
  const Mask each{mask_counting_each_avx2, mask_threshold_avx2_scratch};
  list->push_back(
      saving(rows, "threshold compared once a window offset, not by each pair", "mask_threshold_avx2", by_pair, mask));
  list->push_back(
      saving(rows, "T found by eight thresholds a pass, not by bisection", "mask_threshold_avx2", bisection, even));
  list->push_back(saving(rows, "steps of 8 and 1 while any T is open, not 32, 4 and 1", "mask_threshold_avx2", even, mask));
  list->push_back(saving(rows, "pairs that repeat counted once", "mask_threshold_avx2", each, mask));
  if (!rows.has_maps()) return;
  list->push_back(saving<MedianWeightedArgs>(rows, "blocks that keep their levels left out", "median_weighted_avx2",
                                             {median_of_all_blocks_avx2, median_weighted_avx2_scratch},
                                             {median_weighted_avx2, median_weighted_avx2_scratch}));
}
#endif

#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX512)
void add_avx512(const PairRows& rows, std::vector<Saving>* list) {
  using Mask = Form<MaskThresholdArgs>;
  if ((kIsaAvx512 & ~rows.features()) != 0) return;
  const Mask mask{mask_threshold_avx512, mask_threshold_avx512_scratch};
  const Mask equal_steps{mask_by_equal_steps_avx512, mask_threshold_avx512_scratch};
  const Mask each{mask_counting_each_avx512, mask_threshold_avx512_scratch};
  list->push_back(saving(rows, "first thresholds where most T are, found with the colours at hand", "mask_threshold_avx512",
                         equal_steps, mask));
  list->push_back(saving(rows, "pairs that repeat counted once", "mask_threshold_avx512", each, mask));
  if (!rows.has_maps()) return;
  list->push_back(saving<VoteWeighArgs>(rows, "taps of several rows or pixels weighed at once", "vote_weigh_avx512",
                                        {vote_by_row_avx512, vote_weigh_avx512_scratch},
                                        {vote_weigh_avx512, vote_weigh_avx512_scratch}));
}
#endif

#if BSM_ARCH_NEON && defined(BSM_BENCH_NEON)
void add_neon(const PairRows& rows, std::vector<Saving>* list) {
  using Match = Form<MatchHammingArgs>;
  if ((kIsaNeon & ~rows.features()) != 0) return;
  const Match all_bits{match_all_bits_neon, match_hamming_neon_scratch};
  const Match without_guess{match_without_guess_neon, match_hamming_neon_scratch};
  const Match match{match_hamming_neon, match_hamming_neon_scratch};
  list->push_back(saving(rows, "counting ends once none of four can win", "match_hamming_neon", all_bits, without_guess));
  list->push_back(saving(rows, "the most promising candidate counted first", "match_hamming_neon", without_guess, match));
}
#endif

}  // namespace

std::vector<Saving> all_savings(const PairRows& rows) {
  std::vector<Saving> list;
  add_scalar(rows, &list);
  if (rows.has_maps()) add_refinement(rows, &list);
#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX2)
  add_avx2(rows, &list);
#endif
#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX512)
  add_avx512(rows, &list);
#endif
#if BSM_ARCH_NEON && defined(BSM_BENCH_NEON)
  add_neon(rows, &list);
#endif
  return list;
}

}  // namespace bsm::bench
