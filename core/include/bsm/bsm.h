/* bsm.h - public C99 interface of the binary stereo matching library.
 *
 * Two rectified images in, a disparity map out, integers only. The method is "Binary Stereo Matching" (Zhang, Li, Li, Hu,
 * Sun, Yang; ICPR 2012); equation numbers in the documentation are that paper's.
 *
 * Life of a context: fill a bsm_config, ask bsm_memory_required how many bytes it takes, give them to bsm_open, then either
 * hand whole frames to bsm_process or push and pull rows. The library allocates nothing, keeps no global state and needs no
 * closing: when the caller reuses the arena, the context is gone. Contexts are independent; one context is used by one
 * thread at a time (bsm_process may spread its work through the caller's parallel_for).
 *
 * Every call checks its arguments before it writes anything. A call that returns a negative status has written nothing to
 * the caller's buffers and has left the context as it was.
 */
#ifndef BSM_BSM_H
#define BSM_BSM_H

#include <stddef.h>
#include <stdint.h>

#define BSM_VERSION_MAJOR 0
#define BSM_VERSION_MINOR 1
#define BSM_VERSION_PATCH 0

#if defined(BSM_SHARED) && defined(_WIN32)
#if defined(BSM_BUILDING)
#define BSM_API __declspec(dllexport)
#else
#define BSM_API __declspec(dllimport)
#endif
#elif defined(BSM_SHARED) && defined(__GNUC__)
#define BSM_API __attribute__((visibility("default")))
#else
#define BSM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Limits of a configuration. */
#define BSM_MIN_BITS 64           /* bits is a multiple of this */
#define BSM_MAX_BITS 4096         /* pairs in the pattern */
#define BSM_MAX_SIZE 16384        /* largest width and height, in pixels */
#define BSM_MIN_DISPARITY (-2047) /* smallest min_disparity, in pixels */
#define BSM_MAX_DISPARITY 2046    /* largest min_disparity + num_disparities - 1, in pixels */
#define BSM_MAX_VOTE_RADIUS 32    /* largest half side of the voting window, in pixels */
#define BSM_MAX_SMOOTH_RADIUS 8   /* largest half side of the weighted median's window, in pixels */
#define BSM_MAX_SMOOTH_PASSES 3
#define BSM_MAX_SGM_BITS 1024   /* pairs in the pattern of sgm */
#define BSM_MAX_JOBS 64         /* largest max_jobs */
#define BSM_DISPARITY_SCALE 16  /* units of a disparity value per pixel: 4 fractional bits */
#define BSM_ISA_ALL 0xffffffffu /* isa_mask that allows every instruction set */

