// Kernels without one of their savings: what the equations say, or the kernel with that one step done the plain way. They
// write the bytes of the kernels of simd/kernels.h and take the same arguments.
#ifndef BSM_BENCH_PLAIN_FORMS_H
#define BSM_BENCH_PLAIN_FORMS_H

#include "simd/kernels.h"

namespace bsm::bench {

// mask_threshold_scalar, but every pair compares the colours of its two ends itself (eq. 6).
mask_threshold_fn mask_colors_by_pair;
kernel_scratch_fn mask_colors_by_pair_scratch;

// mask_threshold_scalar, but colours are compared at every offset of the window.
mask_threshold_fn mask_whole_window;
kernel_scratch_fn mask_whole_window_scratch;

// match_hamming_scalar without its early end, and the same with an XOR for each view.
match_hamming_fn match_all_bits, match_each_view;
kernel_scratch_fn match_all_bits_scratch, match_each_view_scratch;

// The same pixels with their bits in two orders.
struct TwoOrdersArgs {
  MatchHammingArgs given;     // that of the pattern
  MatchHammingArgs coherent;  // pairs whose points lie in the same directions side by side
};

// match_all_bits in the given order, and in the coherent one leaving out words that both masks leave out. No kernel does the
// latter.
void match_given_order(const TwoOrdersArgs& args);
void match_skipping_zeros(const TwoOrdersArgs& args);

// aggregate_along_scalar, but every level looks for the least of the predecessor's levels itself.
aggregate_along_fn aggregate_least_by_level;
kernel_scratch_fn aggregate_least_by_level_scratch;

// vote_weigh_scalar, but every pixel asks its window, also one that keeps its level.
vote_weigh_fn vote_everywhere;
kernel_scratch_fn vote_everywhere_scratch;

// median_weighted_scalar, but every window is sorted.
median_weighted_fn median_by_sorting;
kernel_scratch_fn median_by_sorting_scratch;

#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX2)
// descriptor_compare_avx2, but every pair loads both of its points.
descriptor_compare_fn descriptors_by_pair_avx2;

// mask_threshold_avx2, but every pair compares with the threshold itself.
mask_threshold_fn mask_threshold_by_pair_avx2;
// mask_threshold_avx2, but T is found by bisection, one threshold a pass over the pairs; and by eight thresholds a pass with
// the steps 32, 4 and 1 for all pixels.
mask_threshold_fn mask_by_bisection_avx2, mask_by_even_steps_avx2;
// mask_threshold_avx2, but pairs that come more than once are counted one by one.
mask_threshold_fn mask_counting_each_avx2;

// median_weighted_avx2, but blocks whose pixels keep their levels are weighed as well.
median_weighted_fn median_of_all_blocks_avx2;
#endif

#if BSM_ARCH_X86_64 && defined(BSM_BENCH_AVX512)
// mask_threshold_avx512, but its first thresholds lie eight apart as the next ones do; and with pairs that come more than
// once counted one by one.
mask_threshold_fn mask_by_equal_steps_avx512, mask_counting_each_avx512;

// vote_weigh_avx512, but pixel by pixel and each row of the window apart.
vote_weigh_fn vote_by_row_avx512;
#endif

#if BSM_ARCH_NEON && defined(BSM_BENCH_NEON)
// match_hamming_neon, but all candidates are counted to the end; and ending early, but without a guess that bounds them.
match_hamming_fn match_all_bits_neon, match_without_guess_neon;
#endif

}  // namespace bsm::bench

#endif  // BSM_BENCH_PLAIN_FORMS_H
