package bsm;

import java.nio.ByteBuffer;

/**
 * Matches rectified pairs of camera frames (YUV_420_888 with interleaved chroma, that is NV12 or NV21) into disparity maps.
 *
 * <p>One matcher is used by one thread at a time. Frames are read in place: their buffers are direct, as those of
 * {@code Image.Plane} are, and are read from their first byte whatever their position.
 */
public final class StereoMatcher implements AutoCloseable {
  /** Presets, see bsm.h. {@link #BEST} takes about 1 KB of memory for each 4 pixels. */
  public static final int PAPER = 0, FAST = 1, BALANCED = 2, BEST = 3, LOCAL = 4;
  /** Orders of the chroma bytes: U V and V U. */
  public static final int NV12 = 6, NV21 = 7;

  static {
    System.loadLibrary("bsm_jni");
  }

  private long handle;

  /**
   * @param width even number of pixels in a row
   * @param height even number of rows
   * @param disparities how many whole disparities are searched, from 0 up
   * @param preset FAST, BALANCED and so on
   * @param format NV12 or NV21; {@link #formatOf} tells a camera's
   * @throws IllegalArgumentException when the library takes no such configuration
   */
  public StereoMatcher(int width, int height, int disparities, int preset, int format) {
    handle = nativeOpen(width, height, disparities, preset, format);
  }

  /** The order of two chroma planes: {@link #NV12} or {@link #NV21}; throws when they are not interleaved. */
  public static int formatOf(ByteBuffer u, ByteBuffer v) {
    return nativeFormat(u, v);
  }

  /**
   * Matches one pair. Strides are those of {@code Image.Plane.getRowStride()}.
   *
   * @param disparities receives width x height signed 16-bit values in the machine's byte order, in 1/16 pixel: a direct buffer
   *     of 2 width height bytes
   * @throws IllegalArgumentException when a buffer is not direct or too small, or the planes are not interleaved as said
   */
  public void match(
      ByteBuffer leftY, int leftYStride, ByteBuffer leftU, ByteBuffer leftV, int leftChromaStride,
      ByteBuffer rightY, int rightYStride, ByteBuffer rightU, ByteBuffer rightV, int rightChromaStride,
      ByteBuffer disparities) {
    if (handle == 0) throw new IllegalStateException("the matcher is closed");
    nativeMatch(handle, leftY, leftYStride, leftU, leftV, leftChromaStride,
        rightY, rightYStride, rightU, rightV, rightChromaStride, disparities);
  }

  /** Frees the matcher's memory. */
  @Override
  public void close() {
    if (handle == 0) return;
    nativeClose(handle);
    handle = 0;
  }

  private static native int nativeFormat(ByteBuffer u, ByteBuffer v);

  private static native long nativeOpen(int width, int height, int disparities, int preset, int format);

  private static native void nativeClose(long handle);

  private static native void nativeMatch(
      long handle, ByteBuffer leftY, int leftYStride, ByteBuffer leftU, ByteBuffer leftV, int leftChromaStride,
      ByteBuffer rightY, int rightYStride, ByteBuffer rightU, ByteBuffer rightV, int rightChromaStride,
      ByteBuffer disparities);
}