/* What a call reports. Zero and above: the call did what it says. Below zero: it did nothing. */
typedef enum bsm_status {
  BSM_OK = 0,
  BSM_NEED_ROWS = 1, /* bsm_pull_row: no row is finished yet; push more or call bsm_finish */
  BSM_END = 2,       /* bsm_pull_row: every row of the image has been pulled */

  BSM_ERROR_NULL = -1,             /* a required pointer is null */
  BSM_ERROR_STRUCT_SIZE = -2,      /* struct_size is not that of this library's struct; call bsm_config_init */
  BSM_ERROR_RESERVED = -3,         /* a reserved field is not zero */
  BSM_ERROR_PRESET = -4,           /* preset is not a bsm_preset */
  BSM_ERROR_WIDTH = -5,            /* width is not within 1..BSM_MAX_SIZE */
  BSM_ERROR_HEIGHT = -6,           /* height is not within 1..BSM_MAX_SIZE */
  BSM_ERROR_MIN_DISPARITY = -7,    /* min_disparity is not within BSM_MIN_DISPARITY..BSM_MAX_DISPARITY */
  BSM_ERROR_NUM_DISPARITIES = -8,  /* num_disparities is below 1, or the largest disparity above BSM_MAX_DISPARITY */
  BSM_ERROR_BITS = -9,             /* bits is not a multiple of 64 within 64..4096 (sgm: 64..1024) */
  BSM_ERROR_METHOD = -10,          /* method is not a bsm_method that was built */
  BSM_ERROR_STAGE = -11,           /* stage is not a bsm_stage, or the method or this build has no such stage */
  BSM_ERROR_FORMAT = -12,          /* format is not a bsm_format that was built */
  BSM_ERROR_PATHS = -13,           /* paths is not 3, 4, 5 or 8 */
  BSM_ERROR_PENALTY = -14,         /* a penalty is not within 1..16384, or p1 is above p2 */
  BSM_ERROR_EDGE = -15,            /* edge_threshold is not within 1..255, or edge_divisor not within 1..64 */
  BSM_ERROR_RIGHT_COSTS = -16,     /* right_costs is not a bsm_right_costs */
  BSM_ERROR_SUBPIXEL = -17,        /* subpixel is neither 0 nor 1 */
  BSM_ERROR_TOLERANCE = -18,       /* lr_tolerance is not within 0..255 */
  BSM_ERROR_SPECKLE = -19,         /* speckle is not within 0..100 */
  BSM_ERROR_BORDER = -20,          /* border is neither 0 nor 1 */
  BSM_ERROR_VOTE_RADIUS = -21,     /* vote_radius is not within 1..BSM_MAX_VOTE_RADIUS */
  BSM_ERROR_VOTE_STEP = -22,       /* vote_step is not within 1..vote_radius, or vote_radius is not a multiple of it */
  BSM_ERROR_VOTE_COLOR = -23,      /* vote_color is not within 1..64 */
  BSM_ERROR_VOTE_DISTANCE = -24,   /* vote_distance is not within 1..64 */
  BSM_ERROR_VOTE_CAP = -25,        /* vote_cap is neither 0 nor 1 */
  BSM_ERROR_SMOOTH_RADIUS = -26,   /* smooth_radius is not within 1..BSM_MAX_SMOOTH_RADIUS */
  BSM_ERROR_SMOOTH_PASSES = -27,   /* smooth_passes is not within 0..BSM_MAX_SMOOTH_PASSES */
  BSM_ERROR_SMOOTH_COLOR = -28,    /* smooth_color is not within 1..64 */
  BSM_ERROR_SMOOTH_DISTANCE = -29, /* smooth_distance is not within 2..64 */
  BSM_ERROR_MEDIAN = -30,          /* median is neither 0 nor 1 */
  BSM_ERROR_RIGHT_MAP = -31,       /* right_map is neither 0 nor 1 */
  BSM_ERROR_CONFIDENCE = -32,      /* confidence is neither 0 nor 1, or 1 and not built */
  BSM_ERROR_JOBS = -33,            /* max_jobs is not within 1..BSM_MAX_JOBS */
  BSM_ERROR_MEMORY_SIZE = -34,     /* the configuration needs more bytes than size_t can count (32-bit machines) */
  BSM_ERROR_ARENA = -35,           /* the arena is smaller than bsm_memory_required says */
  BSM_ERROR_CONTEXT = -36,         /* the pointer is not a context that bsm_open returned */
  BSM_ERROR_STRIDE = -37,          /* a stride is shorter than a row, so that rows would overlap */
  BSM_ERROR_ALIGNMENT = -38,       /* an output pointer or stride is not a multiple of 2 bytes */
  BSM_ERROR_NO_RIGHT_MAP = -39,    /* a right map was asked for, but the configuration has right_map = 0 */
  BSM_ERROR_NO_CONFIDENCE = -40,   /* a confidence map was asked for, but the configuration has confidence = 0 */
  BSM_ERROR_STREAM_OPEN = -41,     /* bsm_process while rows are in flight; pull to the end or call bsm_reset */
  BSM_ERROR_ROW_MODE = -42,        /* the row API with 8 paths, which need the whole frame; use bsm_process or fewer paths */
  BSM_ERROR_ROW_COUNT = -43,       /* bsm_push_row after the last row of the image, or after bsm_finish */
  BSM_ERROR_PULL_FIRST = -44,      /* bsm_push_row while a finished row waits; call bsm_pull_row first */
  BSM_ERROR_ISA = -45,             /* isa_mask leaves nothing: this build has no scalar kernels */
  BSM_ERROR_SIGMA = -46            /* sigma is neither 3 nor 4 */
} bsm_status;

