// The plain form of vote_weigh_avx512, made of the kernel's own parts.
#include "bench/plain_forms.h"
#include "platform/compiler.h"

#if BSM_ARCH_X86_64
// The kernel once more, under a name of its own.
#define vote_weigh_avx512 vote_weigh_avx512_again
#define vote_weigh_avx512_scratch vote_weigh_avx512_again_scratch
#include "simd/x86/vote_weigh_avx512.cpp"

namespace bsm::bench {
namespace {

template <int32_t kPlanes, bool kStrided>
void vote_row_by_row(const Window& window) {
  const VoteWeighArgs& args = window.args;
  copy_whole(args);
  for (int32_t x = next_missing(args, 0); x < args.width; x = next_missing(args, x + 1)) {
    collect_votes<kPlanes, kStrided>(window, x);
    args.out[x] = vote_of(args, window.votes, x);
  }
}

}  // namespace

void vote_by_row_avx512(const VoteWeighArgs& args) {
  Scratch& scratch = *static_cast<Scratch*>(args.scratch);
  Window window{args,
                scratch,
                reinterpret_cast<uint32_t*>(&scratch + 1),
                (args.num_disparities + 15) / 16 * 16,
                2 * args.radius / args.step + 1,
                63 / args.step + 1 < kLanes ? 63 / args.step + 1 : kLanes,
                {0, 0}};
  prepare(window);
  if (args.step == 1) return args.planes == 3 ? vote_row_by_row<3, false>(window) : vote_row_by_row<1, false>(window);
  return args.planes == 3 ? vote_row_by_row<3, true>(window) : vote_row_by_row<1, true>(window);
}

}  // namespace bsm::bench
#endif
