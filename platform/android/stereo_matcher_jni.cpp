// The native half of bsm.StereoMatcher: checks what Java hands over, then calls the library. Every pointer into a buffer is
// within its capacity before it is used; what is wrong becomes a Java exception.
#include <jni.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "bsm/bsm.h"

namespace {

struct Matcher {
  bsm_config config;
  bsm_context* context;
  void* arena;
};

Matcher* matcher_of(jlong handle) {
  return reinterpret_cast<Matcher*>(static_cast<intptr_t>(handle));
}

void throw_java(JNIEnv* env, const char* type, const char* message) {
  const jclass exception = env->FindClass(type);
  if (exception != nullptr) env->ThrowNew(exception, message);
}

void throw_argument(JNIEnv* env, const char* message) {
  throw_java(env, "java/lang/IllegalArgumentException", message);
}

// Start of a direct buffer that holds `bytes` bytes, or nullptr with an exception pending.
uint8_t* address(JNIEnv* env, jobject buffer, int64_t bytes) {
  void* start = buffer == nullptr ? nullptr : env->GetDirectBufferAddress(buffer);
  if (start == nullptr) {
    throw_argument(env, "a buffer is null or not direct");
    return nullptr;
  }
  if (env->GetDirectBufferCapacity(buffer) < bytes) {
    throw_argument(env, "a buffer is smaller than its rows");
    return nullptr;
  }
  return static_cast<uint8_t*>(start);
}

// Bytes from the first pixel to the last of `rows` rows.
int64_t plane_bytes(int64_t stride, int64_t rows, int64_t row_bytes) {
  return stride * (rows - 1) + row_bytes;
}

// The order of two interleaved chroma planes, or -1: the later one begins at the second byte of the earlier.
int32_t chroma_order(const uint8_t* u, const uint8_t* v) {
  if (u + 1 == v) return BSM_FORMAT_NV12;
  if (v + 1 == u) return BSM_FORMAT_NV21;
  return -1;
}

// Fills image from the planes of a frame; false with an exception pending.
bool set_image(JNIEnv* env, const bsm_config& config, jobject y, jint y_stride, jobject u, jobject v, jint chroma_stride,
               bsm_image* image) {
  if (y_stride < config.width || chroma_stride < config.width) {
    throw_argument(env, "a stride is shorter than a row");
    return false;
  }
  // Each chroma plane ends with the last of its own bytes, which is one before the end of the row for the earlier plane.
  const int64_t chroma_bytes = plane_bytes(chroma_stride, config.height / 2, config.width - 1);
  const uint8_t* luma = address(env, y, plane_bytes(y_stride, config.height, config.width));
  const uint8_t* blue = luma == nullptr ? nullptr : address(env, u, chroma_bytes);
  const uint8_t* red = blue == nullptr ? nullptr : address(env, v, chroma_bytes);
  if (red == nullptr) return false;
  if (chroma_order(blue, red) != config.format) {
    throw_argument(env, "the chroma planes are not interleaved in the order that the matcher was made for");
    return false;
  }
  image->plane[0] = luma;
  image->plane[1] = config.format == BSM_FORMAT_NV12 ? blue : red;
  image->stride[0] = y_stride;
  image->stride[1] = chroma_stride;
  return true;
}

}  // namespace

extern "C" {

JNIEXPORT jint JNICALL Java_bsm_StereoMatcher_nativeFormat(JNIEnv* env, jclass, jobject u, jobject v) {
  const uint8_t* blue = address(env, u, 1);
  const uint8_t* red = blue == nullptr ? nullptr : address(env, v, 1);
  if (red == nullptr) return -1;
  const int32_t format = chroma_order(blue, red);
  if (format < 0) throw_argument(env, "the chroma planes are not interleaved");
  return format;
}

JNIEXPORT jlong JNICALL Java_bsm_StereoMatcher_nativeOpen(JNIEnv* env, jclass, jint width, jint height, jint disparities,
                                                          jint preset, jint format) {
  if (width % 2 != 0 || height % 2 != 0) {
    throw_argument(env, "width and height have to be even");
    return 0;
  }
  if (format != BSM_FORMAT_NV12 && format != BSM_FORMAT_NV21) {
    throw_argument(env, "the format has to be NV12 or NV21");
    return 0;
  }
  bsm_config config;
  bsm_config_init(&config, width, height);
  config.format = format;
  config.num_disparities = disparities;
  size_t bytes = 0;
  bsm_status status = bsm_config_preset(&config, static_cast<bsm_preset>(preset));
  if (status == BSM_OK) status = bsm_memory_required(&config, &bytes);
  if (status != BSM_OK) {
    throw_argument(env, bsm_status_string(status));
    return 0;
  }
  void* arena = std::malloc(bytes);
  Matcher* matcher = arena == nullptr ? nullptr : new (std::nothrow) Matcher{config, nullptr, arena};
  if (matcher == nullptr) {
    std::free(arena);
    throw_java(env, "java/lang/OutOfMemoryError", "no memory for the matcher");
    return 0;
  }
  status = bsm_open(&config, arena, bytes, &matcher->context);
  if (status != BSM_OK) {
    std::free(arena);
    delete matcher;
    throw_java(env, "java/lang/IllegalStateException", bsm_status_string(status));
    return 0;
  }
  return static_cast<jlong>(reinterpret_cast<intptr_t>(matcher));
}

JNIEXPORT void JNICALL Java_bsm_StereoMatcher_nativeClose(JNIEnv*, jclass, jlong handle) {
  Matcher* matcher = matcher_of(handle);
  std::free(matcher->arena);
  delete matcher;
}

JNIEXPORT void JNICALL Java_bsm_StereoMatcher_nativeMatch(JNIEnv* env, jclass, jlong handle, jobject left_y,
                                                          jint left_y_stride, jobject left_u, jobject left_v,
                                                          jint left_chroma_stride, jobject right_y, jint right_y_stride,
                                                          jobject right_u, jobject right_v, jint right_chroma_stride,
                                                          jobject disparities) {
  Matcher* matcher = matcher_of(handle);
  const bsm_config& config = matcher->config;
  bsm_frame frame{};
  if (!set_image(env, config, left_y, left_y_stride, left_u, left_v, left_chroma_stride, &frame.left)) return;
  if (!set_image(env, config, right_y, right_y_stride, right_u, right_v, right_chroma_stride, &frame.right)) return;
  const int64_t map_stride = int64_t{config.width} * 2;
  uint8_t* map = address(env, disparities, map_stride * config.height);
  if (map == nullptr) return;
  frame.disparity.data = reinterpret_cast<int16_t*>(map);
  frame.disparity.stride = static_cast<ptrdiff_t>(map_stride);
  const bsm_status status = bsm_process(matcher->context, &frame);
  if (status != BSM_OK) throw_argument(env, bsm_status_string(status));
}

}  // extern "C"