/* How costs become disparities. */
typedef enum bsm_method {
  BSM_METHOD_LOCAL = 0, /* every pixel takes the cheapest of its own costs (eq. 1) */
  BSM_METHOD_SGM = 1    /* semi-global: costs are aggregated along scanline paths first */
} bsm_method;

/* The step whose map comes out; each includes those before it. */
typedef enum bsm_stage {
  BSM_STAGE_COST = 0,       /* winner-takes-all over the plain Hamming cost (eq. 1-4) */
  BSM_STAGE_MASKED = 1,     /* winner-takes-all over the masked cost (eq. 5-8) */
  BSM_STAGE_AGGREGATED = 2, /* sgm only: winner-takes-all over the aggregated cost */
  BSM_STAGE_CHECKED = 3,    /* less the pixels that fail the left/right check: a sparse map */
  BSM_STAGE_REFINED = 4     /* holes filled and smoothed: a dense map */
} bsm_stage;

/* sgm: which costs the right view's map comes from. */
typedef enum bsm_right_costs {
  BSM_RIGHT_COSTS_OWN = 0, /* its own masks, aggregated along its rows */
  BSM_RIGHT_COSTS_LEFT = 1 /* the left view's sums, whole levels: less memory and time, a worse map */
} bsm_right_costs;

/* Ready choices of everything that trades quality, time and memory; see bsm_config_preset. */
typedef enum bsm_preset {
  BSM_PRESET_PAPER = 0,    /* the paper's own steps: local, 4096 bits, left/right check, vote, 3x3 median */
  BSM_PRESET_FAST = 1,     /* sgm, 4 paths, 128 bits */
  BSM_PRESET_BALANCED = 2, /* sgm, 4 paths, 256 bits */
  BSM_PRESET_BEST = 3,     /* sgm, 8 paths, 1024 bits; whole frames only */
  BSM_PRESET_LOCAL = 4     /* local, 256 bits, refined as the maps of sgm are */
} bsm_preset;

/* Memory layout of the input. Names give the order of bytes in memory. With YUV, two pixels side by side (nv12, nv21: two
 * by two) share their chroma, the nearest sample; an image of odd width or height ends with a sample that only the pixels
 * inside use. Y alone is the luma that descriptors compare, as in gray8. Colour is BT.601 in full range, as the cameras of
 * Android deliver it (JFIF); the limited range that V4L2 has by default is taken as it is, a picture of 14 % less contrast:
 * nothing is clipped, and U = V = 128 matches as gray8 of the plane Y does. */
typedef enum bsm_format {
  BSM_FORMAT_GRAY8 = 0,  /* 1 byte: luma */
  BSM_FORMAT_RGB24 = 1,  /* 3 bytes: R G B (sRGB) */
  BSM_FORMAT_BGR24 = 2,  /* 3 bytes: B G R */
  BSM_FORMAT_RGBA32 = 3, /* 4 bytes: R G B A; A is ignored */
  BSM_FORMAT_BGRA32 = 4, /* 4 bytes: B G R A; A is ignored */
  BSM_FORMAT_RGB565 = 5, /* 2 bytes, little-endian: R in bits 15..11, G in 10..5, B in 4..0 */
  BSM_FORMAT_NV12 = 6,   /* plane 0: 1 byte Y; plane 1: a row of pairs U V for two rows of pixels */
  BSM_FORMAT_NV21 = 7,   /* plane 0: 1 byte Y; plane 1: a row of pairs V U for two rows of pixels */
  BSM_FORMAT_YUYV = 8    /* 4 bytes for two pixels: Y0 U Y1 V */
} bsm_format;

/* Stages that have kernels, for bsm_kernel_name. */
typedef enum bsm_kernel {
  BSM_KERNEL_COLOR = 0,            /* input pixels to luma and CIELAB */
  BSM_KERNEL_DESCRIPTOR = 1,       /* descriptor bits (eq. 2, 3) */
  BSM_KERNEL_MASK = 2,             /* mask bits (eq. 5-7) */
  BSM_KERNEL_MATCH = 3,            /* masked cost and winner-takes-all of both views (eq. 1, 4, 8) */
  BSM_KERNEL_COST = 4,             /* masked costs of all candidates (eq. 4, 8) */
  BSM_KERNEL_EDGE = 5,             /* colour edges, where the penalties of the aggregation are lower */
  BSM_KERNEL_AGGREGATE_ALONG = 6,  /* semi-global aggregation: the two paths along the row */
  BSM_KERNEL_AGGREGATE_ACROSS = 7, /* semi-global aggregation: one path from the row before */
  BSM_KERNEL_WINNER = 8,           /* winner-takes-all over the aggregated sums, with the sub-pixel fraction */
  BSM_KERNEL_VOTE = 9,             /* voting refinement (eq. 9, 10) */
  BSM_KERNEL_MEDIAN = 10,          /* weighted median of the dense map */
  BSM_KERNEL_FRACTION = 11,        /* smoothing of the sub-pixel fractions */
  BSM_KERNEL_COUNT = 12
} bsm_kernel;

/* What to compute. Fill with bsm_config_init, then change fields. */
typedef struct bsm_config {
  uint32_t struct_size; /* sizeof(bsm_config), set by bsm_config_init */

  /* Input and output. */
  int32_t width;           /* pixels in a row, 1..BSM_MAX_SIZE */
  int32_t height;          /* rows, 1..BSM_MAX_SIZE; a row stream may end earlier (bsm_finish) */
  int32_t format;          /* bsm_format of both images */
  int32_t min_disparity;   /* smallest disparity searched, in pixels; may be negative */
  int32_t num_disparities; /* how many whole disparities are searched, from min_disparity up */
  int32_t stage;           /* bsm_stage whose map comes out */
  int32_t right_map;       /* 1: the map of the right view can be asked for; takes more memory and time */
  int32_t confidence;      /* 1: the confidence of the left view's map can be asked for */

  /* Costs. */
  int32_t method; /* bsm_method */
  int32_t bits;   /* descriptor length n, a multiple of 64 within 64..4096 (sgm: 64..1024) */
  int32_t sigma;  /* local: standard deviation of the pattern's offsets, in pixels: 4 (the paper's) or 3; sgm has 2.5 */

  /* Semi-global aggregation; read by sgm alone. */
  int32_t paths;          /* 3: from the left, the right and above; 4: and above-left; 5: and above-right; 8: and the three
                             from below, which need the whole frame in the arena and no row API */
  int32_t p1;             /* penalty of a change by one level, as if bits were 4096: p1 * bits / 4096, rounded, at least 1 */
  int32_t p2;             /* penalty of a larger change, the same way; p1 <= p2 */
  int32_t edge_threshold; /* a SAD of neighbouring colours above this, in stored units of 0.8 CIELAB, is an edge: 1..255 */
  int32_t edge_divisor;   /* penalties are divided by this at an edge, 1..64; rounded down, at least 1 */
  int32_t right_costs;    /* bsm_right_costs */
  int32_t subpixel; /* 1: a fraction from the sums around the winner. Vote and medians work on whole levels; in the end a
                       pixel that they left within 12/16 of its own sub-pixel level gets that level back, and two passes of
                       a 5 x 5 mean over the same surface smooth the fractions, which lean to whole pixels and are spread
                       between the passes */

  /* Check and refinement. */
  int32_t lr_tolerance;  /* left/right check: largest difference that still agrees, in pixels, 0..255 */
  int32_t speckle;       /* speckle filter: a pixel stays valid when at least this percentage of the 5 x 5 pixels around it,
                            two apart, is valid and within 1.5 pixels of it; 0: no filter */
  int32_t border;        /* 1: the band that the other view does not show continues its surfaces by their slope */
  int32_t vote_radius;   /* voting window is (2 r + 1) x (2 r + 1) pixels, r within 1..BSM_MAX_VOTE_RADIUS */
  int32_t vote_step;     /* every vote_step-th pixel of the window votes; a divisor of vote_radius */
  int32_t vote_color;    /* 1..64: the colour distance, in CIELAB units, that divides a vote's weight by e (eq. 10: 9) */
  int32_t vote_distance; /* 1..64: the same for the distance in pixels (eq. 10: 16) */
  int32_t vote_cap;      /* 1: an occluded pixel between two surfaces takes no level of the nearer one */
  int32_t smooth_radius; /* weighted median over (2 r + 1) x (2 r + 1) pixels, r within 1..BSM_MAX_SMOOTH_RADIUS */
  int32_t smooth_passes; /* how often, 0..BSM_MAX_SMOOTH_PASSES; each pass trusts a pixel's own level less */
  int32_t smooth_color;  /* 1..64: as vote_color, for the weighted median */
  int32_t smooth_distance; /* 2..64: as vote_distance, for the weighted median */
  int32_t median;          /* 1: a 3x3 median at the end */

  /* Machine. */
  int32_t max_jobs;     /* jobs that bsm_process may run side by side, 1..BSM_MAX_JOBS; each needs scratch and rows of its
                           own. Processors without atomic additions run one */
  uint32_t isa_mask;    /* instruction sets allowed (bsm_cpu_features bits); BSM_ISA_ALL for all. Scalar always is */
  uint32_t reserved[5]; /* zero */
} bsm_config;

/* An image in the caller's memory, never written. Row y of plane i begins stride[i] * y bytes after plane[i]; strides are in
 * bytes and may be negative (bottom-up images), no pointer needs any alignment.
 * Plane 0 has height rows of width pixels; yuyv rounds the width up to even. Plane 1 of nv12 and nv21 has (height + 1) / 2
 * rows of (width + 1) / 2 pairs; pixel (x, y) takes pair x / 2 of row y / 2. Other formats ignore plane[1].
 * Exactly these bytes are read: none before, none after, none between the rows. */
typedef struct bsm_image {
  const void* plane[2];
  ptrdiff_t stride[2];
} bsm_image;

/* One row of an image; planes as in bsm_image. plane[1] of nv12 and nv21 is the chroma row that belongs to this row: rows 2
 * k and 2 k + 1 are pushed with the same one. */
typedef struct bsm_row {
  const void* plane[2];
} bsm_row;

/* A disparity map in the caller's memory: width x height signed 16-bit values in 1/16 pixel. A left pixel (x, y) with value
 * v shows the same scene point as the right pixel (x - v / 16, y). Invalid pixels hold bsm_invalid_disparity. data and
 * stride (in bytes, may be negative) are multiples of 2. Nothing between the rows is written. */
typedef struct bsm_map {
  int16_t* data;
  ptrdiff_t stride;
} bsm_map;

/* A map of bytes in the caller's memory: width x height values, rows `stride` bytes apart, nothing between them written. */
typedef struct bsm_byte_map {
  uint8_t* data;
  ptrdiff_t stride;
} bsm_byte_map;

/* Calls job(job_context, i) once for every i in 0..n_jobs-1, in any order and on any threads, and returns when all have
 * returned. Maps are the same bytes for any number of threads. */
typedef void (*bsm_job)(void* job_context, int32_t index);
typedef void (*bsm_parallel_for)(void* user, int32_t n_jobs, bsm_job job, void* job_context);

/* One frame for bsm_process. Zero the struct, then fill it. */
typedef struct bsm_frame {
  bsm_image left, right;   /* width x height pixels each, in the configuration's format */
  bsm_map disparity;       /* out: the left view's map */
  bsm_map right_disparity; /* out, or data = NULL: the right view's map; a right pixel (x, y) of value v shows the left
                              pixel (x + v / 16, y) */
  bsm_byte_map confidence; /* out, or data = NULL: how far each value of the left view's map can be trusted, 0 (invalid or
                              least) to 255; an order, not a probability */
  bsm_parallel_for parallel_for; /* NULL: everything runs in the calling thread */
  void* parallel_user;           /* handed to parallel_for */
} bsm_frame;

typedef struct bsm_context bsm_context;

/* Fills config for images of width x height with the documented defaults: the preset balanced, 64 disparities from 0, rgb24,
 * the refined stage, no right map, one job, every instruction set. Errors: BSM_ERROR_NULL. The sizes are checked by
 * bsm_open. */
BSM_API bsm_status bsm_config_init(bsm_config* config, int32_t width, int32_t height);

/* Sets the fields of costs, aggregation, check and refinement to those of a preset and leaves the others as they are. Set
 * format first: for gray8 sgm has penalties and scales of its own. Errors: BSM_ERROR_NULL, BSM_ERROR_PRESET. */
BSM_API bsm_status bsm_config_preset(bsm_config* config, bsm_preset preset);

/* *bytes = size of the arena that bsm_open needs for config with the kernels this machine would run. The figure is exact and
 * does not depend on height beyond the rows that the windows span. */
BSM_API bsm_status bsm_memory_required(const bsm_config* config, size_t* bytes);

/* The same for a machine with the given CPU features (bsm_cpu_features bits; 0 = scalar kernels) and this machine's pointer
 * size. */
BSM_API bsm_status bsm_memory_required_for(const bsm_config* config, uint32_t features, size_t* bytes);

/* *rows = how many rows the row API is behind: row y can be pulled once row y + *rows has been pushed, or after bsm_finish.
 * Errors: those of bsm_memory_required but for BSM_ERROR_MEMORY_SIZE, and BSM_ERROR_ROW_MODE. */
BSM_API bsm_status bsm_row_delay(const bsm_config* config, int32_t* rows);

/* Opens a context inside arena, which the caller owns, keeps alive and leaves alone while the context is in use. arena may
 * have any alignment; bytes is at least what bsm_memory_required says. config is copied. */
BSM_API bsm_status bsm_open(const bsm_config* config, void* arena, size_t bytes, bsm_context** context);

/* Matches one frame. */
BSM_API bsm_status bsm_process(bsm_context* context, const bsm_frame* frame);

/* Row by row: push rows from the top, pull finished rows. After each push at most one row is finished; it must be pulled
 * before the next push. The rows are copied: the caller may reuse them when the call returns. */
BSM_API bsm_status bsm_push_row(bsm_context* context, const bsm_row* left, const bsm_row* right);

/* Writes the next finished row: width values to disparity and, where they are not NULL, to right_disparity and confidence
 * (as in bsm_frame). Returns BSM_OK when a row was written, BSM_NEED_ROWS or BSM_END when not. */
BSM_API bsm_status bsm_pull_row(bsm_context* context, int16_t* disparity, int16_t* right_disparity, uint8_t* confidence);

/* Says that the rows pushed so far are the whole image; the rest can be pulled. Implied by pushing row height - 1. */
BSM_API bsm_status bsm_finish(bsm_context* context);

/* Drops the rows in flight; the next push is row 0 of a new image. */
BSM_API bsm_status bsm_reset(bsm_context* context);

/* Value of an invalid pixel: (min_disparity - 1) * 16. Dense maps have none. */
BSM_API int16_t bsm_invalid_disparity(const bsm_config* config);

/* One English sentence about a status, or its number in a build without text; never NULL. */
BSM_API const char* bsm_status_string(bsm_status status);

/* "major.minor.patch" of the library. */
BSM_API const char* bsm_version(void);

/* CPU features of this machine that kernels exist for, as bits; bsm_cpu_feature_name(bit) names one, NULL when it has none
 * and in a build without text. */
BSM_API uint32_t bsm_cpu_features(void);
BSM_API const char* bsm_cpu_feature_name(int32_t bit);

/* Name of the kernel that context runs for a stage, as "stage_operation_isa"; NULL for a bad argument, for stages that were
 * not built and in a build without text. */
BSM_API const char* bsm_kernel_name(const bsm_context* context, bsm_kernel kernel);

#ifdef __cplusplus
}
#endif

#endif /* BSM_BSM_H */
